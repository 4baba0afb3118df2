// A cut as a tree of branches.
//
//   const std::vector<char> is_terminal(mesh->vertex_count(), 0);
//   const Vec edge_cost = Vec::Ones(mesh->half_edge_count());
//   const CutBranches tree = cut_branches(*mesh, is_cut, is_terminal, edge_cost, 150);
//   for (const CutBranch& branch : tree.all)
//     if (branch.parent < 0) std::cout << branch.half_edges.front();   // leaves the root
//
// Each boundary loop is one node. The root consists of the parts of the cut that turn a surface
// with handles into a disk. Without handles it is the longest boundary loop, or two edges in the
// middle of the cut of a closed surface. The rest of the cut hangs from the root, divided into
// branches of about equal length. If there are more than 500, the inner branches belong to the root
// and stay.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct CutBranch {
  Index parent = -1;              // the branch that it hangs from, -1: the root
  std::vector<Index> half_edges;  // away from the root
  double cost = 0;
};

struct CutBranches {
  std::vector<CutBranch> all;     // parents before their children
  std::vector<char> is_root_cut;  // 3 #F: the cuts of the root
  std::vector<char> is_inside;    // #V: neither on a boundary loop nor in the root
  Index outer = -1;               // a half-edge that leaves a vertex of the root
};

// is_cut: 3 #F flags that leave one disk of the surface. is_terminal: #V, branches end there.
// edge_cost: 3 #F. count: the approximate number of branches.
CutBranches cut_branches(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                         const std::vector<char>& is_terminal, const Vec& edge_cost, Index count);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
