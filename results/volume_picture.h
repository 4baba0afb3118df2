// A mesh of volumes cut open, as a picture: the elements behind the plane through the worst one,
// coloured by their scaled Jacobian, and the worst ones drawn over them with their numbers.
//
//   const VolumeMesh mesh = read_volume_mesh("part.msh");
//   const VolumeCheck check = check_volume_mesh(mesh);
//   write_space_png("part.png", picture_of_elements(mesh, check, 10));
#pragma once

#include "majorant/pictures/space_picture.h"
#include "majorant/volumes/check_volume_mesh.h"

namespace majorant {

// marked: how many of the worst elements are drawn over the others, at most. Of a mesh of triangles
// or quads nothing is cut away.
SpacePicture picture_of_elements(const VolumeMesh& mesh, const VolumeCheck& check, int marked);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
