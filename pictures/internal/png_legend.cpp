#include "majorant/pictures/internal/png_legend.h"

#include <algorithm>
#include <cmath>

#include "majorant/pictures/internal/pixel_font.h"

namespace majorant {
namespace {

constexpr Color kInk{51, 51, 51};
constexpr int kWideEnough = 900;  // for letters of twice the size
// In dots of letters.
constexpr int kLegendMargin = 6, kBarHeight = 8, kPoint = 5, kTick = 2, kLine = 12, kHeight = 52;

int zoom_of(int width) { return width >= kWideEnough ? 2 : 1; }

void fill_column(PixelImage& image, int x, int top, int bottom, Color color) {
  for (int y = top; y < bottom; ++y)
    if (x >= 0 && x < image.width && y >= 0 && y < image.height) image.at(x, y) = color;
}

// Narrower from one column to the next.
void draw_point(PixelImage& image, int x, int way, int top, int height, int length, Color color) {
  for (int k = 0; k < length; ++k) {
    const int cut = height * (k + 1) / (2 * (length + 1));
    fill_column(image, x + way * k, top + cut, top + height - cut, color);
  }
}

// As much of a line as there is room for.
std::string cut_off(const std::string& text, int room) {
  return text.substr(0, static_cast<std::size_t>(std::max(0, room)));
}

}  // namespace

int png_legend_height(int width) { return kHeight * zoom_of(width); }

void draw_legend(PixelImage& image, const Legend& legend) {
  const int zoom = zoom_of(image.width);
  const int left = (kLegendMargin + kPoint) * zoom;
  const int width = std::max(1, std::min(image.width / 2, 400 * zoom) - 2 * left);
  const int top = image.height - (kHeight - 4) * zoom, height = kBarHeight * zoom;
  for (int x = 0; x < width; ++x)
    fill_column(image, left + x, top, top + height, legend.scale.color_at((x + 0.5) / width));
  if (legend.goes_below)
    draw_point(image, left - 1, -1, top, height, kPoint * zoom, legend.scale.colors().front());
  if (legend.goes_above)
    draw_point(image, left + width, 1, top, height, kPoint * zoom, legend.scale.colors().back());
  const int ticks = top + height;
  int free = 0;  // labels that would overlap the one before are left out
  for (const ColorScale::Tick& tick : legend.scale.ticks()) {
    const int x = left + static_cast<int>(std::lround(tick.position * (width - 1)));
    fill_column(image, x, ticks, ticks + kTick * zoom, kInk);
    const int wide = static_cast<int>(tick.label.size()) * kGlyphAdvance * zoom;
    if (x - wide / 2 < free) continue;
    draw_text(image, x - wide / 2, ticks + (kTick + 2) * zoom, zoom, kInk, tick.label);
    free = x - wide / 2 + wide + kGlyphAdvance * zoom / 2;
  }
  const int room = (image.width - 2 * kLegendMargin * zoom) / (kGlyphAdvance * zoom);
  const int text = ticks + (kTick + 3 + kGlyphHeight) * zoom;
  draw_text(image, kLegendMargin * zoom, text, zoom, kInk, cut_off(legend.title, room));
  draw_text(image, kLegendMargin * zoom, text + (kLine - 1) * zoom, zoom, kInk,
            cut_off(legend.note, room));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
