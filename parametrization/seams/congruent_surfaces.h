// Surfaces that are copies of each other: which charts may lie on one place of a layout, which
// components are cut alike.
//
//   const auto places = stack_places({mesh, mesh}, Stacking::Equal, {});
//   if (places[1]) is_cut = flags_on(is_cut, *places[1]);
//
// Not for parts that repeat within one surface: whole surfaces are compared, face by face.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Which charts may share a place of the layout: none; those whose surfaces are
// copies of each other; and those that are copies of mirror images.
enum class Stacking { None, Equal, Mirrored };
enum class ChartSense { Same, Mirrored };

// The chart that another one lies on, corner by corner: corner k of face f on corner corner[f][k]
// of face[f].
struct StackPlace {
  std::size_t chart = 0;
  ChartSense sense = ChartSense::Same;
  std::vector<Index> face = {};
  std::vector<std::array<int, 3>> corner = {};
};

// Of every surface, each connected, the first one that it is a copy of, as it is or (Mirrored) as
// in a mirror; none where it is the first of its kind. Copies have the same triangles of the same
// polygons, with edges and, once moved onto each other, vertices in the same places but for a part
// of 1e-4 of the size. scale: of every surface, or empty; copies have equal ones.
std::vector<std::optional<StackPlace>> stack_places(
    const std::vector<std::shared_ptr<const SurfaceMesh>>& surfaces, Stacking stacking,
    const std::vector<double>& scale);

// 3 #F flags of the half-edges of a surface, from those of the one that it lies on.
std::vector<char> flags_on(const std::vector<char>& under, const StackPlace& place);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
