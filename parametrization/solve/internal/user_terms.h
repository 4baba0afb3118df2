// What a MapExtension added, as a part of the problems of its degree: bounds with a barrier are
// left out, relaxed or held, as the solver goes along (degree_solver.cpp).
//
//     UserTerms added(extension);
//     const std::vector<TermId> barriers = added.add_to(builder);
//     builder.add(added.gauge(spec, *space, start));
#pragma once

#include <memory>
#include <vector>

#include "majorant/constraints/fixed_unknowns.h"
#include "majorant/framework/internal/barrier_path.h"
#include "majorant/framework/problem.h"
#include "majorant/parametrization/maps/map_problem.h"
#include "majorant/parametrization/solve/map_extension.h"

namespace majorant {

class UserTerms {
 public:
  UserTerms() = default;  // nothing
  explicit UserTerms(std::shared_ptr<const MapExtension> extension);

  bool constrained() const { return extension_ && !extension_->constraints().empty(); }
  // Terms, constraints, checkers and the bounds that are held; the map's nodes are the builder's
  // first. Returns the ids of the barriers.
  std::vector<TermId> add_to(ProblemBuilder& builder) const;
  // What must be held so that the gauge vertices' pieces cannot be translated where nothing that
  // was added withstands: both coordinates of each, or fewer. A term withstands where a translation
  // changes it at the start; rows with auxiliary unknowns do not count.
  FixedUnknowns gauge(const MapSpecification& spec, const BezierTriangleSpace& space,
                      VecIn start) const;

  // Throws InvalidArgument where a term has no such curvature model.
  void require_curvature(Curvature asked) const;
  // Weighted sum of the terms, bounds' barriers not among them.
  double energy(VecIn x) const;

  // ---- Bounds with a barrier ----
  bool bounded() const { return !bounds_.bounds().empty(); }
  // Whether x meets all of them; the first one that it does not, by name.
  bool met(VecIn x) const { return violated(x) == nullptr; }
  const BarrierChecker* violated(VecIn x) const { return bounds_.violated(of_map(x)); }
  // What is held in their place; they see the map's unknowns alone.
  HeldBounds& bounds() { return bounds_; }
  Vec of_map(VecIn x) const;
  double barrier_weight() const { return barrier_weight_; }
  void set_barrier_weight(double weight) { barrier_weight_ = weight; }
  // Sum of the absolute values of the elements of the held bounds' barriers.
  double barrier_size(VecIn x) const;

 private:
  std::shared_ptr<const MapExtension> extension_;
  HeldBounds bounds_;
  double barrier_weight_ = 1;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
