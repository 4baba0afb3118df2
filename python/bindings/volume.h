// Meshes of volumes as the package's VolumeMesh has them: read or made of arrays, checked,
// optimized, written.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

namespace py = pybind11;

void bind_volumes(py::module_& module);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
