#include "majorant/quads/internal/seamless_lattice.h"

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/random_steps.h"

namespace majorant {
namespace {

// The number of lattice steps along the layout, as a power of two. Edges of a thousandth of the
// layout keep nine digits, and products of two differences stay far below 2^127.
constexpr int kLatticeBits = 40;
// The largest coordinate. Layouts that are closer to the origin than this lose no digits.
constexpr double kLargestCoordinate = 0x1p56;
// The random offset of unknowns on a surface with held edges, in steps: at most 1e-9 of the layout.
// If a face is turned over, the offset is divided by kSmallerOffset and tried again. In an
// integer-grid map, lines without an edge between them are kRealPart of their distance apart
// (grid_translations.h), which may be that small.
constexpr int kLargestOffset = 1000, kSmallerOffset = 10;

[[noreturn]] void refuse_map(const std::string& what) {
  throw Error(ErrorKind::Infeasible, "the seamless map, rounded to integers, " + what);
}

// Returns the edges of the border and of features, with the coordinate that the map holds along
// them.
std::vector<AlignedEdge> held_edges(const SurfaceMesh& surface, const BezierMap& map,
                                    const std::vector<char>& is_feature) {
  std::vector<AlignedEdge> held;
  const auto uv = map.control_uv();
  const std::vector<char> is_held = held_flags(surface, is_feature);
  for (Index h = 0; h < surface.half_edge_count(); ++h) {
    if (!is_held[h] || (surface.opposite(h) >= 0 && surface.opposite(h) < h)) continue;
    const Vector2 edge = uv.row(map.mesh().to_vertex(h)) - uv.row(map.mesh().from_vertex(h));
    held.push_back({h, std::abs(edge.x()) <= std::abs(edge.y()) ? 0 : 1});
  }
  return held;
}

// Returns a power of two.
std::int64_t common_denominator(const Elimination& elimination, Index unknowns) {
  constexpr std::int64_t kMaximum = 256;
  std::int64_t denominator = 1;
  for (Index i = 0; i < unknowns; ++i)
    for (const auto& e : elimination.row(i))
      for (double c = e.coefficient * static_cast<double>(denominator); c != std::round(c);
           c *= 2) {
        if (denominator == kMaximum) refuse_map("has seams with fractions");
        denominator *= 2;
      }
  return denominator;
}

// Returns x = Z y in integers, where y has random offsets up to `most` steps.
std::vector<std::int64_t> rounded_unknowns(const std::vector<AlignedEdge>& held,
                                           const BezierMap& map, double unit, int most) {
  const Index unknowns = static_cast<Index>(map.control_points().size());
  ConstraintRows rows;
  if (!map.seams().empty())
    SeamlessConstraint(map.shared_space(), map.shared_seams()).append_rows(rows);
  if (!held.empty()) AxisAlignment(map.shared_space(), held).append_rows(rows);
  const Elimination elimination(unknowns, rows);
  const Vec y = elimination.reduce(map.control_points(), nullptr);
  std::mt19937 random(1);
  // y are multiples of the denominators of the coefficients, so that all unknowns are integers.
  const std::int64_t denominator = common_denominator(elimination, unknowns);
  std::vector<std::int64_t> free, x;
  for (const double value : y) {
    if (!(std::abs(value) < kLargestCoordinate * unit)) refuse_map("is too far from the origin");
    free.push_back(std::llround(value / unit / static_cast<double>(denominator)) +
                   random_between(random, -most, most));
  }
  for (Index i = 0; i < unknowns; ++i) {
    std::int64_t sum = 0;
    for (const auto& e : elimination.row(i))
      sum += std::llround(e.coefficient * static_cast<double>(denominator)) * free[e.reduced];
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

SeamlessLattice::SeamlessLattice(const SurfaceMesh& surface, const BezierMap& map,
                                 std::vector<char> features, double border_turn)
    : surface_(surface),
      is_feature_(std::move(features)),
      border_turn_(border_turn),
      turns_(to_size(surface.half_edge_count()), 0),
      quarter_turns_(map.seams().quarter_turns()),
      leaving_(to_size(surface.vertex_count()), -1) {
  const auto uv = map.control_uv();
  const double extent = (uv.colwise().maxCoeff() - uv.colwise().minCoeff()).maxCoeff();
  unit_ = std::ldexp(1.0, std::ilogb(extent) - kLatticeBits);
  // A map without seams belongs to a planar surface.
  if (quarter_turns_.empty()) quarter_turns_.assign(to_size(surface.vertex_count()), 4);
  for (const SeamEdge& edge : map.seams().edges()) {
    turns_[edge.side] = edge.turns;
    turns_[edge.opposite] = quarter(-edge.turns);
  }
  const auto rank = [&](Index h) { return surface.opposite(h) < 0 ? 2 : is_feature(h) ? 1 : 0; };
  for (Index h = 0; h < surface.half_edge_count(); ++h) {
    Index& leaving = leaving_[surface.from_vertex(h)];
    if (leaving < 0 || (rank(leaving) < 2 && rank(h) >= rank(leaving))) leaving = h;
  }
  const std::vector<AlignedEdge> held = held_edges(surface, map, is_feature_);
  int most = held.empty() ? 0 : kLargestOffset;
  while (!is_placed(map, held, most)) most /= kSmallerOffset;
}

// Returns whether the map is proven with offsets up to so many steps. Throws Error(Infeasible) if
// it is not proven without offsets.
bool SeamlessLattice::is_placed(const BezierMap& map, const std::vector<AlignedEdge>& held,
                                int most) {
  try {
    place(map, rounded_unknowns(held, map, unit_, most));
    return true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Infeasible || most == 0) throw;
    return false;
  }
}

// x: the unknowns of the map, in steps. Throws Error(Infeasible) if the map is not proven.
void SeamlessLattice::place(const BezierMap& map, const std::vector<std::int64_t>& x) {
  corners_.clear();
  shift_.clear();
  for (Index h = 0; h < surface_.half_edge_count(); ++h) {
    const Index node = map.mesh().from_vertex(h);
    corners_.push_back({x[2 * node], x[2 * node + 1]});
  }
  for (Index h = 0; h < surface_.half_edge_count(); ++h) {
    const Index o = surface_.opposite(h);
    shift_.push_back(o < 0 ? LatticePoint{} : corners_[h] - turned(corners_[next(o)], turns_[h]));
  }
  count_turns_of_border();
  prove();
}

int SeamlessLattice::direction_of(Index half_edge) const {
  const LatticePoint along = corners_[next(half_edge)] - corners_[half_edge];
  if (along.v == 0) return along.u > 0 ? 0 : 2;
  return along.v > 0 ? 1 : 3;
}

// Counts the axis directions from one edge of the border to the other.
void SeamlessLattice::count_turns_of_border() {
  for (Index h = 0; h < surface_.half_edge_count(); ++h) {
    if (surface_.opposite(h) >= 0) continue;
    int& turns = quarter_turns_[surface_.from_vertex(h)] = 0;
    for (Index k = h; k >= 0; k = surface_.opposite(previous(k)))
      turns += static_cast<int>(leaving_directions(*this, k).size());
  }
}

LatticePoint SeamlessLattice::beyond(Index half_edge, LatticePoint p) const {
  return turned(p - shift_[half_edge], -turns_[half_edge]);
}

bool SeamlessLattice::contains(Index face, LatticePoint p) const {
  for (Index h = 3 * face; h < 3 * face + 3; ++h)
    if (side(corners_[h], corners_[next(h)], p) < 0) return false;
  return true;
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
    const LatticePoint along = corners_[next(h)] - corners_[h];
    if ((o < 0 || is_feature(h)) && along.u != 0 && along.v != 0)
      refuse_map(fmt::format("has the {} at face {} off its axes", o < 0 ? "border" : "feature",
                             surface_.input_face(face_of(h))));
    if (o >= 0 && (beyond(h, corners_[h]) != corners_[next(o)] ||
                   beyond(h, corners_[next(h)]) != corners_[o]))
      refuse_map(fmt::format("is torn at half-edge {}", h));
    leave[surface_.from_vertex(h)] += static_cast<int>(leaving_directions(*this, h).size());
  }
  for (Index v = 0; v < surface_.vertex_count(); ++v)
    if (leave[v] != quarter_turns_[v])
      refuse_map(fmt::format("has {} quarter turns around vertex {}, not {}", leave[v],
                             surface_.input_vertex(v), quarter_turns_[v]));
}

void SeamlessLattice::move(Index vertex, LatticePoint by) {
  Index h = leaving_[vertex];
  if (is_on_border(vertex) || is_on_feature(vertex)) by = by.u * unit_vector(direction_of(h));
  do {
    corners_[h] = corners_[h] + by;
    if (side(corners_[h], corners_[next(h)], corners_[previous(h)]) <= 0)
      refuse_map(fmt::format("leaves vertex {} no room", surface_.input_vertex(vertex)));
    by = turned(by, -turns_[previous(h)]);
    h = surface_.opposite(previous(h));
  } while (h >= 0 && h != leaving_[vertex]);
  // The translations of the edges around it do not change, since both sides move alike.
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
  // There are at most two directions, and 3 precedes 0.
  if (found.size() == 2 && found[0] == 0 && found[1] == 3) std::swap(found[0], found[1]);
  return found;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
