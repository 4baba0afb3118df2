// The layout of a map as a drawing, with its legends.
//
//  const LayoutSheet sheet(map, marks, {.colors = legend});
//  sheet.place(uv);                                     // in units of the drawing
//  const LayoutDrawing drawing = draw_layout(sheet, colors, CellFill::Colors);
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "majorant/maps/map_file.h"
#include "majorant/pictures/internal/drawing.h"
#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/internal/legend_drawing.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// The places where a layout meets itself.
struct LayoutMeeting {
  std::vector<Vector2> places;  // uv; empty: none, or unknown
  std::string words;            // "overlaps itself near (0.25, 1.5)"
};

// Finds these places by the boundary of the map. Empty for maps with cones, whose images usually
// overlap, and for cells that form no surface.
LayoutMeeting meeting_of(const MapFile& map);

// The marks of a drawing besides cells, in the plane of the map.
struct LayoutMarks {
  std::optional<double> grid = {};  // see SvgOptions
  Vector2 direction{1, 0};  // was turned to (1, 0); grid lines have constant u and v of the file
  std::optional<MapFile> scaffold = {};
  std::vector<Vector2> unit_square = {};  // corners; for layouts that were made for it and lie in
                                          // it
  std::vector<PagePoint> points = {};
  LayoutMeeting meeting = {};
  CellEdges edges = CellEdges::Drawn;
  Legends legends = Legends::Drawn;
  std::vector<Index> turned_over = {};   // cells, ascending: kFlippedColor, over all others
  std::vector<Index> without_area = {};  // cells, ascending: kNoAreaColor
};

// Returns the marks of a map that is drawn with `direction` turned to (1, 0). Marks are turned,
// labels are not.
LayoutMarks marks_of(const MapFile& map, const Vector2& direction,
                     const std::optional<double>& grid, const std::optional<MapFile>& scaffold,
                     const std::vector<PagePoint>& points);

// Returns 1, 2 or 5 times a power of ten, at least `least`; 0 if that is not positive.
double round_spacing(double least);

// The colours of cells without area on the surface, and of plain cells.
inline constexpr Color kNoAreaColor{221, 221, 221};
inline constexpr Color kGridColor{20, 50, 122};
// Returns blue for index > 0 (angle < 360 degrees), green for index < 0.
Color cone_color(int quarter_turns);

// The arrangement of a drawing: the layout, as large as possible, above its legends.
class LayoutSheet {
 public:
  static constexpr double kWidth = 1000;
  static constexpr double kMargin = kDrawingMargin;

  struct Format {
    std::optional<Legend> colors = {};  // the legend of the cells' colours
    double width = kWidth;
    std::optional<double> height = {};  // none: as high as needed
    std::optional<double> scale = {};   // largest scale(); none: as large as fits
  };

  // Map and marks must outlive this. Throws Error(Usage) for a grid that cannot be drawn.
  LayoutSheet(const MapFile& map, const LayoutMarks& marks, const Format& format);

  const MapFile& map() const { return map_; }
  const LayoutMarks& marks() const { return marks_; }
  double width() const { return width_; }
  double height() const { return height_; }
  double layout_height() const { return layout_height_; }  // including margins
  const std::optional<Legend>& colors() const { return colors_; }
  const DrawnLegends& legends() const { return legends_; }
  LegendRoom legend_room() const { return {legends_.least_width(), legends_.height()}; }
  // These return corners of the box around the layout and the targets of points, and half its
  // larger side; the side itself may overflow.
  const Vector2& low() const { return low_; }
  const Vector2& high() const { return high_; }
  double half_size() const { return (0.5 * high_ - 0.5 * low_).maxCoeff(); }
  double grid_spacing() const { return grid_spacing_; }  // 0: no grid
  // Returns a twentieth of the typical cell, at most the width of thin lines.
  double stroke_width() const;

  // Returns a place in units of the drawing, with the v axis up.
  Vector2 place(const Vector2& uv) const;
  Vector2 place(Index point) const { return place(Vector2(map_.uv.row(point))); }
  // Returns the units of the drawing per unit of uv.
  double scale() const { return 0.5 * scale_; }

  // Continues a path along edge 0 (01), 1 (12) or 2 (20) of a cell, from its start, where the path
  // must be. The map has the same degree and plane. Exact up to degree 3, then in Hermite cubics.
  void add_edge(Path& path, const MapFile& map, Index cell, int edge) const;
  // Adds the outline of a cell.
  void add_cell(Path& path, const MapFile& map, Index cell) const;

 private:
  const MapFile& map_;
  const LayoutMarks& marks_;
  std::optional<Legend> colors_;
  DrawnLegends legends_{{}, {}, kWidth};
  Vector2 low_, high_, corner_;  // corner_: place of the box
  double scale_ = 1;             // units of the drawing per half unit of uv
  double width_ = kWidth, height_ = 0, layout_height_ = 0, grid_spacing_ = 0;
  std::array<std::vector<int>, 3> edges_;  // local control points
};

// The parts of a drawing, in painting order.
struct LayoutDrawing {
  std::vector<DrawingItem> behind;  // the scaffold
  std::vector<DrawingItem> cells;   // with colours and edges
  std::vector<DrawingItem> over;    // marks and legends
  std::string description;
};

// Colours of cells; empty: those of charts, or one grey.
using CellColors = std::vector<Color>;
// Returns pale colours of charts on white, or one grey.
CellColors plain_colors(const MapFile& map);
// The filling of cells: their colours, or nothing if pixels lie below their edges.
enum class CellFill { Colors, Nothing };

LayoutDrawing draw_layout(const LayoutSheet& sheet, const std::optional<CellColors>& colors,
                          CellFill fill);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
