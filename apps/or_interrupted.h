// Makes an error with a line out of a limit or Ctrl-C that ends a run before there is anything to
// write, or the writing of one of several files.
//
//   const auto read = [&] { return read_mesh(path, stop); };
//   const PolygonMesh polygons = or_interrupted("reading " + path, read);
#pragma once

#include <fmt/format.h>

#include <string>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"

namespace majorant::app {

// Who ends the run with it adds that nothing is written; who writes other files (WrittenFiles),
// which these are.
class Interrupted : public Error {
 public:
  Interrupted(Directive why, const std::string& message)
      : Error(ErrorKind::Invalid, message), why_(why) {}
  Directive why() const { return why_; }

 private:
  Directive why_;
};

// work(); Interrupted("interrupted while DOING") when it throws Stopped.
template <class Work>
auto or_interrupted(const std::string& doing, const Work& work) {
  try {
    return work();
  } catch (const Stopped& stopped) {
    throw Interrupted(stopped.why(), fmt::format("{} while {}", stopped.what(), doing));
  }
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
