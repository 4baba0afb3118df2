// Turns the options that Python asks of a map into those of the library.
//
// The dictionary is made by majorant/_options.py, which has checked names, types and ranges: all
// keys are there. Only what needs the surface is checked here.
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

// mesh: what the vertices of pins and handles, which are those of the arrays, are looked up in: the
// surface, or the surface of a start, cut open. names: as pins_at() takes them. Throws
// Error(Unsupported) for a vertex of no face.
ParametrizationOptions read_options(const py::dict& keywords, const SurfaceMesh& mesh,
                                    const std::vector<Index>& names = {});

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
