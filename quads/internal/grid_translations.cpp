#include "majorant/quads/internal/grid_translations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"
#include "majorant/quads/internal/border.h"

namespace majorant {
namespace {

[[noreturn]] void refuse_grid(const std::string& what) {
  throw Error(ErrorKind::Infeasible, "the map of whole numbers: " + what);
}

// The unknowns of a point's two coordinates.
using PointUnknowns = std::array<Index, 2>;

// A point in a chart as an expression: a sum of terms factor i^turns point, a number of edges, and
// the length of these edges in the lattice.
class DevelopedPoint {
 public:
  struct Term {
    PointUnknowns point;
    int turns, factor;
  };

  void add(const PointUnknowns& point, int factor) { terms_.push_back({point, 0, factor}); }
  void go(int direction, std::int64_t edges, std::int64_t length) {
    edges_ = edges_ + edges * unit_vector(direction);
    length_ = length_ + length * unit_vector(direction);
  }
  void turn(int quarters) {
    for (Term& term : terms_) term.turns = quarter(term.turns + quarters);
    edges_ = turned(edges_, quarters);
    length_ = turned(length_, quarters);
  }
  void subtract(const DevelopedPoint& other) {
    for (const Term& term : other.terms_) terms_.push_back({term.point, term.turns, -term.factor});
    edges_ = edges_ - other.edges_;
    length_ = length_ - other.length_;
  }

  const std::vector<Term>& terms() const { return terms_; }
  LatticePoint edges() const { return edges_; }
  LatticePoint length() const { return length_; }

 private:
  std::vector<Term> terms_;
  LatticePoint edges_, length_;
};

// Returns component c of i^turns (u, v) as a component of (u, v) and a sign.
std::pair<int, int> component_of_turned(int turns, int c) {
  const LatticePoint of_u = turned({1, 0}, turns), of_v = turned({0, 1}, turns);
  const auto from_u = static_cast<int>(c == 0 ? of_u.u : of_u.v);
  return from_u != 0 ? std::pair(0, from_u)
                     : std::pair(1, static_cast<int>(c == 0 ? of_v.u : of_v.v));
}

std::int64_t component_of(LatticePoint p, int c) { return c == 0 ? p.u : p.v; }

// Appends rows for the lengths of arcs. Auxiliary unknowns are the ends of lines inside of faces,
// and the translations of seams.
class ArcRows {
 public:
  ArcRows(const BezierMap& map, const SeamlessLattice& lattice, const TMesh& mesh,
          const std::vector<Index>& edges, double edge_length, ConstraintRows& rows)
      : map_(map),
        lattice_(lattice),
        surface_(lattice.surface()),
        mesh_(mesh),
        edges_(edges),
        edge_length_(edge_length),
        rows_(rows),
        chain_(to_size(surface_.half_edge_count()), -1),
        is_side_(chain_.size(), 0),
        places_(mesh.nodes.size()) {}

  void append() {
    append_seams();
    hold_first();
    for (const TraceLine& line : mesh_.lines) append_line(line);
  }

 private:
  // A point where a line ends on another, in the chart of a face.
  struct InnerPlace {
    Index face = -1;
    LatticePoint at;
    PointUnknowns unknowns{};
  };

  static PointUnknowns unknowns_of(Index node) { return {2 * node, 2 * node + 1}; }
  PointUnknowns new_point() {
    const Index u = rows_.add_auxiliary();
    return {u, rows_.add_auxiliary()};
  }

  // Appends the equations `zero` = 0.
  void append_row(const DevelopedPoint& zero) {
    for (int c = 0; c < 2; ++c) {
      std::map<Index, int> coefficients;
      for (const DevelopedPoint::Term& term : zero.terms()) {
        const auto [component, sign] = component_of_turned(term.turns, c);
        coefficients[term.point[component]] += sign * term.factor;
      }
      rows_.begin_row("the length of an arc");
      for (const auto& [unknown, coefficient] : coefficients)
        if (coefficient != 0) rows_.add(unknown, coefficient);
      const double whole = edge_length_ * static_cast<double>(component_of(zero.edges(), c));
      const double real = lattice_.unit() * static_cast<double>(component_of(zero.length(), c));
      rows_.end_row(-((1 - kRealPart) * whole + kRealPart * real));
    }
  }

  void append_seams() {
    translations_.resize(to_size(map_.seams().chain_count()));
    std::vector<char> is_known(translations_.size(), 0);
    for (const SeamEdge& edge : map_.seams().edges()) {
      chain_[edge.side] = chain_[edge.opposite] = edge.chain;
      is_side_[edge.side] = 1;
      if (std::exchange(is_known[edge.chain], 1)) continue;
      translations_[edge.chain] = new_point();
      DevelopedPoint zero, opposite;
      zero.add(unknowns_of(map_.mesh().from_vertex(edge.side)), 1);
      zero.add(translations_[edge.chain], -1);
      opposite.add(unknowns_of(map_.mesh().to_vertex(edge.opposite)), 1);
      opposite.turn(edge.turns);
      zero.subtract(opposite);
      append_row(zero);
    }
  }

  // Holds a cone or corner, of which every T-mesh has one, because the rows leave a translation
  // free.
  void hold_first() {
    const auto node = std::find_if(mesh_.nodes.begin(), mesh_.nodes.end(),
                                   [](const TNode& n) { return n.vertex >= 0; });
    const Index at = map_.mesh().from_vertex(lattice_.leaving(node->vertex));
    for (int c = 0; c < 2; ++c) {
      rows_.begin_row("the origin");
      rows_.add(2 * at + c, 1);
      rows_.end_row(edge_length_ * std::round(map_.control_points()[2 * at + c] / edge_length_));
    }
  }

  // Moves the point from the chart of a half-edge's face to that of the opposite face.
  void cross_edge(DevelopedPoint& point, Index half_edge) const {
    const Index chain = chain_[half_edge];
    if (chain < 0) return;
    if (is_side_[half_edge]) point.add(translations_[chain], -1);
    point.turn(-lattice_.turns(half_edge));
    if (!is_side_[half_edge]) point.add(translations_[chain], 1);
  }

  // Returns the node, which lies at p in the chart of a face, as an expression in that chart.
  DevelopedPoint node_in(Index face, LatticePoint p, Index node) {
    DevelopedPoint point;
    if (const Index vertex = mesh_.nodes[node].vertex; vertex >= 0) {
      for (Index h = 3 * face; h < 3 * face + 3; ++h)
        if (surface_.from_vertex(h) == vertex && lattice_.corner(h) == p) {
          point.add(unknowns_of(map_.mesh().from_vertex(h)), 1);
          return point;
        }
      refuse_grid("a line does not end in its vertex");
    }
    InnerPlace& place = places_[node];
    if (place.face < 0) place = {face, p, new_point()};
    point.add(place.unknowns, 1);
    if (place.face == face) return point;
    for (Index h = 3 * face; h < 3 * face + 3; ++h)
      if (const Index o = surface_.opposite(h);
          o >= 0 && face_of(o) == place.face && lattice_.beyond(h, p) == place.at) {
        cross_edge(point, o);
        return point;
      }
    refuse_grid("a line does not end on another");
  }

  void append_line(const TraceLine& line) {
    std::size_t leg = 0;
    for (const Index a : line.arcs) {
      const TArc& arc = mesh_.arcs[a];
      while (!is_in(line.legs[leg], arc.begin)) leg = leg_after(line, leg, nullptr);
      const LineLeg& first = line.legs[leg];
      DevelopedPoint point = node_in(first.face, first.at(arc.begin), arc.node[0]);
      point.go(first.direction, edges_[a], arc.length());
      while (!is_in(line.legs[leg], arc.end)) leg = leg_after(line, leg, &point);
      const LineLeg& last = line.legs[leg];
      point.subtract(node_in(last.face, last.at(arc.end), arc.node[1]));
      append_row(point);
    }
  }

  bool is_in(const LineLeg& leg, std::int64_t distance) const {
    return lattice_.contains(leg.face, leg.at(distance));
  }

  // Returns the next leg, and moves `point` (may be null) to its chart.
  std::size_t leg_after(const TraceLine& line, std::size_t leg, DevelopedPoint* point) const {
    if (leg + 1 == line.legs.size()) refuse_grid("a line ends in none of its faces");
    const LineLeg &here = line.legs[leg], &there = line.legs[leg + 1];
    if (point == nullptr || here.face == there.face) return leg + 1;
    for (Index h = 3 * here.face; h < 3 * here.face + 3; ++h)
      if (line.side == Side::Inside ? leads_to(h, here, there) : runs_along(h, here)) {
        if (line.side == Side::Inside)
          cross_edge(*point, h);
        else
          go_around(*point, next(h), there.face);
        return leg + 1;
      }
    refuse_grid("two legs of a line have no edge between them");
  }

  bool leads_to(Index h, const LineLeg& here, const LineLeg& there) const {
    const Index o = surface_.opposite(h);
    return o >= 0 && face_of(o) == there.face &&
           lattice_.direction_beyond(h, here.direction) == there.direction &&
           cross(lattice_.beyond(h, here.start) - there.start, unit_vector(there.direction)) == 0;
  }

  bool runs_along(Index h, const LineLeg& leg) const {
    return (surface_.opposite(h) < 0 || lattice_.is_feature(h)) &&
           lattice_.direction_of(h) == leg.direction;
  }

  // Goes clockwise around the vertex that a half-edge leaves, up to that face.
  void go_around(DevelopedPoint& point, Index half_edge, Index face) const {
    const Index first = half_edge;
    while (face_of(half_edge) != face) {
      const Index o = surface_.opposite(half_edge);
      if (o < 0 || next(o) == first) refuse_grid("a border has a gap");
      cross_edge(point, half_edge);
      half_edge = next(o);
    }
  }

  const BezierMap& map_;
  const SeamlessLattice& lattice_;
  const SurfaceMesh& surface_;
  const TMesh& mesh_;
  const std::vector<Index>& edges_;
  const double edge_length_;
  ConstraintRows& rows_;
  std::vector<Index> chain_;                 // by half-edge, -1: no seam
  std::vector<char> is_side_;                // by half-edge: SeamEdge::side
  std::vector<PointUnknowns> translations_;  // by chain
  std::vector<InnerPlace> places_;           // by node that is not a vertex
};

// Returns whether constraints determine the unknown.
bool is_constant(const Elimination& elimination, Index unknown) {
  return elimination.row(unknown).size() == 0;
}

}  // namespace

std::vector<AlignedEdge> held_axes(const SeamlessLattice& lattice) {
  std::vector<AlignedEdge> held;
  const SurfaceMesh& surface = lattice.surface();
  const std::vector<char> is_held = held_flags(surface, lattice.features());
  for (Index h = 0; h < surface.half_edge_count(); ++h)
    if (is_held[h] && (surface.opposite(h) < 0 || h < surface.opposite(h)))
      held.push_back({h, lattice.direction_of(h) % 2 == 0 ? 1 : 0});
  return held;
}

GridTranslations::GridTranslations(const BezierMap& map, const SeamlessLattice& lattice,
                                   const TMesh& mesh, const std::vector<Index>& edges,
                                   double edge_length)
    : edge_length_(edge_length) {
  ConstraintRows rows;
  if (!map.seams().empty())
    SeamlessConstraint(map.shared_space(), map.shared_seams()).append_rows(rows);
  if (const std::vector<AlignedEdge> held = held_axes(lattice); !held.empty())
    AxisAlignment(map.shared_space(), held).append_rows(rows);
  ArcRows(map, lattice, mesh, edges, edge_length, rows).append();
  std::optional<Elimination> solved;
  try {
    solved.emplace(static_cast<Index>(map.control_points().size()), rows);
  } catch (const Error& error) {
    refuse_grid(error.what());
  }
  const Elimination& elimination = *solved;
  const SurfaceMesh& surface = lattice.surface();
  std::vector<char> is_node(to_size(surface.vertex_count()), 0);
  for (const TNode& node : mesh.nodes)
    if (node.vertex >= 0) is_node[node.vertex] = 1;
  std::vector<char> is_done(to_size(map.mesh().vertex_count()), 0);
  for (Index h = 0; h < surface.half_edge_count(); ++h) {
    const Index node = map.mesh().from_vertex(h);
    if (!is_node[surface.from_vertex(h)] || std::exchange(is_done[node], 1)) continue;
    for (const Index i : {2 * node, 2 * node + 1}) {
      if (!is_constant(elimination, i)) refuse_grid("a cone is nowhere");
      fixed_.push_back({i, elimination.offset(i)});
    }
  }
  std::vector<char> is_known(to_size(map.seams().chain_count()), 0);
  for (const SeamEdge& edge : map.seams().edges()) {
    if (std::exchange(is_known[edge.chain], 1)) continue;
    const Index side = map.mesh().from_vertex(edge.side),
                opposite = map.mesh().to_vertex(edge.opposite);
    for (int c = 0; c < 2; ++c) {
      const auto [component, sign] = component_of_turned(edge.turns, c);
      const Index i = 2 * side + c, j = 2 * opposite + component;
      std::map<Index, double> difference;
      for (const auto& e : elimination.row(i)) difference[e.reduced] += e.coefficient;
      for (const auto& e : elimination.row(j)) difference[e.reduced] -= sign * e.coefficient;
      for (const auto& [unknown, coefficient] : difference)
        if (coefficient != 0) refuse_grid("a seam has no translation");
      translations_.push_back(
          {side, opposite, edge.turns, c, elimination.offset(i) - sign * elimination.offset(j)});
    }
  }
}

GridTranslations GridTranslations::scaled(double factor) const {
  GridTranslations other = *this;
  other.edge_length_ *= factor;
  for (FixedUnknown& fixed : other.fixed_) fixed.value *= factor;
  for (Translation& translation : other.translations_) translation.value *= factor;
  return other;
}

void GridTranslations::append_rows(ConstraintRows& rows) const {
  FixedUnknowns(fixed_).append_rows(rows);
  const std::string label = "the translation of a seam";
  for (const Translation& translation : translations_) {
    const auto [component, sign] = component_of_turned(translation.turns, translation.component);
    rows.begin_row(label);
    rows.add(2 * translation.side + translation.component, 1);
    rows.add(2 * translation.opposite + component, -sign);
    rows.end_row(translation.value);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
