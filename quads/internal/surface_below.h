// The surface under the quads of a mesh: its nearest points, and whether quads face its other side.
//
//   const std::array<Vector3, 4> corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
//   const SurfaceBelow below(*mesh);
//   const NearestPoint nearest = below.tree().nearest({0.5, 0.5, 0});
//   if (below.is_away(corners, nearest)) std::cerr << "turned over\n";
//
// The surface nearest to the centroid of a quad may be the wrong side, in a thin wall or where
// another component touches. Vertices lie on the surface, so there the right side is at distance
// zero.
#pragma once

#include <array>
#include <vector>

#include "majorant/mesh/nearest_point.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the faces that contain the nearest point, at least one: both at an edge, all around a
// vertex, where coordinates up to 1e-9 count as 0. Unordered, with repetitions.
std::vector<Index> faces_at(const SurfaceMesh& mesh, const NearestPoint& point);

// Returns the positions of all vertices in the file.
Points3 positions_in_file(const SurfaceMesh& mesh);

class SurfaceBelow {
 public:
  // The largest distance of a vertex on the surface, relative to its quad. Other programs place
  // vertices with such errors. Chosen, not tuned.
  static constexpr double kOnSurface = 0.01;

  // surface: must outlive this.
  explicit SurfaceBelow(const SurfaceMesh& surface);

  const SurfaceTree& tree() const { return tree_; }
  const Points3& positions() const { return positions_; }  // in the file
  // Returns the tolerance within which points are at one place.
  double close() const { return close_; }

  // Returns whether a quad faces away from the surface below its centroid. nearest: the nearest
  // point of the surface. With the normal n of the quad, it returns false in two cases. First, n .
  // N >= 0 for the normals N of all faces there, or of all faces at another point of the surface
  // that is as near, up to close(). Second, all corners lie on the surface, up to kOnSurface of the
  // quad's longer diagonal, and each has a face with n . N > 0 among the nearest ones up to
  // close(). Signs are exact.
  bool is_away(const std::array<Vector3, 4>& corners, const NearestPoint& nearest) const;
  // Returns is_away(), or whether at least three corners on the surface face away, which detects
  // quads whose centroid is near another side that agrees by chance. near: faces_near() of each
  // corner.
  bool is_turned(const std::array<Vector3, 4>& corners, const NearestPoint& nearest,
                 const std::array<const NearestFaces*, 4>& near) const;
  // Returns the faces nearest to p, or at most close() farther.
  NearestFaces faces_near(const Vector3& p, Index likely) const {
    return tree_.nearest_faces(p, close_, likely);
  }

 private:
  // Facts about a corner: it is on the surface; n . N > 0 for a face there; n . N < 0 for all of
  // them.
  struct AtCorner {
    bool is_on_surface = false, agrees = false, is_away = false;
  };
  AtCorner at_corner(const std::array<Vector3, 4>& corners, const NearestFaces& near) const;
  bool is_away_at_middle(const std::array<Vector3, 4>& corners, const NearestPoint& nearest) const;
  int sign_against(const std::array<Vector3, 4>& corners, Index face) const;

  const SurfaceMesh& surface_;
  const Points3 positions_;
  const SurfaceTree tree_;
  const double close_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
