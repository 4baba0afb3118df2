// Densities of the Jacobian in Python: a formula on arrays, everything else in C++.
//
// The kernels of the library run over a batch of elements twice. The first time they see a density
// that notes the Jacobians they come by and is 0; then Python is called once, with all of them; the
// second time they see one that answers from what Python said. So a call of Python is paid once for
// some thousand points, and element tables, contraction and packing stay ours.
#pragma once

#include <pybind11/pybind11.h>

#include "majorant/energies/energy_factory.h"

namespace majorant::python {

// density: a majorant.Density. What it raises passes through evaluators, unchanged.
EnergyFactory python_energy(const pybind11::object& density);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
