// Tutte's system: every vertex that is not held is the mean of its neighbours.
//
//     const MeanOfNeighbours means(faces, held);
//     const EdgeLaplacian laplacian = means.laplacian();
//     const Vec values = means.values(laplacian);            // of laplacian.pattern()
//     const Vec rhs = means.right_hand_side(x, 0);           // x: u, v by vertex, where it is held
//
// For a part of the faces the system is their contribution to the whole.
#pragma once

#include <vector>

#include "majorant/framework/types.h"
#include "majorant/parametrization/fields/edge_laplacian.h"

namespace majorant {

class MeanOfNeighbours {
 public:
  // held: flags of the vertices whose positions are given.
  MeanOfNeighbours(Cells faces, const std::vector<char>& held);

  const std::vector<Index>& vertices() const { return vertices_; }  // by row
  EdgeLaplacian laplacian() const { return {faces_, row_of_}; }
  Vec values(const EdgeLaplacian& laplacian) const;  // of the matrix
  // Returns the right-hand side of coordinate c: sums over the held neighbours.
  Vec right_hand_side(const Vec& x, int c) const;

 private:
  Cells faces_;
  std::vector<Index> row_of_;  // by vertex, -1 where it is held
  std::vector<Index> vertices_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
