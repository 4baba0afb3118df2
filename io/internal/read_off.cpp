// Object File Format of Geomview: "OFF", the counts of vertices, faces and edges, the vertices, the
// faces (corner count, corners, optional colour).
//
// By its manual the file is a stream of numbers, in which line ends only end the colour of a face.
// But many files have undeclared numbers after the coordinates of a vertex, and others several
// faces on a line. A file is read as the first of three forms that it fits. These are a stream
// without colours, to the last number; one line for each vertex and face, with anything after the
// expected numbers; a stream with colours to the ends of lines. Broken colours and one extra line
// are dropped (dropped_parts.h).
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/dropped_parts.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

class OffReader {
 public:
  OffReader(const std::string& path, std::string_view text, const StopCheck& stop,
            Strictness strictness)
      : cursor_(path, text, TextLines::Plain, stop),
        size_(static_cast<long long>(text.size())),
        ends_with_line_(text.ends_with('\n')),
        dropped_(strictness) {
    mesh_.file = path;
  }

  PolygonMesh read() {
    read_header();
    choose_layout();
    for (long long i = 0; i < vertices_; ++i) read_vertex(i);
    for (long long i = 0; i < faces_ && has_face(i); ++i) read_face(i);
    if (mesh_.faces_missing == 0) read_end();
    require_complete(mesh_);
    dropped_.conclude(mesh_);
    return std::move(mesh_);
  }

 private:
  // One extra line is common; other programs do not read it.
  void read_end() {
    if (cursor_.at_end_of_line() && !cursor_.next_line()) return;
    TextCursor ahead = cursor_;
    if (ahead.next_line())
      cursor_.fail("content after the last face that the header announces; correct the counts");
    dropped_.add(DroppedPart::Line, [&] {
      return here(fmt::format("one line more than {} vertices and {} faces", vertices_, faces_));
    });
  }

  std::string here(std::string_view problem) const {
    return fmt::format("{}:{}: {}", mesh_.file, cursor_.line(), problem);
  }

  // Reads a number that does not concern the shape.
  void skip_attribute(std::string_view what) {
    double ignored = 0;
    if (!cursor_.try_number(ignored))
      dropped_.add(DroppedPart::Color, [&] { return here(cursor_.number_problem(what)); });
  }

  void read_header() {
    if (!cursor_.next_line()) cursor_.fail("the header OFF is missing; the file is empty");
    const std::string_view keyword = cursor_.next_token();
    if (!keyword.ends_with("OFF") || keyword.size() > 8) {
      cursor_.fail(
          fmt::format("{} instead of OFF; check that this is an OFF file", in_quotes(keyword)));
    }
    for (const char c : keyword.substr(0, keyword.size() - 3)) {
      if (c != 'S' && c != 'T' && c != 'C' && c != 'N') {
        cursor_.fail(fmt::format("{} is not supported; three coordinates per vertex are needed",
                                 in_quotes(keyword)));
      }
      attributes_ += c == 'C' ? 4 : c == 'N' ? 3 : 1;  // RGBA, a normal; ST: two coordinates
    }
    require_more("the counts are missing; the file is truncated");
    vertices_ = read_count("number of vertices");
    const bool counts_share_a_line = !cursor_.at_end_of_line();
    require_more("the number of faces is missing; the file is truncated");
    faces_ = read_count("number of faces");
    // The number of edges may be missing.
    if (!counts_share_a_line) require_more("the number of edges is missing");
    if (!cursor_.at_end_of_line()) cursor_.next_integer("number of edges");
    mesh_.positions.reserve(static_cast<std::size_t>(vertices_));
    mesh_.polygons.reserve(static_cast<std::size_t>(faces_), 3 * static_cast<std::size_t>(faces_));
  }

  // A number takes at least two bytes, a vertex or a face more than one; larger counts are refused.
  long long read_count(std::string_view what) {
    const long long count = cursor_.next_integer(what);
    if (count < 0 || count > size_ / 2) {
      cursor_.fail(fmt::format("{} {} does not fit the size of the file; truncated?", what, count));
    }
    return count;
  }

  enum class Layout { Stream, Lines, StreamWithColors };

  void choose_layout() {
    if (fits_stream()) return;
    TextCursor ahead = cursor_;
    long long lines = 0;
    const bool begins_with_line = ahead.at_end_of_line();
    while (ahead.next_line()) ++lines;
    layout_ =
        begins_with_line && lines == vertices_ + faces_ ? Layout::Lines : Layout::StreamWithColors;
  }

  // Returns whether the rest of the file consists of vertices and faces without colours.
  bool fits_stream() const {
    TextCursor ahead = cursor_;
    const auto next = [&ahead] {
      while (ahead.at_end_of_line())
        if (!ahead.next_line()) return std::string_view();
      return ahead.next_token();
    };
    for (long long k = 0; k < vertices_ * (3 + attributes_); ++k)
      if (next().empty()) return false;
    for (long long i = 0; i < faces_; ++i) {
      const std::string_view token = next();
      long long corners = 0;
      const auto [stop, code] = std::from_chars(token.data(), token.data() + token.size(), corners);
      if (code != std::errc() || stop != token.data() + token.size()) return false;
      if (corners < 3) return false;
      for (long long k = 0; k < corners; ++k)
        if (next().empty()) return false;
    }
    return next().empty();
  }

  // Continues on the next line if this one is at its end and records may be continued.
  void continue_record(std::string_view what, long long i, long long announced) {
    if (layout_ == Layout::Lines) return;
    while (cursor_.at_end_of_line())
      if (!cursor_.next_line()) refuse_end(what, i, announced);
  }

  void begin_record(std::string_view what, long long i, long long announced) {
    if (layout_ != Layout::Lines) return continue_record(what, i, announced);
    if (!cursor_.next_line()) refuse_end(what, i, announced);
  }

  void read_vertex(long long i) {
    begin_record("vertices", i, vertices_);
    Vector3 position;
    for (int k = 0; k < 3; ++k) {
      continue_record("vertices", i, vertices_);
      position[k] = cursor_.next_number("coordinate");
    }
    if (layout_ == Layout::Lines) {
      while (!cursor_.at_end_of_line()) skip_attribute("vertex attribute");
    } else {
      for (int k = 0; k < attributes_; ++k) {
        continue_record("vertices", i, vertices_);
        skip_attribute("vertex attribute");
      }
    }
    mesh_.positions.push_back(position);
  }

  // Returns whether face i follows. If the file ends after a complete line of a face, the header
  // counts too many faces.
  bool has_face(long long i) {
    if (i == 0 || !ends_with_line_) return true;
    TextCursor ahead = cursor_;
    if (!ahead.at_end_of_line() || ahead.next_line()) return true;
    mesh_.faces_missing = static_cast<Index>(faces_ - i);
    dropped_.add(DroppedPart::Faces, [&] {
      return here(fmt::format("{} of the {} faces that the header announces", i, faces_));
    });
    return false;
  }

  void read_face(long long i) {
    begin_record("faces", i, faces_);
    const long line = cursor_.line();
    const long long corners = cursor_.next_integer("number of corners");
    if (corners < 3) {
      cursor_.fail(fmt::format("face with {} corners; at least 3 are needed", corners));
    }
    polygon_.clear();
    for (long long k = 0; k < corners; ++k) {
      continue_record("faces", i, faces_);
      const long long vertex = cursor_.next_integer("vertex index");
      if (vertex < 0 || vertex >= vertices_) {
        cursor_.fail(fmt::format("vertex index {} out of range 0..{}; correct the face", vertex,
                                 vertices_ - 1));
      }
      polygon_.push_back(static_cast<Index>(vertex));
    }
    while (layout_ != Layout::Stream && !cursor_.at_end_of_line()) skip_attribute("face colour");
    mesh_.polygons.push_back(polygon_);
    mesh_.polygon_lines.push_back(line);
  }

  void require_more(std::string_view problem) {
    while (cursor_.at_end_of_line())
      if (!cursor_.next_line()) cursor_.fail(problem);
  }

  [[noreturn]] void refuse_end(std::string_view what, long long found, long long announced) {
    cursor_.fail(fmt::format("{} of {} {} found; the file is truncated", found, announced, what));
  }

  TextCursor cursor_;
  long long size_;
  bool ends_with_line_;
  long long vertices_ = 0, faces_ = 0;
  int attributes_ = 0;  // numbers after the coordinates of a vertex
  Layout layout_ = Layout::Stream;
  DroppedParts dropped_;
  PolygonMesh mesh_;
  std::vector<Index> polygon_;  // the current one
};

}  // namespace

PolygonMesh read_off(const std::string& path, std::string content, const StopCheck& stop,
                     Strictness strictness) {
  require_text(path, content);
  return OffReader(path, content, stop, strictness).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
