// The level of each face in a quadrature hierarchy. Most faces stay on level 0; a face that blocks
// a run, or whose integral is inaccurate, is refined.
#pragma once

#include <vector>

#include "majorant/maps/map_problem.h"
#include "majorant/maps/quadrature_hierarchy.h"

namespace majorant {

class QuadratureLevels {
 public:
  QuadratureLevels(QuadratureHierarchy hierarchy, Index face_count)
      : hierarchy_(std::move(hierarchy)), level_(to_size(face_count), 0) {}

  // Returns all rules of the hierarchy, guarded ones first, in the numbering of terms.
  std::vector<Quadrature> rules() const;
  const std::vector<RuleId>& of_faces() const { return level_; }

  // Sets levels that of_faces() returned earlier; none: the lowest. Throws InvalidArgument for
  // another number of faces and for levels that the hierarchy does not have.
  void set(std::vector<RuleId> levels);
  // Refines these faces by one level where possible. Returns whether any of them changed.
  bool refine(const std::vector<Index>& faces);
  // Refines the faces whose integrals are worst, until the error of the rest is below `allowed` of
  // the energy, both of the whole map. Returns whether any face of the map changed. terms: on
  // rules(). Throws Stopped, the levels unchanged.
  bool refine_inaccurate(const MapSpecification& spec, const DensityTerms& terms, VecIn x,
                         double allowed, const StopCheck& stop);

 private:
  QuadratureHierarchy hierarchy_;
  std::vector<RuleId> level_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
