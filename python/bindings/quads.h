// Meshes of quads.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

// Registers Quads, quad_mesh and save_quads.
void bind_quads(pybind11::module_& module);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
