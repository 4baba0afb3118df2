// Spaces of maps: triangles, quads and tetrahedra of any degree.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant::python {

// Elements of one kind and degree, with their rest shapes.
struct Space {
  std::shared_ptr<const BernsteinSpace> space;
  RestShapes rest;
  RowMatrix vertices;                       // #V by d
  std::shared_ptr<const SurfaceMesh> mesh;  // null unless the elements are triangles
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
