// Wavefront OBJ. The grammar accepted here is the polygonal subset of the "Object Files (.obj)"
// appendix of Wavefront's Advanced Visualizer manual. Points, lines and attributes are kept as they
// are; what else a line may begin with, curves and surfaces of the manual or words that programs
// have added, is skipped, and said in one warning.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <limits>

#include "majorant/framework/error.h"
#include "majorant/io/internal/input_file.h"
#include "majorant/io/internal/line_cursor.h"
#include "majorant/io/internal/mesh_readers.h"

namespace majorant {
namespace {

// Lines that are kept as they are.
constexpr std::array<std::string_view, 14> kDirectives = {
    "g",        "o",        "s",   "mg",     "usemtl", "mtllib",     "bevel",
    "c_interp", "d_interp", "lod", "maplib", "usemap", "shadow_obj", "trace_obj"};

template <class List>
bool contains(const List& list, std::string_view keyword) {
  return std::find(list.begin(), list.end(), keyword) != list.end();
}

// One of the three index spaces v, vt, vn: how many elements there are so far, and the largest
// positive index yet, which may point forward and is checked at the end.
struct IndexSpace {
  std::string_view name;
  long long count = 0;
  long long largest = 0;
  long largest_line = 0;
  long partial_faces = 0, first_partial = 0;  // faces of which some corners have an index
};

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view text, const StopCheck& stop)
      : cursor_(path, text, Continuation::Backslash, stop) {
    mesh_.file = path;
  }

  PolygonMesh read() {
    while (cursor_.next_line()) read_line();
    for (const IndexSpace& space : spaces_) require_in_range(space);
    require_complete(mesh_);
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), no_color());
    if (skipped_lines_ > 0) warn_of_skipped();
    for (const IndexSpace& space : spaces_)
      if (space.partial_faces > 0) warn_of_partial(space);
    if (!has_texcoords_) mesh_.polygon_texcoords.clear();
    if (!has_normals_) mesh_.polygon_normals.clear();
    return std::move(mesh_);
  }

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
      mesh_.normals.push_back(read_vector("normal component"));
      while (!cursor_.at_end_of_line()) cursor_.next_number("normal component");
      ++spaces_[2].count;
    } else if (keyword == "l" || keyword == "p") {
      keep_element(keyword);
    } else if (contains(kDirectives, keyword)) {
      keep_directive();
    } else {
      skip_line(keyword);
    }
  }

  // Words are skipped; what begins in another way is a broken line, or no OBJ.
  void skip_line(std::string_view keyword) {
    if (!std::isalpha(static_cast<unsigned char>(keyword.front()))) {
      cursor_.fail(
          fmt::format("{} is no OBJ keyword; check that this is an OBJ file", in_quotes(keyword)));
    }
    if (skipped_lines_++ == 0) first_skipped_ = cursor_.line();
    const std::string name = in_quotes(keyword);
    if (skipped_.size() < kMostNamed && !contains(skipped_, name)) skipped_.push_back(name);
  }

  void warn_of_skipped() {
    mesh_.warnings.push_back(fmt::format(
        "{}:{}: {} line{} skipped that say nothing about polygons, of {}{}", mesh_.file,
        first_skipped_, skipped_lines_, skipped_lines_ == 1 ? "" : "s", fmt::join(skipped_, ", "),
        skipped_.size() == kMostNamed ? " and maybe others" : ""));
  }

  void warn_of_partial(const IndexSpace& space) {
    mesh_.warnings.push_back(fmt::format(
        "{}:{}: {} face{} with a {} index at some corners only, taken as without", mesh_.file,
        space.first_partial, space.partial_faces, space.partial_faces == 1 ? "" : "s", space.name));
  }

  Vector3 read_vector(std::string_view what) {
    Vector3 vector;
    for (int k = 0; k < 3; ++k) vector[k] = cursor_.next_number(what);
    return vector;
  }

  static Vector3 no_color() { return Vector3::Constant(std::numeric_limits<double>::quiet_NaN()); }

  // A position, and a colour if three numbers more follow. Others (a weight) are dropped.
  void read_vertex() {
    mesh_.positions.push_back(read_vector("coordinate"));
    ++spaces_[0].count;
    std::vector<double> more;
    while (!cursor_.at_end_of_line()) more.push_back(cursor_.next_number("coordinate"));
    if (more.size() != 3) return;
    mesh_.colors.resize(mesh_.positions.size(), no_color());
    mesh_.colors.back() = Vector3(more[0], more[1], more[2]);
  }

  // Points and lines, by the numbers of vertices alone: an output has other texture coordinates.
  void keep_element(std::string_view keyword) {
    std::string text(keyword);
    while (!cursor_.at_end_of_line()) {
      const std::string_view token = cursor_.next_token();
      text += fmt::format(
          " {}", 1 + resolve(read_index(token.substr(0, token.find('/')), token), spaces_[0]));
    }
    mesh_.directives.emplace_back(static_cast<Index>(mesh_.polygons.size()), std::move(text));
  }

  // All of `digits`, which are of this token.
  long long read_index(std::string_view digits, std::string_view token) {
    long long value = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, code] = std::from_chars(digits.data(), end, value);
    if (code != std::errc() || stop != end)
      cursor_.fail(fmt::format("{} is no vertex index; correct the file", in_quotes(token)));
    return value;
  }

  void read_texcoord() {
    Vector2 texcoord(cursor_.next_number("texture coordinate"), 0.0);
    Vector2 rounding(cursor_.rounding(), 0.0);
    if (!cursor_.at_end_of_line()) {
      texcoord[1] = cursor_.next_number("texture coordinate");
      rounding[1] = cursor_.rounding();
    }
    while (!cursor_.at_end_of_line()) cursor_.next_number("texture coordinate");
    mesh_.texcoords.push_back(texcoord);
    mesh_.texcoord_rounding.push_back(rounding);
    ++spaces_[1].count;
  }

  void keep_directive() {
    // A continued line becomes one line: backslash, what follows it and the line end are a space.
    std::string text;
    for (std::string_view rest = cursor_.whole_line(); !rest.empty();) {
      const std::size_t end = rest.find('\n');
      const std::string_view line = rest.substr(0, end);
      if (end == std::string_view::npos) {
        text += line;
        break;
      }
      text += line.substr(0, line.rfind('\\'));
      text.push_back(' ');
      rest.remove_prefix(end + 1);
    }
    mesh_.directives.emplace_back(static_cast<Index>(mesh_.polygons.size()), std::move(text));
  }

  void read_face() {
    std::array<std::vector<Index>, 3> lists;
    while (!cursor_.at_end_of_line()) read_corner(cursor_.next_token(), lists);
    const std::size_t corners = lists[0].size();
    if (corners < 3) {
      cursor_.fail(
          fmt::format("face with {} corner{}; at least 3 are needed, the file may be "
                      "truncated",
                      corners, corners == 1 ? "" : "s"));
    }
    for (std::size_t k = 1; k < 3; ++k) {
      if (lists[k].empty() || lists[k].size() == corners) continue;
      lists[k].clear();
      if (spaces_[k].partial_faces++ == 0) spaces_[k].first_partial = cursor_.line();
    }
    has_texcoords_ |= !lists[1].empty();
    has_normals_ |= !lists[2].empty();
    mesh_.polygons.push_back(std::move(lists[0]));
    mesh_.polygon_texcoords.push_back(std::move(lists[1]));
    mesh_.polygon_normals.push_back(std::move(lists[2]));
    mesh_.polygon_lines.push_back(cursor_.line());
  }

  // v, v/vt, v//vn or v/vt/vn.
  void read_corner(std::string_view token, std::array<std::vector<Index>, 3>& lists) {
    const char* at = token.data();
    const char* end = at + token.size();
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(k == 1 && at != end && *at == '/')) {  // v//vn leaves vt out
        long long value = 0;
        const auto [stop, code] = std::from_chars(at, end, value);
        if (code == std::errc::result_out_of_range) {
          cursor_.fail(
              fmt::format("index {} overflows 64 bits; correct the face", in_quotes(token)));
        }
        if (code != std::errc()) refuse_corner(token);
        at = stop;
        lists[k].push_back(resolve(value, spaces_[k]));
      }
      if (at == end) return;
      if (*at != '/' || k == 2) refuse_corner(token);
      ++at;
    }
  }

  [[noreturn]] void refuse_corner(std::string_view token) {
    cursor_.fail(fmt::format("{} is no face corner (v, v/vt, v//vn or v/vt/vn); correct the face",
                             in_quotes(token)));
  }

  // From OBJ's numbering (1, 2, ... from the start, -1, -2, ... back from here) to 0, 1, ...
  Index resolve(long long value, IndexSpace& space) {
    if (value == 0) {
      cursor_.fail(fmt::format("{} index 0; OBJ counts from 1", space.name));
    }
    if (value < 0) value += space.count + 1;
    if (value <= 0 || value > std::numeric_limits<Index>::max()) {
      cursor_.fail(fmt::format("{} index out of range, {} were read up to here; correct the file",
                               space.name, space.count));
    }
    if (value > space.largest) {
      space.largest = value;
      space.largest_line = cursor_.line();
    }
    return static_cast<Index>(value - 1);
  }

  void require_in_range(const IndexSpace& space) const {
    if (space.largest <= space.count) return;
    throw Error(
        ErrorKind::Unreadable,
        fmt::format("{}:{}: {} index {} out of range, the file has {}; correct the face",
                    mesh_.file, space.largest_line, space.name, space.largest, space.count));
  }

  LineCursor cursor_;
  PolygonMesh mesh_;
  std::array<IndexSpace, 3> spaces_ = {IndexSpace{"v"}, IndexSpace{"vt"}, IndexSpace{"vn"}};
  bool has_texcoords_ = false;
  bool has_normals_ = false;
  static constexpr std::size_t kMostNamed = 8;  // keywords in the warning
  std::vector<std::string> skipped_;            // in quotes
  long skipped_lines_ = 0, first_skipped_ = 0;
};

}  // namespace

PolygonMesh read_obj(const std::string& path, std::string content, const StopCheck& stop) {
  require_text(path, content);
  return ObjReader(path, content, stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
