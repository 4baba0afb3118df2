// The solvers of maps.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

// Registers parametrize, seamless, deform and unwrap. Each takes a Mesh, keywords (options.h) and a
// callback, and returns
//     (MapFile, Mesh, promise, input, status, message, report)
// for Python to make a Map of: the mesh as writers want it, what files must be proven to be,
// whether formats of meshes keep its polygons, and the report as JSON. Raises where there is no
// valid map.
void bind_solvers(pybind11::module_& module);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
