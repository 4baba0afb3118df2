// PLY (Stanford polygon file). Every record is decoded by the layout that the header declares.
// Everything except positions, texture coordinates, colours, faces and strips of triangles is
// skipped. Broken texture coordinates, broken colours and one extra line are dropped
// (dropped_parts.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/dropped_parts.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/io/internal/ply_header.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {
namespace {

// The records of a PLY file after its header, from text or from bytes. Both classes have the same
// members, for read_ply. They throw Error(Unreadable) naming the place. After read_record(), the
// record has size(p) values of its property p, value(p, k); a number has size 1.

// Returns the size that a list announces.
template <class Source>
std::size_t list_size(const Source& source, double size, long long record) {
  if (!(size >= 0.0 && size <= 4294967295.0) || size != std::floor(size))
    source.fail(fmt::format("record {}: bad list size; correct the file", record + 1));
  return static_cast<std::size_t>(size);
}

// Numbers from text; a record is a line.
class AsciiPlySource {
 public:
  AsciiPlySource(const std::string& path, std::string_view text, long first_line)
      : cursor_(path, text, TextLines::Plain),
        first_line_(first_line),
        ends_with_line_(text.ends_with('\n')),
        path_(path) {}

  // Returns whether the text ends after a complete record.
  bool is_at_end() const {
    if (!ends_with_line_) return false;
    TextCursor ahead = cursor_;
    return ahead.at_end_of_line() && !ahead.next_line();
  }
  void read_record(const PlyElement& element, long long record, const StopCheck& stop) {
    if (!cursor_.next_line()) fail("a record is missing; the file is truncated");
    values_.clear();
    begin_.assign(1, 0);
    for (const PlyProperty& property : element.properties) {
      const std::size_t count = property.list_size_type ? list_size(*this, next(), record) : 1;
      for (std::size_t k = 0; k < count; ++k) {
        stop.poll_at(k + 1);
        values_.push_back(next());
      }
      begin_.push_back(values_.size());
    }
    if (!cursor_.at_end_of_line()) fail("more numbers than the header declares; correct the file");
  }
  std::size_t size(std::size_t p) const { return begin_[p + 1] - begin_[p]; }
  double value(std::size_t p, std::size_t k = 0) const { return values_[begin_[p] + k]; }
  // Returns the number of records to reserve memory for.
  std::size_t begin_element(const PlyElement&) { return 0; }
  // Drops one line more than the header announces.
  void finish(DroppedParts& dropped) {
    if (!cursor_.next_line()) return;
    TextCursor ahead = cursor_;
    if (ahead.next_line()) fail("content after the last record; correct the header's counts");
    dropped.add(DroppedPart::Line, [this] {
      return where("", place(0)) + ": one line more than the header announces";
    });
  }
  long place(long long) const { return first_line_ + cursor_.line(); }
  // Returns the place of a record of this element, for messages.
  std::string where(std::string_view, long place) const {
    return fmt::format("{}:{}", path_, place);
  }
  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}:{}: {}", path_, first_line_ + cursor_.line(), problem));
  }

 private:
  // Returns NaN for anything that is not a finite number.
  double next() {
    if (cursor_.at_end_of_line()) fail("a number is missing; the file may be truncated");
    double value = 0.0;
    return cursor_.try_number(value) ? value : std::numeric_limits<double>::quiet_NaN();
  }

  TextCursor cursor_;
  std::vector<double> values_;      // of the record, by properties
  std::vector<std::size_t> begin_;  // of each property, in `values_`
  long first_line_;
  bool ends_with_line_;
  const std::string& path_;
};

// Records of bytes. Values are decoded when they are read, so that properties without a use cost
// nothing, and without lists all records of an element have the same layout.
class BinaryPlySource {
 public:
  BinaryPlySource(const std::string& path, std::string_view bytes, ByteOrder order)
      : bytes_(bytes), path_(path), order_(order), size_(bytes.size()), parsed_(bytes.size()) {}

  bool is_at_end() const { return false; }  // bytes do not show the end of a record

  // Requires that records with empty lists can follow, as many as announced. Returns the number of
  // those with three values in each list that can.
  std::size_t begin_element(const PlyElement& element) {
    const auto count = static_cast<std::size_t>(element.count);
    require_count(count, element.least_size());
    columns_.clear();
    std::size_t begin = 0, usual_size = 0;
    has_lists_ = false;
    for (const PlyProperty& property : element.properties) {
      const std::size_t width = ply_type_size(property.type);
      const auto& list_size_type = property.list_size_type;
      columns_.push_back({begin, 1, property.type, list_size_type});
      begin += width;
      usual_size += list_size_type ? ply_type_size(*list_size_type) + 3 * width : width;
      has_lists_ |= list_size_type.has_value();
    }
    stride_ = begin;
    return std::min(count, bytes_.size() / usual_size);
  }

  void read_record(const PlyElement&, long long record, const StopCheck&) {
    if (++records_ % StopCheck::kPeriod == 0) parsed_.reach(size_ - bytes_.size());
    record_ = bytes_.data();
    const std::size_t record_size = has_lists_ ? place_columns(record) : stride_;
    bytes_.remove_prefix(record_size);
  }

  std::size_t size(std::size_t p) const { return columns_[p].count; }
  double value(std::size_t p, std::size_t k = 0) const {
    const Column& column = columns_[p];
    return decoded(column.type, record_ + column.begin + k * ply_type_size(column.type));
  }

  void finish(DroppedParts&) {}  // padding after the last record is harmless
  long place(long long record) const { return static_cast<long>(record) + 1; }
  std::string where(std::string_view element, long place) const {
    return fmt::format("{}: {} {}", path_, element, place);
  }
  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
  }

 private:
  struct Column {
    std::size_t begin, count;  // first byte of the values in the record; values
    PlyType type;
    std::optional<PlyType> list_size_type;
  };

  double decoded(PlyType type, const char* at) const {
    switch (type) {
      case PlyType::Int8:
        return load_bytes<signed char>(at, order_);
      case PlyType::UInt8:
        return load_bytes<unsigned char>(at, order_);
      case PlyType::Int16:
        return load_bytes<std::int16_t>(at, order_);
      case PlyType::UInt16:
        return load_bytes<std::uint16_t>(at, order_);
      case PlyType::Int32:
        return load_bytes<std::int32_t>(at, order_);
      case PlyType::UInt32:
        return load_bytes<std::uint32_t>(at, order_);
      case PlyType::Float32:
        return static_cast<double>(load_bytes<float>(at, order_));
      case PlyType::Float64:
        break;
    }
    return load_bytes<double>(at, order_);
  }

  // Finds the columns of a record with lists. Returns its size.
  std::size_t place_columns(long long record) {
    std::size_t at = 0;
    for (Column& column : columns_) {
      if (column.list_size_type) {
        const std::size_t width = ply_type_size(*column.list_size_type);
        require(at + width);
        column.count =
            list_size(*this, decoded(*column.list_size_type, bytes_.data() + at), record);
        at += width;
        const std::size_t left = bytes_.size() - at;
        if (column.count > left / ply_type_size(column.type)) refuse_count(column.count, left);
      }
      column.begin = at;
      at += column.count * ply_type_size(column.type);
      require(at);
    }
    return at;
  }

  void require(std::size_t count) const {
    if (count > bytes_.size()) fail("binary data end too early; the file is truncated");
  }
  // Requires that `count` items of at least `size` bytes can still follow.
  void require_count(std::size_t count, std::size_t size) const {
    if (count > bytes_.size() / size) refuse_count(count, bytes_.size());
  }
  [[noreturn]] void refuse_count(std::size_t count, std::size_t left) const {
    fail(fmt::format("{} entries announced, {} bytes left; truncated", count, left));
  }

  std::string_view bytes_;  // that are left
  const char* record_ = nullptr;
  std::vector<Column> columns_;
  bool has_lists_ = false;
  std::size_t stride_ = 0;  // of records without lists
  const std::string& path_;
  ByteOrder order_;
  std::size_t size_, records_ = 0;
  ParsedBytes parsed_;
};

// Joins vertices that a file holds several times, for the texture coordinates on both sides of a
// cut.

// copy_of: for each vertex of the mesh, the number of its original, from 0 without gaps; not empty.
// Afterwards the originals are the vertices; each copy keeps its texture coordinates. Throws
// Error(Unreadable) for other numbers, or if copies are at different places.
void join_copies(PolygonMesh& mesh, const std::vector<Index>& copy_of) {
  const auto damaged = [&](std::string_view problem) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: input_vertex {}; damaged file", mesh.file, problem));
  };
  const Index largest = *std::max_element(copy_of.begin(), copy_of.end());
  if (to_size(largest) >= copy_of.size()) damaged(fmt::format("{} is out of range", largest));
  std::vector<Index> first(to_size(largest) + 1, -1);
  for (std::size_t k = 0; k < copy_of.size(); ++k) {
    Index& original = first[copy_of[k]];
    if (original < 0) original = static_cast<Index>(k);
    if (mesh.positions[original] != mesh.positions[k])
      damaged(fmt::format("{} is at two places", copy_of[k]));
  }
  std::vector<Vector3> positions, colors;
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] < 0) damaged(fmt::format("{} is missing", v));
    positions.push_back(mesh.positions[first[v]]);
    if (!mesh.colors.empty()) colors.push_back(mesh.colors[first[v]]);
  }
  mesh.positions = std::move(positions);
  mesh.colors = std::move(colors);
  for (Index& v : mesh.polygons.indices()) v = copy_of[v];
}

template <class Source>
class PlyReader {
 public:
  PlyReader(Source source, const std::string& path, const StopCheck& stop, Strictness strictness)
      : source_(std::move(source)), stop_(stop), dropped_(strictness) {
    mesh_.file = path;
  }

  PolygonMesh read(const PlyHeader& header) {
    for (const PlyElement& element : header.elements)
      read_element(element, &element == &header.elements.back());
    if (mesh_.faces_missing == 0) source_.finish(dropped_);
    require_indices();
    require_complete(mesh_);
    if (std::any_of(wedge_uv_.begin(), wedge_uv_.end(),
                    [](const auto& list) { return !list.empty(); })) {
      take_wedges();
    } else if (!mesh_.texcoords.empty()) {
      mesh_.polygon_texcoords = mesh_.polygons;
      if (!copy_of_.empty()) join_copies(mesh_, copy_of_);
      drop_unusable_texcoords();
    }
    dropped_.conclude(mesh_);
    return std::move(mesh_);
  }

 private:
  // Drops texture coordinates that were read as NaN.
  void drop_unusable_texcoords() {
    std::vector<Vector2> nothing;
    drop_unusable(mesh_.texcoords, nothing, mesh_.polygon_texcoords,
                  [this](std::size_t p, Index vertex) {
                    dropped_.add(DroppedPart::FaceTexcoords, [&] {
                      return fmt::format("{}: the texture coordinates of vertex {} are left out",
                                         source_.where("face", mesh_.polygon_lines[p]), vertex);
                    });
                  });
    if (mesh_.texcoords.empty()) mesh_.polygon_texcoords.clear();
  }

  void read_element(const PlyElement& element, bool is_last) {
    if (element.properties.empty() || element.count == 0) return;
    const std::size_t certain = source_.begin_element(element);
    counted(fmt::format("records of element {}", element.name), certain);
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face", is_strip = element.name == "tristrips";
    if (is_vertex) locate_vertex(element);
    if (is_vertex) mesh_.positions.reserve(certain);
    if (is_face || is_strip)
      corners_ = require_property(element, {"vertex_indices", "vertex_index"});
    if (is_face) locate_wedges(element);
    if (is_face) {
      mesh_.polygons.reserve(certain, 3 * certain);
      mesh_.polygon_lines.reserve(certain);
    }
    for (record_ = 0; record_ < element.count; ++record_) {
      stop_.poll_at(static_cast<std::size_t>(record_));
      if (is_face && is_last && record_ > 0 && source_.is_at_end()) return miss_faces(element);
      source_.read_record(element, record_, stop_);
      if (is_vertex) add_vertex();
      if (is_face) add_face();
      if (is_strip) add_strips();
    }
  }

  // Records that the file ends before the announced number of faces.
  void miss_faces(const PlyElement& element) {
    mesh_.faces_missing = static_cast<Index>(element.count - record_);
    drop(DroppedPart::Faces, element.name,
         fmt::format("{} of the {} faces that the header announces", record_, element.count));
  }

  std::size_t require_property(const PlyElement& element,
                               std::initializer_list<std::string_view> names) {
    const int found = element.find(names);
    const bool is_list = element.name != "vertex";
    if (found < 0 ||
        element.properties[static_cast<std::size_t>(found)].list_size_type.has_value() != is_list) {
      source_.fail(fmt::format("element {} has no {} {}; correct the header", element.name,
                               is_list ? "list" : "number", *names.begin()));
    }
    return static_cast<std::size_t>(found);
  }

  void locate_vertex(const PlyElement& element) {
    coordinates_ = {require_property(element, {"x"}), require_property(element, {"y"}),
                    require_property(element, {"z"})};
    locate_color(element);
    locate_texcoord(element);
    if (has_texcoords_) locate_copies(element);
  }

  void locate_texcoord(const PlyElement& element) {
    constexpr std::array<std::array<std::string_view, 2>, 4> kNames = {
        {{"texture_u", "texture_v"}, {"texcoord_u", "texcoord_v"}, {"s", "t"}, {"u", "v"}}};
    for (const auto& [u, v] : kNames) {
      const std::array<int, 2> found = {element.find({u}), element.find({v})};
      const auto is_number = [&element](int k) {
        return k >= 0 && !element.properties[static_cast<std::size_t>(k)].list_size_type;
      };
      if (!std::all_of(found.begin(), found.end(), is_number)) continue;
      texcoord_ = {static_cast<std::size_t>(found[0]), static_cast<std::size_t>(found[1])};
      has_texcoords_ = true;
      return;
    }
  }

  // Finds the properties that mark copies of a vertex in files of write_ply.
  void locate_copies(const PlyElement& element) {
    const int found = element.find({"input_vertex"});
    if (found < 0) return;
    const PlyProperty& property = element.properties[static_cast<std::size_t>(found)];
    if (property.list_size_type || property.type >= PlyType::Float32) return;
    input_vertex_ = static_cast<std::size_t>(found);
    has_copies_ = true;
  }

  // Finds u v of corners, as VCG (MeshLab) writes them.
  void locate_wedges(const PlyElement& element) {
    const int found = element.find({"texcoord"});
    has_wedges_ = found >= 0 &&
                  element.properties[static_cast<std::size_t>(found)].list_size_type.has_value();
    if (has_wedges_) wedges_ = static_cast<std::size_t>(found);
  }

  // Finds the channels of colours. They have one type; integers count from 0 to their largest
  // value.
  void locate_color(const PlyElement& element) {
    const std::array<int, 3> found = {element.find({"red", "diffuse_red", "r"}),
                                      element.find({"green", "diffuse_green", "g"}),
                                      element.find({"blue", "diffuse_blue", "b"})};
    if (*std::min_element(found.begin(), found.end()) < 0) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const PlyProperty& channel = element.properties[static_cast<std::size_t>(found[k])];
      if (channel.list_size_type) return;
      color_[k] = static_cast<std::size_t>(found[k]);
      color_scale_[static_cast<Index>(k)] = channel.type == PlyType::UInt8    ? 255.0
                                            : channel.type == PlyType::UInt16 ? 65535.0
                                                                              : 1.0;
    }
    has_colors_ = true;
  }

  template <std::size_t N>
  Eigen::Matrix<double, int{N}, 1> values_of(const std::array<std::size_t, N>& properties) const {
    Eigen::Matrix<double, int{N}, 1> values;
    for (std::size_t k = 0; k < N; ++k)
      values[static_cast<Index>(k)] = source_.value(properties[k]);
    return values;
  }

  void drop(DroppedPart part, std::string_view element, std::string_view problem) {
    dropped_.add(part, [&] {
      return fmt::format("{}: {}", source_.where(element, source_.place(record_)), problem);
    });
  }

  // A value that is not finite stays NaN here: the vertex has no colour.
  void add_vertex() {
    const Vector3 position = values_of(coordinates_);
    if (!position.allFinite())
      source_.fail(fmt::format("vertex {}: a coordinate is no finite number; correct the file",
                               record_ + 1));
    mesh_.positions.push_back(position);
    if (has_colors_) {
      const Vector3 color = values_of(color_).cwiseQuotient(color_scale_);
      if (!color.allFinite()) drop(DroppedPart::Color, "vertex", "a colour is no finite number");
      mesh_.colors.push_back(color);
    }
    if (!has_texcoords_) return;
    const Vector2 texcoord = values_of(texcoord_);
    if (!texcoord.allFinite())
      drop(DroppedPart::Texcoord, "vertex", "a texture coordinate is no finite number");
    mesh_.texcoords.push_back(texcoord);
    if (has_copies_) copy_of_.push_back(vertex_index(source_.value(input_vertex_)));
  }

  void add_face() {
    const std::size_t count = source_.size(corners_);
    if (count < 3) {
      source_.fail(
          fmt::format("face {} with {} corners; at least 3 are needed", record_ + 1, count));
    }
    polygon_.resize(count);
    for (std::size_t k = 0; k < count; ++k) polygon_[k] = vertex_index(source_.value(corners_, k));
    mesh_.polygons.push_back(polygon_);
    mesh_.polygon_lines.push_back(source_.place(record_));
    if (has_wedges_) add_wedges(count);
  }

  // An empty list means that the face has no coordinates.
  void add_wedges(std::size_t corners) {
    const std::size_t count = source_.size(wedges_);
    wedge_uv_.resize(mesh_.polygons.size());
    if (count != 0 && count != 2 * corners)
      return drop(DroppedPart::FaceTexcoords, "face",
                  fmt::format("{} corners and {} texture coordinates, 2 a corner are needed",
                              corners, count));
    auto& list = wedge_uv_.back();
    for (std::size_t k = 0; k < count; k += 2)
      list.emplace_back(source_.value(wedges_, k), source_.value(wedges_, k + 1));
    if (std::all_of(list.begin(), list.end(), [](const Vector2& uv) { return uv.allFinite(); }))
      return;
    drop(DroppedPart::FaceTexcoords, "face", "a texture coordinate is no finite number");
    list.clear();
  }

  Index vertex_index(double value) const {
    if (!(value >= 0.0 && value < std::numeric_limits<Index>::max()) ||
        value != static_cast<double>(static_cast<Index>(value))) {
      source_.fail(
          fmt::format("record {}: {} is no vertex index; correct the face", record_ + 1, value));
    }
    return static_cast<Index>(value);
  }

  // Every three consecutive vertices are a triangle, with alternating orientation; -1 begins
  // another strip. Strips repeat vertices to turn, which gives triangles without area; these are no
  // faces.
  void add_strips() {
    std::array<Index, 3> last{};
    std::size_t length = 0;  // of the strip so far
    for (std::size_t k = 0; k < source_.size(corners_); ++k) {
      const double vertex = source_.value(corners_, k);
      if (vertex == -1.0) {
        length = 0;
        continue;
      }
      last = {last[1], last[2], vertex_index(vertex)};
      if (++length < 3) continue;
      const auto [a, b, c] = last;
      if (a == b || b == c || c == a) continue;
      const bool is_turned = length % 2 == 0;
      mesh_.polygons.push_back({is_turned ? b : a, is_turned ? a : b, c});
      mesh_.polygon_lines.push_back(source_.place(record_));
    }
  }

  // Corners of one vertex with equal coordinates share them. Coordinates of vertices are ignored
  // then, and strips have none.
  void take_wedges() {
    std::map<std::tuple<Index, double, double>, Index> numbers;
    mesh_.texcoords.clear();
    wedge_uv_.resize(mesh_.polygons.size());
    std::vector<Index> list;
    for (std::size_t p = 0; p < mesh_.polygons.size(); ++p) {
      list.clear();
      for (std::size_t k = 0; k < wedge_uv_[p].size(); ++k) {
        const Vector2& uv = wedge_uv_[p][k];
        const auto [entry, is_new] = numbers.emplace(std::tuple(mesh_.polygons[p][k], uv[0], uv[1]),
                                                     static_cast<Index>(mesh_.texcoords.size()));
        if (is_new) mesh_.texcoords.push_back(uv);
        list.push_back(entry->second);
      }
      mesh_.polygon_texcoords.push_back(list);
    }
  }

  // Called at the end, since faces may come before the vertices.
  void require_indices() const {
    const auto indices = mesh_.polygons.indices();
    if (indices.empty() ||
        to_size(*std::max_element(indices.begin(), indices.end())) < mesh_.positions.size())
      return;
    for (std::size_t p = 0; p < mesh_.polygons.size(); ++p) {
      for (const Index vertex : mesh_.polygons[p]) {
        if (static_cast<std::size_t>(vertex) < mesh_.positions.size()) continue;
        throw Error(ErrorKind::Unreadable,
                    fmt::format("{}: face {}: vertex index {} out of range, the file has {} "
                                "vertices; correct the face",
                                mesh_.file, p + 1, vertex, mesh_.positions.size()));
      }
    }
  }

  Source source_;
  const StopCheck& stop_;
  PolygonMesh mesh_;
  DroppedParts dropped_;
  long long record_ = 0;
  std::array<std::size_t, 3> coordinates_{};
  std::array<std::size_t, 2> texcoord_{};
  std::array<std::size_t, 3> color_{};
  Vector3 color_scale_;
  bool has_texcoords_ = false, has_colors_ = false, has_copies_ = false, has_wedges_ = false;
  std::size_t corners_ = 0, wedges_ = 0, input_vertex_ = 0;
  std::vector<Index> copy_of_;                  // by vertex
  std::vector<std::vector<Vector2>> wedge_uv_;  // by face
  std::vector<Index> polygon_;                  // the current one
};

}  // namespace

PolygonMesh read_ply(const std::string& path, std::string content, const StopCheck& stop,
                     Strictness strictness) {
  const PlyHeader header = read_ply_header(path, content);
  if (header.encoding == PlyEncoding::Ascii) {
    std::string records = content.substr(header.size);
    require_text(path, records);
    return PlyReader(AsciiPlySource(path, records, header.lines), path, stop, strictness)
        .read(header);
  }
  const ByteOrder order =
      header.encoding == PlyEncoding::LittleEndian ? ByteOrder::Little : ByteOrder::Big;
  const std::string_view records = std::string_view(content).substr(header.size);
  return PlyReader(BinaryPlySource(path, records, order), path, stop, strictness).read(header);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
