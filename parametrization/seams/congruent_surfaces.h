// Surfaces that are copies of each other. Charts of copies may share a place in a layout, and
// components that are copies are cut alike.
//
//   const auto places = stack_places({mesh, mesh}, Stacking::Equal, {});
//   if (places[1]) is_cut = flags_on(is_cut, *places[1]);
//
// Whole surfaces are compared face by face, so parts that repeat within one surface are not found.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The charts that may share a place of the layout. Equal: those whose surfaces are copies of each
// other. Mirrored: also copies of mirror images.
enum class Stacking { None, Equal, Mirrored };
enum class ChartSense { Same, Mirrored };

// The chart that another one is stacked on, corner by corner: corner k of face f lies on corner
// corner[f][k] of face[f].
struct StackPlace {
  std::size_t chart = 0;
  ChartSense sense = ChartSense::Same;
  std::vector<Index> face = {};
  std::vector<std::array<int, 3>> corner = {};
};

// Returns for every surface the first one that it is a copy of, directly or (Mirrored) as a mirror
// image; none for the first of its kind. Surfaces are connected. Copies have the same triangles of
// the same polygons. Their edges and, once moved onto each other, their vertices agree up to 1e-4
// of the size. scale: of every surface, or empty; copies have equal scales.
std::vector<std::optional<StackPlace>> stack_places(
    const std::vector<std::shared_ptr<const SurfaceMesh>>& surfaces, Stacking stacking,
    const std::vector<double>& scale);

// Returns 3 #F flags of the half-edges of a surface, from the flags of the one that it lies on.
std::vector<char> flags_on(const std::vector<char>& under, const StackPlace& place);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
