// The control points of a mesh, which its cells share: what is moved in place of the nodes.
//
//   const VolumeMesh cells = read_volume_mesh("ball.msh");
//   const ControlNet net(cells, sides_of(cells));
//   Vec x = net.control_points();                     // dim() numbers each
//   const std::vector<char> held(x.size(), 0);
//   const Points3 moved = net.nodes(x, 2 * x, held);  // the points of the mesh with that map
//
// Where a node stands on the lattice of its cell, there is a control point. Nodes that two cells
// have at one place of a shared side, under numbers of their own, are one control point.
#pragma once

#include <memory>
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
  // The points of the mesh where the map has the control points x, and had those of start. Bit by
  // bit as they were: nodes of a cell all of whose control points are, and the coordinates of held
  // ones. held: of every coordinate of a control point.
  Points3 nodes(VecIn start, VecIn x, const std::vector<char>& held) const;

 private:
  const VolumeMesh& mesh_;
  int dim_;
  Index count_ = 0;
  std::vector<Index> point_of_;
  std::vector<Part> parts_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
