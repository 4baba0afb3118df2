#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "majorant/io/atomic_file.h"
#include "majorant/io/base64.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/cell_writers.h"
#include "majorant/io/internal/vtk_types.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/io/vtu_text.h"
#include "majorant/io/written_mark.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/volumes/node_orders.h"

namespace majorant {
namespace {

static_assert(std::endian::native == std::endian::little, "write_vtu writes memory as it is");

template <class T>
constexpr std::string_view type_name() {
  if (std::is_same_v<T, double>) return "Float64";
  if (std::is_same_v<T, std::int64_t>) return "Int64";
  return std::is_same_v<T, std::int32_t> ? "Int32" : "UInt8";
}

// The text of a file, array by array.
class VtkText {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  void begin(std::string_view mark, std::string_view version) {
    add("<?xml version=\"1.0\"?>\n{}<VTKFile type=\"UnstructuredGrid\" version=\"{}\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n",
        mark, version);
  }
  void begin_piece(Eigen::Index points, std::size_t cells) {
    add("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, cells);
  }
  std::string end() {
    add("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    return std::move(text_);
  }

  // Adds `size` values in row-major order; an empty array is left out.
  template <class T>
  void add_array(std::string_view name, int components, const T* values, Eigen::Index size) {
    if (size > 0) add_array(name, components, std::span(values, static_cast<std::size_t>(size)));
  }
  template <class T>
  void add_array(std::string_view name, int components, std::span<const T> values) {
    const std::uint64_t bytes = values.size_bytes();
    std::string data(sizeof(bytes) + bytes, '\0');
    std::memcpy(data.data(), &bytes, sizeof(bytes));
    if (bytes > 0) std::memcpy(data.data() + sizeof(bytes), values.data(), bytes);
    add("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n",
        type_name<T>(), name, components);
    append_base64(data, text_);
    text_ += "\n</DataArray>\n";
  }

  // Writes text as numbers, since some readers refuse files with arrays of strings.
  void add_claims(std::string_view value) {
    add("{}{}{}\n", claims_begin(), value.size(), claims_end());
    add("{}",
        fmt::join(std::span(reinterpret_cast<const unsigned char*>(value.data()), value.size()),
                  " "));
    text_ += "\n</DataArray>\n";
  }

  // Reserves memory, so that the text grows without copies.
  void reserve(std::size_t size) { text_.reserve(size); }

 private:
  std::string text_;
};

// Lagrange triangles of degree 2 get the type for arbitrary degrees, too: programs with the type
// for quadratic triangles also have that one.
int type_of(const MapFile& map, VtuCells cells) {
  constexpr int kLagrangeTriangle = 69;
  if (cells == VtuCells::Lagrange && map.degree > 1) return kLagrangeTriangle;
  return vtk_number({CellShape::Triangle, map.degree, NodeKind::ControlPoints});
}

void add_cells(const MapFile& map, VtuCells cells, VtkText& text) {
  const Eigen::Index count = map.cells.rows();
  const auto size = static_cast<std::size_t>(count);
  const std::vector<std::int64_t> connectivity(map.cells.data(),
                                               map.cells.data() + map.cells.size());
  std::vector<std::int64_t> offsets(size);
  for (std::size_t f = 0; f < size; ++f) {
    offsets[f] = static_cast<std::int64_t>(f + 1) * map.cells.cols();
  }
  const std::vector<std::uint8_t> types(size, static_cast<std::uint8_t>(type_of(map, cells)));
  text.add("<Cells>\n");
  text.add_array("connectivity", 1, connectivity.data(), map.cells.size());
  text.add_array("offsets", 1, offsets.data(), count);
  text.add_array("types", 1, types.data(), count);
  text.add("</Cells>\n");
}

// Returns for each point the smallest number + 1 of the seam chains through it; 0 for others.
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

// Returns a bound on the size of the text: base64 with a header for arrays, up to four characters
// for each byte of claims.
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

// The text of a mesh of cells.
class VtkCellText {
 public:
  void add_points(const Points3& points) {
    points_.insert(points_.end(), points.data(), points.data() + points.size());
  }
  Index point_count() const { return static_cast<Index>(points_.size() / 3); }

  // nodes: rows of the points.
  void add_cell(const CellBlock& block, Index cell, std::span<const Index> nodes) {
    const int type = vtk_number(block.type);
    const std::size_t begin = connectivity_.size();
    connectivity_.insert(connectivity_.end(), nodes.begin(), nodes.end());
    // The first triangle of linear wedges faces outwards, that of others inwards.
    if (type == kLinearWedge) {
      std::swap(connectivity_[begin + 1], connectivity_[begin + 2]);
      std::swap(connectivity_[begin + 4], connectivity_[begin + 5]);
    }
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
    types_.push_back(static_cast<std::uint8_t>(type));
    has_lattice_hexahedra_ = has_lattice_hexahedra_ || is_lattice_hexahedron(type);
    numbers_.push_back(block.numbers[to_size(cell)]);
    regions_.push_back(block.regions[to_size(cell)]);
  }
  // Adds the cell's check to the columns.
  void add_check(const CheckedCell& cell) {
    low_.push_back(cell.range.low);
    high_.push_back(cell.range.high);
    scaled_.push_back(cell.scaled_jacobian);
  }

  // Returns the text in version 1.0, which meshio can read, unless there are hexahedra whose order
  // of nodes changed later.
  std::string text() const {
    VtkText text;
    text.begin(mark_text(MarkStyle::XmlComment), has_lattice_hexahedra_ ? "2.2" : "1.0");
    text.begin_piece(point_count(), types_.size());
    text.add("<CellData>\n");
    add("number", 1, numbers_, text);
    add("region", 1, regions_, text);
    if (!scaled_.empty()) {
      add("min_det_low", 1, low_, text);
      add("min_det_high", 1, high_, text);
      add("scaled_jacobian", 1, scaled_, text);
    }
    text.add("</CellData>\n<Points>\n");
    add("Points", 3, points_, text);
    text.add("</Points>\n<Cells>\n");
    add("connectivity", 1, connectivity_, text);
    add("offsets", 1, offsets_, text);
    add("types", 1, types_, text);
    text.add("</Cells>\n");
    return text.end();
  }

 private:
  template <class T>
  static void add(std::string_view name, int components, const std::vector<T>& values,
                  VtkText& text) {
    text.add_array(name, components, std::span<const T>(values));
  }

  std::vector<double> points_, low_, high_, scaled_;
  std::vector<std::int64_t> connectivity_, offsets_, numbers_;
  std::vector<std::int32_t> regions_;
  std::vector<std::uint8_t> types_;
  bool has_lattice_hexahedra_ = false;  // Lagrange or Bezier
};

}  // namespace

std::string vtu_text(const std::string& path, const MapFile& map, VtuCells cells) {
  require_sound(path, map);
  if (cells == VtuCells::Lagrange) require_lagrange_degree(path, map);
  const Points2 uv = cells == VtuCells::Lagrange ? lagrange_nodes(map) : map.uv;
  VtkText text;
  text.reserve(greatest_size(map));
  // Claims serve as a mark.
  text.begin(map.claims.empty() ? mark_text(MarkStyle::XmlComment) : "", "1.0");
  if (!map.claims.empty()) {
    text.add("<FieldData>\n");
    text.add_claims(map.claims);
    text.add("</FieldData>\n");
  }
  text.begin_piece(map.points.rows(), static_cast<std::size_t>(map.cells.rows()));
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
  return text.end();
}

void write_vtu(const std::string& path, const MapFile& map, VtuCells cells,
               const FileVerification& verify) {
  write_file_atomically(path, vtu_text(path, map, cells), verify);
}

void write_vtu(const std::string& path, const MapFile& map, const FileVerification& verify) {
  write_vtu(path, map, VtuCells::Bezier, verify);
}

std::string vtk_text(const VolumeMesh& mesh, const GmshChoice& /*choice*/) {
  VtkCellText out;
  out.add_points(mesh.points);
  for (const CellBlock& block : mesh.blocks)
    for (Index cell = 0; cell < block.size(); ++cell)
      out.add_cell(block, cell,
                   {block.nodes.row(cell).data(), static_cast<std::size_t>(block.nodes.cols())});
  return out.text();
}

void write_cells_vtu(const std::string& path, const VolumeMesh& mesh,
                     const std::vector<const CheckedCell*>& cells) {
  VtkCellText out;
  for (const CheckedCell* checked : cells) {
    const CellBlock& block = mesh.blocks[to_size(checked->name.block)];
    const auto count = static_cast<Index>(block.nodes.cols());
    Points3 points(count, 3);
    std::vector<Index> nodes(to_size(count));
    std::iota(nodes.begin(), nodes.end(), out.point_count());
    for (Index k = 0; k < count; ++k)
      points.row(k) = mesh.points.row(block.nodes(checked->name.cell, k));
    if (block.type.kind == NodeKind::GaussLobatto) points = control_points_of(block.type, points);
    out.add_points(points);
    out.add_cell(block, checked->name.cell, nodes);
    out.add_check(*checked);
  }
  write_file_atomically(path, out.text());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
