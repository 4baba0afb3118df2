// The verbs of `majorant mesh`, one file each.
#pragma once

#include <CLI/App.hpp>

#include "apps/command.h"

namespace majorant::app {

void add_mesh_check(CLI::App& mesh, Action* run);
void add_mesh_optimize(CLI::App& mesh, Action* run);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
