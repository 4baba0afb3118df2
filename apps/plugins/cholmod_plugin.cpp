// libmajorant_cholmod.so, which `majorant` loads for --linear-solver cholmod.
#include "apps/plugins/plugin.h"
#include "majorant/framework/cholmod_solver.h"

extern "C" const majorant::app::CholmodPlugin majorant_plugin{
    MAJORANT_VERSION, [] { return majorant::make_cholmod_solver(); }};

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
