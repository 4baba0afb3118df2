// The edges of the cells of a map, with a number on the surface, in space and in the plane.
//
//   const MapEdges edges(file, corner_mesh(file, ""));
//   for (const MapEdges::Side& side : edges.sides_of(edges.of(12).surface[0]))
//     std::cout << edges.of(side.cell).plane[side.edge];   // the same where the map is continuous
//
// Edges are the same on the surface if their ends are the same two nodes, the same in space if
// these are the same two vertices, and the same in the plane if they have the same control points.
// A node is a vertex of the map; several vertices of the mesh of its corners may be one node.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "majorant/maps/corner_mesh.h"
#include "majorant/maps/map_file.h"

namespace majorant {

class MapEdges {
 public:
  // An edge as seen from one of its cells.
  struct Side {
    Index cell;
    int edge;  // of the cell, 0: corners 0 to 1, 1, 2
  };

  // coarse: corner_mesh of `map`; its triangles are the cells.
  MapEdges(const MapFile& map, const CornerMesh& coarse);

  // The numbers of the three edges of a cell.
  struct Numbers {
    std::array<Index, 3> surface, space, plane;
  };
  const Numbers& of(Index cell) const { return numbers_[cell]; }
  Index surface_count() const { return static_cast<Index>(begin_.size()) - 1; }
  Index space_count() const { return space_count_; }
  Index plane_count() const { return static_cast<Index>(plane_sides_.size()); }

  // Returns the number of the node of a vertex of the coarse mesh.
  Index node(Index vertex) const { return node_[vertex]; }
  // Returns the sides of an edge on the surface, ordered by cell and edge.
  std::span<const Side> sides_of(Index surface_edge) const {
    return {sides_.data() + begin_[surface_edge], sides_.data() + begin_[surface_edge + 1]};
  }
  // Returns the number of sides of an edge in the plane.
  int plane_sides(Index plane_edge) const { return plane_sides_[plane_edge]; }

 private:
  std::vector<Index> node_;  // by vertex of the coarse mesh
  std::vector<Numbers> numbers_;
  // Edge e has the sides begin_[e] to begin_[e + 1] - 1.
  std::vector<Index> begin_;
  std::vector<Side> sides_;
  std::vector<int> plane_sides_;  // by plane edge
  Index space_count_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
