// Edges that a cross field follows: the directions that they fix and the sectors that they bound.
//
// A face with followed edges has one branch along the longest of them. The followed edges around a
// vertex bound sectors. A sector has a number of quarter turns as an inner vertex has,
//     (pi / 2) turns = sum of its angles - sum of the rotations across its inner edges,
// which is the sum of its angles in a map that follows the field. A boundary vertex has sectors if
// both of its boundary edges are followed.
#pragma once

#include <vector>

#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

inline constexpr double kNotAligned = 10;  // no angle in (-pi, pi]

// Returns the angle to which each face is fixed, or kNotAligned (#F). is_aligned: 3 #F, or empty.
Vec fixed_angles(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                 const std::vector<char>& is_aligned);

struct AlignedSectors {
  std::vector<char> is_bound;      // 3 #F: followed by the faces on both sides
  std::vector<Index> of_corner;    // 3 #F: the sector of the corner where a half-edge starts, or -1
  std::vector<int> turns, target;  // by sector: of the field; of its angles, rounded
  std::vector<int> least;          // by sector: lower bound on turns
  std::vector<int> faces;          // by sector: number of faces
  std::vector<std::vector<Index>> at;  // #V: sectors
  std::vector<Index> vertex;           // by sector
};

// Returns the sectors of a field with these rotations (3 #F). is_aligned: 3 #F. fixed: from
// fixed_angles().
AlignedSectors aligned_sectors(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                               const std::vector<char>& is_aligned, const Vec& fixed,
                               const Vec& rotation);

// Returns the least number of quarter turns of a sector with this angle, in quarter turns; at most
// that of a regular vertex.
int least_turns_at(double angle, int regular);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
