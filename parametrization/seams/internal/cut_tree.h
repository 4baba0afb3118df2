// A cut as a tree, and the strain that each of its branches saves.
//
//   const std::vector<char> is_terminal(mesh->vertex_count(), 0);
//   const Vec edge_cost = Vec::Ones(mesh->half_edge_count());
//   FlatteningSystem system(*mesh);
//   CutTree tree(system, is_cut, is_terminal, edge_cost, 150, {});
//   tree.shorten(FlatteningStrain(system, is_cut).strain(), 0.02, {});
//   is_cut = tree.after(tree.steps_within(0.02)).is_cut;
//
// Each boundary loop is one node. The root consists of the parts of the cut that turn a surface
// with handles into a disk. Without handles it is the longest boundary loop, or two edges in the
// middle of the cut of a closed surface. The rest of the cut hangs from the root, divided into
// branches of about equal length. If there are more than 500, the inner branches belong to the root
// and stay.
//
// The strain saved by branches follows from the surface cut along the root alone. There the stress
// function chi (flattening_strain.h) and its slope are held at 0 at the ends of all branches, which
// approximates the effect of cuts. Let C be the rows of these conditions, G = C A^-1 C^T, P = G^-1,
// x = P C chi. Releasing some of them (rows R) adds
//     x_R^T P_RR^-1 x_R
// to the strain, and P, x of the rest follow from P, x. This costs half a solve for each row, and
// none for a query.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/internal/flattening_system.h"
#include "majorant/parametrization/seams/internal/mirror_plane.h"

namespace majorant {

class CutTree {
 public:
  // is_cut: 3 #F flags that leave one disk of the system's surface. is_terminal: #V, branches end
  // there. edge_cost: 3 #F. branches: their approximate number. Stopped.
  CutTree(FlatteningSystem& system, const std::vector<char>& is_cut,
          const std::vector<char>& is_terminal, const Vec& edge_cost, Index branches,
          const StopCheck& stop);

  // Makes later calls shorten ends together with their images, as long as these lie within
  // `distance` of other ends, so that a symmetric cut stays symmetric.
  void shorten_in_pairs(const MirrorPlane& plane, double distance);
  // Removes branches from the ends, step by step, those first that save most cost for the strain
  // they add, as long as the estimated strain stays below `limit`. strain: that of the full cut.
  void shorten(double strain, double limit, const StopCheck& stop);
  // Returns the number of the first steps after which the estimated strain is no larger than
  // `strain`.
  std::size_t steps_within(double strain) const;

  struct State {
    std::vector<char> is_cut;  // 3 #F
    std::vector<Index> ends;   // vertices where the cut ends inside the surface
  };
  State after(std::size_t steps) const;
  double strain_after(std::size_t steps) const { return steps_[steps - 1].strain; }

 private:
  struct Branch {
    Index parent = -1;              // the branch that it hangs from, -1: the root
    std::vector<Index> half_edges;  // away from the root
    double cost = 0;
    Index first_row = 0, rows = 0;  // the conditions at its far end: indices into place_
    Index children = 0;             // not removed
    bool is_removed = false;
  };
  struct Step {
    std::vector<Index> branches;
    double strain;  // estimated, after the step
  };
  struct Removal {
    double price;  // added strain per cost
    std::vector<Index> branches;
  };
  using Edges = std::vector<std::vector<Index>>;  // per node, half-edges that leave it

  void contract_loops();
  Edges cut_edges() const;  // of the cut without its root
  void find_root();
  void put_into_root(const std::vector<Index>& half_edges);
  std::vector<Index> middle_edges() const;
  std::vector<Index> cycles() const;
  void grow(const std::vector<char>& is_terminal, double length);
  std::vector<Index> inner_half_edges() const;
  void constrain_ends(FlatteningSystem& system, const StopCheck& stop);
  std::vector<Index> removable_run(Index branch) const;
  std::vector<Index> places_of(const std::vector<Index>& branches) const;
  double added_strain(const std::vector<Index>& places) const;
  void release(const std::vector<Index>& branches);
  void drop(Index row);
  std::vector<Removal> removals(double most_added) const;
  Vector3 far_end(std::size_t branch) const;
  std::vector<std::ptrdiff_t> partners(const std::vector<std::size_t>& ends) const;
  std::vector<Index> with_partner(std::vector<Index> part, const std::vector<Index>& other) const;

  const SurfaceMesh& mesh_;
  const Vec& cost_;
  std::vector<char> is_cut_, is_root_cut_;  // 3 #F
  std::vector<Index> node_;                 // #V: its number as a node
  Index root_;                              // number of the root as a node
  Index outer_ = -1;                        // a half-edge that leaves a vertex of the root
  std::vector<Branch> branches_;
  std::vector<Step> steps_;
  std::optional<MirrorPlane> mirror_;
  double pair_distance_ = 0;
  std::vector<Index> place_;   // of every condition in P and x
  Index held_rows_ = 0;        // rows of P and x that are not released: the first ones
  Eigen::MatrixXd precision_;  // P
  Vec force_;                  // x
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
