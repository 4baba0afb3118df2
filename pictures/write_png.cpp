#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/map_check.h"
#include "majorant/pictures/images/png_file.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/bezier_image.h"
#include "majorant/pictures/internal/canvas.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/density_probe.h"
#include "majorant/pictures/internal/layout_drawing.h"
#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/internal/legend_drawing.h"
#include "majorant/pictures/internal/raster_scene.h"
#include "majorant/pictures/internal/rasterizer.h"
#include "majorant/pictures/pictures.h"
#include "majorant/pictures/turned_over.h"

namespace majorant {
namespace {

// Painters of pixel pictures.

using FloatColor = Eigen::Vector3d;  // sRGB, 0 to 255

// Gives colours to fragments. Called by several threads at a time.
class Painter {
 public:
  virtual ~Painter() = default;
  // Sets a colour for each sample with a cell; adds to the statistics of legends.
  virtual void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
                     ValueSummary& values) const = 0;
};

constexpr double kSquares = 40.0;  // at most, along the layout
const FloatColor kDark(79, 107, 135), kLight(242, 240, 232);

FloatColor as_float(Color c) {
  return {static_cast<double>(c.red), static_cast<double>(c.green), static_cast<double>(c.blue)};
}

// A square in the plane.
struct Square {
  Vector2 middle;
  double side;
};

// Returns a square around the layout with its larger side.
Square square_around(const MapFile& map) {
  const Vector2 low = map.uv.colwise().minCoeff(), high = map.uv.colwise().maxCoeff();
  const double side = (high - low).maxCoeff();
  return {0.5 * low + 0.5 * high, side > 0 ? side : 1};
}

// Returns the square of a texture: the unit square for layouts made for it, else the square around
// the layout.
Square texture_square(const MapFile& map) {
  if (is_for_unit_square(map)) return {{0.5, 0.5}, 1};
  return square_around(map);
}

// Paints one colour a cell.
class CellPainter final : public Painter {
 public:
  explicit CellPainter(CellColors colors) : colors_(std::move(colors)) {}
  void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
             ValueSummary&) const override {
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (samples[k].cell >= 0) colors[k] = as_float(colors_[to_size(samples[k].cell)]);
  }

 private:
  CellColors colors_;
};

// Paints the background of grid lines.
class LightPainter final : public Painter {
 public:
  void paint(std::span<const Fragment>, std::span<FloatColor> colors,
             ValueSummary&) const override {
    std::fill(colors.begin(), colors.end(), kLight);
  }
};

// Paints functions of uv.
class TexturePainter : public Painter {
 public:
  explicit TexturePainter(const MapFile& map) : image_(map, 1) {}
  void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
             ValueSummary&) const final {
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (samples[k].cell >= 0) colors[k] = color(image_.uv(samples[k].cell, samples[k].xi));
  }

 private:
  virtual FloatColor color(const Vector2& uv) const = 0;
  BezierImage image_;
};

class CheckerPainter final : public TexturePainter {
 public:
  // count: squares along the texture's square; none: the width that PngOptions describes.
  CheckerPainter(const MapFile& map, const std::optional<int>& count) : TexturePainter(map) {
    if (count) {
      const Square square = texture_square(map);
      width_ = square.side / *count;
      corner_ = square.middle.array() - 0.5 * square.side;
      return;
    }
    width_ = round_spacing(square_around(map).side / kSquares);
  }

 private:
  FloatColor color(const Vector2& uv) const override {
    const Vector2 place = (uv - corner_) / width_;
    const double number = std::floor(place[0]) + std::floor(place[1]);
    return std::fmod(number, 2.0) == 0 ? kLight : kDark;
  }
  Vector2 corner_ = Vector2::Zero();
  double width_;
};

class ImagePainter final : public TexturePainter {
 public:
  ImagePainter(const MapFile& map, PixelImage image)
      : TexturePainter(map), square_(texture_square(map)), texture_(std::move(image)) {}

 private:
  FloatColor color(const Vector2& uv) const override {
    const Vector2 t = (uv - square_.middle) / square_.side;
    const double x = (t[0] + 0.5) * texture_.width - 0.5;
    const double y = (0.5 - t[1]) * texture_.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const double right = x - left, below = y - top;
    return (1 - below) * ((1 - right) * pixel(left, top) + right * pixel(left + 1, top)) +
           below * ((1 - right) * pixel(left, top + 1) + right * pixel(left + 1, top + 1));
  }
  FloatColor pixel(double x, double y) const {
    const auto repeated = [](double place, int count) {
      const double rest = place - count * std::floor(place / count);
      return static_cast<int>(std::clamp(rest, 0.0, count - 1.0));
    };
    return as_float(texture_.at(repeated(x, texture_.width), repeated(y, texture_.height)));
  }
  Square square_;
  PixelImage texture_;
};

class HeatPainter final : public Painter {
 public:
  HeatPainter(const MapFile& map, Quantity quantity, const EnergySum& energy, ColorScale scale)
      : image_(map, layout_scale(map)),
        quantity_(quantity),
        density_(energy),
        scale_(std::move(scale)) {}

  void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
             ValueSummary& values) const override {
    std::vector<Vector2> sigma(samples.size(), Vector2::Ones());
    std::vector<char> is_over(samples.size(), 0);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (samples[k].cell < 0) continue;
      const BezierImage::Point point = image_.at(samples[k].cell, samples[k].xi);
      sigma[k] = {point.distortion.sigma_1, point.distortion.sigma_2};
      is_over[k] = std::isfinite(sigma[k][1]) ? !(sigma[k][1] > 0) : point.determinant < 0;
    }
    std::vector<double> value(samples.size());
    evaluate(quantity_, density_, sigma, value);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (samples[k].cell < 0) continue;
      const bool has_area = std::isfinite(sigma[k][1]);
      if (has_area && !is_over[k] && !samples[k].is_line) values.add(scale_, value[k]);
      colors[k] = as_float(is_over[k] ? kFlippedColor
                           : has_area ? scale_.color(value[k])
                                      : kNoAreaColor);
    }
  }

 private:
  BezierImage image_;
  Quantity quantity_;
  DensityProbe density_;
  ColorScale scale_;
};

// Paints points at which these cells are turned over in their colour, and all others by another
// painter.
class TurnedOverPainter final : public Painter {
 public:
  TurnedOverPainter(const MapFile& map, const std::vector<Index>& over,
                    std::unique_ptr<Painter> others)
      : image_(map, 1),
        is_over_(to_size(static_cast<Index>(map.cells.rows()))),
        others_(std::move(others)) {
    for (const Index cell : over) is_over_[to_size(cell)] = true;
  }

  void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
             ValueSummary& values) const override {
    others_->paint(samples, colors, values);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const Index cell = samples[k].cell;
      const Barycentric& xi = samples[k].xi;
      if (cell >= 0 && is_over_[to_size(cell)] && !(image_.at(cell, xi).determinant > 0))
        colors[k] = as_float(kFlippedColor);
    }
  }

 private:
  BezierImage image_;
  std::vector<bool> is_over_;
  std::unique_ptr<Painter> others_;
};

// Paints lines of constant u and v over another painter.
class GridPainter final : public Painter {
 public:
  GridPainter(const MapFile& map, double spacing, std::unique_ptr<Painter> below)
      : image_(map, 1), spacing_(spacing), below_(std::move(below)) {}

  void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
             ValueSummary& values) const override {
    constexpr double kHalfLine = 1.0 / 24;  // of the spacing
    below_->paint(samples, colors, values);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (samples[k].cell < 0) continue;
      const Vector2 place = image_.uv(samples[k].cell, samples[k].xi) / spacing_;
      const Vector2 off = (place - place.array().round().matrix()).cwiseAbs();
      if (off.minCoeff() < kHalfLine) colors[k] = as_float(kGridColor);
    }
  }

 private:
  BezierImage image_;
  double spacing_;
  std::unique_ptr<Painter> below_;
};

std::unique_ptr<Painter> plain_painter(const MapFile& map, const std::vector<Index>& over) {
  return std::make_unique<TurnedOverPainter>(map, over,
                                             std::make_unique<CellPainter>(plain_colors(map)));
}

// Returns a painter of a checkerboard, or of a grid if its spacing is not 0.
std::unique_ptr<Painter> textured_painter(const MapFile& map, double spacing,
                                          const std::optional<int>& squares,
                                          const std::vector<Index>& over) {
  std::unique_ptr<Painter> texture;
  if (spacing > 0)
    texture = std::make_unique<GridPainter>(map, spacing, std::make_unique<LightPainter>());
  else
    texture = std::make_unique<CheckerPainter>(map, squares);
  return std::make_unique<TurnedOverPainter>(map, over, std::move(texture));
}

// write_png.h describes where the image lies.
std::unique_ptr<Painter> image_painter(const MapFile& map, PixelImage image) {
  return std::make_unique<ImagePainter>(map, std::move(image));
}

// energy: for the density. Cells whose surface triangle has no area are kNoAreaColor.
std::unique_ptr<Painter> heat_painter(const MapFile& map, Quantity quantity,
                                      const EnergySum& energy, const ColorScale& scale) {
  return std::make_unique<HeatPainter>(map, quantity, energy, scale);
}

const FloatColor kCut(194, 24, 91);

void require_usable(const PngOptions& options) {
  for (const int side : {options.width, options.height})
    if (side < PngOptions::kSmallest || side > PngOptions::kLargest)
      throw Error(ErrorKind::Usage,
                  fmt::format("a picture of {} x {} pixels: sides are {} to {}", options.width,
                              options.height, PngOptions::kSmallest, PngOptions::kLargest));
  const Vector3 view = options.view.value_or(Vector3::UnitZ());
  if (!view.allFinite() || view.isZero(0))
    throw Error(ErrorKind::Usage,
                fmt::format("a view from ({:g}, {:g}, {:g}) is from nowhere; give the direction to "
                            "the eye",
                            view.x(), view.y(), view.z()));
  if (options.squares && *options.squares < 1)
    throw Error(ErrorKind::Usage,
                fmt::format("a checkerboard of {} squares; give 1 or more", *options.squares));
  if (options.image && options.quantity)
    throw Error(ErrorKind::Usage, "an image and a heat map lie on top of each other; choose one");
}

// Returns the quantity shown by colours: the requested one, or the density on a layout that has
// one.
std::optional<Quantity> heat_of(const MapFile& map, const PngOptions& options) {
  if (options.quantity || options.view || options.image) return options.quantity;
  if (claimed_energy(map).name.empty()) return {};
  return Quantity::Density;
}

// The light on the surface, and the colour of lines.
class SurfaceShade {
 public:
  SurfaceShade(const MapFile& map, const Vector3& view)
      : normals_(map), eye_(view.stableNormalized()) {}

  FloatColor operator()(const Fragment& sample, const FloatColor& color) const {
    const double light = std::abs(normals_.at(sample.cell, sample.xi).dot(eye_));
    return (kDarkest + (1 - kDarkest) * light) * (sample.is_line ? kCut : color);
  }

 private:
  SmoothNormals normals_;
  Vector3 eye_;
};

// Averages a row of pixels over the samples that have a cell.
void average(std::span<const Fragment> samples, std::span<const FloatColor> colors,
             std::span<CoveredColor> row) {
  for (std::size_t x = 0; x < row.size(); ++x) {
    CoveredColor sum = CoveredColor::Zero();
    for (std::size_t k = x * kSamplesPerPixel; k < (x + 1) * kSamplesPerPixel; ++k)
      if (samples[k].cell >= 0) sum += CoveredColor(colors[k][0], colors[k][1], colors[k][2], 1);
    row[x] = sum / kSamplesPerPixel;
  }
}

struct DrawnPixels {
  std::vector<CoveredColor> pixels;
  ValueSummary values;  // statistics of the samples for legends
};

DrawnPixels draw_triangles(const std::vector<RasterTriangle>& triangles, const Painter& painter,
                           const std::optional<SurfaceShade>& shade, PixelSize size) {
  DrawnPixels drawn;
  drawn.pixels.resize(to_size(size.width) * to_size(size.height));
  std::vector<ValueSummary> rows(to_size(size.height));
  rasterize(triangles, size, [&](int y, std::span<const Fragment> samples) {
    std::vector<FloatColor> colors(samples.size(), FloatColor::Zero());
    painter.paint(samples, colors, rows[y]);
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (samples[k].cell >= 0 && shade) colors[k] = (*shade)(samples[k], colors[k]);
    average(samples, colors,
            std::span(drawn.pixels).subspan(to_size(y) * to_size(size.width), to_size(size.width)));
  });
  for (const ValueSummary& row : rows) drawn.values.add(row);
  return drawn;
}

// marks: the grid of a surface (that of a layout is drawn), the cells that are turned over.
std::unique_ptr<Painter> painter_of(const MapFile& map, const PngOptions& options,
                                    const std::optional<Quantity>& heat, const LayoutMarks& marks) {
  const double spacing = options.view ? LayoutSheet(map, marks, {}).grid_spacing() : 0;
  const auto with_grid = [&](std::unique_ptr<Painter> painter) -> std::unique_ptr<Painter> {
    if (spacing == 0) return painter;
    return std::make_unique<GridPainter>(map, spacing, std::move(painter));
  };
  if (heat)
    return with_grid(heat_painter(map, *heat, claimed_energy(map).sum,
                                  picture_scale(claimed_energy(map), *heat, options.color_range)));
  if (options.image)
    return with_grid(image_painter(map, pixels_of_png("the image", *options.image)));
  return options.view ? textured_painter(map, spacing, options.squares, marks.turned_over)
                      : plain_painter(map, marks.turned_over);
}

// A drawing and its final legend.
struct Drawn {
  DrawnPixels of;
  std::optional<Legend> legend;
};

// A legend takes room and describes the map that is drawn in the rest. The map is therefore drawn
// with a legend without statistics first. If these need more lines, it is drawn again with the
// largest legend. draw: makes a drawing with a given legend.
Drawn draw_under_legend(const MapFile& map, const PngOptions& options,
                        const std::optional<Quantity>& heat,
                        const std::function<DrawnPixels(const std::optional<Legend>&)>& draw) {
  if (!heat) return {draw({}), {}};
  const auto note_of = [](const Legend& legend, const ValueSummary& values) {
    return with_values(legend, values, "samples");
  };
  Legend legend =
      make_legend(map, *heat, picture_scale(claimed_energy(map), *heat, options.color_range));
  const auto lines_with = [&](const ValueSummary& values) {
    return note_lines(note_of(legend, values), LayoutSheet::kWidth);
  };
  legend.note_lines = note_lines(legend, LayoutSheet::kWidth);
  DrawnPixels drawn = draw(legend);
  if (lines_with(drawn.values) > legend.note_lines) {
    const auto all = std::int64_t{options.width} * options.height * kSamplesPerPixel;
    legend.note_lines = lines_with({all, all, all});
    drawn = draw(legend);
  }
  const ValueSummary values = drawn.values;
  return {std::move(drawn), note_of(legend, values)};
}

PixelImage surface_image(const MapFile& map, const PngOptions& options) {
  const std::optional<Quantity> heat = heat_of(map, options);
  const double scale = options.width / LayoutSheet::kWidth;
  LayoutMarks seen;
  seen.grid = options.grid;
  seen.turned_over = turned_over_cells(map);
  seen.without_area = cells_without_area(map);
  const auto legends_with = [&](const std::optional<Legend>& legend) {
    if (options.legends == Legends::Left) return DrawnLegends({}, {}, LayoutSheet::kWidth);
    std::vector<LegendMark> marks;
    const LegendAbove above = heat ? LegendAbove::Colors : LegendAbove::Nothing;
    if (!seen.turned_over.empty())
      marks.push_back(turned_over_mark(seen.turned_over.size(), above));
    if (!seen.without_area.empty())
      marks.push_back(without_area_mark(seen.without_area.size(), above));
    return DrawnLegends(legend, std::move(marks), LayoutSheet::kWidth);
  };
  const auto painter = painter_of(map, options, heat, seen);
  PixelSize size{options.width, options.height};
  const Drawn drawn = draw_under_legend(map, options, heat, [&](const auto& legend) {
    const DrawnLegends legends = legends_with(legend);
    require_room(LayoutSheet::kWidth, options.height / scale,
                 {legends.least_width(), legends.height()}, scale);
    size.height = options.height - static_cast<int>(std::lround(scale * legends.height()));
    const auto triangles = surface_triangles(map, *options.view, size);
    return draw_triangles(triangles, *painter, SurfaceShade(map, *options.view), size);
  });
  Canvas canvas({options.width, options.height}, scale, options.paper);
  canvas.lay(drawn.of.pixels);
  const DrawnLegends legends = legends_with(drawn.legend);
  const double top = size.height / scale;
  canvas.paint(legends.items(top, top + legends.height()));
  return canvas.image();
}

// Draws as write_svg() does, with colours per pixel.
PixelImage layout_image(const MapFile& map, const LayoutMarks& marks, const PngOptions& options) {
  const std::optional<Quantity> heat = heat_of(map, options);
  const PixelSize size{options.width, options.height};
  const double scale = size.width / LayoutSheet::kWidth;
  const auto sheet_with = [&](const std::optional<Legend>& legend) {
    return LayoutSheet(map, marks, {.colors = legend, .height = size.height / scale});
  };
  const auto painter = painter_of(map, options, heat, marks);
  const Drawn drawn = draw_under_legend(map, options, heat, [&](const auto& legend) {
    const LayoutSheet sheet = sheet_with(legend);
    require_room(sheet.width(), sheet.height(), sheet.legend_room(), scale);
    auto triangles = layout_triangles(map, scale * sheet.scale(), [&](const Vector2& uv) {
      return Vector2(scale * sheet.place(uv));
    });
    for (RasterTriangle& t : triangles)  // over all others
      if (std::binary_search(marks.turned_over.begin(), marks.turned_over.end(), t.cell))
        t.depth = {1, 1, 1};
    return draw_triangles(triangles, *painter, {}, size);
  });
  const LayoutDrawing drawing = draw_layout(sheet_with(drawn.legend), {}, CellFill::Nothing);
  Canvas canvas(size, scale, options.paper);
  canvas.paint(drawing.behind);
  canvas.lay(drawn.of.pixels);
  if (!options.image) canvas.paint(drawing.cells);  // an image has no edges over it
  canvas.paint(drawing.over);
  return canvas.image();
}

}  // namespace

void write_png(const std::string& path, const MapFile& map, const PngOptions& options) {
  require_usable(options);
  require_sound(path, map);
  // A surface is drawn with the file's uv, not turned.
  if (options.view) return write_file_atomically(path, encode_png(surface_image(map, options)));
  if (options.scaffold) require_sound("scaffold", *options.scaffold);
  const Vector2 direction = picture_direction(map, options.alignment);
  const MapFile shown = turned(map, direction);
  LayoutMarks marks = marks_of(map, direction, options.grid, options.scaffold, options.points);
  marks.edges = options.edges;
  marks.legends = options.legends;
  write_file_atomically(path, encode_png(layout_image(shown, marks, options)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
