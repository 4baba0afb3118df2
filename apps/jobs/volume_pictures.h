// What people look at of a mesh of volumes: single elements as a page for a browser, their sides in
// space, and beside it those of the regular elements, a row for each element, in the order given;
// and the mesh cut open, as a picture.
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

// Charts and faults are numbered as the elements are, faces name the element of the file that they
// are of. The faults are the elements that are not proven to be valid, at the place where det J is
// least. elements: at least one.
MapPage page_of_elements(const VolumeMesh& mesh, const std::vector<const CheckedCell*>& elements);

// The elements behind the plane through the worst one, coloured by their scaled Jacobian, and the
// worst ones, `marked` at most, drawn over them with their numbers. Of a mesh of triangles or quads
// nothing is cut away.
// Throws Stopped.
SpacePicture picture_of_elements(const VolumeMesh& mesh, const VolumeCheck& check, int marked,
                                 const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
