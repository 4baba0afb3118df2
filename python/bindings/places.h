// From places to points of surfaces: preimages of a map, nearest points.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

// Registers InverseMap and SurfaceTree.
void bind_places(pybind11::module_& module);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
