// Writes a distributed map: OUT_0.vtu, OUT_1.vtu, ... from the ranks that have faces, and OUT.pvtu
// that names them, for ParaView, `majorant convert` and `majorant check`.
#pragma once

#include <string>

#include "apps/mpi/parametrize_parts.h"

namespace majorant {

// Collective. Points that ranks share have the same bits in every piece. claims: JSON with the
// claims of the files, written into rank 0's piece. Every piece is read back and compared, and no
// piece takes its name before all are complete, so that an earlier map survives a full disk. Then
// the earlier OUT.pvtu and the pieces that it names are removed; the new one appears after the last
// piece. If one rank fails, all throw: rank 0 its error, the others
// ReportedByFirstRank (internal/rethrow_collectively.h).
void write_parts(const std::string& path, const MeshPart& part, const ParametrizationResult& result,
                 const std::string& claims);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
