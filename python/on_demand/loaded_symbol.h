// Libraries that the Python module loads on their first use, not on import.
//
//   const auto make = loaded_symbol<cairo_t* (*)(cairo_surface_t*)>({"libcairo.so.2", "pictures"}, "cairo_create");
//
// Parts of the package are in the folder of the module. The system's loader finds other libraries
// by the search path of the module, which contains the folder of a wheel's libraries. Loaded
// libraries stay.
#pragma once

namespace majorant::python {

struct LibraryOnDemand {
  const char* file;
  const char* use;       // for messages: the feature that needs the library
  bool is_part = false;  // whether the library belongs to the package
};

// Throws Error(Unsupported) if the library or the symbol is missing.
void* loaded_address(const LibraryOnDemand& library, const char* name);

template <class Function>
Function loaded_symbol(const LibraryOnDemand& library, const char* name) {
  return reinterpret_cast<Function>(loaded_address(library, name));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
