// Converts the options of a map from Python to the library's.
//
// majorant/_options.py makes the dictionary with all keys and checks names, types and ranges. Here
// only conditions that need the surface are checked.
#pragma once

#include <pybind11/pybind11.h>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant::python {

namespace py = pybind11;

template <class T>
T keyword(const py::dict& keywords, const char* name) {
  return keywords[name].cast<T>();
}

// [(name or density, weight), ...].
EnergySum energy_sum(const py::handle& energies);

// mesh: the surface, or the cut surface of a start, in which the vertices of pins and handles are
// looked up. These are rows of V. names: see pins_at(). Throws Error(Unsupported) for a vertex
// without a face.
ParametrizationOptions read_options(const py::dict& keywords, const SurfaceMesh& mesh,
                                    const std::vector<Index>& names = {});

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
