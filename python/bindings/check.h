// Results judged again.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

// Registers check_map.
void bind_check(pybind11::module_& module);

}  // namespace majorant::python
