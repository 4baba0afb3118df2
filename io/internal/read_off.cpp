// Object File Format of Geomview: "OFF", the counts of vertices, faces and edges, one line per
// vertex, one line per face (corner count, corners, optional colour).
#include <fmt/format.h>

#include <algorithm>

#include "majorant/io/internal/input_file.h"
#include "majorant/io/internal/line_cursor.h"
#include "majorant/io/internal/mesh_readers.h"

namespace majorant {
namespace {

class OffReader {
 public:
  OffReader(const std::string& path, std::string_view text, const StopCheck& stop)
      : cursor_(path, text, Continuation::None, stop), size_(static_cast<long long>(text.size())) {
    mesh_.file = path;
  }

  PolygonMesh read() {
    read_header();
    for (long long i = 0; i < vertices_; ++i) read_vertex(i);
    for (long long i = 0; i < faces_; ++i) read_face(i);
    if (cursor_.next_line()) {
      cursor_.fail("content after the last face that the header announces; correct the counts");
    }
    require_complete(mesh_);
    return std::move(mesh_);
  }

 private:
  void read_header() {
    next_line("the header OFF");
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
    }
    if (cursor_.at_end_of_line()) next_line("the counts");
    vertices_ = read_count("number of vertices");
    faces_ = read_count("number of faces");
    if (!cursor_.at_end_of_line()) cursor_.next_integer("number of edges");
    cursor_.require_end_of_line();
    mesh_.positions.reserve(static_cast<std::size_t>(vertices_));
    mesh_.polygons.reserve(static_cast<std::size_t>(faces_));
  }

  // A line of a vertex or a face has at least two bytes: larger counts are a lie.
  long long read_count(std::string_view what) {
    const long long count = cursor_.next_integer(what);
    if (count < 0 || count > size_ / 2) {
      cursor_.fail(fmt::format("{} {} does not fit the size of the file; truncated?", what, count));
    }
    return count;
  }

  void read_vertex(long long i) {
    if (!cursor_.next_line()) refuse_end("vertices", i, vertices_);
    Vector3 position;
    for (int k = 0; k < 3; ++k) position[k] = cursor_.next_number("coordinate");
    while (!cursor_.at_end_of_line()) cursor_.next_number("vertex attribute");
    mesh_.positions.push_back(position);
  }

  void read_face(long long i) {
    if (!cursor_.next_line()) refuse_end("faces", i, faces_);
    const long long corners = cursor_.next_integer("number of corners");
    if (corners < 3) {
      cursor_.fail(fmt::format("face with {} corners; at least 3 are needed", corners));
    }
    std::vector<Index> polygon;
    polygon.reserve(static_cast<std::size_t>(std::min<long long>(corners, 8)));
    for (long long k = 0; k < corners; ++k) {
      const long long vertex = cursor_.next_integer("vertex index");
      if (vertex < 0 || vertex >= vertices_) {
        cursor_.fail(fmt::format("vertex index {} out of range 0..{}; correct the face", vertex,
                                 vertices_ - 1));
      }
      polygon.push_back(static_cast<Index>(vertex));
    }
    while (!cursor_.at_end_of_line()) cursor_.next_number("face colour");
    mesh_.polygons.push_back(std::move(polygon));
    mesh_.polygon_lines.push_back(cursor_.line());
  }

  void next_line(std::string_view expected) {
    if (!cursor_.next_line())
      cursor_.fail(
          fmt::format("{} is missing; the file is empty or "
                      "truncated",
                      expected));
  }

  [[noreturn]] void refuse_end(std::string_view what, long long found, long long announced) {
    cursor_.fail(fmt::format("{} of {} {} found; the file is truncated", found, announced, what));
  }

  LineCursor cursor_;
  long long size_;
  long long vertices_ = 0;
  long long faces_ = 0;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh read_off(const std::string& path, std::string content, const StopCheck& stop) {
  require_text(path, content);
  return OffReader(path, content, stop).read();
}

}  // namespace majorant
