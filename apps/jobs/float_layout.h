// A layout whose coordinates are floats, and what is proven of these floats: for programs that take
// no doubles.
//
//   const ProofRequest promise{.surface = &polygons, .cuts = CutRule::Free};
//   const FloatLayout layout = float_layout(file, polygons, promise);
//   const bool is_proven = layout.defect.empty();
//
// Not for files: write_map() proves what it has written (write_map.h).
#pragma once

#include <string>

#include "majorant/certify/map_proof.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

struct FloatLayout {
  // u and v are floats. Every corner of a cell names the vertex that its polygon has there.
  MapFile map;
  std::string defect;  // the first property of the promise that is not proven; empty: all are
};

// map: of degree 1, made from `input`. Throws Stopped.
FloatLayout float_layout(const MapFile& map, const PolygonMesh& input, const ProofRequest& promise);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
