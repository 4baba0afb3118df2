// A map of parametrize() or deform() as a function of its data: targets of pins and handles,
// weights, numbers of densities, and at degree 1 the positions of the surface.
//
//   const ParametrizationResult result = parametrize(mesh, options);
//   const MapSensitivity s(result, options);
//   MapSensitivity::Change change;
//   change.pins = {{0.1, 0}, {0, 0}};                     // both pins of options.map, in order
//   const Vec duv = s.forward(change);                    // 2 a control point, in model units
//   const MapSensitivity::Derivative d = s.adjoint(duv);  // of L, duv its slope at the map
//
// The problem is built again on the rule of the degree, and the map is polished by exact Newton
// steps first: map() is the one that derivatives belong to. Where nothing holds a map, the energy
// leaves its motions free: derivatives are those of least norm in the control points, unless a
// gauge is given; motions() says how many there are. Injectivity that holds a map back makes it no
// function of its data.
//
// Not for unwrap(), seamless maps, maps whose scaffold is active (MapInjectivity::Global), with
// aligned edges, flipped triangles or additions (ParametrizationOptions::extend): all refused by
// name.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/sensitivity.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

struct MapSensitivityOptions {
  // Two vertices that hold a map which nothing else does: the first one stays, the second one goes
  // on to lie in the same direction, and where the energy leaves the scale free, at the same
  // distance. None: least norm.
  std::optional<std::array<Index, 2>> gauge = {};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
};

class MapSensitivity {
 public:
  // result: of parametrize() or deform() with these options. Throws Error(Unsupported), naming it,
  // for what is listed above, where there is no map, injectivity holds it back or Sensitivity
  // refuses; InvalidArgument for options that are not those of the result, for a gauge of vertices
  // that do not exist or of a map that something holds.
  MapSensitivity(const ParametrizationResult& result, const ParametrizationOptions& options,
                 MapSensitivityOptions how = {});
  ~MapSensitivity();
  MapSensitivity(MapSensitivity&&) noexcept;
  MapSensitivity& operator=(MapSensitivity&&) noexcept;

  // A direction in the data, in model units; what is empty does not change.
  struct Change {
    std::vector<Vector2> pins = {}, handles = {};  // targets, in the order of MapOptions
    Vec weights = {};                              // of the summands of the energy
    double handle_weight = 0;
    Vec face_weights = {};             // #F
    std::vector<Vec> parameters = {};  // of each summand: its data, EnergyTerm::parameter_count()
    Points3 positions = {};            // #V by 3, of the surface that is mapped; degree 1
  };
  struct Derivative {
    std::vector<Vector2> pins, handles;
    Vec weights;
    double handle_weight = 0;
    Vec face_weights;
    std::vector<Vec> parameters;
    std::optional<Points3> positions;  // none at degrees above 1
  };

  const BezierMap& map() const;
  // The largest distance of a control point from where the result has it, in extents of the map.
  double moved() const;
  // An estimate of |uv - uv*| / |uv| after polishing.
  double error() const;
  // Motions that nothing holds and the energy does not see: 0, or those of which derivatives take
  // nothing (no gauge) or what the gauge leaves.
  Index motions() const;

  // Throw InvalidArgument for lists of other lengths and numbers that are not finite;
  // Error(Unsupported) for positions at degrees above 1.
  Vec forward(const Change& change) const;
  Derivative adjoint(const Vec& slope) const;  // dL/d(control points), 2 each

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
