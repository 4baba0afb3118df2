// The nearest points of a triangle surface, and the nearest of a set of points.
//
//   const SurfaceTree tree(mesh->positions(), mesh->faces());
//   const NearestPoint p = tree.nearest({0, 0, 1});
//   std::cout << p.face << " at " << p.distance << "\n";
//   const auto all = tree.locate(Points3::Random(1000, 3));   // on all threads
//
// Results are exact but for rounding: only boxes farther than the best point are skipped. Of faces
// at equal distance, to the last bit, the one with the smallest number is returned, so that results
// depend on the point alone. Faces without an area count as segments or points.
//
// Not for points inside of solids: distances have no sign.
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

// The faces nearest to a point, and those at most a given slack farther.
struct NearestFaces {
  double distance = 0;  // of the nearest one
  std::vector<Index> faces;
};

// Returns the nearest point of the triangle with these corners; its face is -1.
NearestPoint nearest_of_triangle(const Vector3& a, const Vector3& b, const Vector3& c,
                                 const Vector3& p);

class SurfaceTree {
 public:
  // positions: #V by 3, faces: #F by 3, at least one; both are copied. Takes O(#F log #F). Throws
  // InvalidArgument if there are no faces, or positions are not finite.
  SurfaceTree(Points3 positions, Cells faces);

  // likely: a face that is probably near, such as the result for a neighbouring point, or -1. It
  // makes the search faster, and does not change the result.
  NearestPoint nearest(const Vector3& p, Index likely = -1) const;
  // Returns the nearest point, at most `farthest` away, on faces whose normals make less than 90
  // degrees with this direction; its face is -1 if there is none.
  NearestPoint nearest_facing(const Vector3& p, const Vector3& direction, double farthest,
                              Index likely = -1) const;
  // Returns the nearest point, at most `farthest` away, of such faces on the line through p along
  // the direction, of length 1, on either side of p; its face is -1 if there is none.
  NearestPoint along(const Vector3& p, const Vector3& direction, double farthest) const;
  // Returns the normal of a face, whose length is twice the area.
  Vector3 doubled_normal(Index face) const;
  // Returns the nearest points of all rows of p, #P by 3. Polls `stop` and throws Stopped.
  std::vector<NearestPoint> locate(const Points3& p, const StopCheck& stop = {}) const;
  // Returns the largest of the distances of the rows of p and of `known`. Most distances are not
  // computed, but only shown to be smaller than others. Polls `stop` and throws Stopped.
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
  // points: #P by 3, finite, at least one; they must outlive this object.
  explicit VertexTree(const Points3& points);
  // Returns the number of the nearest point; of points at equal distance the smallest number.
  Index nearest(const Vector3& p) const;

 private:
  const Points3& points_;
  BoxTree<3> tree_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
