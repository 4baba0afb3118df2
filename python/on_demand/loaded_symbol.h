// Libraries that the Python module loads when they are used first: import loads none of them.
//
//   const auto make = loaded_symbol<cairo_t* (*)(cairo_surface_t*)>({"libcairo.so.2", "pictures"}, "cairo_create");
//
// A library is looked for in the folder of the module, then as the system's loader does for the
// module, whose search path names the libraries that a wheel brings. It stays loaded.
#pragma once

namespace majorant::python {

struct LibraryOnDemand {
  const char* file;
  const char* use;  // for messages: what is not possible without it
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
