// All that a program needs that maps surfaces, in one line.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//   ParametrizationResult result = parametrize(mesh, {});
//   if (result.map) write_vtu("map.vtu", to_map_file(*result.map));
//
// It includes the umbrella headers of the modules that stand below; the comment of each is its
// table of contents. Not for programs that put problems together themselves (other elements,
// constraints, solvers): framework/framework.h, framework/terms/terms.h, elements/elements.h and
// constraints/constraints.h, or single headers of these. Nor for meshes of volumes
// (volumes/volumes.h) and of quads (quads/quad_mesh.h).
#pragma once

#include "majorant/certify/certify.h"
#include "majorant/energies/energies.h"
#include "majorant/framework/error.h"
#include "majorant/framework/run_record.h"
#include "majorant/io/io.h"
#include "majorant/mesh/mesh.h"
#include "majorant/parametrization/parametrization.h"
#include "majorant/pictures/pictures.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
