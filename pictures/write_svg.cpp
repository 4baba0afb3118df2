#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/map_check.h"
#include "majorant/maps/measure.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/layout_drawing.h"
#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/internal/legend_drawing.h"
#include "majorant/pictures/page_text.h"
#include "majorant/pictures/pictures.h"

namespace majorant {
namespace {

// Writes a drawing as text. Numbers have three decimals. Coordinates of paths are relative to the
// written position of the pen, so that rounding errors do not accumulate.
class SvgWriter {
 public:
  void write(const Drawing& drawing) {
    add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" role=\"img\">\n",
        drawing.width, drawing.height);
    add("<title>{}</title>\n<desc>{}</desc>\n", html_text(drawing.title),
        html_text(drawing.description));
    if (drawing.paper == Paper::White)
      add("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", drawing.width, drawing.height);
    // Common attributes.
    add("<g fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" "
        "font-family=\"sans-serif\">\n");
    for (const DrawingItem& item : drawing.items)
      std::visit([this](const auto& one) { write(one); }, item);
    add("</g>\n</svg>\n");
  }

  std::string text() const { return fmt::to_string(buffer_); }

 private:
  struct Thousandths {
    long long x = 0, y = 0;
  };

  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
  }

  static Thousandths rounded(const Vector2& p) {
    return {std::llround(1000.0 * p.x()), std::llround(1000.0 * p.y())};
  }

  // Writes no trailing zeros, no zero before the point, no -0.
  void add_thousandths(long long value) {
    const auto magnitude = std::llabs(value);
    if (value < 0) add("-");
    if (magnitude >= 1000 || value == 0) add("{}", magnitude / 1000);
    const auto rest = magnitude % 1000;
    if (rest == 0) return;
    const std::string digits = fmt::format(".{:03}", rest);
    add("{}", std::string_view(digits).substr(0, digits.find_last_not_of('0') + 1));
  }

  void add_number(double value) { add_thousandths(std::llround(1000.0 * value)); }

  // A sign also separates numbers.
  void add_separated(long long value) {
    if (value >= 0) add(" ");
    add_thousandths(value);
  }

  void add_path(const Path& path) {
    Thousandths pen, start;
    const Vector2* p = path.points.data();
    bool is_first = true;
    char last = 0;
    for (const Path::Verb verb : path.verbs) {
      const int count = point_count(verb);
      const char letter = is_first ? 'M' : "mlqcz"[static_cast<std::size_t>(verb)];
      // A repeated verb needs no letter, except after a move, where it would mean lines.
      const bool goes_on = letter == last && verb != Path::Verb::Move && count > 0;
      if (!goes_on) add("{}", letter);
      Thousandths at = pen;
      for (int k = 0; k < count; ++k) {
        at = rounded(p[k]);
        if (k == 0 && !goes_on)
          add_thousandths(at.x - pen.x);
        else
          add_separated(at.x - pen.x);
        add_separated(at.y - pen.y);
      }
      p += count;
      pen = verb == Path::Verb::Close ? start : at;
      if (verb == Path::Verb::Move) start = pen;
      last = letter;
      is_first = false;
    }
  }

  void add_stroke(const std::optional<Stroke>& stroke) {
    if (stroke) add(" stroke=\"{}\" stroke-width=\"{:.3g}\"", stroke->color.hex(), stroke->width);
  }

  void write(const Shape& shape) {
    add("<path");
    if (shape.fill) add(" fill=\"{}\"", shape.fill->hex());
    add_stroke(shape.stroke);
    add(" d=\"");
    add_path(shape.path);
    add("\"/>\n");
  }

  void write(const Circle& circle) {
    add("<circle cx=\"");
    add_number(circle.center.x());
    add("\" cy=\"");
    add_number(circle.center.y());
    add("\" r=\"{:.4g}\"", circle.radius);
    if (circle.fill) add(" fill=\"{}\"", circle.fill->hex());
    add_stroke(circle.stroke);
    add("/>\n");
  }

  void write(const Label& label) {
    add("<text font-size=\"{:.3g}\" fill=\"{}\"", label.size, label.color.hex());
    if (label.anchor == Label::Anchor::Middle) add(" text-anchor=\"middle\"");
    if (label.halo > 0)
      add(" stroke=\"#ffffff\" stroke-width=\"{:.3g}\" paint-order=\"stroke\"", label.halo);
    add(" x=\"");
    add_number(label.at.x());
    add("\" y=\"");
    add_number(label.at.y());
    add("\">{}</text>\n", html_text(label.text));
  }

  void write(const Clipped& clipped) {
    add("<clipPath id=\"{}\"><path d=\"", clipped.name);
    add_path(clipped.clip);
    add("\"/></clipPath>\n<g clip-path=\"url(#{})\">\n", clipped.name);
    for (const Shape& shape : clipped.shapes) write(shape);
    add("</g>\n");
  }

  fmt::memory_buffer buffer_;
};

// Colours of cells, and statistics of their values for legends.
struct Heat {
  CellColors colors;
  ValueSummary values;
};

constexpr const char* kParts = "triangle means";

// Returns means over cells.
Vec cell_values(const MapFile& map, Quantity quantity) {
  const FaceDistortion faces =
      map.face_distortion.rows() > 0 ? map.face_distortion : measure_distortion(map).faces;
  const Index column = quantity == Quantity::SigmaMax   ? 0
                       : quantity == Quantity::SigmaMin ? 1
                       : quantity == Quantity::Area     ? 2
                                                        : 3;
  return faces.col(column);
}

// Returns means of the density of an energy, which may differ from that of the file.
Vec cell_densities(const MapFile& map, const ClaimedEnergy& energy) {
  const bool is_known = map.distortion.size() > 0 && claimed_energy(map).name == energy.name;
  if (is_known) return map.distortion;
  const BezierMap in_file = to_bezier_map(map, "layout");
  const BezierMap in_model_units =
      in_file.with(in_file.shared_space(), layout_scale(map) * in_file.control_points());
  Vec densities;
  mean_density(in_model_units, rest_shapes(in_file.mesh()), energy.sum, densities);
  return densities;
}

// Excludes cells that are turned over or without area, by the marks.
Heat heat_of(const ColorScale& scale, const Vec& cells, const LayoutMarks& marks) {
  Heat heat;
  const auto is_in = [](const std::vector<Index>& rising, Index cell) {
    return std::binary_search(rising.begin(), rising.end(), cell);
  };
  for (Index cell = 0; cell < cells.size(); ++cell) {
    const bool has_area = !is_in(marks.without_area, cell);
    heat.colors.push_back(has_area ? scale.color(cells[cell]) : kNoAreaColor);
    if (has_area && !is_in(marks.turned_over, cell)) heat.values.add(scale, cells[cell]);
  }
  return heat;
}

Error no_density() {
  return Error(ErrorKind::Usage,
               "the map has no density: no energy is claimed that it could be of, or none was "
               "measured");
}

// Returns the requested quantity; else the density, if the cells have one and its energy is known.
std::optional<Quantity> shown_quantity(const MapFile& map, const SvgOptions& options) {
  if (options.quantity && options.quantity != Quantity::Density) return options.quantity;
  const bool is_known = map.distortion.size() > 0 && !claimed_energy(map).name.empty();
  if (is_known) return Quantity::Density;
  if (options.quantity) throw no_density();
  return {};
}

void require_usable(const SheetSize& size) {
  for (const int side : {size.width, size.height})
    if (side < PngOptions::kSmallest || side > PngOptions::kLargest)
      throw Error(ErrorKind::Usage,
                  fmt::format("a sheet of {} x {} px: sides are {} to {}", size.width, size.height,
                              PngOptions::kSmallest, PngOptions::kLargest));
}

LayoutMarks drawn_marks(const MapFile& map, const Vector2& direction, const SvgOptions& options) {
  LayoutMarks marks = marks_of(map, direction, options.grid, options.scaffold, options.points);
  marks.edges = options.edges;
  marks.legends = options.legends;
  return marks;
}

LayoutSheet::Format format_of(const SvgOptions& options) {
  LayoutSheet::Format format;
  if (!options.size) return format;
  require_usable(*options.size);
  format.width = options.size->width;
  format.height = options.size->height;
  return format;
}

void append(std::vector<DrawingItem>& items, LayoutDrawing parts) {
  for (auto* more : {&parts.behind, &parts.cells, &parts.over})
    items.insert(items.end(), std::make_move_iterator(more->begin()),
                 std::make_move_iterator(more->end()));
}

// One of two maps side by side.
struct Half {
  MapFile map;
  LayoutMarks marks;
  double unit = 1;  // surface units per unit of uv
  std::optional<CellColors> colors = {};
  std::vector<std::string> caption = {};

  // height: of the layout; none: as needed. scale: units of the drawing per unit of the surface.
  LayoutSheet sheet(double width, const std::optional<double>& height, double scale) const {
    LayoutSheet::Format format{.width = width, .scale = scale * unit};
    if (height) format.height = *height + LayoutSheet(map, marks, format).legends().height();
    return {map, marks, format};
  }
};

Half half_of(const CaptionedMap& of, const SvgOptions& options) {
  const Vector2 direction = picture_direction(of.map, options.alignment);
  SvgOptions own = options;
  own.points = of.points;
  own.scaffold.reset();
  return {turned(of.map, direction), drawn_marks(of.map, direction, own), layout_scale(of.map)};
}

// Colours both halves on the scale of the first map, and sets the statistics in their captions.
// Returns the common legend.
std::optional<Legend> color(std::array<Half, 2>& halves, std::array<std::string, 2>& notes,
                            const SvgOptions& options) {
  const ClaimedEnergy energy = claimed_energy(halves[0].map);
  if (!options.quantity && energy.name.empty()) return {};
  const Quantity quantity = options.quantity.value_or(Quantity::Density);
  if (quantity == Quantity::Density && energy.name.empty()) throw no_density();
  const ColorScale scale = picture_scale(energy, quantity, options.color_range);
  Legend legend = scale_legend(quantity, scale, energy);
  for (std::size_t k = 0; k < halves.size(); ++k) {
    const MapFile& map = halves[k].map;
    Heat heat = heat_of(
        scale,
        quantity == Quantity::Density ? cell_densities(map, energy) : cell_values(map, quantity),
        halves[k].marks);
    halves[k].colors = std::move(heat.colors);
    notes[k] = extremes_clause(map, quantity, energy) + beyond_clauses(scale, heat.values, kParts);
    legend.goes_below |= heat.values.below > 0;
    legend.goes_above |= heat.values.above > 0;
  }
  return legend;
}

// Renames clips, whose names must be unique in a file.
DrawingItem renamed(DrawingItem item, std::size_t part) {
  if (auto* clipped = std::get_if<Clipped>(&item); clipped && part > 0)
    clipped->name += fmt::format("-{}", part + 1);
  return item;
}

}  // namespace

std::string svg_text(const Drawing& drawing) {
  SvgWriter writer;
  writer.write(drawing);
  return writer.text();
}

std::string svg_text(const MapFile& map, const SvgOptions& options) {
  require_sound("layout", map);
  if (options.scaffold) require_sound("scaffold", *options.scaffold);
  const Vector2 direction = picture_direction(map, options.alignment);
  const MapFile shown = turned(map, direction);
  const LayoutMarks marks = drawn_marks(map, direction, options);
  LayoutSheet::Format format = format_of(options);
  std::optional<CellColors> colors;
  if (const std::optional<Quantity> quantity = shown_quantity(shown, options)) {
    const ColorScale scale = picture_scale(claimed_energy(map), *quantity, options.color_range);
    Heat heat = heat_of(
        scale, quantity == Quantity::Density ? shown.distortion : cell_values(shown, *quantity),
        marks);
    format.colors = with_values(make_legend(shown, *quantity, scale), heat.values, kParts);
    colors = std::move(heat.colors);
  }
  const LayoutSheet sheet(shown, marks, format);
  if (options.size) require_room(sheet.width(), sheet.height(), sheet.legend_room(), 1);
  LayoutDrawing parts = draw_layout(sheet, colors, CellFill::Colors);
  Drawing drawing{.width = sheet.width(),
                  .height = sheet.height(),
                  .paper = options.paper,
                  .title = "Layout of a surface in the plane",
                  .description = parts.description};
  append(drawing.items, std::move(parts));
  return svg_text(drawing);
}

std::string svg_text(const MapPair& pair, const SvgOptions& options) {
  for (const CaptionedMap& of : pair) require_sound(of.caption, of.map);
  std::array<Half, 2> halves{half_of(pair[0], options), half_of(pair[1], options)};
  std::array<std::string, 2> notes;
  const std::optional<Legend> colors = color(halves, notes, options);
  const LayoutSheet::Format format = format_of(options);
  const bool has_legends = options.legends == Legends::Drawn;
  const DrawnLegends legends(has_legends ? colors : std::nullopt, {}, format.width);
  // Below the layouts: legends of marks, captions, the legend of colours.
  const double width = format.width / 2, room = width - 2 * kDrawingMargin;
  double marks = 0, captions = 0, least_width = legends.least_width();
  for (std::size_t k = 0; k < halves.size(); ++k) {
    std::vector<std::string>& caption = halves[k].caption;
    caption =
        caption_lines(fmt::format("{}, degree {}", pair[k].caption, pair[k].map.degree), room);
    const std::string clauses = has_legends && !notes[k].empty() ? notes[k].substr(2) : "";
    for (const std::string& line : lines_of(clauses, kSmallLetters, room)) {
      if (!line.empty()) caption.push_back(line);
      least_width = std::max(least_width, 2 * (widest_word(line, kSmallLetters) + width - room));
    }
    captions =
        std::max(captions, kDrawingMargin + kLineHeight * static_cast<double>(caption.size()));
    const LayoutSheet sheet = halves[k].sheet(width, {}, 1);
    marks = std::max(marks, sheet.legends().height());
    least_width = std::max(least_width, 2 * sheet.legends().least_width());
  }
  const double below = marks + captions + legends.height();
  std::optional<double> height;  // of the layouts
  if (format.height) height = *format.height - below;
  if (format.height) require_room(format.width, *format.height, {least_width, below}, 1);
  double scale = std::numeric_limits<double>::infinity();
  for (const Half& half : halves)
    scale = std::min(scale, half.sheet(width, height, scale).scale() / half.unit);
  if (!height)
    height = std::max(halves[0].sheet(width, {}, scale).layout_height(),
                      halves[1].sheet(width, {}, scale).layout_height());
  Drawing drawing{.width = format.width,
                  .height = format.height ? *format.height : std::round(*height + below),
                  .paper = options.paper,
                  .title = "Two layouts of a surface in the plane"};
  for (std::size_t k = 0; k < halves.size(); ++k) {
    const Half& half = halves[k];
    LayoutDrawing parts =
        draw_layout(half.sheet(width, height, scale), half.colors, CellFill::Colors);
    drawing.description +=
        fmt::format("{}{}: {}", k == 0 ? "" : "; ", pair[k].caption, parts.description);
    const double left = static_cast<double>(k) * width;
    std::vector<DrawingItem> items;
    append(items, std::move(parts));
    for (DrawingItem& item : items) drawing.items.push_back(renamed(moved(item, {left, 0}), k));
    double foot = *height + marks + kSmallLetters;
    for (const std::string& line : half.caption) {
      drawing.items.emplace_back(Label{.at = {left + width / 2, foot},
                                       .text = line,
                                       .size = kSmallLetters,
                                       .anchor = Label::Anchor::Middle});
      foot += kLineHeight;
    }
  }
  if (colors)
    drawing.description += fmt::format("; coloured by {}: {}", colors->title, colors->note);
  for (DrawingItem& item : legends.items(*height + marks + captions, drawing.height))
    drawing.items.push_back(std::move(item));
  return svg_text(drawing);
}

void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options) {
  require_sound(path, map);
  write_file_atomically(path, svg_text(map, options));
}

void write_svg(const std::string& path, const MapPair& pair, const SvgOptions& options) {
  write_file_atomically(path, svg_text(pair, options));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
