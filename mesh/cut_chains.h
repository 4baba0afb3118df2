// The parts of a cut that can be taken back one by one, and which of them a plane can do without.
//
//   std::vector<char> opened = planar_cut(*mesh, edge_lengths(*mesh));
//   const std::vector<char> no_terminal(mesh->vertex_count(), 0);
//   for (const CutChain& chain : cut_chains(*mesh, opened, no_terminal))
//     set_cut(*mesh, chain, 0, opened);   // closed again
//
// Gluing a surface along a chain joins two boundary loops, or splits one in two. The first makes a
// handle when the loops belong to one piece, the second never does.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// A maximal path of cut edges between nodes: terminals, vertices of the boundary, and vertices
// where one cut edge ends or three or more meet; or a closed path without any.
struct CutChain {
  std::vector<Index> half_edges;  // one after the other
};

// is_cut: 3 #F flags, both sides of an edge or none; is_terminal: #V. In the order of their
// smallest half-edges.
std::vector<CutChain> cut_chains(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                                 const std::vector<char>& is_terminal);

void set_cut(const SurfaceMesh& mesh, const CutChain& chain, char value, std::vector<char>& is_cut);

// For every half-edge on the boundary of the cut surface (cut, or without an opposite) the number
// of its loop there, -1 for the others. Loops are counted in the order of their smallest
// half-edges.
std::vector<Index> boundary_loops_of_cut(const SurfaceMesh& mesh, const std::vector<char>& is_cut);

// Flags for the edges of a connected surface, such that the pieces are disks with holes: what is
// cut, nothing for surfaces that are such already. A closed surface is cut along two edges at
// least, a handle along one loop. Takes cut_graph and glues its most expensive chains again.
std::vector<char> planar_cut(const SurfaceMesh& mesh, const Vec& edge_cost,
                             const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
