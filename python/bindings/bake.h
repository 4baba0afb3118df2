// The registration function of bake.cpp.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

void bind_bakes(pybind11::module_& module);  // bake

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
