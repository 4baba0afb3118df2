#include "majorant/pictures/internal/legend_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "majorant/mesh/refusal.h"
#include "majorant/pictures/internal/letters.h"
#include "majorant/pictures/turned_over.h"

namespace majorant {
namespace {

// Sizes of the legend of colours. The height includes one line of title and of note.
constexpr double kColorsHeight = 130, kTitleHeight = 30;
constexpr double kBarLeft = 26, kBarHeight = 20;
constexpr double kPoint = 14;  // of an end with values beyond it
constexpr double kTickSpace = 0.4 * kLetters;
constexpr int kSteps = 72;

// Sizes of the legend of marks.
constexpr double kRowHeight = 40, kColumn = 245;
constexpr double kSign = 10, kText = 28, kFoot = 7;

// The least height of the layout on a sheet.
constexpr double kLeastLayout = 4 * kDrawingMargin;

// Where texts may be broken, best first: between clauses, words, or anywhere in words.
enum class Break { Clauses, Words, Parts };

// Returns whether a line may end after character k, with the following space, if any.
bool ends_at(std::string_view text, std::size_t k, Break where) {
  const char c = text[k], then = text[k + 1];
  if (where == Break::Clauses) return c == ';' && then == ' ';
  if (where == Break::Words) return then == ' ';
  return c == '*' || (c == '-' && std::isalpha(static_cast<unsigned char>(then)) != 0);
}

std::vector<std::string_view> pieces_of(std::string_view text, Break where) {
  std::vector<std::string_view> pieces;
  std::size_t first = 0;
  for (std::size_t k = 0; k + 1 < text.size(); ++k) {
    if (!ends_at(text, k, where)) continue;
    pieces.push_back(text.substr(first, k + 1 - first));
    first = text[k + 1] == ' ' ? k + 2 : k + 1;
  }
  pieces.push_back(text.substr(first));
  return pieces;
}

void add_lines(std::vector<std::string>& lines, std::string_view text, Break where, double size,
               double width) {
  const std::string between = where == Break::Parts ? "" : " ";
  for (const std::string_view piece : pieces_of(text, where)) {
    const auto fits = [&](std::string_view line) { return widest(line, size) <= width; };
    const std::string joined =
        lines.back().empty() ? std::string(piece) : lines.back() + between + std::string(piece);
    if (fits(joined)) {
      lines.back() = joined;
      continue;
    }
    if (!lines.back().empty()) lines.emplace_back();
    if (fits(piece) || where == Break::Parts)
      lines.back() = piece;
    else
      add_lines(lines, piece, where == Break::Clauses ? Break::Words : Break::Parts, size, width);
  }
}

std::vector<std::string> note_of(const Legend& legend, double width) {
  return lines_of(legend.note, kSmallLetters, width - 2 * kDrawingMargin);
}

double bar_width(double width) { return std::max(width - 2 * kBarLeft, kBarLeft); }

struct PlacedTick {
  ColorScale::Tick tick;
  double x;             // of the tick
  double middle, half;  // of its label, which stays on the sheet
};

PlacedTick placed(const ColorScale::Tick& tick, double width) {
  const double x = kBarLeft + tick.position * bar_width(width);
  const double half = 0.5 * widest(tick.label, kLetters);
  return {tick, x, std::max(half, std::min(x, width - half)), half};
}

// Returns the ticks whose labels have room beside each other; both ends are always included.
std::vector<PlacedTick> ticks_with_room(const ColorScale& scale, double width) {
  const std::vector<ColorScale::Tick> all = scale.ticks();
  const auto have_room = [](const PlacedTick& a, const PlacedTick& b) {
    const double both = a.half + b.half;
    return b.middle - a.middle >= std::max(both, both / kWidestLetters + kTickSpace);
  };
  const PlacedTick last = placed(all.back(), width);
  std::vector<PlacedTick> shown;
  for (const ColorScale::Tick& tick : all) {
    const PlacedTick one = placed(tick, width);
    const bool is_end = &tick == &all.front() || &tick == &all.back();
    if (is_end || (have_room(shown.back(), one) && have_room(one, last))) shown.push_back(one);
  }
  return shown;
}

}  // namespace

double widest(std::string_view line, double size) {
  return kWidestLetters * size * text_width(line);
}

std::vector<std::string> lines_of(std::string_view text, double size, double width) {
  std::vector<std::string> lines(1);
  add_lines(lines, text, Break::Clauses, size, width);
  return lines;
}

std::size_t note_lines(const Legend& legend, double width) { return note_of(legend, width).size(); }

double widest_word(std::string_view text, double size) {
  double width = 0;
  for (const std::string& line : lines_of(text, size, 0))
    width = std::max(width, widest(line, size));
  return width;
}

namespace {

// words: about cells of this colour, which have no values.
LegendMark mark_of_cells(const Color& color, const std::string& words, LegendAbove above) {
  const char* rest = above == LegendAbove::Colors ? ", not counted in the numbers above" : "";
  return {{Shape{.path = rectangle({-kHalfSign, -kHalfSign}, {2 * kHalfSign, 2 * kHalfSign}),
                 .fill = color}},
          words + rest};
}

}  // namespace

LegendMark turned_over_mark(std::size_t count, LegendAbove above) {
  return mark_of_cells(kFlippedColor, turned_over_words(count), above);
}

LegendMark without_area_mark(std::size_t count, LegendAbove above) {
  return mark_of_cells(kNoAreaColor, without_area_words(count), above);
}

DrawnLegends::DrawnLegends(const std::optional<Legend>& colors, std::vector<LegendMark> marks,
                           double width)
    : colors_(colors), width_(width) {
  if (colors_) {
    title_ = lines_of(colors_->title, kLetters, width_ - 2 * kDrawingMargin);
    note_ = note_of(*colors_, width_);
    colors_height_ =
        kColorsHeight + kTitleHeight * static_cast<double>(title_.size() - 1) +
        kLineHeight * static_cast<double>(std::max(note_.size(), colors_->note_lines) - 1);
  }
  place(std::move(marks));
}

// Places marks in columns; each mark takes as many as it needs.
void DrawnLegends::place(std::vector<LegendMark> marks) {
  double x = kDrawingMargin, row = 0;
  for (LegendMark& mark : marks) {
    const double text = widest(mark.text, kSmallLetters);
    const bool has_room = x + kText + text <= width_ - kDrawingMargin;
    if (!has_room && x > kDrawingMargin) x = kDrawingMargin, row = marks_height_;
    std::vector<std::string> lines =
        lines_of(mark.text, kSmallLetters, width_ - kDrawingMargin - x - kText);
    const double more = kLineHeight * static_cast<double>(lines.size() - 1);
    marks_height_ = std::max(marks_height_, row + kRowHeight + more);
    marks_.push_back({std::move(mark), std::move(lines), {x, row + 0.5 * kRowHeight}});
    x += kColumn * std::max(1.0, std::ceil((kText + text / kWidestLetters) / kColumn));
  }
}

double DrawnLegends::least_width() const {
  double width = 0;
  if (colors_) {
    const std::vector<ColorScale::Tick> ticks = colors_->scale.ticks();
    width = std::max({widest_word(colors_->title, kLetters) + 2 * kDrawingMargin,
                      widest_word(colors_->note, kSmallLetters) + 2 * kDrawingMargin,
                      widest(ticks.front().label, kLetters) + widest(ticks.back().label, kLetters) +
                          kTickSpace});
  }
  for (const PlacedMark& one : marks_)
    width = std::max(width, widest_word(one.mark.text, kSmallLetters) + kText + 2 * kDrawingMargin);
  return width;
}

std::vector<DrawingItem> DrawnLegends::items(double top, double bottom) const {
  std::vector<DrawingItem> items;
  if (colors_) add_colors(top, items);
  for (const PlacedMark& one : marks_) {
    const Vector2 at = one.at + Vector2(0, bottom - marks_height_);
    for (const DrawingItem& item : one.mark.sign)
      items.push_back(moved(item, at + Vector2(kSign, 0)));
    double foot = at.y() + kFoot;
    for (const std::string& line : one.lines) {
      items.emplace_back(Label{.at = {at.x() + kText, foot}, .text = line, .size = kSmallLetters});
      foot += kLineHeight;
    }
  }
  return items;
}

void DrawnLegends::add_colors(double top, std::vector<DrawingItem>& items) const {
  double y = top + kLetters;
  for (const std::string& line : title_) {
    items.emplace_back(Label{.at = {kDrawingMargin, y}, .text = line, .size = kLetters});
    y += kTitleHeight;
  }
  y += 12 - kTitleHeight;
  const double bar = bar_width(width_), below = y + kBarHeight;
  for (int k = 0; k < kSteps; ++k) {  // each reaches to the end of the bar, so that there are no
                                      // hairlines
    const double from = k * bar / kSteps;
    items.emplace_back(Shape{.path = rectangle({kBarLeft + from, y}, {bar - from, kBarHeight}),
                             .fill = colors_->scale.color_at((k + 0.5) / kSteps)});
  }
  const auto add_end = [&](double x, double way, const Color& color) {
    Shape end{.fill = color};
    end.path.move({x, y});
    end.path.line({x + way * kPoint, y + kBarHeight / 2});
    end.path.line({x, y + kBarHeight});
    end.path.close();
    items.emplace_back(std::move(end));
  };
  if (colors_->goes_below) add_end(kBarLeft, -1, colors_->scale.colors().front());
  if (colors_->goes_above) add_end(kBarLeft + bar, 1, colors_->scale.colors().back());
  for (const PlacedTick& one : ticks_with_room(colors_->scale, width_)) {
    items.emplace_back(Shape{.path = rectangle({one.x - 1, below}, {2, 5}), .fill = kInk});
    items.emplace_back(Label{.at = {one.middle, below + 5 + kLetters},
                             .text = one.tick.label,
                             .size = kLetters,
                             .anchor = Label::Anchor::Middle});
  }
  double foot = below + 16 + kLetters + kSmallLetters;
  for (const std::string& line : note_) {
    items.emplace_back(Label{.at = {kDrawingMargin, foot}, .text = line, .size = kSmallLetters});
    foot += kLineHeight;
  }
}

void require_room(double width, double height, const LegendRoom& legends, double scale) {
  const auto refuse = [&](double side, const char* high, double taken, double least) {
    return Refusal(
        ErrorKind::Usage, "",
        fmt::format(
            "a sheet {:.0f} px {}: its legends are {:.0f} px {}; take one of {:.0f} or more, or ",
            scale * side, high, std::ceil(scale * taken), high, std::ceil(scale * least)),
        Hint::LeaveOutLegends);
  };
  if (width < legends.least_width)
    throw refuse(width, "wide", legends.least_width, legends.least_width);
  if (height - legends.height < kLeastLayout)
    throw refuse(height, "high", legends.height, legends.height + kLeastLayout);
}

std::vector<std::string> caption_lines(std::string_view text, double width) {
  const auto is_inside_letter = [](char c) { return (static_cast<unsigned char>(c) >> 6) == 2; };
  std::vector<std::string> lines;
  for (std::string rest : lines_of(text, kSmallLetters, width)) {
    while (widest(rest, kSmallLetters) > width) {
      std::size_t end = rest.size();
      while (end > 1 &&
             (widest(rest.substr(0, end), kSmallLetters) > width || is_inside_letter(rest[end])))
        --end;
      if (end == 1 && rest.size() == 1) break;
      lines.push_back(rest.substr(0, end));
      rest.erase(0, end);
    }
    if (!rest.empty()) lines.push_back(rest);
  }
  return lines;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
