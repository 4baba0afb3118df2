// Terms of a problem that Python puts together: spaces and their energies, penalties, and functions
// of few unknowns written in Python.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/energy_term.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant::python {

// The Bezier triangles of one degree on a surface.
struct Space {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
};

struct Term {
  std::shared_ptr<const EnergyTerm> term;
};

// Registers Space, Term, penalty and element_term.
void bind_terms(pybind11::module_& module);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
