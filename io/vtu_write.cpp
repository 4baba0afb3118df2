#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "majorant/io/atomic_file.h"
#include "majorant/io/base64.h"
#include "majorant/io/formats.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/io/vtu_text.h"
#include "majorant/io/written_mark.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

static_assert(std::endian::native == std::endian::little, "write_vtu writes memory as it is");

template <class T>
constexpr std::string_view type_name() {
  if (std::is_same_v<T, double>) return "Float64";
  if (std::is_same_v<T, std::int64_t>) return "Int64";
  return std::is_same_v<T, std::int32_t> ? "Int32" : "UInt8";
}

class VtuText {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  // `size` values in row-major order; an empty array is left out.
  template <class T>
  void add_array(std::string_view name, int components, const T* values, Eigen::Index size) {
    if (size == 0) return;
    const std::uint64_t bytes = static_cast<std::uint64_t>(size) * sizeof(T);
    std::string data(sizeof(bytes) + bytes, '\0');
    std::memcpy(data.data(), &bytes, sizeof(bytes));
    std::memcpy(data.data() + sizeof(bytes), values, bytes);
    add("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n",
        type_name<T>(), name, components);
    append_base64(data, text_);
    text_ += "\n</DataArray>\n";
  }

  // Bytes as numbers: there are readers that know no array of strings, and refuse the whole file.
  void add_claims(std::string_view value) {
    add("{}{}{}\n", claims_begin(), value.size(), claims_end());
    add("{}",
        fmt::join(std::span(reinterpret_cast<const unsigned char*>(value.data()), value.size()),
                  " "));
    text_ += "\n</DataArray>\n";
  }

  // Makes room for a text of that size: it grows without being copied.
  void reserve(std::size_t size) { text_.reserve(size); }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void add_cells(const MapFile& map, VtuCells cells, VtuText& text) {
  const Eigen::Index count = map.cells.rows();
  const auto size = static_cast<std::size_t>(count);
  const std::vector<std::int64_t> connectivity(map.cells.data(),
                                               map.cells.data() + map.cells.size());
  std::vector<std::int64_t> offsets(size);
  for (std::size_t f = 0; f < size; ++f) {
    offsets[f] = static_cast<std::int64_t>(f + 1) * map.cells.cols();
  }
  const int curved = cells == VtuCells::Lagrange ? 69 : 76;
  const std::vector<std::uint8_t> types(size, map.degree == 1 ? 5 : curved);
  text.add("<Cells>\n");
  text.add_array("connectivity", 1, connectivity.data(), map.cells.size());
  text.add_array("offsets", 1, offsets.data(), count);
  text.add_array("types", 1, types.data(), count);
  text.add("</Cells>\n");
}

// Per point the smallest chain + 1 of the seam edges it is on.
Eigen::VectorXi seam_of_points(const MapFile& map) {
  Eigen::VectorXi seam = Eigen::VectorXi::Zero(map.points.rows());
  for (int edge = 0; edge < 3; ++edge) {
    const std::vector<int> on_edge = bezier_edge_points(map.degree, edge);
    for (Index f = 0; f < map.seam_edges.rows(); ++f) {
      const Index chain = map.seam_edges(f, edge);
      if (chain == 0) continue;
      for (const int local : on_edge) {
        int& value = seam[map.cells(f, local)];
        value = value == 0 ? chain : std::min(value, chain);
      }
    }
  }
  return seam;
}

// Of the text: of arrays base64 with a header, of claims bytes of up to four characters.
std::size_t greatest_size(const MapFile& map) {
  constexpr std::size_t kMarkup = 8192;
  const auto numbers = [](const auto&... arrays) {
    return (static_cast<std::size_t>(arrays.size()) + ...);
  };
  const std::size_t cells = numbers(map.chart) + static_cast<std::size_t>(map.cells.rows());
  const std::size_t bytes =
      sizeof(double) *
          numbers(map.uv, map.points, map.distortion, map.min_det, map.face_distortion) +
      sizeof(Index) * (numbers(map.input_vertex, map.cone, map.input_face, map.seam_edges) +
                       static_cast<std::size_t>(map.points.rows())) +
      sizeof(std::int64_t) * (numbers(map.cells) + 2 * cells);
  return base64_length(bytes) + 4 * map.claims.size() + kMarkup;
}

}  // namespace

std::string vtu_text(const std::string& path, const MapFile& map, VtuCells cells) {
  require_sound(path, map);
  if (cells == VtuCells::Lagrange) require_lagrange_degree(path, map);
  const Points2 uv = cells == VtuCells::Lagrange ? lagrange_nodes(map) : map.uv;
  VtuText text;
  text.reserve(greatest_size(map));
  text.add(
      "<?xml version=\"1.0\"?>\n{}<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n",
      map.claims.empty() ? mark_text(MarkStyle::XmlComment) : "");  // claims are a mark
  if (!map.claims.empty()) {
    text.add("<FieldData>\n");
    text.add_claims(map.claims);
    text.add("</FieldData>\n");
  }
  text.add("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", map.points.rows(),
           map.cells.rows());
  text.add("<PointData TCoords=\"uv\">\n");
  text.add_array("uv", 2, uv.data(), uv.size());
  text.add_array("input_vertex", 1, map.input_vertex.data(), map.input_vertex.size());
  text.add_array("cone", 1, map.cone.data(), map.cone.size());
  if (map.seam_edges.size() > 0)
    text.add_array("seam", 1, seam_of_points(map).data(), map.points.rows());
  text.add("</PointData>\n<CellData>\n");
  text.add_array("distortion", 1, map.distortion.data(), map.distortion.size());
  text.add_array("min_det", 1, map.min_det.data(), map.min_det.size());
  for (std::size_t k = 0; k < kFaceDistortionNames.size(); ++k)
    text.add_array(kFaceDistortionNames[k], 1,
                   map.face_distortion.col(static_cast<Eigen::Index>(k)).data(),
                   map.face_distortion.rows());
  text.add_array("input_face", 1, map.input_face.data(), map.input_face.size());
  text.add_array("chart", 1, map.chart.data(), map.chart.size());
  text.add_array("seam_edges", 3, map.seam_edges.data(), map.seam_edges.size());
  text.add("</CellData>\n<Points>\n");
  text.add_array("Points", 3, map.points.data(), map.points.size());
  text.add("</Points>\n");
  add_cells(map, cells, text);
  text.add("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  return text.take();
}

void write_vtu(const std::string& path, const MapFile& map, VtuCells cells,
               const FileVerification& verify) {
  write_file_atomically(path, vtu_text(path, map, cells), verify);
}

void write_vtu(const std::string& path, const MapFile& map, const FileVerification& verify) {
  write_vtu(path, map, VtuCells::Bezier, verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
