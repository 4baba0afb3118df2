// Terms of problems made in Python: energies of maps, penalties, loads, and functions of few
// unknowns written in Python.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "majorant/framework/energy_term.h"

namespace majorant::python {

struct Term {
  std::shared_ptr<const EnergyTerm> term;
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
