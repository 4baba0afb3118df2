// Maps of surfaces, whole: one low-distortion map, an atlas of many, seamless maps, and what they
// are worth.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//   const ParametrizationResult result = parametrize(mesh, {});
//   if (result.map) std::cout << result.measures.value << "\n";
//
// What is asked for (folders of parametrization/, and maps/ beside it):
//     solve/parametrize.h           parametrize(), one map; deform(), a planar mesh by handles
//     maps/map_options.h            what a map shall be, how it is looked for; a map on its way
//     maps/map_extension.h          terms, constraints and checkers of one's own
//     atlas/unwrap.h                unwrap(): any surface as charts in one square
//     seams/choose_cuts.h           where a surface is cut
//     packing/pack.h                charts side by side
//     initialization/start.h        maps to start from: Tutte's, texture coordinates, seamless ones
//     fields/cross_field.h          cross fields and their cones
//
// What comes out:
//     maps/bezier_map.h             BezierMap: evaluation, Jacobians, control points
//     maps/measure.h                energies, extremes, proofs of a finished map
//     maps/distortion.h             what it does to areas, angles and textures
//     maps/map_file.h               a finished map as files hold it
//     tessellation/tessellate_map.h straight triangles, valid as they stand
//
// What a problem of one's own is made of:
//     maps/map_problem.h            the problem of a map on one space
//     maps/rest_shapes_of.h         the shapes of the faces that it is measured against
//
// Not for files and pictures of maps: io/io.h, pictures/pictures.h; nor for the proofs of what a
// file holds: certify/certify.h.
#pragma once

#include "majorant/maps/bezier_map.h"
#include "majorant/maps/distortion.h"
#include "majorant/maps/map_extension.h"
#include "majorant/maps/map_file.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/measure.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/parametrization/atlas/unwrap.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/packing/pack.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
