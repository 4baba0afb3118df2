// Whole numbers for the arcs of a T-mesh, so that opposite sides of every patch have the same sum:
// how many edges of quads lie along each of them.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice);
//   const std::vector<double> wanted(t_mesh.arcs.size(), 2.4);   // edges on each arc
//   const std::vector<Index> least(wanted.size(), 1);
//   const std::vector<Index> n = Quantization(t_mesh, wanted, least).numbers(Effort::Least);
//
// They minimize sum (n - wanted)^2 / max(wanted, 1). Each arc lies between two patches, so a change
// by one goes on through a patch, to its opposite side or back on its own: a bi-directed flow
// [HWB23], which arcs of the border, of one patch, may start and end. Its relaxation to halves is a
// flow in a graph with every node twice, found along cheapest paths; halves are branched on.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// What is searched: the first numbers that are found, close to the least sum; or all others too
// that may have a lower one, in at most kMostDescents steps of the search, so that it is the least
// sum where these were enough.
enum class Effort { First, Least };
// Chosen: on the public meshes searches that end at all do so after some 120.
inline constexpr long kMostDescents = 200;

class Quantization {
 public:
  // wanted: >= 0, least: >= 0, by arc.
  Quantization(const TMesh& mesh, const std::vector<double>& wanted,
               const std::vector<Index>& least);
  ~Quantization();

  // Other numbers from now on; where they are close to those of before numbers() takes less time.
  void want(const std::vector<double>& wanted);
  // least: at least that of before.
  void raise(Index arc, Index least);

  // Edges by arc. Throws Error(Infeasible) where no numbers were found; Stopped.
  std::vector<Index> numbers(Effort effort, const StopCheck& stop = {});

 private:
  class Relaxed;
  std::unique_ptr<Relaxed> relaxed_;
};

// The number of quads.
long quad_count(const TMesh& mesh, const std::vector<Index>& edges);
// Of half-arcs.
Index sum_of(const std::vector<Index>& half_arcs, const std::vector<Index>& edges);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
