// Libraries that the Python module loads when they are used first: import loads none of them.
//
//   const auto make = loaded_symbol<cairo_t* (*)(cairo_surface_t*)>({"libcairo.so.2", "pictures"}, "cairo_create");
//
// Parts of the package are in the folder of the module, other libraries where the system's loader
// finds them for the module, whose search path names the libraries that a wheel brings. What is
// loaded stays.
#pragma once

namespace majorant::python {

struct LibraryOnDemand {
  const char* file;
  const char* use;       // for messages: what is not possible without it
  bool is_part = false;  // of the package
};

// Throws Error(Unsupported) where the library or the symbol is not there.
void* loaded_address(const LibraryOnDemand& library, const char* name);

template <class Function>
Function loaded_symbol(const LibraryOnDemand& library, const char* name) {
  return reinterpret_cast<Function>(loaded_address(library, name));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
