// Continuous numbering of the nodes of cells that share vertices, edges and faces.
//
// Two cells share a node if the weights of its straight position agree on the vertices of the
// cells, whatever the rotation of either cell.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "majorant/elements/bernstein_space.h"

namespace majorant {

// The nodes of one cell.
class NodeLattice {
 public:
  // nodes: Bernstein functions of the cell, the corners first.
  explicit NodeLattice(const BernsteinBasis& nodes);

  int node_count() const { return static_cast<int>(weights_.rows()); }
  int corner_count() const { return static_cast<int>(weights_.cols()); }
  // Node l of a straight cell is at sum_c weight(l, c) corner_c / total_weight().
  int weight(int node, int corner) const { return weights_(node, corner); }
  int total_weight() const { return weights_.row(0).sum(); }

  // A part of the cell's boundary that other cells may share.
  struct Part {
    std::vector<int> corners;  // at most 4
    std::vector<int> nodes;    // inside the part: with weights on exactly these corners
    std::vector<int> closure;  // for facets, all their nodes; else empty
  };
  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<int>& interior() const { return interior_; }  // nodes of no part

 private:
  Part& part_of(const std::vector<int>& corners);
  Eigen::MatrixXi weights_;
  std::vector<Part> parts_;
  std::vector<int> interior_;
};

// Returns the sum. Throws Error(Unsupported) if three coordinates per node would exceed an Index,
// so the result may be multiplied by 2 or 3.
Index with_more_nodes(Index nodes, std::size_t more);

// Numbers the nodes. cells: #E by corners. name: begins the messages. Throws InvalidArgument for a
// wrong number of columns, vertex numbers outside 0..vertex_count-1, a vertex twice in a cell and
// facets of more than two cells.
NodeNumbering number_nodes(const NodeLattice& lattice, const Cells& cells, Index vertex_count,
                           std::string_view name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
