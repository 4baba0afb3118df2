// Any mesh to charts side by side.
#pragma once

#include <pybind11/pybind11.h>

#include "mesh.h"

namespace majorant::python {

// As the other solvers (solve.h).
pybind11::tuple unwrap_mesh(const SharedPolygons& polygons, const pybind11::dict& keywords,
                            const pybind11::object& callback);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
