// Limits the memory that reading a file takes. Small files can describe huge meshes, and a process
// that exceeds the limit of its control group is killed without a message.
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

// Returns read(). Throws Error(Unsupported) if it would take more memory than is free.
template <class Read>
auto within_memory(const std::string& path, const Read& read) {
  const ScopedMemoryLimit limit;
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw Error(
        ErrorKind::Unsupported,
        fmt::format(
            "{}: out of memory while reading it; use a smaller mesh, or raise the memory limit",
            path));
  }
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
