// The start of an optimization in coordinates that suit it: the surface scaled by a power of two to
// size about 1, exactly undone at the end, so that scaling the input changes nothing but rounding.
//
//   NormalizedStart start(map, options.map);
//   BezierMap optimized = start.map();   // minimized under start.specification()
//   BezierMap result = start.in_model_units(optimized);
#pragma once

#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"

namespace majorant {

// Throws InvalidArgument unless face weights and data of energies are for the faces of the mesh.
void require_face_data(const SurfaceMesh& mesh, const MapOptions& asked);

// The factor between the model and the coordinates of an optimization, a power of two.
double normal_scale(const SurfaceMesh& mesh);

// Extents of the surface beyond which the position of a free map is given up for its digits.
// Three of the sixteen digits are lost there.
inline constexpr double kLargestOffset = 1000;

// Free: the origin is where coordinates have most digits. Kept: it is where the start has it,
// because somebody else knows the coordinates.
enum class Origin { Free, Kept };

// The coordinates that a map is optimized in: (uv - origin) scale.
struct NormalFrame {
  double scale = 1;  // a power of two
  // The place of a free map's held vertex, else 0, and the place that it is put back to: the same
  // one unless that is so far from 0 that coordinates would lose digits. Model units.
  Vector2 origin = Vector2::Zero(), destination = Vector2::Zero();

  // A map with a fixed boundary comes back to where it was, however far.
  void move_origin(const Vector2& to, BoundaryCondition boundary);
  void normalize(std::vector<FixedPoint>& points) const;
  Vec normalized(const Vec& uv) const;
  Vec in_model_units(const Vec& x) const;
};

class NormalizedStart {
 public:
  // asked.aligned: edges are projected onto their axis, seams kept, before anything else.
  // Throws Error(Infeasible) when the start is not locally injective, does not meet the pins or has
  // an aligned edge off its axis by more than kSeamTolerance,
  // Error(Unsupported) when a vertex is held twice or a handle's target too far away to compute
  // with (kLargestFactor), Error(Usage) for vertices that do not exist, weights or data of
  // faces that do not fit, and an energy that would shrink the map to a point (free_scale.h).
  // part: whose start, points, weights and data these are, pins on all ranks that have the vertex,
  // handles on its owner; null: the whole map. Collective where there are several ranks; throws on
  // one or on several, whatever the scale, and does not ask whether the start is injective.
  // rest: rest_shapes(mesh, normal_scale(mesh)), where somebody has them; null: they are made.
  NormalizedStart(const BezierMap& start, const MapOptions& asked, Origin origin = Origin::Free,
                  std::shared_ptr<const MapPart> part = nullptr,
                  std::shared_ptr<const RestShapes> rest = nullptr);

  double scale() const { return frame_.scale; }
  const BezierMap& map() const { return map_; }  // (uv - origin) * scale
  // The largest distance by which aligning edges moved the start; model units.
  double moved() const { return moved_; }
  const MapSpecification& specification() const { return specification_; }
  BezierMap in_model_units(const BezierMap& normalized) const;
  BezierMesh in_model_units(BezierMesh normalized) const;

 private:
  NormalFrame frame_;
  double moved_ = 0;
  BezierMap map_;
  MapSpecification specification_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
