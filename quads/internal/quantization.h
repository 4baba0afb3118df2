// A quantization of a T-mesh at one edge length: an integer number n_a of edges for every arc a.
//
//     min sum_a (n_a - w_a)^2 / max(w_a, 1),   n_a >= least_a integer,
//     sum_{a in side s} n_a = sum_{a in side s + 2} n_a   for both pairs of sides of every patch,
//
// w_a is the target number, the arc's length divided by the edge length. Each arc lies between two
// patches, so that a change by one continues through a patch to the opposite side, or back on the
// same side: a bidirected flow [HWB23]. It may start and end at arcs of the border, which have one
// patch. The problem is
// solved by branch and bound (branch_and_bound.h) over the relaxation to halves (min_cost_flow.h).
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice);
//   const std::vector<double> targets(t_mesh.arcs.size(), 2.4);   // edges on each arc
//   const std::vector<Index> least(targets.size(), 1);
//   const std::vector<Index> n = Quantization(t_mesh, targets, least).numbers(SearchEffort::Least);
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/branch_and_bound.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

class Quantization {
 public:
  // targets: target numbers >= 0; least: lower bounds >= 0; by arc.
  Quantization(const TMesh& mesh, const std::vector<double>& targets,
               const std::vector<Index>& least);
  ~Quantization();

  // Sets other target numbers. If they are close to the previous ones, numbers() takes less time.
  void set_targets(const std::vector<double>& targets);
  // Raises the lower bound of an arc. least: at least the previous bound.
  void raise(Index arc, Index least);

  // Returns the edges by arc. Throws Error(Infeasible) if no integers were found; Stopped.
  std::vector<Index> numbers(SearchEffort effort, const StopCheck& stop = {});

 private:
  class Relaxed;
  std::unique_ptr<Relaxed> relaxed_;
};

// Returns the number of quads.
long quad_count(const TMesh& mesh, const std::vector<Index>& edges);
// Returns the sum over half-arcs.
Index sum_of(const std::vector<Index>& half_arcs, const std::vector<Index>& edges);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
