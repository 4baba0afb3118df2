#include "majorant/volumes/internal/held_points.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "majorant/framework/rounding.h"
#include "majorant/mesh/union_find.h"
#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {
namespace {

// Distances from a plane, relative to the side, that count as rounding.
constexpr double kFlat = 1e-12;
// Sines of the angle between two planes: below the first they count as one plane, above the second
// as two. Points between planes at angles in between are held.
constexpr double kSamePlane = 1e-9, kOtherPlane = 1e-3;
// The rounding of det J, relative to the product of its columns' sizes: far above that of control
// points.
constexpr double kRounding = 1e-12;

// Returns whether det J <= 0 at a corner, exactly for the nodes of the cell as doubles. There
// derivatives are integer combinations of control points (rows: one direction each).
bool is_not_positive_at_corner(const ReferenceCell& reference, const RowMatrix& rows,
                               const RowMatrix& nodes) {
  using Fraction = boost::multiprecision::cpp_rational;
  const auto dim = static_cast<int>(rows.rows());
  const ReferenceCell::ExactMatrix& exact = reference.exact_control_points();
  std::array<std::array<Fraction, 3>, 3> J;
  for (Index k = 0; k < rows.cols(); ++k)
    for (int d = 0; d < dim; ++d) {
      Fraction control;
      if (reference.nodes_are_control_points())
        control = Fraction(nodes(k, d));
      else
        for (Index i = 0; i < static_cast<Index>(nodes.rows()); ++i) {
          Fraction part(exact.numerators[to_size(k * static_cast<Index>(nodes.rows()) + i)],
                        exact.denominator);
          part *= Fraction(nodes(i, d));
          control += part;
        }
      for (int a = 0; a < dim; ++a) {
        Fraction part(rows(a, k));
        part *= control;
        J[to_size(a)][to_size(d)] += part;
      }
    }
  if (dim == 2) return J[0][0] * J[1][1] <= J[0][1] * J[1][0];
  Fraction det = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    det += J[0][a] * (J[1][b] * J[2][c] - J[1][c] * J[2][b]);
  }
  return det <= 0;
}

int region_of(const VolumeMesh& mesh, CellName name) {
  return mesh.blocks[to_size(name.block)].regions[to_size(name.cell)];
}

}  // namespace

// The planes (in the plane: lines) that contain each point.
class HeldPoints::Planes {
 public:
  Planes(const VolumeMesh& mesh, const ControlNet& net) : mesh_(mesh), net_(net) {
    of_point_.resize(to_size(net.count()));
    for (const CellBlock& block : mesh.blocks) {
      if (dimension(block.type.shape) != net.dim() - 1) continue;
      for (Index cell = 0; cell < block.size(); ++cell) {
        std::vector<Index> corners;
        for (int k = 0; k < corner_count(block.type.shape); ++k)
          corners.push_back(block.vertex(cell, k));
        region_.emplace(side_key(corners), block.regions[to_size(cell)]);
      }
    }
  }

  // Returns false if the side is in no plane.
  bool add(const CellSide& side) {
    const std::vector<SideNode> nodes = nodes_of(mesh_, side);
    const std::optional<Vector3> normal = normal_of(nodes);
    const int region = region_of_side(side);
    for (const SideNode& node : nodes) {
      OfPoint& at = of_point_[to_size(net_.point_of(node.second))];
      at.is_held = at.is_held || !normal || (at.is_on_side && at.region != region);
      if (normal) add_normal(*normal, at.oblique, at.is_axis);
      at.is_on_side = true;
      at.region = region;
    }
    return normal.has_value();
  }

  // Computes the remaining freedom of the points once all sides are added: oblique normals are
  // orthogonalized against the axes and each other.
  void finish() {
    for (OfPoint& at : of_point_) {
      std::vector<Vector3> oblique;
      for (const Vector3& normal : std::exchange(at.oblique, {})) {
        Vector3 rest = normal;
        const auto remove = [&] {
          for (int d = 0; d < net_.dim(); ++d)
            if (at.is_axis[to_size(d)]) rest[d] = 0;
          for (const Vector3& other : oblique) rest -= rest.dot(other) * other;
        };
        remove();
        remove();  // so that the rest is orthogonal to all of them, also for skew planes
        const double sine = rest.norm();
        if (sine <= kSamePlane) continue;
        if (sine < kOtherPlane) at.is_held = true;
        add_normal(rest / sine, oblique, at.is_axis);
      }
      at.oblique = std::move(oblique);
      if (at.planes() >= net_.dim()) at.is_held = true;
    }
  }

  // Returns the region of the lower-dimensional cell on a side; 0 if there is none.
  int region_of_side(const CellSide& side) const {
    const auto named = region_.find(side.key);
    return named == region_.end() ? 0 : named->second;
  }

  bool is_held(Index point) const { return of_point_[to_size(point)].is_held; }
  // The number of planes, and the planes: coordinates that are constant on them, and the normals of
  // other planes, orthogonalized against these and each other.
  int count(Index point) const { return of_point_[to_size(point)].planes(); }
  bool is_axis(Index point, int axis) const {
    return of_point_[to_size(point)].is_axis[to_size(axis)];
  }
  const std::vector<Vector3>& oblique(Index point) const {
    return of_point_[to_size(point)].oblique;
  }

 private:
  struct OfPoint {
    bool is_held = false, is_on_side = false;
    int region = 0;
    std::array<bool, 3> is_axis{};
    std::vector<Vector3> oblique;

    int planes() const {
      return static_cast<int>(std::count(is_axis.begin(), is_axis.end(), true) +
                              static_cast<std::ptrdiff_t>(oblique.size()));
    }
  };

  // Finds an axis along which all nodes have one coordinate.
  std::optional<Vector3> normal_of(const std::vector<SideNode>& nodes) const {
    const auto point = [&](std::size_t k) -> Vector3 {
      return mesh_.points.row(nodes[k].second).transpose();
    };
    const Vector3 origin = point(0);
    double size = 0;
    Vector3 along = Vector3::Zero();
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      const Vector3 edge = point(k) - origin;
      if (edge.norm() > size) along = edge, size = edge.norm();
    }
    for (int d = 0; d < net_.dim(); ++d) {
      bool is_flat = true;
      for (std::size_t k = 1; k < nodes.size(); ++k) is_flat = is_flat && point(k)[d] == origin[d];
      if (is_flat) return Vector3::Unit(d);
    }
    if (!(size > 0)) return std::nullopt;
    along /= size;
    Vector3 normal = Vector3::Zero();
    if (net_.dim() == 2) {
      normal = Vector3(along.y(), -along.x(), 0);
    } else {
      for (std::size_t k = 1; k < nodes.size(); ++k) {
        const Vector3 candidate = along.cross(point(k) - origin);
        if (candidate.norm() > normal.norm()) normal = candidate;
      }
      if (!(normal.norm() > kOtherPlane * size)) return std::nullopt;
      normal.normalize();
    }
    for (std::size_t k = 1; k < nodes.size(); ++k)
      if (!(std::abs(normal.dot(point(k) - origin)) <= kFlat * size)) return std::nullopt;
    return normal;
  }

  static void add_normal(const Vector3& normal, std::vector<Vector3>& oblique,
                         std::array<bool, 3>& is_axis) {
    for (int d = 0; d < 3; ++d)
      if (normal.cwiseAbs() == Vector3::Unit(d)) {
        is_axis[to_size(d)] = true;
        return;
      }
    oblique.push_back(normal);
  }

  const VolumeMesh& mesh_;
  const ControlNet& net_;
  std::map<CellSide::Key, int> region_;
  std::vector<OfPoint> of_point_;
};

HeldPoints::HeldPoints(const VolumeMesh& mesh, const std::vector<CellSide>& sides,
                       const ControlNet& net, VecIn x, VolumeBoundary boundary)
    : net_(net), x_(x), held_(to_size(net.dim() * net.count()), 0) {
  if (boundary != VolumeBoundary::Free) hold_boundary(mesh, sides, boundary);
  hold_periodic(mesh, sides);
  hold_pieces();
}

// Holds periodic sides, since the two sides of a pair would have to move alike.
void HeldPoints::hold_periodic(const VolumeMesh& mesh, const std::vector<CellSide>& sides) {
  for_each_side(sides, [&](std::span<const CellSide> cells) {
    if (cells.size() != 2 || !are_translated(mesh, cells[0], cells[1])) return;
    for (const CellSide& side : cells)
      for (const SideNode& node : nodes_of(mesh, side)) hold(net_.point_of(node.second));
  });
}

void HeldPoints::hold_all_but(const std::vector<CellName>& cells) {
  std::vector<char> may_move(to_size(net_.count()), 0);
  for (const ControlNet::Part& part : net_.parts())
    for (const CellName& name : cells)
      if (name.block == part.block)
        for (const Index point : part.space->cells().row(name.cell)) may_move[to_size(point)] = 1;
  for (Index point = 0; point < net_.count(); ++point)
    if (may_move[to_size(point)] == 0) hold(point);
}

void HeldPoints::hold_boundary(const VolumeMesh& mesh, const std::vector<CellSide>& sides,
                               VolumeBoundary boundary) {
  Planes planes(mesh, net_);
  std::vector<CellSide> all;
  std::vector<char> is_curved;
  std::vector<int> regions;
  for_each_side(sides, [&](std::span<const CellSide> cells) {
    const bool is_inner = cells.size() > 1 &&
                          region_of(mesh, cells.front().name) == region_of(mesh, cells.back().name);
    if (is_inner) return;
    ++sides_;
    if (boundary == VolumeBoundary::Fixed) {
      for (const SideNode& node : nodes_of(mesh, cells.front())) hold(net_.point_of(node.second));
    } else {
      const bool is_flat = planes.add(cells.front());
      if (!is_flat) ++curved_sides_;
      all.push_back(cells.front());
      is_curved.push_back(is_flat ? 0 : 1);
      regions.push_back(planes.region_of_side(cells.front()));
    }
  });
  planes.finish();
  // Holds lower-dimensional cells. Points of curves that lie in two planes may move along the
  // curve.
  for (const CellBlock& block : mesh.blocks) {
    const int dim = dimension(block.type.shape);
    if (dim >= net_.dim()) continue;
    for (Index k = 0; k < block.nodes.size(); ++k) {
      const Index point = net_.point_of(block.nodes.data()[k]);
      if (point < 0) continue;
      if (boundary == VolumeBoundary::Fixed || planes.count(point) < net_.dim() - dim) hold(point);
    }
  }
  for (Index point = 0; boundary == VolumeBoundary::Slide && point < net_.count(); ++point) {
    if (planes.is_held(point)) {
      hold(point);
      continue;
    }
    for (int d = 0; d < net_.dim(); ++d)
      if (planes.is_axis(point, d)) held_[to_size(net_.dim() * point + d)] = 1;
    for (const Vector3& normal : planes.oblique(point)) rows_.push_back({point, normal});
  }
  if (curved_sides_ == 0) return;
  curved_.emplace(mesh, net_, x_, all, is_curved, regions);
  std::vector<char> is_named(to_size(net_.count()), 0);  // by curves and points
  for (const CellBlock& block : mesh.blocks) {
    if (dimension(block.type.shape) >= net_.dim() - 1) continue;
    for (Index k = 0; k < block.nodes.size(); ++k)
      if (const Index point = net_.point_of(block.nodes.data()[k]); point >= 0)
        is_named[to_size(point)] = 1;
  }
  for (Index point = 0; point < net_.count(); ++point)
    if (curved_->slides(point) && is_named[to_size(point)] == 0) sliding_.push_back(point);
}

void HeldPoints::let_slide(VecIn x) {
  x_ = x;
  std::erase_if(rows_, [](const PlaneRow& row) { return row.is_of_node; });
  const RowMatrix nodes = net_.node_places(x_);
  for (const Index point : sliding_) {
    for (int d = 0; d < net_.dim(); ++d) held_[to_size(net_.dim() * point + d)] = 0;
    Vector3 at = Vector3::Zero();
    at.head(net_.dim()) = nodes.row(point).transpose();
    rows_.push_back({point, curved_->nearest(point, at).normal, true});
  }
  std::stable_sort(rows_.begin(), rows_.end(),
                   [](const PlaneRow& a, const PlaneRow& b) { return a.point < b.point; });
}

void HeldPoints::put_back(RowMatrix& nodes) const {
  for (const Index point : sliding_) {
    Vector3 at = Vector3::Zero();
    at.head(net_.dim()) = nodes.row(point).transpose();
    nodes.row(point) = curved_->nearest(point, at).place.head(net_.dim()).transpose();
  }
}

void HeldPoints::hold(Index point) {
  for (int d = 0; d < net_.dim(); ++d) held_[to_size(net_.dim() * point + d)] = 1;
}

void HeldPoints::release(const std::vector<CellName>& cells, const HeldPoints& others) {
  const int dim = net_.dim();
  for (const ControlNet::Part& part : net_.parts())
    for (const CellName& name : cells) {
      if (name.block != part.block) continue;
      for (const Index point : part.space->cells().row(name.cell)) {
        for (Index k = dim * point; k < dim * (point + 1); ++k)
          held_[to_size(k)] = others.held_[to_size(k)];
        std::erase_if(rows_, [&](const PlaneRow& row) { return row.point == point; });
      }
    }
}

// Holds in every connected piece those coordinates of one node in which nothing else, not even an
// oblique plane, holds the piece.
void HeldPoints::hold_pieces() {
  UnionFind pieces(net_.count());
  for (const ControlNet::Part& part : net_.parts()) {
    const Cells& cells = part.space->cells();
    for (Index e = 0; e < cells.rows(); ++e)
      for (Index k = 1; k < cells.cols(); ++k) pieces.join(cells(e, 0), cells(e, k));
  }
  const int dim = net_.dim();
  // The held directions of each piece, orthonormal.
  std::vector<std::vector<Vector3>> directions(to_size(net_.count()));
  const auto add = [&](Index point, Vector3 direction) {
    std::vector<Vector3>& of_piece = directions[to_size(pieces.find(point))];
    for (const Vector3& other : of_piece) direction -= direction.dot(other) * other;
    if (direction.norm() <= kOtherPlane) return false;
    of_piece.push_back(direction.normalized());
    return true;
  };
  for (Index point = 0; point < net_.count(); ++point)
    for (int d = 0; d < dim; ++d)
      if (held_[to_size(dim * point + d)] != 0) add(point, Vector3::Unit(d));
  for (const PlaneRow& row : rows_) add(row.point, row.normal);
  for (Index point = 0; point < net_.count(); ++point)
    for (int d = 0; d < dim; ++d)
      if (pieces.find(point) == point && add(point, Vector3::Unit(d)))
        held_[to_size(dim * point + d)] = 1;
}

void HeldPoints::append_rows(ConstraintRows& rows) const {
  const int dim = net_.dim();
  for (Index k = 0; k < static_cast<Index>(held_.size()); ++k) {
    if (held_[to_size(k)] == 0) continue;
    const int axis = static_cast<int>(k % dim);
    rows.begin_row(fmt::format("coordinate {} of node {}", axis, k / dim));
    if (is_still(k / dim, axis)) {
      rows.add(k, 1);
      rows.end_row(x_[k]);
      continue;
    }
    double sum = 0;
    for (const auto& [point, weight] : net_.weights_of_node(k / dim)) {
      rows.add(dim * point + axis, weight);
      sum += weight * x_[dim * point + axis];
    }
    rows.end_row(sum);
  }
  for (const PlaneRow& row : rows_) {
    rows.begin_row(fmt::format("a plane of control point {}", row.point));
    double sum = 0;
    const auto add = [&](Index point, double weight) {
      for (int d = 0; d < dim; ++d) {
        const Index unknown = dim * point + d;
        if (row.normal[d] == 0) continue;
        rows.add(unknown, weight * row.normal[d]);
        sum += weight * row.normal[d] * x_[unknown];
      }
    };
    if (row.is_of_node)
      for (const auto& [point, weight] : net_.weights_of_node(row.point)) add(point, weight);
    else
      add(row.point, 1);
    rows.end_row(sum);
  }
}

bool HeldPoints::is_still(Index point, int axis) const {
  if (held_[to_size(net_.dim() * point + axis)] == 0) return false;
  for (const auto& [of, weight] : net_.weights_of_node(point))
    if (held_[to_size(net_.dim() * of + axis)] == 0) return false;
  return true;
}

bool HeldPoints::is_free(Index point) const {
  const int dim = net_.dim();
  for (int d = 0; d < dim; ++d)
    if (held_[to_size(dim * point + d)] != 0) return false;
  // Rows are sorted by their points.
  const auto row = std::lower_bound(rows_.begin(), rows_.end(), point,
                                    [](const PlaneRow& r, Index p) { return r.point < p; });
  return row == rows_.end() || row->point != point;
}

std::vector<CellName> HeldPoints::impossible_cells(const VolumeMesh& mesh) const {
  const int dim = net_.dim();
  std::vector<char> may_move(to_size(net_.count()), 0);
  for (Index point = 0; point < net_.count(); ++point)
    for (int d = 0; d < dim; ++d)
      if (!is_still(point, d)) may_move[to_size(point)] = 1;
  std::vector<CellName> out;
  for (const ControlNet::Part& part : net_.parts()) {
    const CellBlock& block = mesh.blocks[to_size(part.block)];
    const ReferenceCell& reference = ReferenceCell::of(block.type);
    const RowMatrix& gradients = reference.sampled_gradients();
    const Cells& cells = part.space->cells();
    RowMatrix control(cells.cols(), dim), nodes(cells.cols(), dim);
    // det J <= 0 at a sampled point, beyond the rounding of n terms with factors of that size.
    const auto is_forced = [&](Index e) {
      for (Index k = 0; k < cells.cols(); ++k)
        control.row(k) = x_.segment(dim * cells(e, k), dim).transpose();
      for (Index s = 0; s < gradients.rows() / dim; ++s) {
        const auto rows = gradients.middleRows(dim * s, dim);
        bool is_held = true;
        for (Index k = 0; k < cells.cols(); ++k)
          is_held = is_held && (may_move[to_size(cells(e, k))] == 0 || rows.col(k).isZero(0));
        if (!is_held) continue;
        const RowMatrix J = rows * control;
        const double size = (rows.cwiseAbs() * (control.rowwise() - control.row(0)).cwiseAbs())
                                .rowwise()
                                .sum()
                                .prod();
        const double det = J.determinant();
        if (det <= -kRounding * size) return true;
        if (s >= corner_count(block.type.shape) || det > kRounding * size) continue;
        for (Index k = 0; k < cells.cols(); ++k)
          nodes.row(k) = mesh.points.row(block.nodes(e, k)).head(dim);
        if (is_not_positive_at_corner(reference, rows, nodes)) return true;
      }
      return false;
    };
    for (Index e = 0; e < cells.rows(); ++e) {
      bool all_held = true;
      for (Index k = 0; k < cells.cols(); ++k)
        all_held = all_held && may_move[to_size(cells(e, k))] == 0;
      if (all_held) {
        for (Index k = 0; k < cells.cols(); ++k)
          nodes.row(k) = mesh.points.row(block.nodes(e, k)).head(dim);
        if (determinant_range(block.type, nodes.data()).positive == ProofStatus::Violated)
          out.push_back({part.block, e});
      } else if (is_forced(e)) {
        out.push_back({part.block, e});
      }
    }
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
