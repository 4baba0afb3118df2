// Meshes of Python, with vertices and faces in the order of the arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "majorant/mesh/polygon_mesh.h"

namespace majorant::python {

using SharedPolygons = std::shared_ptr<PolygonMesh>;

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
