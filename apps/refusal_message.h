// Refusals of the library in the terms of the command: verbs and flags instead of functions.
//
//   try {
//     SurfaceMesh::from_polygons(polygons);
//   } catch (const Error& e) {
//     std::cerr << command_message(e) << "\n";
//   }
#pragma once

#include <string>

#include "majorant/framework/error.h"

namespace majorant::app {

std::string command_message(const Error& error);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
