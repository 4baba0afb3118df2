#include "majorant/framework/terms/inequality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// A term with the value f(room, gap) for each finite bound. room = sign (x - at); gap: the distance
// to the opposite bound, +inf if there is none.
template <class F>
class BoundTerm final : public EnergyTerm {
 public:
  BoundTerm(const Vec& lower, const Vec& upper, F f) : f_(f) {
    std::vector<Index> unknowns;
    for (Index k = 0; k < lower.size(); ++k) {
      const double gap = upper[k] - lower[k];
      for (const auto& [at, sign] : {std::pair(lower[k], 1.0), {upper[k], -1.0}}) {
        if (!std::isfinite(at)) continue;
        unknowns.push_back(k);
        sides_.push_back({at, sign, gap});
      }
    }
    element_dofs_.nodes =
        Eigen::Map<const Cells>(unknowns.data(), static_cast<Index>(unknowns.size()), 1);
  }
  std::string_view name() const override { return "bounds"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }

  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) f[p] = at(x, batch.elements[p])[0];
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState&, Workspace&,
             LocalSystem& out) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const std::array<double, 3> f = at(x, batch.elements[p]);
      out.value[p] = f[0];
      out.gradient[p] = sides_[batch.elements[p]].sign * f[1];
      if (out.hessian) out.hessian[p] = f[2];
    }
  }

 private:
  struct Side {
    double at, sign, gap;
  };
  std::array<double, 3> at(VecIn x, Index e) const {
    const Side& side = sides_[e];
    return f_(side.sign * (x[element_dofs_.nodes(e, 0)] - side.at), side.gap);
  }
  F f_;
  std::vector<Side> sides_;
  ElementDofs element_dofs_;
};

// Returns value, slope and second derivative of -log(room).
std::array<double, 3> barrier_of(double room, double /*gap*/) {
  const double inverse = 1 / room;
  return {room > 0 ? -std::log(room) : kNone, -inverse, inverse * inverse};
}

// Returns the derivatives of max(0, m - room)^2, where m is the margin, or that part of the gap.
struct MissingRoom {
  double margin;
  std::array<double, 3> operator()(double room, double gap) const {
    const double missing = std::max(0.0, margin * std::min(1.0, gap) - room);
    return {missing * missing, -2 * missing, missing > 0 ? 2.0 : 0.0};
  }
};

// The clearance of a relaxed bound from the point. It is relative to the gap between two bounds, or
// to 1, and to the violation. BarrierChecker::relaxed() requires about a tenth.
constexpr double kClear = 0.1;

class BoundChecker final : public BarrierChecker, public ViolationMeasure {
 public:
  BoundChecker(Vec lower, Vec upper) : lower_(std::move(lower)), upper_(std::move(upper)) {}
  std::string_view name() const override { return "bounds"; }

  Verdict check(VecIn x) const override {
    require_fitting(x);
    Verdict verdict;
    verdict.margin = kNone;
    for (Index k = 0; k < lower_.size(); ++k) {
      const double inside = std::min(x[k] - lower_[k], upper_[k] - x[k]);
      if (!(inside > 0)) verdict.blocking.push_back(k);
      verdict.margin = std::min(verdict.margin, inside);
    }
    verdict.feasible = verdict.blocking.empty();
    return verdict;
  }

  StepBound max_step(VecIn x, VecIn d, double s) const override {
    require_fitting(x);
    StepBound bound{s, {}};
    for (Index k = 0; k < lower_.size(); ++k) bound.step = std::min(bound.step, step(x, d, k));
    if (bound.step == s) return bound;
    for (Index k = 0; k < lower_.size(); ++k)
      if (step(x, d, k) <= 2 * bound.step) bound.blocking.push_back(k);
    return bound;
  }

  std::shared_ptr<const EnergyTerm> barrier() const override {
    return Bounds(lower_, upper_).barrier();
  }
  std::shared_ptr<const EnergyTerm> violation(double margin) const override {
    return std::make_shared<const BoundTerm<MissingRoom>>(lower_, upper_, MissingRoom{margin});
  }
  std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const override {
    require_fitting(x);
    Vec lower = lower_, upper = upper_;
    for (Index k = 0; k < lower.size(); ++k) {
      const double gap = upper_[k] - lower_[k], unit = std::isfinite(gap) ? gap : 1.0;
      if (x[k] <= lower_[k]) lower[k] = x[k] - kClear * (unit + lower_[k] - x[k]);
      if (x[k] >= upper_[k]) upper[k] = x[k] + kClear * (unit + x[k] - upper_[k]);
    }
    return std::make_shared<const BoundChecker>(std::move(lower), std::move(upper));
  }

 private:
  void require_fitting(VecIn x) const {
    if (x.size() != lower_.size())
      throw InvalidArgument("Bounds of " + std::to_string(lower_.size()) +
                            " unknowns in a problem of " + std::to_string(x.size()) +
                            ": one for each of the full unknowns is needed, -inf or +inf where "
                            "there is none");
  }
  double step(VecIn x, VecIn d, Index k) const {
    if (d[k] == 0) return kNone;
    return ((d[k] > 0 ? upper_[k] : lower_[k]) - x[k]) / d[k];
  }
  Vec lower_, upper_;
};

}  // namespace

Bounds::Bounds(Vec lower, Vec upper) : lower_(std::move(lower)), upper_(std::move(upper)) {
  if (lower_.size() != upper_.size())
    throw InvalidArgument("Bounds: " + std::to_string(lower_.size()) + " lower and " +
                          std::to_string(upper_.size()) + " upper bounds");
  for (Index k = 0; k < lower_.size(); ++k)
    if (!(lower_[k] < upper_[k]))
      throw InvalidArgument("Bounds: no room for unknown " + std::to_string(k) + " between " +
                            std::to_string(lower_[k]) + " and " + std::to_string(upper_[k]));
}

std::shared_ptr<const EnergyTerm> Bounds::barrier() const {
  return std::make_shared<const BoundTerm<decltype(&barrier_of)>>(lower_, upper_, &barrier_of);
}

std::shared_ptr<const BarrierChecker> Bounds::checker() const {
  return std::make_shared<const BoundChecker>(lower_, upper_);
}

Vec Bounds::interior(Vec x, double margin) const {
  if (x.size() != lower_.size())
    throw InvalidArgument("Bounds: of " + std::to_string(lower_.size()) + " unknowns, not " +
                          std::to_string(x.size()));
  if (!(margin > 0 && margin <= 0.5))
    throw InvalidArgument("Bounds: the margin must be in (0, 1/2]");
  for (Index k = 0; k < x.size(); ++k) {
    const double gap = upper_[k] - lower_[k], away = std::isfinite(gap) ? margin * gap : margin;
    x[k] = std::min(std::max(x[k], lower_[k] + away), upper_[k] - away);
  }
  return x;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
