// The nearest points of a triangle surface, and the nearest of some points.
//
//   const SurfaceTree tree(mesh->positions(), mesh->faces());
//   const NearestPoint p = tree.nearest({0, 0, 1});
//   std::cout << p.face << " at " << p.distance << "\n";
//   const auto all = tree.locate(Points3::Random(1000, 3));   // on all threads
//
// Exact but for rounding: what is left out lies in boxes that are farther than the best point
// found. Of faces at one distance, to the last bit, the one with the smallest number is named, so
// that an answer depends on the point alone. Faces without an area count as the segments or points
// that they are.
//
// Not for points inside of solids: there is no sign.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/box_tree.h"

namespace majorant {

struct NearestPoint {
  Index face = -1;
  Barycentric barycentric = Barycentric::Zero();  // >= 0, sum 1 to rounding
  double distance = 0;
};

// The faces that are nearest to a point, or no more than some slack farther.
struct NearestFaces {
  double distance = 0;  // of the nearest one
  std::vector<Index> faces;
};

// The nearest point of the triangle of these corners; its face is -1.
NearestPoint nearest_of_triangle(const Vector3& a, const Vector3& b, const Vector3& c,
                                 const Vector3& p);

class SurfaceTree {
 public:
  // positions: #V by 3, faces: #F by 3, at least one. Copied. O(#F log #F). Throws InvalidArgument
  // for no faces and positions that are not finite.
  SurfaceTree(Points3 positions, Cells faces);

  // likely: a face that is near, or -1: an answer for a neighbouring point makes this one fast, and
  // changes nothing else.
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
  // Returns the largest of the distances of the rows of p and of `known`. Most of them are not
  // measured, but found to be no larger than others. Polls `stop`: Stopped.
  double largest_distance(const Points3& p, double known = 0, const StopCheck& stop = {}) const;
  // Returns the faces no farther from p than `distance`, in ascending order.
  std::vector<Index> faces_within(const Vector3& p, double distance) const;
  // Returns the nearest faces and those at most `slack` farther, in ascending order.
  NearestFaces nearest_faces(const Vector3& p, double slack, Index likely = -1) const;

 private:
  struct Candidate;
  Vector3 corner(Index face, Index k) const { return positions_.row(faces_(face, k)); }
  Candidate of_face(Index face, const Vector3& p) const;
  Candidate find(const Vector3& p, Index likely, double enough) const;

  Points3 positions_;
  Cells faces_;
  BoxTree<3> tree_;
};

class VertexTree {
 public:
  // points: #P by 3, finite. They outlive this.
  explicit VertexTree(const Points3& points);
  // Returns the number of the nearest point; of those as near the smallest. There is one.
  Index nearest(const Vector3& p) const;

 private:
  const Points3& points_;
  BoxTree<3> tree_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
