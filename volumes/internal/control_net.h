// The control points of a mesh, which its cells share: what is moved in place of the nodes.
//
//   const VolumeMesh cells = read_volume_mesh("ball.msh");
//   const ControlNet net(cells, sides_of(cells));
//   Vec x = net.control_points();                     // dim() numbers each
//   const std::vector<char> held(x.size(), 0);
//   const Points3 moved = net.nodes(x, 2 * x, held);  // the points of the mesh with that map
//
// Where a node stands on the lattice of its cell, there is a control point. Nodes that two cells
// have at one place of a shared side, under numbers of their own, are one control point; sides that
// are equal up to a translation share none.
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
  // The net of the cells of most dimensions, whose sides agree. Throws Error(Unsupported) for cells
  // of a surface in space and for serendipity cells.
  ControlNet(const VolumeMesh& mesh, const std::vector<CellSide>& sides);

  // The cells of a block as elements, numbered as they are there.
  struct Part {
    Index block;
    std::shared_ptr<const BernsteinSpace> space;
  };
  const std::vector<Part>& parts() const { return parts_; }
  int dim() const { return dim_; }
  Index count() const { return count_; }
  // The control point at the place of a node, a row of the mesh's points; -1: of none of the cells.
  Index point_of(Index node) const { return point_of_[node]; }

  // dim() numbers for each control point.
  Vec control_points() const;
  // The control points of which the node at the place of one is a sum, with their weights: those of
  // its edge, its side or its cell.
  std::vector<std::pair<Index, double>> weights_of_node(Index point) const;
  // The nodes of the map with these control points, #control points by dim(), and what control
  // points change by where nodes do.
  RowMatrix node_places(VecIn x) const;
  Vec control_change(const RowMatrix& node_change) const;
  // The points of the mesh where the map has the control points x, and had those of start. Bit by
  // bit as they were: the coordinates of nodes whose control points have the same, and of held
  // nodes. held: of every coordinate of the node at a control point.
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
