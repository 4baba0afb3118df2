// Moves the control points of a mesh until all elements are proven to be valid, as a start for the
// optimization.
//
//     const UntangledMesh result = untangle_mesh(tangled, record);
//     if (const auto depth = tangled.elements.proven_depth(result.x)) optimize(result.x, *depth);
#pragma once

#include <vector>

#include "majorant/volumes/internal/volume_elements.h"

namespace majorant {

// A mesh with invalid elements, and what may move. All references must outlive this object.
struct TangledMesh {
  const VolumeMesh& mesh;
  const std::vector<CellSide>& sides;
  const VolumeElements& elements;
  const HeldPoints& held;
  VolumeBoundary boundary;
  const std::vector<CellName>& movable;  // under VolumeBoundary::Free: the cells whose nodes move
  Vec x;                                 // its control points
};

struct UntangledMesh {
  Vec x;               // of valid elements, or where the attempts have ended
  int iterations = 0;  // Newton steps
};

// Ends early at record.stop().
UntangledMesh untangle_mesh(TangledMesh tangled, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
