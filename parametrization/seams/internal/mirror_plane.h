// The plane in which a surface is its own mirror image, nearly, whatever its triangles.
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

// The plane whose mirror image of the surface lies nearest, of those through the centroid across
// the principal axes and the axes of coordinates. None where more than one of a hundred vertices
// has no vertex within a mean edge of its image. Stopped.
std::optional<MirrorPlane> mirror_plane(const SurfaceMesh& mesh, const StopCheck& stop = {});

// Mean edges from the image of a vertex to another one that stands for it.
inline constexpr double kSameImageEdges = 2;
// The step between vertices whose images are compared: 2,000 of them tell one part of a hundred.
Index image_sample_step(const SurfaceMesh& mesh);

double mean_edge_length(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
