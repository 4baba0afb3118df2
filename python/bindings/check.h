// Results judged again.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

// Registers check_map.
void bind_check(pybind11::module_& module);

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
