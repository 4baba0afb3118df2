// The target shapes of elements: an affine shape for each, as rest shapes.
#pragma once

#include <vector>

#include "majorant/elements/rest_shapes.h"
#include "majorant/volumes/internal/control_net.h"
#include "majorant/volumes/optimize_volume_mesh.h"

namespace majorant {

// Returns the shapes of each part of the net. Throws InvalidArgument for sizes that are not
// positive, or whose number is neither 1 nor that of the cells.
std::vector<RestShapes> target_shapes(const VolumeMesh& mesh, const ControlNet& net,
                                      const VolumeOptions& options);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
