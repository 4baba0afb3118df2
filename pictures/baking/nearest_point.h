// The nearest points of a triangle surface, by a tree of the boxes of its faces.
//
//   const SurfaceTree tree(mesh->positions(), mesh->faces());
//   const NearestPoint p = tree.nearest({0, 0, 1});
//   std::cout << p.face << " at " << p.distance << "\n";
//   const auto all = tree.locate(Points3::Random(1000, 3));   // on all threads
//
// Exact but for rounding: what is left out lies in boxes that are farther than the best point
// found. Of faces at one distance any may be named: faces_at(). Faces without an area count as the
// segments or points that they are.
//
// Not for points inside of solids: there is no sign.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct NearestPoint {
  Index face = -1;
  Barycentric barycentric = Barycentric::Zero();  // >= 0, sum 1 to rounding
  double distance = 0;
};

// The nearest point of the triangle of these corners; its face is -1.
NearestPoint nearest_of_triangle(const Vector3& a, const Vector3& b, const Vector3& c,
                                 const Vector3& p);

// The faces of the surface that its nearest point lies on, at least one: both of an edge, all
// around a vertex, where coordinates up to 1e-9 are 0. In no order, some twice.
std::vector<Index> faces_at(const SurfaceMesh& mesh, const NearestPoint& point);

class SurfaceTree {
 public:
  // positions: #V by 3, faces: #F by 3, at least one. Copied. O(#F log #F). Throws InvalidArgument
  // for no faces and positions that are not finite.
  SurfaceTree(Points3 positions, Cells faces);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;

  // likely: a face that is near, or -1: an answer for a neighbouring point makes this one fast.
  NearestPoint nearest(const Vector3& p, Index likely = -1) const;
  // The nearest point, no farther than `farthest`, of the faces whose normals make less than 90
  // degrees with this direction; its face is -1 where there is none.
  NearestPoint nearest_facing(const Vector3& p, const Vector3& direction, double farthest,
                              Index likely = -1) const;
  // The point of such faces on the line through p along the direction, of length 1, that is nearest
  // to p, on either side of it and no farther than `farthest`; its face is -1 where there is none.
  NearestPoint along(const Vector3& p, const Vector3& direction, double farthest) const;
  // Normal of a face, as long as twice its area.
  Vector3 doubled_normal(Index face) const;
  // Of every row of p, #P by 3. Polls `stop`: Stopped.
  std::vector<NearestPoint> locate(const Points3& p, const StopCheck& stop = {}) const;
  // Returns the faces no farther from p than `distance`, in ascending order.
  std::vector<Index> faces_within(const Vector3& p, double distance) const;

 private:
  struct Boxes;
  template <class Offer>
  void visit_near(const Vector3& p, const double& farthest, const Offer& offer) const;
  NearestPoint of_face(Index face, const Vector3& p) const;

  Points3 positions_;
  Cells faces_;
  std::unique_ptr<const Boxes> boxes_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
