#include "majorant/pictures/internal/letters.h"

#include <array>
#include <charconv>

#include "embedded/letters_txt.h"

namespace majorant {
namespace {

constexpr double kUnits = 2048;  // of letters.txt, per font size
constexpr std::size_t kCodes = 128;

struct Letter {
  Path outline;
  double advance = 0;
};

// Reads numbers and single characters of a line.
class Line {
 public:
  explicit Line(std::string_view text) : rest_(text) {}
  bool is_done() const { return rest_.empty(); }
  char character() {
    const char c = rest_.front();
    rest_.remove_prefix(1);
    return c;
  }
  double number() {
    int value = 0;
    const auto end = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value).ptr;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    if (!rest_.empty() && (rest_.front() == ',' || rest_.front() == ' ')) rest_.remove_prefix(1);
    return value / kUnits;
  }
  Vector2 point() {
    const double x = number();
    return {x, -number()};
  }

 private:
  std::string_view rest_;
};

Path outline_of(Line& line) {
  Path path;
  while (!line.is_done()) switch (line.character()) {
      case 'M':
        path.move(line.point());
        break;
      case 'L':
        path.line(line.point());
        break;
      case 'Q': {
        const Vector2 control = line.point();
        path.quadratic(control, line.point());
        break;
      }
      default:
        path.close();
    }
  return path;
}

std::array<Letter, kCodes> read_letters() {
  std::array<Letter, kCodes> letters;
  std::string_view text = letters_txt();
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (text.front() != '#') {
      Line line(text.substr(0, end));
      Letter& letter = letters[static_cast<std::size_t>(line.number() * kUnits)];
      letter.advance = line.number();
      letter.outline = outline_of(line);
    }
    text.remove_prefix(end + 1);
  }
  return letters;
}

const Letter& letter(char c) {
  static const std::array<Letter, kCodes> letters = read_letters();
  const auto code = static_cast<unsigned char>(c);
  return letters[code >= ' ' && code < kCodes - 1 ? code : '?'];
}

}  // namespace

Path text_outline(std::string_view text) {
  Path path;
  double x = 0;
  for (const char c : text) {
    const std::size_t first = path.points.size();
    path.append(letter(c).outline);
    for (std::size_t k = first; k < path.points.size(); ++k) path.points[k].x() += x;
    x += letter(c).advance;
  }
  return path;
}

double text_width(std::string_view text) {
  double width = 0;
  for (const char c : text) width += letter(c).advance;
  return width;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
