// A quantization of a T-mesh with about as many quads as requested: integers n_a >= 0, the numbers
// of edges of arcs a, such that the quads are a valid mesh.
//
// Quantization (quantization.h) minimizes, for an edge length l that is searched for,
//     sum_a (n_a - w_a)^2 / max(w_a, 1),   w_a = length(a) / l,
// such that opposite sides of every patch agree, and |Q / count - 1| <= kCountClose with the number
// of quads Q, the sum over patches of p q. Zero-length arcs (n_a = 0) may not join two cones,
// corners or stretches of borders and features, nor give a quad one vertex twice: the lower bounds
// of such arcs are raised, one after the other. Quantization by flows: [HWB23].
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice, stop);
//   const std::vector<Index> edges =
//       QuantizationSearch(lattice, t_mesh, ArcLengths::NonNegative, stop).for_count(4000);
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/quantization.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// NonNegative: arcs without edges are allowed; Positive: every arc has at least one edge.
enum class ArcLengths { NonNegative, Positive };

class QuantizationSearch {
 public:
  // The arguments must outlive this.
  QuantizationSearch(const SeamlessLattice& lattice, const TMesh& mesh, ArcLengths lengths,
                     const StopCheck& stop);

  // These throw Error(Infeasible) if no integers were found; Stopped.
  std::vector<Index> at(double edge_length);  // in steps of the lattice
  // Returns numbers with as few quads as possible.
  std::vector<Index> fewest();
  // Returns the numbers at the edge length that gives about as many quads as requested.
  std::vector<Index> for_count(double requested);

 private:
  QuantizationSearch(const SeamlessLattice& lattice, const TMesh& mesh, std::vector<Index> least,
                     const StopCheck& stop);

  struct Found {
    double length = 0;  // edge length of the target numbers
    std::vector<Index> edges;
    double ratio = 0;  // number of quads over the requested number
    double off() const { return std::abs(std::log(ratio)); }
  };
  // Results with more quads than requested, and with fewer, at longer edges.
  struct Bracket {
    std::optional<Found> more, fewer;
  };

  template <class Numbers>
  std::vector<Index> without_bad_quads(const Numbers& numbers);
  std::vector<Index> joined_at(double edge_length);
  std::optional<std::vector<Index>> refined(const std::vector<Index>& edges, double edge_length);
  Found closest_to(double requested);
  Bracket closest_from(double length, double requested, Found& best);
  Found between(const Found& more, const Found& fewer, double requested) const;
  void raise(Index arc, Index least);
  void set_targets(double edge_length);
  Index longest_without_edges(const std::vector<Index>& edges) const;

  const SeamlessLattice& lattice_;
  const TMesh& mesh_;
  const StopCheck& stop_;
  std::vector<Index> least_;   // by arc: lower bounds so far
  Quantization quantization_;  // with these lower bounds
  long raised_ = 0;            // number of raised bounds
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
