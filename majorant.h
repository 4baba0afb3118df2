// What a program that maps surfaces needs, in one line.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//   ParametrizationResult result = parametrize(mesh, {});
//   if (result.map) write_vtu("map.vtu", to_map_file(*result.map));
//
// Programs that put problems together themselves (other elements, constraints, solvers) include the
// headers of framework/, elements/ and constraints/ that they use.
#pragma once

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/map_proof.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/named_energies.h"
#include "majorant/energies/spectral.h"
#include "majorant/framework/derivative_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/run_record.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/vtu.h"
#include "majorant/io/write_obj.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/unwrap.h"
#include "majorant/parametrization/initialization/make_seamless.h"
#include "majorant/parametrization/initialization/texture_seams.h"
#include "majorant/parametrization/initialization/tutte.h"
#include "majorant/parametrization/maps/map_file.h"
#include "majorant/parametrization/solve/deform.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/pictures/write_svg.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
