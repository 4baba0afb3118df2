// A cut as a tree, and what each of its branches is worth.
//
//   const std::vector<char> is_terminal(mesh->vertex_count(), 0);
//   const Vec edge_cost = Vec::Ones(mesh->half_edge_count());
//   FlatteningSystem system(*mesh);
//   CutTree tree(system, is_cut, is_terminal, edge_cost, 150, {});
//   tree.shorten(FlatteningStrain(system, is_cut).strain(), 0.02, {});
//   is_cut = tree.after(tree.steps_within(0.02)).is_cut;
//
// Boundary loops count as one node each. The parts of the cut that make a disk of a surface with
// handles are the root; otherwise it is the longest boundary loop, or two edges in the middle of
// the cut of a closed surface. The rest hangs from it, divided into branches of about equal length.
//
// The worth of branches: on the surface cut along the root alone, the stress function chi
// (flattening_strain.h) is held with its slope at the ends of all branches, which is nearly what
// cuts do. With C the rows that say so, G = C A^-1 C^T, P = G^-1, x = P C chi: letting go of some
// of them (rows R) adds
//     x_R^T P_RR^-1 x_R
// to the strain, and P, x for the rest follow from P, x. Half a solve for each row, none for a
// question.
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
  // is_cut: 3 #F flags that leave one disk of the system's surface; is_terminal: #V, branches end
  // there; edge_cost: 3 #F. `branches`: about how many there may be. Stopped.
  CutTree(FlatteningSystem& system, const std::vector<char>& is_cut,
          const std::vector<char>& is_terminal, const Vec& edge_cost, Index branches,
          const StopCheck& stop);

  // From now on ends are shortened together with their images, as long as these lie within
  // `distance` of other ends: what is a mirror image stays one.
  void shorten_in_pairs(const MirrorPlane& plane, double distance);
  // Takes back branches from the ends, step by step, those first that save most cost for the strain
  // they add, as long as the strain, which is `strain` before, stays below `limit` as estimated.
  void shorten(double strain, double limit, const StopCheck& stop);
  // Number of the first steps after which the strain is no larger, as estimated.
  std::size_t steps_within(double strain) const;

  struct State {
    std::vector<char> is_cut;  // 3 #F
    std::vector<Index> ends;   // vertices where the cut ends inside the surface
  };
  State after(std::size_t steps) const;
  double strain_after(std::size_t steps) const { return steps_[steps - 1].strain; }

 private:
  struct Branch {
    Index parent = -1;              // branch that it hangs from, -1: the root
    std::vector<Index> half_edges;  // away from the root
    double cost = 0;
    Index first_row = 0, rows = 0;  // what its far end holds: numbers of place_
    Index children = 0;             // not removed
    bool is_removed = false;
  };
  struct Step {
    std::vector<Index> branches;
    double strain;  // then, estimated
  };
  struct Removal {
    double price;  // added strain per cost
    std::vector<Index> branches;
  };
  using Edges = std::vector<std::vector<Index>>;  // per node, half-edges that leave it

  void contract_loops();
  Edges cut_edges() const;  // of the cut, but for the root's
  void find_root();
  void put_into_root(const std::vector<Index>& half_edges);
  std::vector<Index> middle_edges() const;
  std::vector<Index> cycles() const;
  void grow(const std::vector<char>& is_terminal, double length);
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
  std::vector<Index> place_;   // of every row in P and x
  Index held_rows_ = 0;        // rows in P and x that are not released: the first ones
  Eigen::MatrixXd precision_;  // P
  Vec force_;                  // x
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
