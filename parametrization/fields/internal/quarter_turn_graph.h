// The matching of a cross field as a flow of quarter turns along edges.
//
// A node is a sector of followed edges (aligned_edges.h), or a vertex that has none. One quarter
// turn passes across a half-edge from the node at its start to the node at its end (move_quarter of
// field_connection.h). The angles of the field stay; relax them afterwards.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "majorant/parametrization/fields/internal/aligned_edges.h"
#include "majorant/parametrization/fields/internal/field_connection.h"

namespace majorant {

class QuarterTurnGraph {
 public:
  // is_fixed: #F, or empty. Edges between fixed faces keep their matching, but for those that end
  // in a sector. sectors: those of the field, or without entries. least_turns: of inner vertices,
  // where no edges are followed. The field is changed by move(); mesh, geometry, is_fixed and field
  // outlive the graph.
  QuarterTurnGraph(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                   const std::vector<char>& is_fixed, AlignedSectors sectors, int least_turns,
                   FieldConnection& field);

  const std::vector<Index>& nodes() const { return nodes_; }  // by vertex
  // Half-edges of a node that may be matched anew.
  const std::vector<Index>& leaving(Index node) const { return leaving_[node]; }
  // A half-edge may be matched anew.
  bool is_movable(Index half_edge) const;
  Index start(Index half_edge) const;
  Index end(Index half_edge) const { return start(mesh_.opposite(half_edge)); }
  Index vertex(Index node) const { return is_sector(node) ? sectors_.vertex[sector(node)] : node; }

  // The boundary takes any number of turns.
  bool is_unbounded(Index node) const { return !is_sector(node) && geometry_.is_boundary[node]; }
  int turns(Index node) const {
    return is_sector(node) ? sectors_.turns[sector(node)] : field_.quarter_turns[node];
  }
  // Turns of a vertex that is no cone; of a sector, those of the surface's angles.
  int regular(Index node) const { return is_sector(node) ? sectors_.target[sector(node)] : 4; }
  int least_turns(Index node) const;
  int most_turns(Index node) const;
  // Quarter turns that a node has to give away (> 0) or to receive (< 0).
  int excess(Index node) const;
  // Change of sum |turns - regular| by a quarter turn less at one node and one more at another.
  int change(Index from, Index to) const;

  // Passes one quarter turn across a half-edge, from its start to its end.
  void move(Index half_edge);
  // Moves a quarter turn from a node to the nearest one that is a goal (step 1), or from there to
  // it
  // (-1), over as few edges as possible. Returns false where there is none within most_edges.
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
