// Densities of the Jacobian in Python: a formula on arrays, everything else in C++.
//
// The kernels of the library run over a batch of elements twice. In the first pass a density
// records the Jacobians and returns 0. Then Python is called once with all Jacobians. In the second
// pass a density returns the results of that call. One call of Python thus serves some thousand
// points, and element tables, contraction and packing stay in C++.
#pragma once

#include <pybind11/pybind11.h>

#include "majorant/energies/energy_factory.h"

namespace majorant::python {

// density: a majorant.Density. Its exceptions pass through evaluators unchanged.
EnergyFactory python_energy(const pybind11::object& density);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
