#include "majorant/parametrization/seams/congruent_surfaces.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// The tolerance of places, relative to the diagonal: half a texel of a surface that is 4096 texels
// wide.
constexpr double kPlaceTolerance = 1e-4;

// Returns the largest distance between vertices of copies.
double close_to(const SurfaceMesh& mesh) { return kPlaceTolerance * diagonal(mesh.positions()); }

// A matching of the faces of two surfaces that grows from one pair of half-edges.
class Matching {
 public:
  // Mirrored: half-edges of one surface run backwards along those of the other.
  Matching(const SurfaceMesh& on, const SurfaceMesh& under, ChartSense sense)
      : on_(on), under_(under), sense_(sense), close_(close_to(under)) {}

  // Returns whether all faces match if h lies on g.
  bool match(Index h, Index g) {
    partner_.assign(to_size(on_.half_edge_count()), -1);
    std::vector<char> is_taken(to_size(under_.face_count()), 0);
    std::vector<std::pair<Index, Index>> open{{h, g}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (partner_[a] >= 0 || is_taken[face_of(b)]) {
        if (partner_[a] != b) return false;
        continue;
      }
      is_taken[face_of(b)] = 1;
      Index along = b;
      for (Index k = 0, of = a; k < 3; ++k, of = next(of), along = step(along)) {
        partner_[of] = along;
        if (std::abs(on_.edge_length(of) - under_.edge_length(along)) > close_) return false;
        const Index over = on_.opposite(of), below = under_.opposite(along);
        if ((over < 0) != (below < 0)) return false;
        if (is_in_polygon(on_, of) != is_in_polygon(under_, along)) return false;
        if (over >= 0) open.emplace_back(over, below);
      }
    }
    return std::find(partner_.begin(), partner_.end(), -1) == partner_.end() && is_congruent();
  }

  StackPlace place(std::size_t chart) const {
    StackPlace place{.chart = chart, .sense = sense_};
    for (Index f = 0; f < on_.face_count(); ++f) {
      place.face.push_back(face_of(partner_[3 * f]));
      place.corner.emplace_back();
      for (Index k = 0; k < 3; ++k) place.corner.back()[to_size(k)] = corner_under(3 * f + k);
    }
    return place;
  }

 private:
  // Returns whether an edge lies inside a polygon of the file. Layouts are proven by polygons
  // (certify/stacked_charts.h): a quadrilateral does not lie on two triangles.
  static bool is_in_polygon(const SurfaceMesh& mesh, Index half_edge) {
    const Index opposite = mesh.opposite(half_edge);
    return opposite >= 0 &&
           mesh.input_face(face_of(half_edge)) == mesh.input_face(face_of(opposite));
  }

  Index step(Index half_edge) const {
    return sense_ == ChartSense::Same ? next(half_edge) : previous(half_edge);
  }

  // Returns the corner that the one at the start of h lies on.
  int corner_under(Index h) const {
    const Index g = partner_[h];
    return static_cast<int>(corner_of(sense_ == ChartSense::Same ? g : next(g)));
  }

  // Returns whether a motion, after a reflection for mirrored surfaces, takes one to the other
  // [Kab76].
  bool is_congruent() const {
    const Index n = 3 * on_.face_count();
    Eigen::Matrix3Xd from(3, n), to(3, n);
    for (Index h = 0; h < n; ++h) {
      from.col(h) = on_.positions().row(on_.from_vertex(h)).transpose();
      const Index g = partner_[h];
      const Index corner = sense_ == ChartSense::Same ? under_.from_vertex(g) : under_.to_vertex(g);
      to.col(h) = under_.positions().row(corner).transpose();
    }
    if (sense_ == ChartSense::Mirrored) from.row(0) *= -1;
    from.colwise() -= from.rowwise().mean().eval();
    to.colwise() -= to.rowwise().mean().eval();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(Eigen::Matrix3d(to * from.transpose()),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vector3 sign = Vector3::Ones();
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign[2] = -1;
    const Eigen::Matrix3d motion = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    return (motion * from - to).colwise().norm().maxCoeff() <= close_;
  }

  const SurfaceMesh &on_, &under_;
  ChartSense sense_;
  double close_;
  std::vector<Index> partner_;  // of every half-edge
};

// Returns the distances of the vertices of a surface from its centre, the mean of the corners of
// its faces. Motions preserve them.
Vec distances_from_middle(const SurfaceMesh& mesh) {
  Vector3 middle = Vector3::Zero();
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    middle += mesh.positions().row(mesh.from_vertex(h)).transpose();
  middle /= mesh.half_edge_count();
  return (mesh.positions().rowwise() - middle.transpose()).rowwise().norm();
}

// Returns a half-edge with few candidates to lie on: the first of the boundary, or on closed
// surfaces the one that starts farthest from the centre.
Index first_half_edge(const SurfaceMesh& mesh, const Vec& distance) {
  Index start = 0;
  if (!mesh.boundary_loops().empty()) {
    while (mesh.opposite(start) >= 0) ++start;
    return start;
  }
  for (Index h = 1; h < mesh.half_edge_count(); ++h)
    if (distance[mesh.from_vertex(h)] > distance[mesh.from_vertex(start)]) start = h;
  return start;
}

// Returns the first match of one half-edge with any other.
std::optional<StackPlace> matched(const SurfaceMesh& on, const SurfaceMesh& under,
                                  std::size_t chart, ChartSense sense) {
  const Vec distance_on = distances_from_middle(on), distance_under = distances_from_middle(under);
  const Index start = first_half_edge(on, distance_on);
  const double close = close_to(under);
  const auto may_lie_on = [&](Index v, Index w) {
    return std::abs(distance_on[v] - distance_under[w]) <= close;
  };
  Matching matching(on, under, sense);
  for (Index g = 0; g < under.half_edge_count(); ++g) {
    if ((under.opposite(g) < 0) != (on.opposite(start) < 0)) continue;
    const bool is_same = sense == ChartSense::Same;
    const Index from = is_same ? under.from_vertex(g) : under.to_vertex(g);
    const Index to = is_same ? under.to_vertex(g) : under.from_vertex(g);
    if (may_lie_on(on.from_vertex(start), from) && may_lie_on(on.to_vertex(start), to) &&
        matching.match(start, g))
      return matching.place(chart);
  }
  return std::nullopt;
}

// Returns numbers that are equal for copies: of faces and vertices, and of the half-edges of each
// boundary loop.
std::vector<Index> numbers_of(const SurfaceMesh& mesh) {
  std::vector<Index> numbers;
  for (const auto& loop : mesh.boundary_loops()) numbers.push_back(static_cast<Index>(loop.size()));
  std::sort(numbers.begin(), numbers.end());
  numbers.insert(numbers.begin(), {mesh.face_count(), mesh.vertex_count()});
  return numbers;
}

// Returns whether the areas agree. If the corners of a triangle move by at most d, its area changes
// by at most half of its perimeter times d, up to d^2.
bool may_be_copies(const SurfaceMesh& on, const SurfaceMesh& under) {
  double perimeters = 0;
  for (Index h = 0; h < under.half_edge_count(); ++h) perimeters += under.edge_length(h);
  return std::abs(on.area() - under.area()) <= close_to(under) * perimeters;
}

}  // namespace

std::vector<std::optional<StackPlace>> stack_places(
    const std::vector<std::shared_ptr<const SurfaceMesh>>& surfaces, Stacking stacking,
    const std::vector<double>& scale) {
  std::vector<std::optional<StackPlace>> places(surfaces.size());
  std::map<std::vector<Index>, std::vector<std::size_t>> kinds;  // first surfaces, by their numbers
  for (std::size_t k = 0; k < surfaces.size() && stacking != Stacking::None; ++k) {
    const SurfaceMesh& mesh = *surfaces[k];
    std::vector<std::size_t>& firsts = kinds[numbers_of(mesh)];
    for (const ChartSense sense : {ChartSense::Same, ChartSense::Mirrored})
      for (std::size_t i = 0; i < firsts.size() && !places[k]; ++i) {
        const std::size_t first = firsts[i];
        const bool is_allowed = sense == ChartSense::Same || stacking == Stacking::Mirrored;
        if (is_allowed && (scale.empty() || scale[k] == scale[first]) &&
            may_be_copies(mesh, *surfaces[first]))
          places[k] = matched(mesh, *surfaces[first], first, sense);
      }
    if (!places[k]) firsts.push_back(k);
  }
  return places;
}

std::vector<char> flags_on(const std::vector<char>& under, const StackPlace& place) {
  std::vector<char> flags(3 * place.face.size());
  for (std::size_t f = 0; f < place.face.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t start = place.sense == ChartSense::Same ? k : (k + 1) % 3;
      flags[3 * f + k] = under[to_size(3 * place.face[f] + place.corner[f][start])];
    }
  return flags;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
