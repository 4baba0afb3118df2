// The third-party parts of this binary, and the licence that follows from them.
//
//   require_gpl_parts("--bijective");
//   print_text(licences());
#pragma once

#include <string>
#include <string_view>

namespace majorant::app {

// Returns whether the build has CGAL and the other parts under the GPL or LGPL (MAJORANT_GPL).
bool has_gpl_parts();

// Throws Error(Usage) if the build lacks these parts. what: the verb or flag that needs them.
void require_gpl_parts(std::string_view what);

// Returns a line for the whole, and a line for every library that is linked or loaded.
std::string licences();

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
