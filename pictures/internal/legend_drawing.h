// The legends of a drawing as they are painted: that of colours, and below it that of marks.
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

// Between the edges of a drawing and what is on it.
inline constexpr double kDrawingMargin = 10;
// Letters of titles and ticks, and those of all else: to be read at a quarter of the size.
inline constexpr double kLetters = 24, kSmallLetters = 20;
inline constexpr Color kInk{51, 51, 51};

// A text in letters of a size, broken into lines that fit into a width with letters of readers,
// which are up to kWidestLetters times as wide as ours: between clauses ("; ") where that is
// enough, then between words. A word that does not fit is a line of its own, and wider.
std::vector<std::string> lines_of(std::string_view text, double size, double width);
// The widest of the words that are not broken.
double widest_word(std::string_view text, double size);
// The width of a line with such letters.
double widest(std::string_view line, double size);
inline constexpr double kWidestLetters = 1.15;

// The lines that the note of a legend takes on a drawing of this width.
std::size_t note_lines(const Legend& legend, double width);

// Half the side of a sign.
inline constexpr double kHalfSign = 7;

// An entry of the legend of marks: what is drawn around a place, the origin, and what it is.
struct LegendMark {
  std::vector<DrawingItem> sign;
  std::string text;
};

// What legends of colours name are numbers of the others.
enum class LegendAbove { Nothing, Colors };
LegendMark turned_over_mark(std::size_t count, LegendAbove above);
LegendMark without_area_mark(std::size_t count, LegendAbove above);

class DrawnLegends {
 public:
  // colors: none, no legend of colours.
  DrawnLegends(const std::optional<Legend>& colors, std::vector<LegendMark> marks, double width);

  double height() const { return colors_height_ + marks_height_; }
  // On narrower drawings a word or a number would be cut off, or lie on another.
  double least_width() const;

  // The legend of colours (title, bar, ticks, note) from `top` on, that of marks down to `bottom`.
  std::vector<DrawingItem> items(double top, double bottom) const;

 private:
  struct PlacedMark {
    LegendMark mark;
    std::vector<std::string> lines;
    Vector2 at;  // from the upper left corner of the legend of marks
  };

  void place(std::vector<LegendMark> marks);
  void add_colors(double top, std::vector<DrawingItem>& items) const;

  std::optional<Legend> colors_;
  double width_, colors_height_ = 0, marks_height_ = 0;
  std::vector<std::string> title_, note_;
  std::vector<PlacedMark> marks_;
};

// Throws Error(Usage) that says the least sides of a sheet where legends have no room on one of
// this width and height, above which the layout is to have some, too. In units of the drawing;
// scale: px a unit.
struct LegendRoom {
  double least_width, height;
};
void require_room(double width, double height, const LegendRoom& legends, double scale);

// Lines of a caption: broken as lines_of() does, and anywhere in words that do not fit.
std::vector<std::string> caption_lines(std::string_view text, double width);
// The height of lines in small letters.
inline constexpr double kLineHeight = 26;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
