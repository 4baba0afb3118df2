// The third-party parts of this binary, and the licence that follows from them.
//
//   print_text(licences());
#pragma once

#include <string>

namespace majorant::app {

// Returns whether the build has CGAL and the other parts under the GPL or LGPL (MAJORANT_GPL).
bool has_gpl_parts();

// Returns a line for the whole, and a line for every library that is linked or loaded.
std::string licences();

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
