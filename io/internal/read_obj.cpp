// Wavefront OBJ. The accepted grammar is the polygonal subset of the "Object Files (.obj)" appendix
// of Wavefront's Advanced Visualizer manual. Points, lines, attributes and comments on lines of
// their own are kept. Lines with other keywords, such as curves, surfaces and extensions of
// programs, are skipped, and named in one warning. Broken parts that do not define the shape are
// left out (dropped_parts.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <charconv>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/cones_of.h"
#include "majorant/io/internal/dropped_parts.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/io/internal/obj_content.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

// Keywords of lines that are kept verbatim.
constexpr std::array<std::string_view, 14> kDirectives = {
    "g",        "o",        "s",   "mg",     "usemtl", "mtllib",     "bevel",
    "c_interp", "d_interp", "lod", "maplib", "usemap", "shadow_obj", "trace_obj"};

template <class List>
bool contains(const List& list, std::string_view keyword) {
  return std::find(list.begin(), list.end(), keyword) != list.end();
}

// A reader of a file, or of a piece of its lines.
class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view text, const StopCheck& stop,
            Strictness strictness)
      : cursor_(path, text, TextLines::Continued, stop), content_(path, strictness) {
    cursor_.collect_comments(comments_);
  }

  void read_lines() {
    while (cursor_.next_line()) {
      keep_comments();
      read_line();
    }
    keep_comments();
    content_.lines = cursor_.lines_read();
  }

  // Reserves the estimated size of the lists, so that they do not move while they grow.
  void reserve(std::string_view text) {
    std::size_t positions = 0, texcoords = 0, faces = 0, corners = 0;
    for (std::size_t line = 0; line < text.size();) {
      const std::string_view word = text.substr(line, 2);
      positions += word == "v ";
      texcoords += word == "vt";
      faces += word == "f ";
      const std::size_t end = text.find('\n', line);
      if (faces == 1 && corners == 0) {  // assumes that all faces are alike
        const std::string_view face = text.substr(line, end - line);
        corners = static_cast<std::size_t>(std::count(face.begin(), face.end(), ' '));
      }
      line = end == std::string_view::npos ? text.size() : end + 1;
    }
    mesh_.positions.reserve(positions);
    mesh_.texcoords.reserve(texcoords);
    mesh_.texcoord_rounding.reserve(texcoords);
    const std::size_t indices = std::min(corners * faces, text.size() / 2);
    mesh_.polygons.reserve(faces, indices);
    mesh_.polygon_lines.reserve(faces);
    if (texcoords > 0) mesh_.polygon_texcoords.reserve(faces, indices);
  }

  const ObjContent& content() const { return content_; }
  ObjContent take_content() { return std::move(content_); }

 private:
  void read_line() {
    const std::string_view keyword = cursor_.next_token();
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f" || keyword == "fo") {
      read_face();
    } else if (keyword == "vt") {
      read_texcoord();
    } else if (keyword == "vn") {
      read_normal();
    } else if (keyword == "l" || keyword == "p") {
      keep_element(keyword);
    } else if (contains(kDirectives, keyword)) {
      keep_directive();
    } else {
      skip_line(keyword);
    }
  }

  void add_directive(std::string text) {
    mesh_.directives.emplace_back(static_cast<Index>(mesh_.polygons.size()), std::move(text));
    content_.vertices_before.push_back(static_cast<Index>(mesh_.positions.size()));
  }

  // Drops comments of our writer about the previous file: its mark, cones and missing charts.
  void keep_comments() {
    for (const std::string_view comment : comments_) {
      const std::string_view text =
          comment.starts_with("# ") ? comment.substr(2) : std::string_view();
      if (text == kPartialLayoutComment)
        mesh_.has_partial_layout = true;
      else if (!is_cone_comment(text) && !is_written_mark(text))
        add_directive(std::string(comment));
    }
    comments_.clear();
  }

  // Lines that begin with a word are skipped; others are errors, or the file is no OBJ.
  void skip_line(std::string_view keyword) {
    if (!std::isalpha(static_cast<unsigned char>(keyword.front()))) {
      cursor_.fail(
          fmt::format("{} is no OBJ keyword; check that this is an OBJ file", in_quotes(keyword)));
    }
    SkippedLines& skipped = content_.skipped;
    if (skipped.count++ == 0) skipped.first = cursor_.line();
    const std::string name = in_quotes(keyword);
    if (skipped.names.size() < SkippedLines::kMaxNames && !contains(skipped.names, name))
      skipped.names.push_back(name);
  }

  // Returns "file:line: problem", for warnings.
  std::string here(std::string_view problem) const {
    return fmt::format("{}:{}: {}", mesh_.file, cursor_.line(), problem);
  }

  // Reads the rest of the line into numbers_, with their rounding in rounded_. Returns false for
  // fewer than `least` numbers, which drops the part. Joined lines are an error, since dropping
  // them would lose the second one.
  bool read_numbers(std::string_view what, std::size_t least, DroppedPart part) {
    numbers_.clear();
    rounded_.clear();
    while (numbers_.size() < least || !cursor_.at_end_of_line()) {
      double number = 0;
      if (!cursor_.try_number(number)) {
        content_.dropped.add(part, [&] { return here(cursor_.number_problem(what)); });
        require_one_line();
        return false;
      }
      numbers_.push_back(number);
      if (part == DroppedPart::Texcoord) rounded_.push_back(cursor_.rounding());
    }
    return true;
  }

  void require_one_line() {
    constexpr std::array<std::string_view, 4> kKeywords = {"v", "vt", "vn", "f"};
    const std::string_view line = cursor_.whole_line();
    TextCursor rest(mesh_.file, line, TextLines::Continued);
    rest.next_line();
    rest.next_token();
    while (!rest.at_end_of_line())
      if (const std::string_view token = rest.next_token(); contains(kKeywords, token))
        cursor_.fail(fmt::format("{} inside of a line; divide the line there", in_quotes(token)));
  }

  // Reads a position, and a colour if three more numbers follow. Other numbers (a weight) are
  // dropped.
  void read_vertex() {
    Vector3 position;
    for (int k = 0; k < 3; ++k) position[k] = cursor_.next_number("coordinate");
    mesh_.positions.push_back(position);
    ++content_.spaces[0].count;
    if (!read_numbers("colour", 0, DroppedPart::Color) || numbers_.size() != 3) return;
    mesh_.colors.resize(mesh_.positions.size(), no_attribute<3>());
    mesh_.colors.back() = Vector3(numbers_[0], numbers_[1], numbers_[2]);
  }

  // Broken normals keep their number until the end.
  void read_normal() {
    const bool is_good = read_numbers("normal component", 3, DroppedPart::Normal);
    mesh_.normals.push_back(is_good ? Vector3(numbers_[0], numbers_[1], numbers_[2])
                                    : no_attribute<3>());
    ++content_.spaces[2].count;
  }

  void read_texcoord() {
    Vector2 texcoord = no_attribute<2>(), rounding(0, 0);
    if (read_numbers("texture coordinate", 1, DroppedPart::Texcoord)) {
      const bool has_two = numbers_.size() > 1;
      texcoord = Vector2(numbers_[0], has_two ? numbers_[1] : 0.0);
      rounding = Vector2(rounded_[0], has_two ? rounded_[1] : 0.0);
    }
    mesh_.texcoords.push_back(texcoord);
    mesh_.texcoord_rounding.push_back(rounding);
    ++content_.spaces[1].count;
  }

  // Reads points and lines, by vertices alone, since outputs have other texture coordinates.
  void keep_element(std::string_view keyword) {
    std::string text(keyword);
    ObjElement element{mesh_.directives.size(), 0, cursor_.line()};
    while (!cursor_.at_end_of_line()) {
      const std::string_view token = cursor_.next_token();
      const ParsedIndex parsed = find_index(token.substr(0, token.find('/')), content_.spaces[0]);
      if (!parsed.problem.empty())
        return content_.dropped.add(DroppedPart::Element, [&] { return here(parsed.problem); });
      element.largest = std::max(element.largest, parsed.index);
      text += fmt::format(" {}", parsed.index + 1);
    }
    content_.elements.push_back(element);
    add_directive(std::move(text));
  }

  void keep_directive() { add_directive(joined_line(cursor_.whole_line())); }

  void read_face() {
    std::array<std::vector<Index>, 3>& lists = lists_;
    for (auto& list : lists) list.clear();
    std::array<bool, 3> is_broken{};
    while (!cursor_.at_end_of_line()) read_corner(cursor_.next_token(), lists, is_broken);
    const std::size_t corners = lists[0].size();
    if (corners < 3) {
      cursor_.fail(
          fmt::format("face with {} corner{}; at least 3 are needed, the file may be "
                      "truncated",
                      corners, corners == 1 ? "" : "s"));
    }
    for (std::size_t k = 1; k < 3; ++k) {
      if (!is_broken[k] && (lists[k].empty() || lists[k].size() == corners)) continue;
      lists[k].clear();
      if (is_broken[k]) continue;
      content_.dropped.add(
          k == 1 ? DroppedPart::PartialTexcoords : DroppedPart::PartialNormals, [&] {
            return here(fmt::format("a {} index at some corners only", content_.spaces[k].name));
          });
    }
    mesh_.polygons.push_back(lists[0]);
    const auto add = [&](IndexLists& of_polygon, const std::vector<Index>& list) {
      if (of_polygon.empty() && list.empty()) return;  // no polygon has any so far
      of_polygon.resize(mesh_.polygons.size() - 1);
      of_polygon.push_back(list);
    };
    add(mesh_.polygon_texcoords, lists[1]);
    add(mesh_.polygon_normals, lists[2]);
    mesh_.polygon_lines.push_back(cursor_.line());
  }

  // Reads v, v/vt, v//vn or v/vt/vn. All lists except v may be broken.
  void read_corner(std::string_view token, std::array<std::vector<Index>, 3>& lists,
                   std::array<bool, 3>& is_broken) {
    std::string_view rest = token;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t slash = rest.find('/');
      const std::string_view digits = rest.substr(0, slash);
      if (k == 0)
        lists[0].push_back(vertex_of(digits, token));
      else if (!digits.empty())
        add_attribute(k, digits, lists[k], is_broken[k]);
      else if (slash == std::string_view::npos)
        drop_slash(token);
      if (slash == std::string_view::npos) return;
      rest.remove_prefix(slash + 1);
    }
    if (!rest.empty()) refuse_corner(token);
    drop_slash(token);
  }

  void drop_slash(std::string_view token) {
    content_.dropped.add(DroppedPart::Slash, [&] {
      return here(fmt::format("{} ends with a slash", in_quotes(token)));
    });
  }

  Index vertex_of(std::string_view digits, std::string_view token) {
    ObjIndexSpace& space = content_.spaces[0];
    const ParsedIndex parsed = find_index(digits, space);
    if (parsed.is_no_number) refuse_corner(token);
    if (!parsed.problem.empty()) cursor_.fail(parsed.problem + "; correct the face");
    if (parsed.index >= space.largest) {
      space.largest = parsed.index + 1LL;
      space.largest_line = cursor_.line();
    }
    return parsed.index;
  }

  void add_attribute(std::size_t k, std::string_view digits, std::vector<Index>& list,
                     bool& is_broken) {
    const ParsedIndex parsed = find_index(digits, content_.spaces[k]);
    if (!parsed.problem.empty() && !is_broken) {
      is_broken = true;
      content_.dropped.add(k == 1 ? DroppedPart::FaceTexcoords : DroppedPart::FaceNormals,
                           [&] { return here(parsed.problem); });
    }
    list.push_back(parsed.index);
  }

  [[noreturn]] void refuse_corner(std::string_view token) {
    cursor_.fail(fmt::format("{} is no face corner (v, v/vt, v//vn or v/vt/vn); correct the face",
                             in_quotes(token)));
  }

  struct ParsedIndex {
    Index index = -1;  // from 0; may point forward
    std::string problem;
    bool is_no_number = false;
  };

  // Converts OBJ's numbering (1, 2, ... from the start, -1, -2, ... backwards) to 0, 1, ...
  ParsedIndex find_index(std::string_view digits, const ObjIndexSpace& space) {
    long long value = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, code] = std::from_chars(digits.data(), end, value);
    if (stop != end || code == std::errc::invalid_argument)
      return {.problem = fmt::format("{} is no {} index", in_quotes(digits), space.name),
              .is_no_number = true};
    if (code != std::errc())
      return {.problem = fmt::format("index {} overflows 64 bits", in_quotes(digits))};
    if (value == 0) return {.problem = fmt::format("{} index 0, OBJ counts from 1", space.name)};
    content_.counts_backwards = content_.counts_backwards || value < 0;
    if (value < 0) value += space.count + 1;
    if (value <= 0 || value > std::numeric_limits<Index>::max())
      return {.problem = fmt::format("{} index out of range, {} were read up to here", space.name,
                                     space.count)};
    ParsedIndex parsed;
    parsed.index = static_cast<Index>(value - 1);
    return parsed;
  }

  TextCursor cursor_;
  ObjContent content_;
  PolygonMesh& mesh_ = content_.mesh;
  std::vector<std::string_view> comments_;  // before the current line
  std::vector<double> numbers_, rounded_;
  std::array<std::vector<Index>, 3> lists_;  // of the current face
};

// Splits the text into pieces of at least this size, except the last. They end with lines that are
// not continued.
std::vector<std::string_view> pieces_of(std::string_view text, std::size_t size) {
  std::vector<std::string_view> pieces;
  while (text.size() > size) {
    std::size_t end = text.find('\n', size);
    const auto is_continued = [&] {
      const std::size_t last = text.substr(0, end).find_last_not_of(" \t\r\v\f");
      return last != std::string_view::npos && text[last] == '\\';
    };
    while (end != std::string_view::npos && is_continued()) end = text.find('\n', end + 1);
    if (end == std::string_view::npos) break;
    pieces.push_back(text.substr(0, end + 1));
    text.remove_prefix(end + 1);
  }
  pieces.push_back(text);
  return pieces;
}

// Reads pieces on all threads. Returns nothing if pieces depend on each other or are broken;
// sequential reading then reports the error.
std::optional<PolygonMesh> read_pieces(const std::string& path, std::string_view text,
                                       const StopCheck& stop, Strictness strictness) {
  constexpr std::size_t kPiece = std::size_t{1} << 17;  // about 1 ms
  const std::vector<std::string_view> pieces = pieces_of(text, kPiece);
  std::vector<std::unique_ptr<ObjReader>> readers(pieces.size());
  std::atomic<bool> is_one = false;
  ParsedBytes parsed(text.size());  // pieces are too small to be counted
  parallel_tasks(static_cast<Index>(pieces.size()), [&](Index k, int) {
    if (is_one) return;
    try {
      readers[k] = std::make_unique<ObjReader>(path, pieces[k], stop, strictness);
      readers[k]->reserve(k == 0 ? text : pieces[k]);  // the other pieces are appended to the first
      readers[k]->read_lines();
      if (!readers[k]->content().is_independent()) is_one = true;
      parsed.add(pieces[k].size());
    } catch (const Error&) {
      is_one = true;
    }
  });
  if (is_one) return std::nullopt;
  ObjContent content = readers[0]->take_content();
  for (std::size_t k = 1; k < readers.size(); ++k) {
    append(content, readers[k]->take_content());
    readers[k].reset();
  }
  return conclude(std::move(content));
}

}  // namespace

PolygonMesh read_obj(const std::string& path, std::string content, const StopCheck& stop,
                     Strictness strictness) {
  require_text(path, content);
  if (ThreadCount::current() > 1 && !is_parallel_task())
    if (auto mesh = read_pieces(path, content, stop, strictness)) return std::move(*mesh);
  ObjReader reader(path, content, stop, strictness);
  reader.reserve(content);
  reader.read_lines();
  return conclude(reader.take_content());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
