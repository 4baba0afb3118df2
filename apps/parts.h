// The parts of this binary, and the licence that follows from them.
//
//   require_gpl_parts("--bijective");
//   print_text(licences());
#pragma once

#include <string>
#include <string_view>

namespace majorant::app {

// Returns whether CGAL and the others under the GPL or LGPL are in (MAJORANT_GPL).
bool has_gpl_parts();

// Throws Error(Usage) that says so where they are not; what: the verb or flag that needs them.
void require_gpl_parts(std::string_view what);

// A line for the whole, and one for every library whose code is in the binary or loaded with it.
std::string licences();

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
