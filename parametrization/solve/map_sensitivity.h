// The derivatives of a map of parametrize() or deform() by its data: targets of pins and handles,
// weights, parameters of densities, and at degree 1 the positions of the surface.
//
//   const ParametrizationResult result = parametrize(mesh, options);
//   const MapSensitivity s(result, options);
//   MapSensitivity::Change change;
//   change.pins = {{0.1, 0}, {0, 0}};                     // both pins of options.map, in order
//   const Vec duv = s.forward(change);                    // 2 a control point, in model units
//   const MapSensitivity::Derivative d = s.adjoint(duv);  // of L, duv its slope at the map
//
// The problem is built again with the quadrature rule of the degree, and the map is first polished
// by exact Newton steps: derivatives belong to map(). If nothing holds a map, its energy is
// invariant under motions. Derivatives are then those of least norm in the control points unless a
// gauge is given; motions() counts the motions. A map at the limit of injectivity is no
// differentiable function of its data.
//
// Not supported, and refused by name, are unwrap(), seamless maps, maps with an active scaffold or
// barrier (MapInjectivity::Global), with aligned edges, flipped triangles or additions
// (ParametrizationOptions::extend).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/sensitivity.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

struct MapSensitivityOptions {
  // Two vertices that fix the motions of a map that nothing else holds. The first one stays; the
  // second one keeps its direction from the first and, if the energy leaves the scale free, its
  // distance. None: derivatives of least norm.
  std::optional<std::array<Index, 2>> gauge = {};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
};

class MapSensitivity {
 public:
  // result: of parametrize() or deform() with these options. Throws Error(Unsupported) naming the
  // reason for the unsupported cases above, if there is no map, if it is at the limit of
  // injectivity, or if Sensitivity refuses. Throws InvalidArgument for options that are not those
  // of the result, for a gauge whose vertices do not exist, and for a gauge of a map that something
  // holds.
  MapSensitivity(const ParametrizationResult& result, const ParametrizationOptions& options,
                 MapSensitivityOptions sensitivity_options = {});
  ~MapSensitivity();
  MapSensitivity(MapSensitivity&&) noexcept;
  MapSensitivity& operator=(MapSensitivity&&) noexcept;

  // A direction of change of the data, in model units; empty members do not change.
  struct Change {
    std::vector<Vector2> pins = {}, handles = {};  // targets, in the order of MapOptions
    Vec weights = {};                              // of the summands of the energy
    double handle_weight = 0;
    Vec face_weights = {};             // #F
    std::vector<Vec> parameters = {};  // of each summand: its data, EnergyTerm::parameter_count()
    Points3 positions = {};            // #V by 3, of the surface that is mapped; degree 1
  };
  // The derivative of a function by the data.
  struct Derivative {
    std::vector<Vector2> pins, handles;
    Vec weights;
    double handle_weight = 0;
    Vec face_weights;
    std::vector<Vec> parameters;
    std::optional<Points3> positions;  // none at degrees above 1
  };

  const BezierMap& map() const;
  // Returns the largest displacement of a control point by polishing, in extents of the map.
  double moved() const;
  // Returns an estimate of |uv - uv*| / |uv| after polishing.
  double error() const;
  // Returns the number of motions under which the energy is invariant and that nothing holds.
  // Derivatives are orthogonal to them, or satisfy the gauge.
  Index motions() const;

  // Return the derivatives of the map in a direction, and of a function of the map by all data.
  // slope: its derivative by the control points, 2 each. Throw InvalidArgument for lists of other
  // lengths and numbers that are not finite; Error(Unsupported) for positions at degrees above 1.
  Vec forward(const Change& change) const;
  Derivative adjoint(const Vec& slope) const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
