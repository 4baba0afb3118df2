// The plane in which a surface is nearly its own mirror image, whatever its triangulation.
//
//   const std::optional<MirrorPlane> plane = mirror_plane(*mesh);
//   const Vector3 other = plane ? plane->image(mesh->positions().row(0)) : Vector3::Zero();
#pragma once

#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct MirrorPlane {
  Vector3 normal;  // of length 1
  double offset;   // along it

  double height(const Vector3& p) const { return normal.dot(p) - offset; }
  Vector3 image(const Vector3& p) const { return p - 2 * height(p) * normal; }
};

// Returns the plane whose mirror image of the surface lies nearest, among the planes through the
// centroid normal to the principal axes and the coordinate axes. None if more than one of a hundred
// vertices has no vertex within a mean edge of its image. Stopped.
std::optional<MirrorPlane> mirror_plane(const SurfaceMesh& mesh, const StopCheck& stop = {});

// The largest distance, in mean edges, between the image of a vertex and the vertex taken for it.
inline constexpr double kSameImageEdges = 2;
// Returns the step between vertices whose images are compared: 2,000 of them resolve one part of a
// hundred.
Index image_sample_step(const SurfaceMesh& mesh);

double mean_edge_length(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
