// Makes an error with a line out of a limit or Ctrl-C that ends a run before there is anything to
// write.
//
//   const auto read = [&] { return read_mesh(path, stop); };
//   const PolygonMesh polygons = or_interrupted("reading " + path, read);
#pragma once

#include <fmt/format.h>

#include <string>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"

namespace majorant::app {

// work(); Error(Invalid, "interrupted while DOING; nothing is written") when it throws Stopped.
template <class Work>
auto or_interrupted(const std::string& doing, const Work& work) {
  try {
    return work();
  } catch (const Stopped& stopped) {
    throw Error(ErrorKind::Invalid,
                fmt::format("{} while {}; nothing is written", stopped.what(), doing));
  }
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
