// The curved sides of a mesh as it was read, and the nodes that may slide along them. All sides of
// such a node are curved, of one region, and join without a corner. A node slides on a patch, the
// polynomial sides around it.
//
//   const VolumeMesh cells = read_volume_mesh("ball.msh");
//   const std::vector<CellSide> sides = sides_of(cells);  // those of the boundary alone
//   const ControlNet net(cells, sides);
//   const std::vector<char> is_curved(sides.size(), 1);
//   const std::vector<int> regions(sides.size(), 0);
//   const CurvedBoundary curved(cells, net, net.control_points(), sides, is_curved, regions);
//   if (curved.slides(0)) curved.nearest(0, Vector3::Zero()).place.norm();
#pragma once

#include <vector>

#include "majorant/volumes/internal/control_net.h"
#include "majorant/volumes/internal/mesh_sides.h"

namespace majorant {

class CurvedBoundary {
 public:
  struct Foot {
    Vector3 place, normal;  // a point of the patch, and its unit normal
  };

  // x: the control points of the net. boundary: sides that nothing moves across, each once.
  // is_curved: by side, true if it is in no plane. regions: by side; sides of different regions are
  // not joined.
  CurvedBoundary(const VolumeMesh& mesh, const ControlNet& net, VecIn x,
                 const std::vector<CellSide>& boundary, const std::vector<char>& is_curved,
                 const std::vector<int>& regions);

  // Returns true if the node of a control point may slide.
  bool slides(Index point) const { return !patch_of_[to_size(point)].empty(); }
  bool is_empty() const { return is_empty_; }
  // Returns the point nearest to `at` on the patch around a sliding node.
  Foot nearest(Index point, const Vector3& at) const;

 private:
  // A side: control points with the exponents of their barycentric coordinates (two or three
  // corners) or of two directions (four corners).
  struct Patch {
    int corners = 0, degree = 1;
    std::vector<std::array<int, 3>> exponents;
    std::vector<Vector3> control;
    std::vector<Index> points;  // of the net

    // Computes the point at (u, v), on edges at u, and its derivatives.
    void evaluate(double u, double v, Vector3& at, Vector3& by_u, Vector3& by_v) const;
    Vector3 normal(double u, double v) const;
    // Returns the parameters of a control point's node.
    std::pair<double, double> parameters(std::size_t k) const;
    void clamp(double& u, double& v) const;
  };

  Patch patch_of(const VolumeMesh& mesh, const ControlNet& net, VecIn x,
                 const CellSide& side) const;

  std::vector<Patch> patches_;
  std::vector<std::vector<Index>> patch_of_;  // by control point; empty: does not slide
  bool is_empty_ = true;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
