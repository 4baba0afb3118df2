#include "majorant/io/volume_files.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>
#include <numeric>
#include <span>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/base64.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/written_mark.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/cell_writers.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/volumes/node_orders.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as memory is");

std::string first_word(const std::string& path, const std::string& content, const StopCheck& stop) {
  TextCursor words(path, content, TextLines::Space, stop);
  return std::string(words.next_token());
}

// VTK's number of a cell with these nodes; Gauss-Lobatto nodes become control points. The quadratic
// cells have the nodes of Lagrange cells of degree 2, in their order, and are known to more
// programs.
int vtk_number(const CellType& type) {
  const int shape = static_cast<int>(type.shape);
  constexpr int kStraight[] = {1, 3, 5, 9, 10, 13, 12}, kQuadratic[] = {1, 21, 22, 28, 24, 32, 29},
                kLagrange[] = {1, 68, 69, 70, 71, 73, 72}, kBezier[] = {1, 75, 76, 77, 78, 80, 79},
                kSerendipity[] = {0, 0, 0, 23, 0, 26, 25};
  if (type.degree == 1) return kStraight[shape];
  if (type.set == NodeSet::Serendipity) return kSerendipity[shape];
  if (type.kind != NodeKind::Uniform) return kBezier[shape];
  return type.degree == 2 ? kQuadratic[shape] : kLagrange[shape];
}

class CellsText {
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
    // The first triangle of linear wedges faces outwards, that of all others inwards.
    if (constexpr int kLinearWedge = 13; type == kLinearWedge) {
      std::swap(connectivity_[begin + 1], connectivity_[begin + 2]);
      std::swap(connectivity_[begin + 4], connectivity_[begin + 5]);
    }
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
    types_.push_back(static_cast<std::uint8_t>(type));
    has_lattice_hexahedra_ = has_lattice_hexahedra_ || type == 72 || type == 79;
    numbers_.push_back(block.numbers[to_size(cell)]);
    regions_.push_back(block.regions[to_size(cell)]);
  }
  // Adds the columns of the cell that was added last.
  void add_check(const CheckedCell& cell) {
    low_.push_back(cell.range.low);
    high_.push_back(cell.range.high);
    scaled_.push_back(cell.scaled_jacobian);
  }

  // In version 1.0, which meshio reads, too, unless it has hexahedra whose order of nodes changed
  // after it.
  std::string take() {
    fmt::format_to(std::back_inserter(text_),
                   "<?xml version=\"1.0\"?>\n{}<VTKFile type=\"UnstructuredGrid\" version=\"{}\" "
                   "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
                   "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<CellData>\n",
                   mark_text(MarkStyle::XmlComment), has_lattice_hexahedra_ ? "2.2" : "1.0", points_.size() / 3,
                   types_.size());
    array("number", "Int64", 1, numbers_);
    array("region", "Int32", 1, regions_);
    if (!scaled_.empty()) {
      array("min_det_low", "Float64", 1, low_);
      array("min_det_high", "Float64", 1, high_);
      array("scaled_jacobian", "Float64", 1, scaled_);
    }
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

  std::vector<double> points_, low_, high_, scaled_;
  std::vector<std::int64_t> connectivity_, offsets_, numbers_;
  std::vector<std::int32_t> regions_;
  std::vector<std::uint8_t> types_;
  bool has_lattice_hexahedra_ = false;  // Lagrange or Bezier
  std::string text_;
};

}  // namespace

std::string vtk_text(const VolumeMesh& mesh, const GmshChoice& /*choice*/) {
  CellsText out;
  out.add_points(mesh.points);
  for (const CellBlock& block : mesh.blocks)
    for (Index cell = 0; cell < block.size(); ++cell)
      out.add_cell(block, cell,
                   {block.nodes.row(cell).data(), static_cast<std::size_t>(block.nodes.cols())});
  return out.take();
}

namespace {

// The extension of the file that was read; empty where there was none.
std::string source_format(const VolumeMesh& mesh) {
  return mesh.source ? format_of(mesh.file) : std::string();
}

}  // namespace

void refuse_mesh(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::Unsupported, fmt::format("{}: {}", path, what));
}

VolumeMesh read_volume_mesh(const std::string& path, const StopCheck& stop) {
  if (!is_for(FormatUse::ReadCells, path)) {
    const std::vector<std::string> readable = extensions_for(FormatUse::ReadCells);
    require_format_name(path, in_words(readable, "or"), ErrorKind::Unsupported);
    refuse_mesh(path, fmt::format("meshes of volumes are read from {}, not {}",
                                  in_words(readable, "and"), format_of(path)));
  }
  return read_volume_content(path, read_whole_file(path, stop), stop);
}

VolumeMesh read_volume_content(const std::string& path, std::string content,
                               const StopCheck& stop) {
  return find_format(format_of(path))->read_cells(path, std::move(content), stop);
}

VolumeMesh read_mfem_or_medit_mesh(const std::string& path, std::string content,
                                   const StopCheck& stop) {
  require_text(path, content);
  const bool is_medit = first_word(path, content, stop) == "MeshVersionFormatted";
  return is_medit ? read_medit_mesh(path, std::move(content), stop)
                  : read_mfem_mesh(path, std::move(content), stop);
}

void require_volume_format(const std::string& path, const VolumeMesh& mesh,
                           const GmshChoice& choice) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::Usage, fmt::format("{}: {}", path, what));
  };
  const std::string extension = format_of(path), source = source_format(mesh);
  const Format* const format = find_format(extension);
  if (is_compressed(path)) refuse("meshes are not written compressed; leave out .gz");
  if ((choice.version || choice.encoding) && !is_for(FormatUse::WriteVersions, path))
    refuse(fmt::format("versions and encodings are of {}", in_words(extensions_for(FormatUse::WriteVersions), "and")));
  if (extension == source) return;
  if (format == nullptr || !format->cells_text) {
    std::vector<std::string> written = extensions_for(FormatUse::WriteCells);
    if (const Format* own = find_format(source); own != nullptr && !own->cells_text)
      written.insert(written.begin(), source);
    refuse(fmt::format("a mesh {} is written as {}",
                       source.empty() ? "that was read from no file" : "of " + mesh.file,
                       in_words(written, "or")));
  }
  for (const CellBlock& block : mesh.blocks) {
    const bool is_lattice = block.type.kind == NodeKind::Uniform;
    if (block.type.kind == NodeKind::GaussLobatto || (!is_lattice && !format->has_control_points))
      refuse(fmt::format(
          "{} has no {} whose nodes are {}", extension, describe(block.type),
          block.type.kind == NodeKind::GaussLobatto ? "Gauss-Lobatto points" : "control points"));
    if (block.vertices.rows() > 0)
      refuse(
          fmt::format("{} has no elements with nodes of their own beside the vertices that they "
                      "share",
                      extension));
  }
}

std::string volume_mesh_content(const std::string& path, const VolumeMesh& mesh,
                                const GmshChoice& choice, std::vector<std::string>* left_out) {
  require_volume_format(path, mesh, choice);
  const std::string extension = format_of(path), source = source_format(mesh);
  const Format& format = *find_format(extension);
  if (extension == source) {
    if (choice.version || choice.encoding) return format.cells_in_version(mesh, choice, left_out);
    return with_mark(format.mark, mesh.source->with_points(mesh.points));
  }
  if (left_out != nullptr && !source.empty())
    left_out->push_back(
        fmt::format("what {} has beside nodes, elements and their regions", mesh.file));
  return format.cells_text(mesh, choice);
}

void write_volume_mesh(const std::string& path, const VolumeMesh& mesh, const GmshChoice& choice,
                       std::vector<std::string>* left_out,
                       const std::function<void(const VolumeMesh& written)>& verify) {
  write_file_atomically(
      path, volume_mesh_content(path, mesh, choice, left_out), [&](const std::string& temporary) {
        const VolumeMesh written = read_volume_mesh(temporary);
        if (written.points != mesh.points)
          throw Error(ErrorKind::Invalid, path + ": what would be written has other points");
        if (verify) verify(written);
      });
}

void write_cells_vtu(const std::string& path, const VolumeMesh& mesh,
                     const std::vector<const CheckedCell*>& cells) {
  CellsText out;
  for (const CheckedCell* checked : cells) {
    const CellBlock& block = mesh.blocks[to_size(checked->name.block)];
    const auto count = static_cast<Index>(block.nodes.cols());
    Points3 points(count, 3);
    std::vector<Index> nodes(to_size(count));
    std::iota(nodes.begin(), nodes.end(), out.point_count());
    for (Index k = 0; k < count; ++k)
      points.row(k) = mesh.points.row(block.nodes(checked->name.cell, k));
    if (block.type.kind == NodeKind::GaussLobatto)
      points = control_points_of(block.type, points);
    out.add_points(points);
    out.add_cell(block, checked->name.cell, nodes);
    out.add_check(*checked);
  }
  write_file_atomically(path, out.take());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
