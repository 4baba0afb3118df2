// The surface under the quads of a mesh: where it is nearest, and whether a quad faces its other
// side.
//
//   const std::array<Vector3, 4> corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
//   const SurfaceBelow below(*mesh);
//   const NearestPoint nearest = below.tree().nearest({0.5, 0.5, 0});
//   if (below.is_away(corners, nearest)) std::cerr << "turned over\n";
//
// The surface nearest to the middle of a quad is not always the one that the quad lies on: in a
// thin wall, or where another component touches, that may be the other side. Vertices lie on the
// surface, so there the side that is meant is the one at no distance.
#pragma once

#include <array>
#include <vector>

#include "majorant/mesh/nearest_point.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The faces of the surface that its nearest point lies on, at least one: both of an edge, all
// around a vertex, where coordinates up to 1e-9 are 0. In no order, some twice.
std::vector<Index> faces_at(const SurfaceMesh& mesh, const NearestPoint& point);

// Positions of all vertices as the file has them.
Points3 positions_in_file(const SurfaceMesh& mesh);

class SurfaceBelow {
 public:
  // Chosen: other programs place vertices up to a hundredth of an edge off the surface.
  static constexpr double kOnSurface = 0.01;

  // surface: outlives this.
  explicit SurfaceBelow(const SurfaceMesh& surface);

  const SurfaceTree& tree() const { return tree_; }
  const Points3& positions() const { return positions_; }  // as the file has them
  // Points at most this far from a place are at it.
  double close() const { return close_; }

  // Returns whether a quad faces away from what is below its middle. nearest: the point of the
  // surface nearest to its centroid. With n the normal of the quad, returns false if n . N >= 0
  // for the normals N of all faces there, or of all faces at another point of the surface that is
  // as near, up to close(); and if all corners lie on the surface, up to kOnSurface
  // of the quad's longer diagonal, and at each of them there is a face with n . N > 0: among all
  // that are as near, or close() farther. Signs are exact.
  bool is_away(const std::array<Vector3, 4>& corners, const NearestPoint& nearest) const;
  // is_away(), or three corners or more on the surface face away: where the middle is nearest to
  // another side, which agrees by chance. near: faces_near() of each corner.
  bool is_turned(const std::array<Vector3, 4>& corners, const NearestPoint& nearest,
                 const std::array<const NearestFaces*, 4>& near) const;
  // The faces nearest to p, or at most close() farther.
  NearestFaces faces_near(const Vector3& p, Index likely) const {
    return tree_.nearest_faces(p, close_, likely);
  }

 private:
  // A corner: on the surface or not; n . N > 0 for a face there; n . N < 0 for all of them.
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
