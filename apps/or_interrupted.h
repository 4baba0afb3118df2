// Turns a stop, by a limit or Ctrl-C, into an error with a message. It is used where nothing can be
// written yet, and for one of several output files.
//
//   const auto read = [&] { return read_mesh(path, stop); };
//   const PolygonMesh polygons = or_interrupted("reading " + path, read);
#pragma once

#include <fmt/format.h>

#include <string>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"

namespace majorant::app {

// A stop of the run. The catcher adds to the message that nothing is written, or which files are
// (WrittenFiles).
class Interrupted : public Error {
 public:
  Interrupted(Directive why, const std::string& message)
      : Error(ErrorKind::Invalid, message), why_(why) {}
  Directive why() const { return why_; }

 private:
  Directive why_;
};

// Returns work(). Throws Interrupted("interrupted while DOING") if it throws Stopped.
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
