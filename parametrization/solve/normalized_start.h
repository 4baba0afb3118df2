// The start of an optimization in normalized coordinates: the surface is scaled by a power of two
// to size about 1. The scaling is undone exactly at the end, so scaling the input changes only
// rounding.
//
//   NormalizedStart start(map, options.map);
//   BezierMap optimized = start.map();   // minimized under start.specification()
//   BezierMap result = start.in_model_units(optimized);
#pragma once

#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"

namespace majorant {

// Throws InvalidArgument unless face weights and data of energies match the faces of the mesh.
void require_face_data(const SurfaceMesh& mesh, const MapOptions& options);

// Returns the factor from model units to normalized coordinates, a power of two.
double normal_scale(const SurfaceMesh& mesh);

// A free map farther from the origin than this many extents of the surface is moved to it, since
// three of the sixteen digits would be lost.
inline constexpr double kMaxOriginOffset = 1000;

// The origin of the coordinates. Free: where coordinates have most digits. Kept: that of the start,
// whose coordinates others use.
enum class Origin { Free, Kept };

// The normalized coordinates of a map: (uv - origin) scale.
struct NormalFrame {
  double scale = 1;  // a power of two
  // origin: the place of a free map's held vertex, else 0. destination: the place to which it is
  // put back, which is the same one unless coordinates there would lose digits. Model units.
  Vector2 origin = Vector2::Zero(), destination = Vector2::Zero();

  // Moves the origin. A map with a fixed boundary keeps its place, however far.
  void move_origin(const Vector2& to, BoundaryCondition boundary);
  void normalize(std::vector<FixedPoint>& points) const;
  Vec normalized(const Vec& uv) const;
  Vec in_model_units(const Vec& x) const;
};

class NormalizedStart {
 public:
  // options.aligned: edges are projected onto their axis, seams kept, before anything else. Throws
  // Error(Infeasible) if the start is not locally injective, does not meet the pins or has an
  // aligned edge off its axis by more than kSeamTolerance. Throws Error(Unsupported) if a vertex is
  // held twice or a handle's target is too far away (kLargestFactor). Throws Error(Usage) for
  // vertices that do not exist, weights or data of faces that do not fit, and an energy that would
  // shrink the map to a point (free_scale.h).
  //
  // part: the part to which start, points, weights and data belong, with pins on all ranks that
  // have the vertex, and handles on its owner; null: the whole map. Collective with several ranks;
  // it then throws on one or several of them, at any scale, and does not test whether the start is
  // injective.
  // rest: rest_shapes(mesh, normal_scale(mesh)) if already computed; null: they are computed.
  NormalizedStart(const BezierMap& start, const MapOptions& options, Origin origin = Origin::Free,
                  std::shared_ptr<const MapPart> part = nullptr,
                  std::shared_ptr<const RestShapes> rest = nullptr);

  double scale() const { return frame_.scale; }
  const BezierMap& map() const { return map_; }  // (uv - origin) * scale
  // Returns the largest distance by which aligning edges moved the start, model units.
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
