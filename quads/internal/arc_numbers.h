// The numbers of edges on the arcs of a T-mesh that make a mesh of quads: no two cones or corners
// become one vertex, borders and features stay, no quad has a vertex twice, and there are about as
// many quads as asked.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice, stop);
//   const std::vector<Index> edges =
//       ArcNumbers(lattice, t_mesh, ArcNumbers::Arcs::Joined, stop).for_count(4000);
//
// Arcs get the numbers that Quantization (quantization.h) finds for one edge length, which is
// changed until the count is as asked.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/quantization.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

class ArcNumbers {
 public:
  // Joined: an arc may have no edges; Separate: all have one at least.
  enum class Arcs { Joined, Separate };

  // All of them outlive this.
  ArcNumbers(const SeamlessLattice& lattice, const TMesh& mesh, Arcs arcs, const StopCheck& stop);

  // Each throws Error(Infeasible) where no numbers were found; Stopped.
  std::vector<Index> at(double edge_length);  // in steps of the lattice
  // As few as possible.
  std::vector<Index> fewest();
  // At the edge length at which there are about as many quads as asked.
  std::vector<Index> for_count(double asked);

 private:
  ArcNumbers(const SeamlessLattice& lattice, const TMesh& mesh, std::vector<Index> least,
             const StopCheck& stop);

  struct Found {
    double length = 0;  // of the edges that were wanted
    std::vector<Index> edges;
    double ratio = 0;  // of the number of quads to that asked
    double off() const { return std::abs(std::log(ratio)); }
  };
  // With more quads than asked, and with fewer, of longer edges.
  struct Bracket {
    std::optional<Found> more, fewer;
  };

  template <class Numbers>
  std::vector<Index> without_bad_quads(const Numbers& numbers);
  std::vector<Index> joined_at(double edge_length);
  std::optional<std::vector<Index>> refined(const std::vector<Index>& edges, double edge_length);
  Found closest_to(double asked);
  Bracket closest_from(double length, double asked, Found& best);
  Found between(const Found& more, const Found& fewer, double asked) const;
  void raise(Index arc, Index least);
  void want(double edge_length);
  Index longest_without_edges(const std::vector<Index>& edges) const;

  const SeamlessLattice& lattice_;
  const TMesh& mesh_;
  const StopCheck& stop_;
  std::vector<Index> least_;   // by arc: the least numbers that were needed so far
  Quantization quantization_;  // with these
  long raised_ = 0;            // how often they were raised
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
