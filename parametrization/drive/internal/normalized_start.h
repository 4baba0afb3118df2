// The start of an optimization in coordinates that suit it: the surface scaled by a power of two to
// size about 1, exactly undone at the end, so that scaling the input changes nothing but rounding.
//
//   NormalizedStart start(map, options.map);
//   BezierMap optimized = start.map();   // minimized under start.specification()
//   BezierMap result = start.in_model_units(optimized);
#pragma once

#include "majorant/parametrization/drive/map_options.h"
#include "majorant/parametrization/maps/bezier_map.h"
#include "majorant/parametrization/maps/bezier_mesh.h"
#include "majorant/parametrization/maps/map_problem.h"

namespace majorant {

// Throws InvalidArgument unless face weights and data of energies are for the faces of the mesh.
void require_face_data(const SurfaceMesh& mesh, const MapObjective& asked);

// Extents of the surface beyond which the position of a free map is given up for its digits.
// Origin: three of the sixteen digits are lost there.
inline constexpr double kLargestOffset = 1000;

// Where the origin is: where coordinates have most digits, or where the start has it, because
// somebody else knows the coordinates.
enum class Origin { Free, Kept };

class NormalizedStart {
 public:
  // asked.aligned: edges are projected onto their axis, seams kept, before anything else.
  // Throws Error(Infeasible) when the start is not locally injective, does not meet the pins or has
  // an aligned edge off its axis by more than kSeamTolerance,
  // Error(Unsupported) when a vertex is held twice or a handle's target too far away to compute
  // with (kLargestFactor), Error(Usage) for vertices that do not exist, weights or data of
  // faces that do not fit, and an energy that would shrink the map to a point (free_scale.h).
  NormalizedStart(const BezierMap& start, const MapOptions& asked, Origin origin = Origin::Free);

  double scale() const { return scale_; }
  const BezierMap& map() const { return map_; }  // (uv - origin) * scale
  // How far aligning edges moved the start, at most; model units.
  double moved() const { return moved_; }
  const MapSpecification& specification() const { return specification_; }
  BezierMap in_model_units(const BezierMap& normalized) const;
  BezierMesh in_model_units(BezierMesh normalized) const;

 private:
  double scale_, moved_ = 0;
  // Where a free map's held vertex is, else 0, and where it is put back to: the same place unless
  // that is so far from 0 that coordinates would lose digits. Model units.
  Vector2 origin_ = Vector2::Zero(), destination_ = Vector2::Zero();
  BezierMap map_;
  MapSpecification specification_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
