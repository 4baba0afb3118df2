#include "majorant/volumes/check_volume_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/volumes/internal/mesh_sides.h"

namespace majorant {
namespace {

// The cells of a task: at least some 10 us of work, and at most some ms between two polls.
constexpr Index kPiece = 64;

// Gathers the coordinates of a cell's nodes.
void gather(const VolumeMesh& mesh, const CellBlock& block, Index cell, std::vector<double>& out) {
  out.clear();
  for (const Index node : block.nodes.row(cell))
    for (int c = 0; c < 3; ++c) out.push_back(mesh.points(node, c));
}

// Returns the directions of the plane in which a cell of a surface is checked: two vectors of
// length about 1, orthogonal to the normal of the straight cell. The proof is about these doubles.
Eigen::Matrix<double, 2, 3> plane_of(CellShape shape, const std::vector<double>& nodes) {
  const auto point = [&](int k) {
    return Vector3(Eigen::Map<const Vector3>(&nodes[to_size(3 * k)]));
  };
  const Vector3 along = shape == CellShape::Triangle ? point(1) - point(0) : point(2) - point(0);
  const Vector3 other = shape == CellShape::Triangle ? point(2) - point(0) : point(3) - point(1);
  const Vector3 u = along.stableNormalized();
  const Vector3 normal = u.cross(other.stableNormalized()).stableNormalized();
  Eigen::Matrix<double, 2, 3> plane;
  plane << u.transpose(), normal.cross(u).transpose();
  return plane;
}

class CellCheck {
 public:
  CellCheck(const VolumeMesh& mesh, const StopCheck& stop)
      : mesh_(mesh), stop_(stop), is_planar_(mesh.is_planar()) {}

  CheckedCell operator()(CellName name) const {
    const CellBlock& block = mesh_.blocks[to_size(name.block)];
    std::vector<double> nodes, flat;
    gather(mesh_, block, name.cell, nodes);
    CheckedCell out{name, {}, 0};
    Vector3 normal = Vector3::UnitZ();
    if (dimension(block.type.shape) == 3) {
      out.range = determinant_range(block.type, nodes.data(), stop_);
    } else if (is_planar_) {
      for (std::size_t k = 0; k < nodes.size(); k += 3) {
        flat.push_back(nodes[k]);
        flat.push_back(nodes[k + 1]);
      }
      out.range = determinant_range(block.type, flat.data(), stop_);
    } else {
      out.range = on_surface(block.type, nodes, normal);
    }
    out.scaled_jacobian = sampled_scaled_jacobian(block.type, nodes.data(), normal);
    return out;
  }

 private:
  // Checks the cell in the plane of the straight cell. Coordinates there are rounded, so the proof
  // is about a cell whose nodes are moved by some 1e-16 of their size.
  DeterminantRange on_surface(const CellType& type, const std::vector<double>& nodes,
                              Vector3& normal) const {
    const Eigen::Matrix<double, 2, 3> plane = plane_of(type.shape, nodes);
    normal = plane.row(0).cross(plane.row(1)).transpose();
    const Vector3 origin = Eigen::Map<const Vector3>(nodes.data());
    std::vector<double> flat;
    for (std::size_t k = 0; k < nodes.size(); k += 3) {
      const Vector2 x = plane * (Eigen::Map<const Vector3>(&nodes[k]) - origin);
      flat.insert(flat.end(), {x[0], x[1]});
    }
    return determinant_range(type, flat.data(), stop_);
  }

  const VolumeMesh& mesh_;
  const StopCheck& stop_;
  bool is_planar_;
};

class SideCheck {
 public:
  SideCheck(const VolumeMesh& mesh, VolumeCheck& check) : mesh_(mesh), check_(check) {}

  void run(const StopCheck& stop) {
    for (const CheckedCell& cell : check_.cells) {
      if (first_.size() <= to_size(cell.name.block)) first_.resize(to_size(cell.name.block) + 1);
      if (cell.name.cell == 0)
        first_[to_size(cell.name.block)] = static_cast<std::size_t>(&cell - check_.cells.data());
    }
    find_repeated();
    stop.poll();
    const std::vector<CellSide> sides = sides_of(mesh_);
    stop.poll();
    for_each_side(sides, [&](std::span<const CellSide> cells) { judge(cells); });
  }

 private:
  using Place = std::array<double, 3>;

  // Finds cells of one type whose nodes are at the same places, in any order that keeps the sign of
  // det J. On a surface, where the two sides of a sheet may be cells, both must have the same
  // direction.
  void find_repeated() {
    std::vector<std::pair<std::uint64_t, std::size_t>> hashes;
    for (std::size_t k = 0; k < check_.cells.size(); ++k)
      hashes.emplace_back(hash_of(check_.cells[k].name), k);
    std::sort(hashes.begin(), hashes.end());
    for (auto first = hashes.begin(); first != hashes.end();) {
      const auto last =
          std::find_if(first, hashes.end(), [&](const auto& h) { return h.first != first->first; });
      // A cell is compared with the first cell of its hash, so that each repeated cell is listed
      // once.
      for (auto other = first + 1; first != last && other != last; ++other) {
        const CellName a = check_.cells[first->second].name, b = check_.cells[other->second].name;
        if (are_same(a, b)) check_.repeated.push_back({a, b});
      }
      first = last;
    }
  }

  Place place_of_node(CellName name, Index k) const {
    const Index row = block_of(name).nodes(name.cell, k);
    return {mesh_.points(row, 0) + 0.0, mesh_.points(row, 1) + 0.0, mesh_.points(row, 2) + 0.0};
  }

  // Returns a hash of the places of the corners in any order, as doubles with -0 replaced by 0.
  std::uint64_t hash_of(CellName name) const {
    std::uint64_t sum = 0;
    for (Index k = 0; k < corner_count(block_of(name).type.shape); ++k) {
      std::uint64_t hash = 0;
      for (const double x : place_of_node(name, k))
        hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
      sum += hash ^ (hash >> 29);
    }
    return sum;
  }

  std::vector<Place> places_of(CellName name) const {
    std::vector<Place> places;
    for (Index k = 0; k < static_cast<Index>(block_of(name).nodes.cols()); ++k)
      places.push_back(place_of_node(name, k));
    std::sort(places.begin(), places.end());
    return places;
  }

  bool are_same(CellName a, CellName b) const {
    if (block_of(a).type != block_of(b).type || places_of(a) != places_of(b)) return false;
    if (check_.is_surface) return is_positive_in(a, b);
    // A moved node may turn a cell over onto its neighbour; det J of the two then has different
    // signs.
    const DeterminantRange &x = range_of(a), &y = range_of(b);
    return !(x.low > 0 && y.largest < 0) && !(x.largest < 0 && y.low > 0);
  }

  // Returns true if the corners of both have the same direction.
  bool is_positive_in(CellName a, CellName b) const {
    const Index corners = corner_count(block_of(a).type.shape);
    for (Index k = 0; k < corners; ++k)
      if (place_of_node(b, k) == place_of_node(a, 0))
        return place_of_node(b, (k + 1) % corners) == place_of_node(a, 1);
    return false;
  }

  const CellBlock& block_of(CellName name) const { return mesh_.blocks[to_size(name.block)]; }

  void judge(std::span<const CellSide> cells) {
    const CellSide& first = cells.front();
    if (cells.size() == 1) ++check_.boundary_sides;
    if (cells.size() > 2) check_.crowded.push_back(first.name);
    if (cells.size() != 2) return;
    const CellSide& second = cells[1];
    const SideSense sense = sense_of(mesh_, first, second);
    if (sense == SideSense::Twisted || !agree(first, second)) {
      if (sense == SideSense::Apart && are_translated(mesh_, first, second))
        ++check_.periodic_sides;
      else
        check_.disagreements.push_back({first.name, second.name});
    } else if (sense == SideSense::Together && !check_.is_surface && have_one_sign(first, second) &&
               !are_same(first.name, second.name)) {
      check_.overlapping.push_back({first.name, second.name});
    }
  }

  // Returns true if det J of both is known to be positive, or known to be negative. Such cells lie
  // on one side of a common side around which they run in the same direction.
  bool have_one_sign(const CellSide& a, const CellSide& b) const {
    const DeterminantRange &x = range_of(a.name), &y = range_of(b.name);
    const auto is_positive = [](const DeterminantRange& range) {
      return range.positive == ProofStatus::Proven;
    };
    return (is_positive(x) && is_positive(y)) || (x.largest < 0 && y.largest < 0);
  }

  const DeterminantRange& range_of(CellName name) const {
    return check_.cells[first_[to_size(name.block)] + to_size(name.cell)].range;
  }

  bool agree(const CellSide& a, const CellSide& b) const {
    const CellType &s = block_of(a.name).type, &t = block_of(b.name).type;
    const bool share_vertices = block_of(a.name).vertices.rows() == 0;
    if (s.degree == 1 && t.degree == 1 && share_vertices) return true;
    if (s.degree != t.degree || s.kind != t.kind) return false;
    const auto x = nodes_of(mesh_, a), y = nodes_of(mesh_, b);
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [&](const auto& p, const auto& q) {
      return p.first == q.first &&
             (p.second == q.second || mesh_.points.row(p.second) == mesh_.points.row(q.second));
    });
  }

  const VolumeMesh& mesh_;
  VolumeCheck& check_;
  std::vector<std::size_t> first_;  // by block: the place of its first cell in check_.cells
};

}  // namespace

Index VolumeCheck::count(ProofStatus status) const {
  return static_cast<Index>(std::count_if(cells.begin(), cells.end(), [=](const CheckedCell& c) {
    return c.range.positive == status;
  }));
}

Index VolumeCheck::inverted() const {
  return static_cast<Index>(std::count_if(
      cells.begin(), cells.end(), [](const CheckedCell& c) { return c.range.largest < 0; }));
}

bool VolumeCheck::is_valid() const {
  return count(ProofStatus::Proven) == static_cast<Index>(cells.size()) && sides_fit();
}

bool VolumeCheck::sides_fit() const {
  return disagreements.empty() && crowded.empty() && overlapping.empty() && repeated.empty();
}

double VolumeCheck::least_scaled_jacobian() const {
  double least = std::numeric_limits<double>::infinity();
  for (const CheckedCell& c : cells) least = std::min(least, c.scaled_jacobian);
  return least;
}

double VolumeCheck::mean_scaled_jacobian() const {
  double sum = 0;
  for (const CheckedCell& c : cells) sum += c.scaled_jacobian;
  return sum / static_cast<double>(cells.size());
}

std::vector<const CheckedCell*> VolumeCheck::worst(std::size_t most) const {
  std::vector<const CheckedCell*> out;
  for (const CheckedCell& c : cells) out.push_back(&c);
  const auto rank = [](const CheckedCell* c) {
    return std::pair(c->range.positive == ProofStatus::Proven, c->scaled_jacobian);
  };
  const auto end = out.begin() + static_cast<std::ptrdiff_t>(std::min(most, out.size()));
  std::partial_sort(out.begin(), end, out.end(),
                    [&](const CheckedCell* a, const CheckedCell* b) { return rank(a) < rank(b); });
  out.erase(end, out.end());
  return out;
}

VolumeCheck check_volume_mesh(const VolumeMesh& mesh, const StopCheck& stop) {
  const int dim = mesh.dimension();
  if (dim < 2)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: no cell has two or three dimensions", mesh.file));
  VolumeCheck check;
  check.is_surface = dim == 2 && !mesh.is_planar();
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    if (dimension(block.type.shape) != dim) continue;
    require_tables(mesh.file, block.type);
    for (Index c = 0; c < block.size(); ++c)
      check.cells.push_back({{static_cast<Index>(b), c}, {}, 0});
  }
  const CellCheck check_cell(mesh, stop);
  std::atomic<std::size_t> begun = 0;
  parallel_for(static_cast<Index>(check.cells.size()), kPiece, [&](Index k) {
    if (k % kPiece == 0) {
      stop.poll();
      stop.advance(begun += to_size(kPiece), check.cells.size());
    }
    check.cells[to_size(k)] = check_cell(check.cells[to_size(k)].name);
  });
  SideCheck(mesh, check).run(stop);
  return check;
}

Vector3 place_of(const VolumeMesh& mesh, const CheckedCell& cell) {
  const CellBlock& block = mesh.blocks[to_size(cell.name.block)];
  std::vector<double> nodes;
  gather(mesh, block, cell.name.cell, nodes);
  return point_of_cell(block.type, nodes.data(), cell.range.at);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
