// The matching of a cross field as a flow of quarter turns along edges.
//
// A node is a sector of followed edges (aligned_edges.h), or a vertex that has none. One quarter
// turn passes across a half-edge from the node at its start to the node at its end (move_quarter of
// field_connection.h). The angles of the field stay, so it must be relaxed afterwards.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "majorant/parametrization/fields/internal/aligned_edges.h"
#include "majorant/parametrization/fields/internal/field_connection.h"

namespace majorant {

class QuarterTurnGraph {
 public:
  // is_fixed: #F, or empty. Edges between fixed faces keep their matching, except those that end in
  // a sector. The sectors are those of the field, or without entries. Inner vertices without
  // followed edges keep at least least_turns. move() changes the field. The arguments mesh,
  // geometry, is_fixed and field outlive the graph.
  QuarterTurnGraph(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                   const std::vector<char>& is_fixed, AlignedSectors sectors, int least_turns,
                   FieldConnection& field);

  const std::vector<Index>& nodes() const { return nodes_; }  // by vertex
  // Returns the half-edges of a node whose matching may change.
  const std::vector<Index>& leaving(Index node) const { return leaving_[node]; }
  // Returns whether the matching of a half-edge may change.
  bool is_movable(Index half_edge) const;
  Index start(Index half_edge) const;
  Index end(Index half_edge) const { return start(mesh_.opposite(half_edge)); }
  Index vertex(Index node) const { return is_sector(node) ? sectors_.vertex[sector(node)] : node; }

  // Returns whether the node takes any number of turns, as the boundary does.
  bool is_unbounded(Index node) const { return !is_sector(node) && geometry_.is_boundary[node]; }
  int turns(Index node) const {
    return is_sector(node) ? sectors_.turns[sector(node)] : field_.quarter_turns[node];
  }
  // Returns the turns of a vertex that is no cone; for a sector, those of the surface's angles.
  int regular(Index node) const { return is_sector(node) ? sectors_.target[sector(node)] : 4; }
  int least_turns(Index node) const;
  int most_turns(Index node) const;
  // Returns the quarter turns that a node has to give away (> 0) or to receive (< 0).
  int excess(Index node) const;
  // Returns the change of sum |turns - regular| if a quarter turn passes from one node to another.
  int change(Index from, Index to) const;

  // Passes one quarter turn across a half-edge, from its start to its end.
  void move(Index half_edge);
  // Passes a quarter turn along the fewest edges, from a node to the nearest one that is a goal
  // (step 1), or from there to the node (-1). Returns false if there is no goal within most_edges.
  bool send(Index node, int step, const std::function<bool(Index)>& is_goal,
            int most_edges = std::numeric_limits<int>::max());

 private:
  // Sectors are numbered after the vertices.
  bool is_sector(Index node) const { return node >= mesh_.vertex_count(); }
  Index sector(Index node) const { return node - mesh_.vertex_count(); }

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  const std::vector<char>& is_fixed_;
  AlignedSectors sectors_;
  const int least_turns_;
  FieldConnection& field_;
  std::vector<Index> nodes_;
  std::vector<std::vector<Index>> leaving_;  // by node
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
