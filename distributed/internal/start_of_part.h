// The start of an optimization in coordinates that suit it, as NormalizedStart makes it of a whole
// map (parametrization/solve/normalized_start.h): the surface scaled by a power of two to
// size about 1, a free map moved to the origin, both undone at the end.
//
//     const StartOfPart start(part, uv, options.map);
//     Vec x = start.x();                                // minimized under start.specification()
//     const Vec result = start.in_model_units(x);
#pragma once

#include <memory>

#include "distributed/mesh_part.h"
#include "majorant/parametrization/maps/map_options.h"
#include "majorant/parametrization/maps/map_problem.h"
#include "majorant/parametrization/solve/normalized_start.h"

namespace majorant {

class StartOfPart {
 public:
  // uv: 2 numbers per vertex here. asked: points, weights and data of this part, pins on all ranks
  // that have the vertex, handles on its owner. Collective. Throws on one rank or on several
  // Error(Infeasible) for pins that the start does not meet, Error(Unsupported) when a vertex is
  // held twice or a handle's target too far away to compute with, InvalidArgument for vertices that
  // do not exist and for weights or data of faces that do not fit: as NormalizedStart.
  StartOfPart(std::shared_ptr<const MeshPart> part, const Vec& uv, const MapOptions& asked);

  const MapSpecification& specification() const { return specification_; }
  const Vec& x() const { return x_; }
  double scale() const { return frame_.scale; }
  Vec in_model_units(const Vec& x) const { return frame_.in_model_units(x); }

 private:
  NormalFrame frame_;
  MapSpecification specification_;
  Vec x_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
