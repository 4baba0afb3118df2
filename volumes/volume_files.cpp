#include "majorant/volumes/volume_files.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>

#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/input_file.h"
#include "majorant/volumes/internal/gmsh_document.h"
#include "majorant/volumes/internal/mesh_readers.h"
#include "majorant/volumes/internal/mesh_source.h"
#include "majorant/volumes/internal/reference_cell.h"
#include "majorant/volumes/internal/token_cursor.h"

namespace majorant {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as memory is");

std::string first_word(const std::string& path, const std::string& content, const StopCheck& stop) {
  TokenCursor words(path, content, '#', stop);
  return std::string(words.next());
}

// VTK's number of a cell with these nodes; Gauss-Lobatto nodes become control points.
int vtk_number(const CellType& type) {
  const int shape = static_cast<int>(type.shape);
  constexpr int kStraight[] = {1, 3, 5, 9, 10, 13, 12}, kLagrange[] = {1, 68, 69, 70, 71, 73, 72},
                kBezier[] = {1, 75, 76, 77, 78, 80, 79}, kSerendipity[] = {0, 0, 0, 23, 0, 26, 25};
  if (type.degree == 1) return kStraight[shape];
  if (type.set == NodeSet::Serendipity) return kSerendipity[shape];
  return type.kind == NodeKind::Uniform ? kLagrange[shape] : kBezier[shape];
}

class VtuOfCells {
 public:
  explicit VtuOfCells(const VolumeMesh& mesh) : mesh_(mesh) {}

  std::string text(const std::vector<const CheckedCell*>& cells) {
    for (const CheckedCell* cell : cells) add(*cell);
    fmt::format_to(std::back_inserter(text_),
                   "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" "
                   "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
                   "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<CellData>\n",
                   points_.size() / 3, types_.size());
    array("number", "Int64", 1, numbers_);
    array("region", "Int32", 1, regions_);
    array("min_det_low", "Float64", 1, low_);
    array("min_det_high", "Float64", 1, high_);
    array("scaled_jacobian", "Float64", 1, scaled_);
    text_ += "</CellData>\n<Points>\n";
    array("Points", "Float64", 3, points_);
    text_ += "</Points>\n<Cells>\n";
    array("connectivity", "Int64", 1, connectivity_);
    array("offsets", "Int64", 1, offsets_);
    array("types", "UInt8", 1, types_);
    text_ += "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return std::move(text_);
  }

 private:
  void add(const CheckedCell& cell) {
    const CellBlock& block = mesh_.blocks[to_size(cell.name.block)];
    Points3 nodes(block.nodes.cols(), 3);
    for (Index k = 0; k < nodes.rows(); ++k)
      nodes.row(k) = mesh_.points.row(block.nodes(cell.name.cell, k));
    if (block.type.kind == NodeKind::GaussLobatto)
      nodes = ReferenceCell::of(block.type).control_points() * nodes;
    for (Index k = 0; k < nodes.rows(); ++k)
      connectivity_.push_back(static_cast<std::int64_t>(points_.size() / 3 + to_size(k)));
    points_.insert(points_.end(), nodes.data(), nodes.data() + nodes.size());
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
    types_.push_back(static_cast<std::uint8_t>(vtk_number(block.type)));
    numbers_.push_back(block.numbers[to_size(cell.name.cell)]);
    regions_.push_back(block.regions[to_size(cell.name.cell)]);
    low_.push_back(cell.range.low);
    high_.push_back(cell.range.high);
    scaled_.push_back(cell.scaled_jacobian);
  }

  template <class T>
  void array(const char* name, const char* type, int components, const std::vector<T>& values) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    std::string data(sizeof(bytes) + bytes, '\0');
    std::memcpy(data.data(), &bytes, sizeof(bytes));
    if (bytes > 0) std::memcpy(data.data() + sizeof(bytes), values.data(), bytes);
    fmt::format_to(std::back_inserter(text_),
                   "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
                   "format=\"binary\">\n",
                   type, name, components);
    append_base64(data, text_);
    text_ += "\n</DataArray>\n";
  }

  const VolumeMesh& mesh_;
  std::vector<double> points_, low_, high_, scaled_;
  std::vector<std::int64_t> connectivity_, offsets_, numbers_;
  std::vector<std::int32_t> regions_;
  std::vector<std::uint8_t> types_;
  std::string text_;
};

}  // namespace

void refuse_mesh(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::Unsupported, fmt::format("{}: {}", path, what));
}

VolumeMesh read_volume_mesh(const std::string& path, const StopCheck& stop) {
  const std::string format = format_of(path);
  if (format != ".msh" && format != ".mesh" && format != ".vtu")
    refuse_mesh(path, fmt::format("meshes of volumes are read from .msh, .mesh and .vtu, not {}",
                                  format.empty() ? "files without an extension" : format));
  std::string content = read_whole_file(path, stop);
  if (format == ".msh") return read_gmsh_mesh(path, std::move(content), stop);
  if (format == ".vtu") return read_vtk_mesh(path, std::move(content), stop);
  require_text(path, content);
  const bool is_medit = first_word(path, content, stop) == "MeshVersionFormatted";
  return is_medit ? read_medit_mesh(path, std::move(content), stop)
                  : read_mfem_mesh(path, std::move(content), stop);
}

std::string volume_mesh_content(const VolumeMesh& mesh) {
  if (!mesh.source) return gmsh_mesh_content(mesh, {GmshVersion::New, GmshEncoding::Text});
  return mesh.source->with_points(mesh.points);
}

void write_volume_mesh(const std::string& path, const VolumeMesh& mesh,
                       const FileVerification& verify) {
  write_file_atomically(path, volume_mesh_content(mesh), verify);
}

GmshFormat gmsh_format_of(const VolumeMesh& mesh) {
  if (!mesh.source) return {GmshVersion::New, GmshEncoding::Text};
  const std::string content = volume_mesh_content(mesh);
  if (first_word(mesh.file, content, {}) != "$MeshFormat")
    refuse_mesh(mesh.file, "no .msh; versions and encodings are gmsh's");
  return read_gmsh_format(mesh.file, content);
}

std::string gmsh_mesh_content(const VolumeMesh& mesh, const GmshFormat& format,
                              std::vector<std::string>* left_out) {
  if (!mesh.source) return gmsh_content(gmsh_document_of(mesh), format, left_out);
  if (gmsh_format_of(mesh) == format) return volume_mesh_content(mesh);
  return gmsh_content(read_gmsh_document(mesh.file, volume_mesh_content(mesh), {}), format,
                      left_out);
}

void write_cells_vtu(const std::string& path, const VolumeMesh& mesh,
                     const std::vector<const CheckedCell*>& cells) {
  write_file_atomically(path, VtuOfCells(mesh).text(cells));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
