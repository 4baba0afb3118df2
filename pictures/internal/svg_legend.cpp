#include "majorant/pictures/internal/svg_legend.h"

namespace majorant {
namespace {

constexpr double kBarLeft = 26.0;
constexpr double kBarWidth = SvgLayout::kWidth - 2 * kBarLeft;
constexpr double kBarHeight = 20.0;
constexpr double kPoint = 14.0;                          // of an end that values are beyond
constexpr double kLetters = 24.0, kSmallLetters = 20.0;  // to be read at a quarter of the size
constexpr int kSteps = 72;

void add_rect(SvgLayout& layout, const Vector2& corner, const Vector2& size,
              const std::string& fill) {
  layout.add("<rect x=\"");
  layout.add_number(corner[0]);
  layout.add("\" y=\"");
  layout.add_number(corner[1]);
  layout.add("\" width=\"{:.3g}\" height=\"{:.3g}\" fill=\"{}\"/>\n", size[0], size[1], fill);
}

void add_end(SvgLayout& layout, double x, double y, double way, const Color& color) {
  layout.add("<polygon fill=\"{}\" points=\"", color.hex());
  layout.add_point(' ', {x, y});
  layout.add_point(' ', {x + way * kPoint, y + kBarHeight / 2});
  layout.add_point(' ', {x, y + kBarHeight});
  layout.add("\"/>\n");
}

void add_text(SvgLayout& layout, const char* anchor, double x, double y, const std::string& text) {
  layout.add("<text text-anchor=\"{}\" x=\"", anchor);
  layout.add_number(x);
  layout.add("\" y=\"");
  layout.add_number(y);
  layout.add("\">{}</text>\n", text);
}

}  // namespace

void add_color_legend(SvgLayout& layout, const Legend& legend, double top) {
  const double y = top + 12.0 + kLetters, below = y + kBarHeight;
  layout.add("<g font-family=\"sans-serif\" font-size=\"{}\" fill=\"#333\">\n", kLetters);
  add_text(layout, "start", SvgLayout::kMargin, y - 12.0, legend.title);
  for (int k = 0; k < kSteps; ++k) {  // each to the end of the bar: no hairlines between them
    const double from = k * kBarWidth / kSteps;
    add_rect(layout, {kBarLeft + from, y}, {kBarWidth - from, kBarHeight},
             legend.scale.color_at((k + 0.5) / kSteps).hex());
  }
  if (legend.goes_below) add_end(layout, kBarLeft, y, -1, legend.scale.colors().front());
  if (legend.goes_above) add_end(layout, kBarLeft + kBarWidth, y, 1, legend.scale.colors().back());
  for (const ColorScale::Tick& tick : legend.scale.ticks()) {
    const double x = kBarLeft + tick.position * kBarWidth;
    add_rect(layout, {x - 1.0, below}, {2.0, 5.0}, "#333");
    add_text(layout, "middle", x, below + 5.0 + kLetters, tick.label);
  }
  layout.add("</g>\n<g font-family=\"sans-serif\" font-size=\"{}\" fill=\"#333\">\n",
             kSmallLetters);
  add_text(layout, "start", SvgLayout::kMargin, below + 16.0 + kLetters + kSmallLetters,
           legend.note);
  layout.add("</g>\n");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
