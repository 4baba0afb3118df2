#include "majorant/parametrization/solve/free_scale.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/error.h"
#include "majorant/maps/map_problem.h"
#include "majorant/mesh/mesh_messages.h"

namespace majorant {
namespace {

// Returns whether two points are at the same place. A point without a target is where the start has
// it, so two vertices without targets differ.
bool at_one_place(const Pin& a, const Pin& b) {
  return a.vertex == b.vertex || (a.target && b.target && *a.target == *b.target);
}

// Returns whether two points hold the scale. Pieces that seams connect need one pair of points
// between them, since seams preserve lengths.
bool two_points_hold(const MapOptions& options, const BezierTriangleSpace& space) {
  const std::vector<Index> piece = vertex_components(space);
  const auto piece_of = [&](const Pin& p) { return piece[static_cast<std::size_t>(p.vertex)]; };
  std::vector<Pin> points = options.pins;
  points.insert(points.end(), options.handles.begin(), options.handles.end());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (piece_of(points[i]) == piece_of(points[k]) && !at_one_place(points[i], points[k]))
        return true;
  return false;
}

std::string names_of(const EnergySum& energy) {
  std::vector<std::string> names;
  for (const WeightedEnergy& e : energy) names.push_back(e.make.traits().name);
  return fmt::format("{}", fmt::join(names, " + "));
}

}  // namespace

bool collapses(const MapOptions& options, const BezierTriangleSpace& space, const Seams& seams) {
  if (free_scale_of(options.energy) != FreeScale::Collapses) return false;
  if (options.boundary == BoundaryCondition::Fixed && !boundary_nodes(space, seams).empty())
    return false;
  return !two_points_hold(options, space);
}

void require_scale(const MapOptions& options, const BezierMap& start) {
  MapOptions placed = options;  // a target may be where the start has the other vertex
  for (auto* points : {&placed.pins, &placed.handles})
    for (Pin& p : *points)
      p.target = p.target.value_or(start.control_points().segment<2>(2 * p.vertex));
  if (!collapses(placed, start.space(), start.seams())) return;
  throw Error(ErrorKind::Usage,
              fmt::format("{}the energy {} is smallest for a map shrunk to a point, and nothing "
                          "holds the scale; fix the boundary, hold two points at different places, "
                          "or add an energy that has a scale, such as symmetric Dirichlet",
                          message_prefix(start.mesh()), names_of(options.energy)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
