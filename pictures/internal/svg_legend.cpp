#include "majorant/pictures/internal/svg_legend.h"

namespace majorant {
namespace {

constexpr double kBarLeft = 26.0;
constexpr double kBarWidth = 360.0;
constexpr double kBarHeight = 14.0;
constexpr double kPoint = 12.0;  // of an end that values are beyond
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
  const double y = top + 8.0, below = y + kBarHeight;
  layout.add("<g font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\">\n");
  for (int k = 0; k < kSteps; ++k) {  // each to the end of the bar: no hairlines between them
    const double from = k * kBarWidth / kSteps;
    add_rect(layout, {kBarLeft + from, y}, {kBarWidth - from, kBarHeight},
             legend.scale.color_at((k + 0.5) / kSteps).hex());
  }
  if (legend.goes_below) add_end(layout, kBarLeft, y, -1, legend.scale.colors().front());
  if (legend.goes_above) add_end(layout, kBarLeft + kBarWidth, y, 1, legend.scale.colors().back());
  for (const ColorScale::Tick& tick : legend.scale.ticks()) {
    const double x = kBarLeft + tick.position * kBarWidth;
    add_rect(layout, {x - 0.5, below}, {1.0, 4.0}, "#333");
    add_text(layout, "middle", x, below + 17.0, tick.label);
  }
  const double text_left = kBarLeft + kBarWidth + kPoint + 18.0;
  add_text(layout, "start", text_left, y + 11.0, legend.title);
  add_text(layout, "start", text_left, y + 30.0, legend.note);
  layout.add("</g>\n");
}

}  // namespace majorant
