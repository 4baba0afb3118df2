// The library's exceptions as those of majorant/_errors.py.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

// Error and Stopped by kind, std::bad_alloc as MemoryError, all else that the library throws as
// InternalError. Exceptions of Python pass through the library as they are.
void translate_errors();

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
