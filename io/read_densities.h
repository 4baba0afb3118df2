// Texel densities of materials as users give them: a JSON file of pixels per unit of the mesh.
//
//     {"materials": {"wood": 512, "metal": 256}, "other": 128}
//
// "other" applies to materials that are not named and to faces without one. One of the two keys may
// be missing. Other keys are comments.
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
