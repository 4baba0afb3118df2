// The control points of a mesh, which its cells share. They are moved instead of the nodes.
//
//   const VolumeMesh cells = read_volume_mesh("ball.msh");
//   const ControlNet net(cells, sides_of(cells));
//   Vec x = net.control_points();                     // dim() numbers each
//   const std::vector<char> held(x.size(), 0);
//   const Points3 moved = net.nodes(x, 2 * x, held);  // the points of the mesh with that map
//
// There is a control point for each node on the lattice of its cell. Nodes of two cells at one
// place of a shared side are one control point, even if they have different numbers; sides that are
// equal up to a translation share none.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/volumes/internal/mesh_sides.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

class ControlNet {
 public:
  // Makes the net of the cells of the largest dimension, whose sides must agree. Throws
  // Error(Unsupported) for cells of a surface in space and for serendipity cells.
  ControlNet(const VolumeMesh& mesh, const std::vector<CellSide>& sides);

  // The cells of a block as elements, with the same numbers.
  struct Part {
    Index block;
    std::shared_ptr<const BernsteinSpace> space;
  };
  const std::vector<Part>& parts() const { return parts_; }
  int dim() const { return dim_; }
  Index count() const { return count_; }
  // Returns the control point for a node, a row of the mesh's points; -1 if no cell has the node.
  Index point_of(Index node) const { return point_of_[node]; }

  // Returns dim() numbers for each control point.
  Vec control_points() const;
  // Returns the control points whose weighted sum is the node of a control point, with their
  // weights: those of its edge, its side or its cell.
  std::vector<std::pair<Index, double>> weights_of_node(Index point) const;
  // Returns the nodes of the map with these control points, #control points by dim(). The map is
  // linear, so it also returns the displacements of nodes for those of control points.
  RowMatrix node_places(VecIn x) const;
  Vec control_change(const RowMatrix& node_change) const;
  // Returns the points of the mesh when the map changes from the control points `start` to x. Held
  // nodes, and coordinates of nodes whose control points do not change, stay the same, bit for bit.
  // held: for every coordinate of the node of a control point.
  Points3 nodes(VecIn start, VecIn x, const std::vector<char>& held) const;

 private:
  struct Place {
    std::size_t part;
    Index cell, node;
  };
  const VolumeMesh& mesh_;
  int dim_;
  Index count_ = 0;
  std::vector<Index> point_of_;
  std::vector<Part> parts_;
  std::vector<Place> place_of_;    // of each control point, in one of its cells
  std::vector<RowMatrix> values_;  // of each part: nodes by control points
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
