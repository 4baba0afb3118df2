// How dense texels are on materials, as a user says it: a JSON file of pixels along a unit of the
// mesh.
//
//     {"materials": {"wood": 512, "metal": 256}, "other": 128}
//
// "other": of materials that are not named, and of faces without one; one of the two keys may be
// missing. Other keys are comments.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "majorant/framework/stop_check.h"

namespace majorant {

struct MaterialDensities {
  std::map<std::string, double> materials;
  std::optional<double> other;
};

// Throws Error(Unreadable), naming the file and the entry, for broken JSON and for numbers that are
// not positive and finite; Stopped.
MaterialDensities read_densities(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
