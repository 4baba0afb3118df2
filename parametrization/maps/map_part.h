// The part of a map that one of several processes has: some of its faces, with their nodes.
//
//     spec.part = part;                                     // null: the whole map
//     double area = whole_area(spec);                       // of all parts
//     std::vector<Index> nodes = boundary_of(spec, space);  // not where it only meets others
//
// A rank's space is over its own faces; spaces of any degree over the same faces have the same
// part. What is asked of a map (map_problem.h) names nodes of the rank's own space: pins on every
// rank that has the vertex, handles on the one that owns it.
#pragma once

#include <memory>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/partition.h"

namespace majorant {

class MapPart {
 public:
  virtual ~MapPart() = default;
  virtual const Ranks& ranks() const = 0;
  // Of 2 unknowns per node of a space over this rank's faces. Collective.
  virtual std::shared_ptr<const Partition> unknowns(const BezierTriangleSpace& space) const = 0;
  // Nodes on the boundary of the whole surface, sorted.
  virtual std::vector<Index> boundary_nodes(const BezierTriangleSpace& space) const = 0;
  // This rank's numbers, if any, of the vertex that holds the translations of a map that nothing
  // else holds: the same vertex of the whole surface on every rank.
  virtual std::vector<Index> gauge_vertex() const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
