// Maps of whole surfaces: one low-distortion map, an atlas of many, seamless maps, and measures of
// all of them.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//   const ParametrizationResult result = parametrize(mesh, {});
//   if (result.map) std::cout << result.measures.value << "\n";
//
// Algorithms and options (folders of parametrization/, and maps/ beside it):
//     solve/parametrize.h           parametrize(): one map; deform(): a planar mesh by handles
//     maps/map_options.h            options of a map and of its solve; the map during a solve
//     maps/map_extension.h          custom terms, constraints and checkers
//     atlas/unwrap.h                unwrap(): any surface as charts in one square
//     seams/choose_cuts.h           the edges along which a surface is cut
//     packing/pack.h                charts side by side
//     initialization/start.h        initial maps: Tutte's, texture coordinates, seamless ones
//     fields/cross_field.h          cross fields and their cones
//
// Results:
//     maps/bezier_map.h             BezierMap: evaluation, Jacobians, control points
//     maps/measure.h                energies, extremes, proofs of a finished map
//     maps/distortion.h             distortion of areas, angles and textures
//     maps/map_file.h               a finished map as files hold it
//     tessellation/tessellate_map.h straight triangles, valid as they stand
//
// Building blocks of a custom problem:
//     maps/map_problem.h            the problem of a map on one space
//     maps/rest_shapes_of.h         the shapes of the faces against which distortion is measured
//
// For files and pictures of maps, see io/io.h and pictures/pictures.h; for proofs about a file,
// certify/certify.h.
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
