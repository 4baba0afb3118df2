// A map in parts as files: OUT_0.vtu, OUT_1.vtu, ... of the ranks that have faces, and OUT.pvtu
// that names them, which ParaView opens and `majorant convert` and `majorant check` read.
#pragma once

#include <string>

#include "apps/mpi/parametrize_parts.h"

namespace majorant {

// Collective. Points that ranks share are the same bits in every piece. claims: JSON, what the
// files promise; rank 0's piece says it. Every piece is read back and compared, and none takes its
// name before all are complete: on a full disk an earlier map stays as it was. From then on there
// is no OUT.pvtu until the last piece has its name; pieces that an earlier one named, of more
// ranks, are gone. Throws on all ranks where one fails: what it failed at there, FailedElsewhere on
// the others (internal/rethrow_collectively.h).
void write_parts(const std::string& path, const MeshPart& part, const ParametrizationResult& result,
                 const std::string& claims);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
