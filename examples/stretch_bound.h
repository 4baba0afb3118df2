// The bound of bounded_stretch.cpp, a checker with a barrier
// (majorant/framework/feasibility.h): the largest stretch of a planar map, proven over all of
// it.
#pragma once

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "majorant/elements/jacobian_net.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/feasibility.h"

namespace majorant {

// sigma_max(J) < bound at all Bernstein coefficients of J, and so everywhere: sigma_max is convex.
// For the same reason the way between two maps inside is inside.
class StretchBound final : public BarrierChecker {
 public:
  StretchBound(JacobianNet net, double bound) : net_(std::move(net)), bound_(bound) {}
  std::string_view name() const override { return "largest stretch"; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    verdict.margin = bound_ - largest_stretch(net_, x).maxCoeff();
    verdict.feasible = verdict.margin > 0;
    return verdict;
  }
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }
  // -log det(bound^2 I - J^T J), a mean over the coefficients.
  std::shared_ptr<const EnergyTerm> barrier() const override {
    const auto wall = [b = bound_ * bound_](const auto& J) {
      return -log(b * b - b * J.squaredNorm() + J.determinant() * J.determinant());
    };
    const Traits everywhere{.domain = Domain::Everywhere};
    return make_energy(net_.triangles, net_.rest, density<2, 2>("stretch", wall, everywhere));
  }
  std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const override {
    const double stretch = largest_stretch(net_, x).maxCoeff();
    return std::make_shared<const StretchBound>(net_, std::max(bound_, 1.1 * stretch));
  }

 private:
  JacobianNet net_;
  double bound_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
