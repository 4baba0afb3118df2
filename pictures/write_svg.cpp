#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/map_check.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/layout_drawing.h"
#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/page_text.h"
#include "majorant/pictures/pictures.h"

namespace majorant {
namespace {

// A drawing as text. Numbers have three decimals, those of paths relative to where the pen is, as
// it is written: rounding does not add up.
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
    // Common to all.
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

  // No trailing zeros, no zero before the point, no -0.
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

  // A sign separates numbers, too.
  void add_separated(long long value, bool is_first) {
    if (!is_first && value >= 0) add(" ");
    add_thousandths(value);
  }

  void add_path(const Path& path) {
    Thousandths pen, start;
    const Vector2* p = path.points.data();
    bool is_first = true;
    char last = 0;
    for (const Path::Verb verb : path.verbs) {
      const int count = points_of(verb);
      const char letter = is_first ? 'M' : "mlqcz"[static_cast<std::size_t>(verb)];
      // A verb goes on without its letter; after a move that would be lines.
      const bool goes_on = letter == last && verb != Path::Verb::Move && count > 0;
      if (!goes_on) add("{}", letter);
      Thousandths at = pen;
      for (int k = 0; k < count; ++k) {
        at = rounded(p[k]);
        add_separated(at.x - pen.x, k == 0 && !goes_on);
        add_separated(at.y - pen.y, false);
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

struct Heat {
  Legend legend;
  CellColors colors;
};

// Means over the cells.
Vec cell_values(const MapFile& map, Quantity quantity) {
  const FaceDistortion faces =
      map.face_distortion.rows() > 0 ? map.face_distortion : measure_distortion(map).faces;
  const Index column = quantity == Quantity::SigmaMax   ? 0
                       : quantity == Quantity::SigmaMin ? 1
                       : quantity == Quantity::Area     ? 2
                                                        : 3;
  return faces.col(column);
}

// Cells that are turned over, as the marks have them, do not count.
Heat heat_of(const MapFile& map, Quantity quantity, const Vec& cells, const LayoutMarks& marks,
             const SvgOptions& options) {
  const ColorScale scale = picture_scale(map, quantity, options.color_range);
  ValueSummary values;
  CellColors colors;
  auto over = marks.turned_over.begin();
  for (Index cell = 0; cell < cells.size(); ++cell) {
    colors.push_back(scale.color(cells[cell]));
    const bool is_over = over != marks.turned_over.end() && *over == cell;
    if (is_over) ++over;
    if (!is_over) values.add(scale, cells[cell]);
  }
  return {make_legend(map, quantity, scale, values, "triangle means"), colors};
}

// The heat map that was asked for; else the density, where the cells have one and something says of
// which energy.
std::optional<Heat> heat_of(const MapFile& map, const LayoutMarks& marks,
                            const SvgOptions& options) {
  if (options.quantity && options.quantity != Quantity::Density)
    return heat_of(map, *options.quantity, cell_values(map, *options.quantity), marks, options);
  const bool is_known = map.distortion.size() > 0 && !claimed_energy(map).name.empty();
  if (is_known) return heat_of(map, Quantity::Density, map.distortion, marks, options);
  if (options.quantity)
    throw Error(ErrorKind::Usage,
                "the map has no density: no energy is claimed that it could be of, or none was "
                "measured");
  return {};
}

void require_usable(const SheetSize& size) {
  for (const int side : {size.width, size.height})
    if (side < PngOptions::kSmallest || side > PngOptions::kLargest)
      throw Error(ErrorKind::Usage,
                  fmt::format("a sheet of {} x {} px: sides are {} to {}", size.width, size.height,
                              PngOptions::kSmallest, PngOptions::kLargest));
}

// Between the legends and the upper end of a sheet whose height was asked for.
void require_room(const LayoutSheet& sheet) {
  constexpr double kLeast = 4 * LayoutSheet::kMargin;
  if (sheet.layout_height() >= kLeast) return;
  throw Error(
      ErrorKind::Usage,
      fmt::format("a sheet {:g} px high: its legends are {:g} px high; take one of {:g} or more",
                  sheet.height(), sheet.height() - sheet.layout_height(),
                  sheet.height() - sheet.layout_height() + kLeast));
}

}  // namespace

std::string svg_text(const MapFile& map, const SvgOptions& options) {
  require_sound("layout", map);
  if (options.scaffold) require_sound("scaffold", *options.scaffold);
  const Vector2 direction = picture_direction(map, options.alignment);
  const MapFile shown = turned(map, direction);
  LayoutMarks marks = marks_of(map, direction, options.grid, options.scaffold, options.points);
  marks.edges = options.edges;
  std::optional<Heat> heat = heat_of(shown, marks, options);
  LayoutSheet::Format format;
  if (options.size) {
    require_usable(*options.size);
    format.width = options.size->width;
    format.height = options.size->height;
  }
  if (heat) {
    if (options.size) heat->legend = wrapped(heat->legend, format.width);
    format.legend = LegendOf::Colors;
    format.notes = heat->legend.notes.size();
  }
  const LayoutSheet sheet(shown, marks, format);
  if (options.size) require_room(sheet);
  LayoutDrawing parts =
      draw_layout(sheet, heat ? std::optional(heat->legend) : std::nullopt,
                  heat ? std::optional(heat->colors) : std::nullopt, CellFill::Colors);
  Drawing drawing{.width = sheet.width(),
                  .height = sheet.height(),
                  .paper = options.paper,
                  .title = "Layout of a surface in the plane",
                  .description = parts.description};
  for (auto* items : {&parts.behind, &parts.cells, &parts.over})
    drawing.items.insert(drawing.items.end(), std::make_move_iterator(items->begin()),
                         std::make_move_iterator(items->end()));
  SvgWriter writer;
  writer.write(drawing);
  return writer.text();
}

void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options) {
  require_sound(path, map);
  write_file_atomically(path, svg_text(map, options));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
