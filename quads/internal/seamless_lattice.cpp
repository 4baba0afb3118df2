#include "majorant/quads/internal/seamless_lattice.h"

#include <fmt/format.h>

#include <cmath>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

// Steps of the lattice along the layout, as a power of two: edges of a thousandth of it keep nine
// digits, and products of two differences stay far below 2^127.
constexpr int kLatticeBits = 40;
// The largest coordinate: a layout far from the origin loses nothing up to there.
constexpr double kLargestCoordinate = 0x1p56;

[[noreturn]] void refuse_map(const std::string& what) {
  throw Error(ErrorKind::Infeasible, "the seamless map, rounded to integers, " + what);
}

// x = Z y in integers.
std::vector<std::int64_t> rounded_unknowns(const BezierMap& map, double unit) {
  const Index unknowns = static_cast<Index>(map.control_points().size());
  ConstraintRows rows;
  SeamlessConstraint(map.shared_space(), map.shared_seams()).append_rows(rows);
  const Elimination elimination(unknowns, rows);
  const Vec y = elimination.reduce(map.control_points(), nullptr);
  std::vector<std::int64_t> free, x;
  for (const double value : y) {
    if (!(std::abs(value) < kLargestCoordinate * unit)) refuse_map("is too far from the origin");
    free.push_back(std::llround(value / unit));
  }
  for (Index i = 0; i < unknowns; ++i) {
    std::int64_t sum = 0;
    for (const auto* e = elimination.begin(i); e != elimination.end(i); ++e) {
      if (e->coefficient != std::round(e->coefficient)) refuse_map("has seams with fractions");
      sum += static_cast<std::int64_t>(e->coefficient) * free[e->reduced];
    }
    x.push_back(sum);
  }
  return x;
}

}  // namespace

LatticePoint turned(LatticePoint p, int turns) {
  switch (quarter(turns)) {
    case 1:
      return {-p.v, p.u};
    case 2:
      return {-p.u, -p.v};
    case 3:
      return {p.v, -p.u};
    default:
      return p;
  }
}

SeamlessLattice::SeamlessLattice(const SurfaceMesh& surface, const BezierMap& map)
    : surface_(surface),
      turns_(to_size(surface.half_edge_count()), 0),
      quarter_turns_(map.seams().quarter_turns()),
      leaving_(to_size(surface.vertex_count()), -1) {
  const auto uv = map.control_uv();
  const double extent = (uv.colwise().maxCoeff() - uv.colwise().minCoeff()).maxCoeff();
  unit_ = std::ldexp(1.0, std::ilogb(extent) - kLatticeBits);
  const std::vector<std::int64_t> x = rounded_unknowns(map, unit_);
  if (quarter_turns_.empty()) {  // a map without seams: of a plane surface
    quarter_turns_.assign(to_size(surface.vertex_count()), 4);
    for (const auto& loop : surface.boundary_loops())
      for (const Index v : loop) quarter_turns_[v] = 0;
  }
  for (const SeamEdge& edge : map.seams().edges()) {
    turns_[edge.side] = edge.turns;
    turns_[edge.opposite] = quarter(-edge.turns);
  }
  for (Index h = 0; h < surface.half_edge_count(); ++h) {
    const Index node = map.mesh().from_vertex(h);
    corners_.push_back({x[2 * node], x[2 * node + 1]});
    leaving_[surface.from_vertex(h)] = h;
  }
  for (Index h = 0; h < surface.half_edge_count(); ++h) {
    const Index o = surface.opposite(h);
    shift_.push_back(o < 0 ? LatticePoint{} : corners_[h] - turned(corners_[next(o)], turns_[h]));
  }
  prove();
}

LatticePoint SeamlessLattice::beyond(Index half_edge, LatticePoint p) const {
  return turned(p - shift_[half_edge], -turns_[half_edge]);
}

WideInteger SeamlessLattice::twice_area() const {
  WideInteger sum = 0;
  for (Index h = 0; h < surface_.half_edge_count(); h += 3)
    sum += cross(corners_[h + 1] - corners_[h], corners_[h + 2] - corners_[h]);
  return sum;
}

void SeamlessLattice::prove() const {
  std::vector<int> leave(to_size(surface_.vertex_count()), 0);
  for (Index h = 0; h < surface_.half_edge_count(); ++h) {
    if (h % 3 == 0 && side(corners_[h], corners_[h + 1], corners_[h + 2]) <= 0)
      refuse_map(fmt::format("turns face {} over", surface_.input_face(face_of(h))));
    const Index o = surface_.opposite(h);
    if (o >= 0 && (beyond(h, corners_[h]) != corners_[next(o)] ||
                   beyond(h, corners_[next(h)]) != corners_[o]))
      refuse_map(fmt::format("is torn at half-edge {}", h));
    leave[surface_.from_vertex(h)] += static_cast<int>(leaving_directions(*this, h).size());
  }
  for (Index v = 0; v < surface_.vertex_count(); ++v)
    if (quarter_turns_[v] > 0 && leave[v] != quarter_turns_[v])
      refuse_map(fmt::format("has {} quarter turns around vertex {}, not {}", leave[v],
                             surface_.input_vertex(v), quarter_turns_[v]));
}

void SeamlessLattice::move(Index vertex, LatticePoint by) {
  Index h = leaving_[vertex];
  do {
    corners_[h] = corners_[h] + by;
    if (side(corners_[h], corners_[next(h)], corners_[previous(h)]) <= 0)
      refuse_map(fmt::format("leaves vertex {} no room", surface_.input_vertex(vertex)));
    by = turned(by, -turns_[previous(h)]);
    h = surface_.opposite(previous(h));
  } while (h != leaving_[vertex]);
  // The shifts of edges around it stay: both sides have moved alike.
}

std::vector<int> leaving_directions(const SeamlessLattice& lattice, Index half_edge) {
  const LatticePoint at = lattice.corner(half_edge);
  const LatticePoint first = lattice.corner(next(half_edge)) - at;
  const LatticePoint last = lattice.corner(previous(half_edge)) - at;
  std::vector<int> found;
  for (int d = 0; d < 4; ++d) {
    const LatticePoint along = unit_vector(d);
    if (cross(first, along) >= 0 && cross(along, last) > 0) found.push_back(d);
  }
  // Two at most: 3 comes before 0.
  if (found.size() == 2 && found[0] == 0 && found[1] == 3) std::swap(found[0], found[1]);
  return found;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
