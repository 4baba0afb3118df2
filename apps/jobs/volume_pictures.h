// Pictures of volume meshes: a page with single elements, a row for each, their sides in space
// beside those of the regular element; and an image of the mesh, cut open.
//
//   const VolumeMesh mesh = read_volume_mesh("part.msh");
//   const VolumeCheck check = check_volume_mesh(mesh);
//   write_page("bad.html", page_of_elements(mesh, check.worst(10)));
//   write_space_png("part.png", picture_of_elements(mesh, check, 10));
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/pictures/pictures.h"
#include "majorant/pictures/space_picture.h"
#include "majorant/volumes/check_volume_mesh.h"

namespace majorant {

// Charts and faults are numbered by element; faces name the element in the file. The faults are the
// elements that are not proven valid, at the place of the least det J. elements: at least one.
MapPage page_of_elements(const VolumeMesh& mesh, const std::vector<const CheckedCell*>& elements);

// Returns the elements behind the plane through the worst one, coloured by scaled Jacobian. At most
// `marked` of the worst elements are drawn over them with their numbers. Surface meshes are not
// cut. Throws Stopped.
SpacePicture picture_of_elements(const VolumeMesh& mesh, const VolumeCheck& check, int marked,
                                 const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
