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

// Where a layout meets itself.
struct LayoutMeeting {
  std::vector<Vector2> places;  // uv; empty: nowhere, or nobody knows
  std::string words;            // "overlaps itself near (0.25, 1.5)"
};

// From the boundary of the map. Nowhere: of maps with cones, whose images overlap as a rule, and of
// cells that are no surface.
LayoutMeeting meeting_of(const MapFile& map);

// What is drawn besides cells, in the plane of the map.
struct LayoutMarks {
  std::optional<double> grid = {};  // as of SvgOptions
  Vector2 direction{1, 0};          // what was turned to (1, 0): lines are those of u and v before
  std::optional<MapFile> scaffold = {};
  std::vector<Vector2> unit_square = {};  // its corners, around layouts made for it that lie in it
  std::vector<PagePoint> points = {};
  LayoutMeeting meeting = {};
  CellEdges edges = CellEdges::Drawn;
  Legends legends = Legends::Drawn;
  std::vector<Index> turned_over = {};   // cells, rising: kFlippedColor, over all others
  std::vector<Index> without_area = {};  // cells, rising: kNoAreaColor, without a value
};

// Of a map whose drawing has `direction` turned to (1, 0): the marks are turned, too, words are
// not.
LayoutMarks marks_of(const MapFile& map, const Vector2& direction,
                     const std::optional<double>& grid, const std::optional<MapFile>& scaffold,
                     const std::vector<PagePoint>& points);

// 1, 2 or 5 times a power of ten, at least `least`; 0 where that is not positive.
double round_spacing(double least);

// Cells without an area on the surface, and plain ones.
inline constexpr Color kNoAreaColor{221, 221, 221};
inline constexpr Color kGridColor{20, 50, 122};
// Blue for index > 0 (angle < 360 degrees), green for index < 0.
Color cone_color(int quarter_turns);

// Places of a drawing: the layout, as large as it fits, above its legends.
class LayoutSheet {
 public:
  static constexpr double kWidth = 1000;
  static constexpr double kMargin = kDrawingMargin;

  struct Format {
    std::optional<Legend> colors = {};  // what cells are coloured by
    double width = kWidth;
    std::optional<double> height = {};  // none: what it needs
    std::optional<double> scale = {};   // scale(), at most what fits; none: that
  };

  // Map and marks must outlive it. Throws Error(Usage) for a grid that cannot be drawn.
  LayoutSheet(const MapFile& map, const LayoutMarks& marks, const Format& format);

  const MapFile& map() const { return map_; }
  const LayoutMarks& marks() const { return marks_; }
  double width() const { return width_; }
  double height() const { return height_; }
  double layout_height() const { return layout_height_; }  // with margins
  const std::optional<Legend>& colors() const { return colors_; }
  const DrawnLegends& legends() const { return legends_; }
  LegendRoom legend_room() const { return {legends_.least_width(), legends_.height()}; }
  // Corners of the box around the layout and the targets of points, and half its larger side: the
  // extent of two finite numbers may overflow.
  const Vector2& low() const { return low_; }
  const Vector2& high() const { return high_; }
  double half_size() const { return (0.5 * high_ - 0.5 * low_).maxCoeff(); }
  double grid_spacing() const { return grid_spacing_; }  // 0: none
  // A twentieth of the typical cell, thin lines at most.
  double stroke_width() const;

  // In units of the drawing, the v axis up.
  Vector2 place(const Vector2& uv) const;
  Vector2 place(Index point) const { return place(Vector2(map_.uv.row(point))); }
  // Units of the drawing a unit of uv.
  double scale() const { return 0.5 * scale_; }

  // Goes on along edge 0 (01), 1 (12) or 2 (20) of a cell of a map of the same degree in the same
  // plane, from where the path is, its start: exactly to degree 3, then in Hermite cubics.
  void add_edge(Path& path, const MapFile& map, Index cell, int edge) const;
  // The outline of a cell.
  void add_cell(Path& path, const MapFile& map, Index cell) const;

 private:
  const MapFile& map_;
  const LayoutMarks& marks_;
  std::optional<Legend> colors_;
  DrawnLegends legends_{{}, {}, kWidth};
  Vector2 low_, high_, corner_;  // corner_: where the box is placed
  double scale_ = 1;             // units of the drawing a half unit of uv
  double width_ = kWidth, height_ = 0, layout_height_ = 0, grid_spacing_ = 0;
  std::array<std::vector<int>, 3> edges_;  // local control points
};

// The parts of a drawing, in the order in which they are painted.
struct LayoutDrawing {
  std::vector<DrawingItem> behind;  // the scaffold
  std::vector<DrawingItem> cells;   // their colours and edges
  std::vector<DrawingItem> over;    // marks, legends
  std::string description;
};

// Colours of cells; none: those of charts, or one grey.
using CellColors = std::vector<Color>;
// On white: pale ones of charts, or one grey.
CellColors plain_colors(const MapFile& map);
// What fills cells in a drawing: their colours, or nothing, where pixels lie below their edges.
enum class CellFill { Colors, Nothing };

LayoutDrawing draw_layout(const LayoutSheet& sheet, const std::optional<CellColors>& colors,
                          CellFill fill);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
