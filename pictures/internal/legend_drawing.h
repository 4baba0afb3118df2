// The drawn legends of a picture: that of colours, and below it that of marks.
//
//   const LegendMark turned = turned_over_mark(2, LegendAbove::Nothing);
//   const DrawnLegends legends(std::nullopt, {turned}, 1000);  // lines wider than that are broken
//   const double bottom = 20 + legends.height();
//   for (const DrawingItem& item : legends.items(20, bottom)) static_cast<void>(item);
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/pictures/internal/drawing.h"
#include "majorant/pictures/internal/legend.h"

namespace majorant {

// The margin of a drawing.
inline constexpr double kDrawingMargin = 10;
// Font sizes of titles and ticks, and of all other text. Both are legible at a quarter of the size.
inline constexpr double kLetters = 24, kSmallLetters = 20;
inline constexpr Color kInk{51, 51, 51};

// Breaks a text of a font size into lines of a width, even with letters of a viewer that are
// kWidestLetters times as wide as ours. It is broken between clauses ("; ") if that suffices, then
// between words. A word that does not fit is a line of its own, and wider.
std::vector<std::string> lines_of(std::string_view text, double size, double width);
// Returns the width of the widest word.
double widest_word(std::string_view text, double size);
// Returns the width of a line with the widest letters.
double widest(std::string_view line, double size);
inline constexpr double kWidestLetters = 1.15;

// Returns the number of lines of a legend's note on a drawing of this width.
std::size_t note_lines(const Legend& legend, double width);

// Half the side of a sign.
inline constexpr double kHalfSign = 7;

// An entry of the legend of marks: a sign around the origin, and its explanation.
struct LegendMark {
  std::vector<DrawingItem> sign;
  std::string text;
};

// The legend above the marks. Colors: the marks refer to its values.
enum class LegendAbove { Nothing, Colors };
LegendMark turned_over_mark(std::size_t count, LegendAbove above);
LegendMark without_area_mark(std::size_t count, LegendAbove above);

class DrawnLegends {
 public:
  // colors: none: no legend of colours.
  DrawnLegends(const std::optional<Legend>& colors, std::vector<LegendMark> marks, double width);

  double height() const { return colors_height_ + marks_height_; }
  // Returns the smallest width at which no word or number is cut off or covered.
  double least_width() const;

  // Draws the legend of colours (title, bar, ticks, note) from `top` on, and that of marks down to
  // `bottom`.
  std::vector<DrawingItem> items(double top, double bottom) const;

 private:
  struct PlacedMark {
    LegendMark mark;
    std::vector<std::string> lines;
    Vector2 at;  // relative to the upper left corner of the legend of marks
  };

  void place(std::vector<LegendMark> marks);
  void add_colors(double top, std::vector<DrawingItem>& items) const;

  std::optional<Legend> colors_;
  double width_, colors_height_ = 0, marks_height_ = 0;
  std::vector<std::string> title_, note_;
  std::vector<PlacedMark> marks_;
};

// The room for legends on a sheet of this width and height, above which the layout needs some, too.
// Throws Error(Usage) with the smallest sufficient sides. In units of the drawing; scale: px a
// unit.
struct LegendRoom {
  double least_width, height;
};
void require_room(double width, double height, const LegendRoom& legends, double scale);

// Returns the lines of a caption, broken as in lines_of(), and inside of words that do not fit.
std::vector<std::string> caption_lines(std::string_view text, double width);
// The height of a line in small letters.
inline constexpr double kLineHeight = 26;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
