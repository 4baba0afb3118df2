// The part of a map that belongs to one of several processes: some of its faces, with their nodes.
//
//     spec.part = part;                                     // null: the whole map
//     double area = whole_area(spec);                       // of all parts
//     std::vector<Index> nodes = boundary_of(spec, space);  // of the surface, not between parts
//
// A rank's space is over its own faces; spaces of any degree over the same faces have the same
// part. Options of a map (map_problem.h) refer to nodes of the rank's own space: pins on every rank
// that has the vertex, handles on the rank that owns it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/partition.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/measure.h"

namespace majorant {

class MapPart {
 public:
  virtual ~MapPart() = default;
  virtual const Ranks& ranks() const = 0;
  // Returns the partition of 2 unknowns per node of a space over this rank's faces. Collective.
  virtual std::shared_ptr<const Partition> unknowns(const BezierTriangleSpace& space) const = 0;
  // Returns the nodes on the boundary of the whole surface, sorted.
  virtual std::vector<Index> boundary_nodes(const BezierTriangleSpace& space) const = 0;
  // Returns this rank's numbers, if any, of the vertex that holds the translations of a free map:
  // the same vertex of the whole surface on every rank.
  virtual std::vector<Index> gauge_vertex() const = 0;
  // Returns why the whole map is not injective, proven to that depth of bisection; empty if it is.
  // rest_det: as for LocalInjectivity. Collective.
  virtual std::string obstacle(const BezierMap& map, const Vec& rest_det, int depth) const = 0;
  // Measures the whole map, but face_value and min_det are those of the faces here, and distortion
  // is empty. unproven: what is not proven of the map; empty: nothing. Collective.
  virtual MapMeasures measure(const BezierMap& map, const EnergySum& energy,
                              std::string& unproven) const = 0;
};

// Returns the ranks that share the map; a single process if it has no part.
const Ranks& ranks_of(const MapSpecification& spec);

// Returns the map with the control points of their owners, since ranks may round those of a shared
// edge differently. Collective.
BezierMap as_owners_have_it(const MapSpecification& spec, BezierMap map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
