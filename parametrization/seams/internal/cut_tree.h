// The shortening of a cut, which is a tree (cut_branches.h), by the strain that each of its
// branches saves.
//
//   const std::vector<char> is_terminal(mesh->vertex_count(), 0);
//   const Vec edge_cost = Vec::Ones(mesh->half_edge_count());
//   FlatteningSystem system(*mesh);
//   CutTree tree(system, is_cut, is_terminal, edge_cost, 150, {});
//   tree.shorten(FlatteningStrain(system, is_cut).strain(), 0.02, {});
//   is_cut = tree.after(tree.steps_within(0.02)).is_cut;
//
// The strain saved by branches follows from the surface cut along the root alone. There the stress
// function chi (flattening_strain.h) and its slope are held at 0 at the ends of all branches, which
// approximates the effect of cuts. Releasing the conditions of a branch adds strain
// (held_conditions.h).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/internal/cut_branches.h"
#include "majorant/parametrization/seams/internal/flattening_system.h"
#include "majorant/parametrization/seams/internal/held_conditions.h"
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
  struct BranchState {
    std::vector<Index> rows;  // the conditions at its far end
    Index children = 0;       // not removed
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
  void constrain_ends(FlatteningSystem& system, const StopCheck& stop);
  std::vector<Index> removable_run(Index branch) const;
  std::vector<Index> rows_of(const std::vector<Index>& branches) const;
  void release(const std::vector<Index>& branches);
  std::vector<Removal> removals(double most_added) const;
  Vector3 far_end(std::size_t branch) const;
  std::vector<std::ptrdiff_t> partners(const std::vector<std::size_t>& ends) const;
  std::vector<Index> with_partner(std::vector<Index> part, const std::vector<Index>& other) const;

  const SurfaceMesh& mesh_;
  std::vector<char> is_cut_;  // 3 #F
  CutBranches tree_;
  std::vector<BranchState> states_;  // by branch
  HeldConditions conditions_;        // at the ends of branches
  std::vector<Step> steps_;
  std::optional<MirrorPlane> mirror_;
  double pair_distance_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
