#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "majorant/framework/error.h"
#include "majorant/io/internal/cell_collector.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/vtk_document.h"
#include "majorant/io/internal/vtk_source.h"
#include "majorant/io/internal/vtk_types.h"

namespace majorant {
namespace {

class VtkCellReader {
 public:
  VtkCellReader(const std::string& path, std::string content, const StopCheck& stop)
      : path_(path),
        stop_(stop),
        original_(std::move(content)),
        file_(path, original_, stop),
        arrays_(file_.arrays()),
        source_{path, original_, file_, stop} {}

  VolumeMesh read() {
    VolumeMesh mesh;
    mesh.file = path_;
    mesh.points = file_.points();
    if (mesh.points.rows() == 0) file_.fail("no points");
    if (mesh.points.rows() > std::numeric_limits<Index>::max() / 4)
      refuse_mesh(path_, "too many points");
    NodeLists lists = read_cells(mesh);
    mesh.source = vtk_source(source_, mesh.points, std::move(lists));
    return mesh;
  }

 private:
  // Returns whether a quad, hexahedron or wedge with different degrees per direction may have so
  // many points.
  static bool is_of_more_degrees(CellShape shape, std::size_t points) {
    if (shape == CellShape::Quad) return is_grid(points, 2);
    if (shape == CellShape::Hexahedron) return is_grid(points, 3);
    if (shape != CellShape::Wedge) return false;
    for (std::size_t side = 2; side <= points; ++side) {
      const std::size_t of_triangle = side * (side + 1) / 2;
      if (points % of_triangle == 0 && is_grid(points / of_triangle, 1)) return true;
    }
    return false;
  }
  // Returns whether `points` is a product of so many factors of at least 2.
  static bool is_grid(std::size_t points, int directions) {
    if (directions == 1) return points >= 2;
    for (std::size_t a = 2; a < points; ++a)
      if (points % a == 0 && is_grid(points / a, directions - 1)) return true;
    return false;
  }

  CellType type_of(std::size_t cell, long long number, std::size_t points) const {
    const std::optional<VtkType> known = vtk_type(number);
    if (!known)
      refuse_mesh(path_, is_vtk_pyramid(number)
                             ? fmt::format("cell {} is a pyramid; tetrahedra, hexahedra, wedges, "
                                           "triangles and quads are supported",
                                           cell)
                             : fmt::format("cell {} of VTK's type {}; linear, quadratic, Lagrange "
                                           "and Bezier simplices, quads, hexahedra and wedges are "
                                           "supported",
                                           cell, number));
    CellType type{known->shape, known->degree, known->kind, known->set};
    if (type.degree == 0) {
      type.degree = 1;
      while (to_size(type.node_count()) < points && type.degree <= CellType::kMaxDegree)
        ++type.degree;
      const bool is_one = to_size(type.node_count()) == points;
      if (type.degree > CellType::kMaxDegree || (!is_one && is_of_more_degrees(type.shape, points)))
        refuse_degrees(cell, fmt::format("{} points", points));
    }
    if (to_size(type.node_count()) != points)
      file_.fail(fmt::format("cell {} has {} points, {} have {}", cell, points, describe(type),
                             type.node_count()));
    // Straight cells are the same for all kinds of nodes.
    if (type.degree == 1) type.kind = NodeKind::Uniform;
    return type;
  }

  // Returns whether most linear wedges of the file have VTK's order, in which the triangle of the
  // first three nodes faces outwards [vtkWedge.h]. In wedges of higher degree it faces inwards, and
  // many programs write linear wedges like that, too.
  static bool has_outward_wedges(const std::vector<long long>& connectivity,
                                 const std::vector<long long>& offsets,
                                 const std::vector<long long>& types, const Points3& points) {
    constexpr long long kNodes = 6;
    Index outward = 0, inward = 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      const long long end = offsets[c];
      if (types[c] != kLinearWedge || end < kNodes ||
          end > static_cast<long long>(connectivity.size()))
        continue;
      const auto node = [&](long long k) {
        return connectivity[static_cast<std::size_t>(end - kNodes + k)];
      };
      bool is_known = true;
      for (long long k = 0; k < kNodes; ++k) is_known &= node(k) >= 0 && node(k) < points.rows();
      if (!is_known) continue;
      const auto at = [&](long long k) -> Vector3 {
        return points.row(static_cast<Index>(node(k)));
      };
      const Vector3 up = at(3) + at(4) + at(5) - at(0) - at(1) - at(2);
      const double volume = (at(1) - at(0)).cross(at(2) - at(0)).dot(up);
      outward += volume < 0;
      inward += volume > 0;
    }
    return outward > inward;
  }

  // Before version 2.1 of the format, edges 2-6 and 3-7 of Lagrange and Bezier hexahedra were
  // exchanged.
  std::vector<int> order_of(const CellType& type, long long number) const {
    if (number == kLinearWedge && has_outward_wedges_) return {0, 2, 1, 3, 5, 4};
    std::vector<int> order;
    for (int k = 0; k < type.node_count(); ++k) order.push_back(k);
    if (is_lattice_hexahedron(number) && file_.is_before(2, 1)) {
      const int inner = type.degree - 1, first = 8 + 10 * inner;
      for (int k = 0; k < inner; ++k)
        std::swap(order[to_size(first + k)], order[to_size(first + inner + k)]);
    }
    return order;
  }

  // Reads the blocks of the mesh, and returns the places of their node lists in the file.
  NodeLists read_cells(VolumeMesh& mesh) {
    const auto& [connectivity, offsets, types] = file_.cells();
    std::vector<double> regions;
    if (const XmlElement* data = file_.piece().child("CellData"))
      if (const XmlElement* array = file_.find_array(*data, "region"))
        regions = arrays_.doubles(*array);
    // Cells with different weights are rational functions.
    if (file_.is_rational())
      refuse_mesh(path_, "rational cells (RationalWeights that differ, or 0) are not supported");
    require_one_degree(types);
    has_outward_wedges_ = has_outward_wedges(connectivity, offsets, types, mesh.points);
    CellCollector cells;
    const XmlElement& section = file_.require_child(file_.piece(), "Cells");
    VtkEntries entries =
        vtk_entries(source_, *file_.find_array(section, "connectivity"), connectivity.size());
    std::map<std::pair<long long, std::size_t>, std::pair<CellType, std::vector<int>>> known;
    long long begin = 0;
    std::vector<Index> nodes;
    for (std::size_t c = 0; c < types.size(); ++c) {
      stop_.poll_at(c);
      if (offsets[c] < begin || offsets[c] > static_cast<long long>(connectivity.size()))
        file_.fail(fmt::format("offset {} of cell {} is out of range", offsets[c], c));
      nodes.clear();
      const std::size_t place = entries.place_of(static_cast<std::size_t>(begin));
      for (; begin < offsets[c]; ++begin) {
        const long long point = connectivity[static_cast<std::size_t>(begin)];
        if (point < 0 || point >= mesh.points.rows())
          file_.fail(
              fmt::format("cell {} has point {}, there are {}", c, point, mesh.points.rows()));
        nodes.push_back(static_cast<Index>(point));
      }
      const std::pair key(types[c], nodes.size());
      auto found = known.find(key);
      if (found == known.end()) {
        const CellType type = type_of(c, types[c], nodes.size());
        found = known.emplace(key, std::pair(type, order_of(type, types[c]))).first;
      }
      const double region = c < regions.size() ? regions[c] : 0;
      cells.add(found->second.first, found->second.second, nodes, static_cast<std::int64_t>(c),
                std::abs(region) < 1e9 ? static_cast<int>(region) : 0, place);
    }
    entries.lists.blocks = cells.lists();
    mesh.blocks = cells.take();
    return std::move(entries.lists);
  }

  // Refuses quads, hexahedra and wedges with different degrees per direction.
  void require_one_degree(const std::vector<long long>& types) const {
    const XmlElement* data = file_.piece().child("CellData");
    const XmlElement* array =
        data == nullptr ? nullptr : file_.find_role(*data, "HigherOrderDegrees");
    if (array == nullptr) return;
    const std::vector<double> degrees = arrays_.doubles(*array);
    if (degrees.size() != 3 * types.size())
      file_.fail("HigherOrderDegrees is not 3 numbers per cell");
    for (std::size_t c = 0; c < types.size(); ++c) {
      const std::optional<VtkType> type = vtk_type(types[c]);
      if (!type || type->degree != 0 || !has_directions(type->shape)) continue;
      const double* const first = &degrees[3 * c];
      const double* const last = first + dimension(type->shape);
      if (std::count(first, last, *first) != last - first)
        refuse_degrees(c, fmt::format("degrees {}", fmt::join(first, last, ", ")));
    }
  }
  static bool has_directions(CellShape shape) {
    using enum CellShape;
    return shape == Quad || shape == Hexahedron || shape == Wedge;
  }

  [[noreturn]] void refuse_degrees(std::size_t cell, const std::string& what) const {
    refuse_mesh(path_, fmt::format("cell {} of {}; degrees 1 to {}, the same in all directions, "
                                   "are supported",
                                   cell, what, CellType::kMaxDegree));
  }

  const std::string& path_;
  const StopCheck& stop_;
  std::string original_;
  VtkDocument file_;
  const VtuArrays& arrays_;
  const VtkFile source_;
  bool has_outward_wedges_ = false;
};

}  // namespace

VolumeMesh read_vtk_mesh(const std::string& path, std::string content, const StopCheck& stop) {
  return VtkCellReader(path, std::move(content), stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
