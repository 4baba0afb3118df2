// A layout with coordinates in floats, and the proof of these floats, for programs that do not take
// doubles.
//
//   const ProofRequest request{.surface = &polygons, .cuts = CutRule::Free};
//   const FloatLayout layout = float_layout(file, polygons, request);
//   const bool is_proven = layout.defect.empty();
//
// Not for files: write_map() proves the bytes that it has written (write_map.h).
#pragma once

#include <string>

#include "majorant/certify/map_proof.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

struct FloatLayout {
  // The map with u and v in floats. Every corner of a cell names the vertex of its polygon.
  MapFile map;
  std::string defect;  // the first required property that is not proven; empty: all are proven
};

// map: of degree 1, made from `input`. Throws Stopped.
FloatLayout float_layout(const MapFile& map, const PolygonMesh& input, const ProofRequest& request);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
