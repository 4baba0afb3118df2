// Reading that ends with a line where it would take more memory than is free: small files can stand
// for large meshes, and who takes more than a control group has is killed without one.
//
//   const auto read = [&] { return read_mesh(path, stop); };
//   const PolygonMesh polygons = within_memory(path, read);
#pragma once

#include <fmt/format.h>

#include <new>
#include <string>

#include "apps/process.h"
#include "majorant/framework/error.h"

namespace majorant::app {

// read(); Error(Unsupported) where it would take more than is free.
template <class Read>
auto within_memory(const std::string& path, const Read& read) {
  const FreeMemoryOnly limit;
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: out of memory while reading it; use a smaller mesh, or allow more", path));
  }
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
