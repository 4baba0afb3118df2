// The matrix of sum_h w_h (x_a - x_b)^2 / 2 over the half-edges h = (a, b) of triangles. Its
// pattern is computed once; the weights may change.
//
//   const std::vector<Index> row_of{-1, 0, 1, 2};                  // vertex 0 is held
//   EdgeLaplacian laplacian(mesh->faces(), row_of);
//   auto solver = make_direct_solver();
//   solver->analyze(laplacian.pattern());
//   solver->factorize(laplacian.values(Vec::Ones(3 * mesh->faces().rows())), 0.0);
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/types.h"

namespace majorant {

class EdgeLaplacian {
 public:
  // faces: #F by 3. row_of: the unknown of every vertex, numbered 0, 1, ... without gaps, or -1
  // where x = 0 is prescribed.
  EdgeLaplacian(const Cells& faces, const std::vector<Index>& row_of);

  const SparsePattern& pattern() const { return pattern_; }
  // Returns the values, parallel to pattern().rows. weights: 3 #F, of half-edge 3 f + k from corner
  // k to corner k + 1.
  Vec values(const Vec& weights) const;

 private:
  struct Slots {
    Index from, to, between;  // of the two diagonal entries and the off-diagonal one, or -1
  };
  SparsePattern pattern_;
  std::vector<Slots> slots_;  // 3 #F
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
