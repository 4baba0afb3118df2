#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/internal/colored_batches.h"
#include "majorant/framework/internal/symmetric_eigen.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// The step of finite differences, relative to a size of the unknown. Both the rounding of the
// energy divided by the step and the fourth power of the step stay far below the tolerance.
constexpr double kStep = 1e-5;
// Two sizes, and so two steps, count as different from this ratio on.
constexpr double kOtherSize = 2;
// The second size, relative to the first, of an unknown that has only one.
constexpr double kSmaller = 0.1;
// The maximum number of entries of local Hessians in a sample: about those of kMaxCheckedElements
// elements of 30 unknowns. At least kMinCheckedElements elements are checked, however large they
// are.
constexpr Index kMaxCheckedEntries = 500000, kMinCheckedElements = 20;
constexpr unsigned kSampleSeed = 1;
// The maximum number of lines of a message: most mistakes are the same in all elements.
constexpr std::size_t kMostLines = 10;
// The allowed error of a gradient, relative to the Hessian times the size and to the tolerance. It
// matters for an element at rest, whose gradient is rounding alone. With the default tolerance it
// corresponds to a displacement of 1e-10 of the size.
constexpr double kRest = 1e-5;

// Returns `size` of the numbers below `count`, ascending; all of them if there are no more.
std::vector<Index> sampled(Index count, Index size) {
  std::mt19937_64 random(kSampleSeed);
  std::vector<Index> sample;
  for (Index k = 0; k < count; ++k) {
    const auto left = static_cast<std::uint64_t>(count - k);
    const auto missing = static_cast<std::uint64_t>(size - std::ssize(sample));
    if (random() % left < missing) sample.push_back(k);
  }
  return sample;
}

struct LocalValues {
  double value;
  Vec gradient;
  Eigen::MatrixXd hessian;
};

// Evaluates one element of a term alone.
class ElementProbe {
 public:
  ElementProbe(const EnergyTerm& term, const TermState& state, Index element)
      : term_(term), state_(state), element_{element} {
    const ElementDofs& s = term.element_dofs();
    for (Index k = 0; k < s.node_count(element); ++k)
      for (int c = 0; c < s.block; ++c) unknowns_.push_back(s.block * s.nodes(element, k) + c);
    batch_.rule = state.element_rule.empty() ? 0 : state.element_rule[element];
    batch_.elements = element_;
  }

  const std::vector<Index>& unknowns() const { return unknowns_; }

  double value(VecIn x) {
    double f = 0;
    term_.values(x, batch_, state_, kernel_, {&f, 1});
    return f;
  }

  LocalValues local(VecIn x, BlendedCurvature curvature) {
    const auto n = static_cast<int>(unknowns_.size());
    constexpr int stride = LocalSystem::stride;
    LocalSystem out = reserve();
    out.hessian = out.gradient + term_.element_dofs().local_size() * stride;
    term_.local(x, batch_, curvature, state_, kernel_, out);
    LocalValues v{out.value[0], gradient_of(out), Eigen::MatrixXd(n, n)};
    for (int i = 0, k = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j, ++k) v.hessian(i, j) = v.hessian(j, i) = out.hessian[k * stride];
    return v;
  }

  // Requests no Hessian; that of the result is empty.
  LocalValues first_order(VecIn x) {
    LocalSystem out = reserve();
    term_.local(x, batch_, Curvature::Projected, state_, kernel_, out);
    return {out.value[0], gradient_of(out), {}};
  }

 private:
  // Reserves arrays for values, gradients and a Hessian, which is not passed on.
  LocalSystem reserve() {
    LocalSystem out;
    const int n = term_.element_dofs().local_size();
    constexpr int stride = LocalSystem::stride;
    out.value = memory_.reserve(to_size((1 + n + n * (n + 1) / 2) * stride));
    out.gradient = out.value + stride;
    return out;
  }
  Vec gradient_of(const LocalSystem& system) const {
    Vec g(static_cast<Index>(unknowns_.size()));
    for (Index i = 0; i < g.size(); ++i) g[i] = system.gradient[i * LocalSystem::stride];
    return g;
  }

  const EnergyTerm& term_;
  const TermState& state_;
  std::array<Index, 1> element_;
  ElementBatch batch_;
  std::vector<Index> unknowns_;
  Workspace kernel_, memory_;
};

struct Worst {
  double error = 0;
  DerivativeMismatch mismatch{};
  // An element without energy has no scale: any derivative other than 0 is then wrong.
  void update(double scale, Index element, std::string block, double computed, double expected) {
    if (computed == expected) return;
    const double relative = std::abs(computed - expected) / scale;
    if (!(relative <= error)) {  // NaN counts
      error = std::isnan(relative) ? std::numeric_limits<double>::infinity() : relative;
      mismatch = {element, std::move(block), computed, expected};
    }
  }
};

// Returns the exact Hessian if the term has it, otherwise any model.
Curvature best_model(const EnergyTerm& term) {
  if (!term.supports(Curvature::Exact))
    for (const Curvature c : kCurvatures)
      if (term.supports(c)) return c;
  return Curvature::Exact;
}

// Makes all comparisons of one element.
class ElementCheck {
 public:
  ElementCheck(const EnergyTerm& term, const TermState& state, Index element, VecIn x,
               double tolerance)
      : term_(term), element_(element), x_(x), tolerance_(tolerance), probe_(term, state, element) {
    exact_ = term.supports(Curvature::Exact);
    at_ = probe_.local(x_, best_model(term));
    size_ = size_of_unknowns(term.element_dofs().block);
    const double first_order = at_.gradient.cwiseAbs().maxCoeff() + std::abs(at_.value) / size_;
    hessian_scale_ = at_.hessian.cwiseAbs().maxCoeff() + first_order / size_;
    Vec displacement(at_.gradient.size());
    for (int i = 0; i < displacement.size(); ++i) displacement[i] = sizes(i).front();
    const double at_rest = (at_.hessian.cwiseAbs() * displacement).maxCoeff();
    gradient_scale_ = first_order + kRest * (at_rest + first_order);
  }

  void run() {
    const double f = probe_.value(x_);
    gradient.update(gradient_scale_ * size_, element_, "value", at_.value, f);
    const LocalValues first_order = probe_.first_order(x_);
    gradient.update(gradient_scale_ * size_, element_, "value without hessian", first_order.value,
                    f);
    for (int i = 0; i < at_.gradient.size(); ++i) {
      gradient.update(gradient_scale_, element_, fmt::format("gradient[{}] without hessian", i),
                      first_order.gradient[i], at_.gradient[i]);
      differences(i);
    }
    for (const Curvature curvature : kCurvatures) {
      if (curvature == Curvature::Exact || !term_.supports(curvature)) continue;
      const Eigen::MatrixXd k = probe_.local(x_, curvature).hessian;
      const double lowest = symmetric_eigen(k).values[0];
      definite.update(hessian_scale_, element_,
                      fmt::format("curvature {}", curvature_name(curvature)), std::min(lowest, 0.0),
                      0);
    }
    if (exact_ && term_.supports(Curvature::Projected)) blend();
  }

  Worst gradient, hessian, definite;

 private:
  // Checks the blend half way between the exact and the projected Hessian.
  void blend() {
    const Eigen::MatrixXd exact = probe_.local(x_, Curvature::Exact).hessian;
    const Eigen::MatrixXd projected = probe_.local(x_, Curvature::Projected).hessian;
    const Eigen::MatrixXd half = probe_.local(x_, BlendedCurvature::projected(0.5)).hessian;
    for (int j = 0; j < half.cols(); ++j)
      for (int i = j; i < half.rows(); ++i) {
        const double expected = 0.5 * (exact(i, j) + projected(i, j));
        hessian.update(hessian_scale_, element_, fmt::format("blend({}, {})", i, j), half(i, j),
                       expected);
      }
  }

  // Returns the extent of an element's nodes along one coordinate. If unknowns are coordinates,
  // steps must be small relative to it.
  double size_of_unknowns(int block) const {
    const std::vector<Index>& u = probe_.unknowns();
    double size = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
      for (std::size_t j = i % to_size(block); j < i; j += to_size(block))
        size = std::max(size, std::abs(x_[u[i]] - x_[u[j]]));
    return size > 0 ? size : 1;
  }

  // Returns sizes relative to which steps in unknown i are small; unknown i may be much smaller
  // than others of its element. The first size suits coordinates and numbers near 1. The others are
  // tried if its differences disagree with a derivative.
  std::vector<double> sizes(int i) const {
    const double here = std::abs(x_[probe_.unknowns()[to_size(i)]]);
    std::vector<double> sizes{std::min(size_, std::max(here, 1.0))};
    for (const double other : {std::max(size_, here), here}) {
      const bool is_new = std::all_of(sizes.begin(), sizes.end(), [other](double size) {
        return other > kOtherSize * size || other * kOtherSize < size;
      });
      if (other > 0 && is_new) sizes.push_back(other);
    }
    if (sizes.size() == 1) sizes.push_back(kSmaller * sizes.front());
    return sizes;
  }

  struct Differences {
    double gradient = 0;
    Vec column;  // of the Hessian, if it is exact
  };

  // Returns differences of fourth order with respect to local unknown i.
  Differences differences(int i, double h) {
    const Index u = probe_.unknowns()[to_size(i)];
    const double here = x_[u];
    Differences found{0, Vec::Zero(at_.gradient.size())};
    for (const auto& [steps, weight] : {std::pair(1, 8.0), {-1, -8.0}, {2, -1.0}, {-2, 1.0}}) {
      x_[u] = here + steps * h;
      found.gradient += weight / (12 * h) * probe_.value(x_);
      if (exact_) found.column += weight / (12 * h) * probe_.local(x_, Curvature::Exact).gradient;
    }
    x_[u] = here;
    return found;
  }

  // If a stencil contains an unknown several times, the derivative is the sum over its occurrences.
  void differences(int i) {
    const Index u = probe_.unknowns()[to_size(i)];
    Differences claimed{0, Vec::Zero(at_.gradient.size())};
    for (Index k = 0; k < at_.gradient.size(); ++k) {
      if (probe_.unknowns()[to_size(k)] != u) continue;
      claimed.gradient += at_.gradient[k];
      claimed.column += at_.hessian.col(k);
    }
    const auto agrees = [this](double a, double b, double scale) {
      return a == b || std::abs(a - b) <= tolerance_ * scale;
    };
    std::vector<Differences> found;
    for (const double size : sizes(i)) {
      found.push_back(differences(i, kStep * size));
      bool all = agrees(claimed.gradient, found.back().gradient, gradient_scale_);
      for (Index j = 0; exact_ && j < claimed.column.size(); ++j)
        all = all && agrees(claimed.column[j], found.back().column[j], hessian_scale_);
      if (all) break;
    }
    // The difference that agrees with the derivative is used, otherwise one that agrees with
    // another difference, otherwise the nearest.
    const auto compare = [&](Worst& worst, double scale, std::string block, const auto& entry) {
      std::vector<double> expected;
      for (const Differences& one : found) expected.push_back(entry(one));
      const double computed = entry(claimed);
      const auto nearer = [computed](double a, double b) {
        if (std::isnan(a) || std::isnan(b)) return std::isnan(b) && !std::isnan(a);
        return std::abs(a - computed) < std::abs(b - computed);
      };
      std::sort(expected.begin(), expected.end(), nearer);
      double believed = expected.front();
      bool resolved = agrees(computed, believed, scale);
      for (std::size_t a = 0; a < expected.size() && !resolved; ++a)
        for (std::size_t b = a + 1; b < expected.size() && !resolved; ++b) {
          resolved = agrees(expected[a], expected[b], scale);
          if (resolved) believed = expected[a];
        }
      if (!resolved) block += ", not resolved by differences,";
      worst.update(scale, element_, std::move(block), computed, believed);
    };
    compare(gradient, gradient_scale_, fmt::format("gradient[{}]", i),
            [](const Differences& d) { return d.gradient; });
    for (Index j = 0; exact_ && j < claimed.column.size(); ++j)
      compare(hessian, hessian_scale_, fmt::format("hessian({}, {})", j, i),
              [j](const Differences& d) { return d.column[j]; });
  }

  const EnergyTerm& term_;
  Index element_;
  Vec x_;
  double tolerance_;
  ElementProbe probe_;
  LocalValues at_;
  bool exact_ = false;
  double size_ = 0, gradient_scale_ = 0, hessian_scale_ = 0;
};

// Checks that elements evaluated together give the values that each gives alone. All other checks
// use position 0 of a batch, so a term that mixes up positions would pass them.
class BatchCheck {
 public:
  BatchCheck(const EnergyTerm& term, const TermState& state, VecIn x)
      : term_(term), state_(state), x_(x), model_(best_model(term)) {}

  // Reports the worst difference of each element, if it exceeds the tolerance.
  void run(const ElementBatch& batch, double tolerance,
           std::vector<DerivativeMismatch>& mismatches) {
    constexpr int stride = LocalSystem::stride;
    const int n = term_.element_dofs().local_size();
    LocalSystem out;
    out.value = memory_.reserve(to_size((1 + n + n * (n + 1) / 2) * stride));
    out.gradient = out.value + stride;
    out.hessian = out.gradient + n * stride;
    double f[ElementBatch::kMaxSize];
    term_.values(x_, batch, state_, kernel_, {f, batch.elements.size()});
    term_.local(x_, batch, model_, state_, kernel_, out);
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      ElementProbe alone(term_, state_, e);
      const LocalValues v = alone.local(x_, model_);
      Worst worst;
      const auto compare = [&](double computed, double expected, double scale, auto block) {
        if (computed != expected)
          worst.update(scale, e, fmt::format("{} among others", block()), computed, expected);
      };
      const double g = v.gradient.cwiseAbs().maxCoeff(), h = v.hessian.cwiseAbs().maxCoeff();
      const auto at = static_cast<int>(p);
      compare(f[p], alone.value(x_), std::abs(v.value), [] { return std::string("value"); });
      const auto own = static_cast<int>(v.gradient.size());  // 0 after these
      for (int i = 0, k = 0; i < n; ++i) {
        compare(out.gradient[i * stride + at], i < own ? v.gradient[i] : 0.0, g,
                [&] { return fmt::format("gradient[{}]", i); });
        for (int j = 0; j <= i; ++j, ++k)
          compare(out.hessian[k * stride + at], i < own ? v.hessian(i, j) : 0.0, h,
                  [&] { return fmt::format("hessian({}, {})", i, j); });
      }
      if (worst.error > tolerance) mismatches.push_back(worst.mismatch);
    }
  }

 private:
  const EnergyTerm& term_;
  const TermState& state_;
  Vec x_;
  Curvature model_;
  Workspace kernel_, memory_;
};

}  // namespace

std::string DerivativeReport::message() const {
  std::string text;
  const std::size_t lines = std::min(kMostLines, mismatches.size());
  std::set<Index> shown, all;
  for (const DerivativeMismatch& m : mismatches) all.insert(m.element);
  for (std::size_t k = 0; k < lines; ++k) {
    const DerivativeMismatch& m = mismatches[k];
    shown.insert(m.element);
    text += fmt::format("element {}: {} is {:.9g}, expected {:.9g}\n", m.element, m.block,
                        m.computed, m.expected);
  }
  const std::size_t more = all.size() - shown.size(), left = mismatches.size() - lines;
  if (more > 0)
    text += fmt::format("... and {} more elements\n", more);
  else if (left > 0)
    text += fmt::format("... and {} more of the same elements\n", left);
  if (!ok() && checked < elements)
    text += fmt::format("{} of {} elements were checked\n", checked, elements);
  return text;
}

DerivativeReport check_derivatives(const EnergyTerm& term, VecIn x, double tolerance,
                                   const TermState& state) {
  require_valid(term, state);
  Index extent = 0;
  const ElementDofs& s = term.element_dofs();
  if (s.nodes.size() > 0) extent = s.block * (s.nodes.maxCoeff() + 1);
  if (x.size() < extent)
    throw InvalidArgument(
        fmt::format("check_derivatives: x has {} numbers, the term's elements use "
                    "{}",
                    x.size(), extent));
  require_finite("check_derivatives: x", x);
  DerivativeReport report;
  const Index entries = s.local_size() * (s.local_size() + 1) / 2;
  const Index most = std::clamp(kMaxCheckedEntries / std::max<Index>(1, entries),
                                kMinCheckedElements, kMaxCheckedElements);
  const std::vector<Index> sample = sampled(s.element_count(), most);
  report.elements = s.element_count();
  report.checked = static_cast<Index>(sample.size());
  for (const Index e : sample) {
    ElementCheck check(term, state, e, x, tolerance);
    check.run();
    report.gradient_error = std::max(report.gradient_error, check.gradient.error);
    report.hessian_error = std::max(report.hessian_error, check.hessian.error);
    for (const Worst* worst : {&check.gradient, &check.hessian, &check.definite})
      if (worst->error > tolerance) report.mismatches.push_back(worst->mismatch);
  }
  const ColoredBatches plan(term.element_dofs(), state.element_rule);
  BatchCheck together(term, state, x);
  // Takes enough batches for `most` elements, or for a few more.
  const Index batches = 1 + (most - 1) / ElementBatch::kMaxSize;
  for (const Index c :
       sampled(plan.batch_count(), report.checked < report.elements ? batches : plan.batch_count()))
    together.run(plan.batch(c), tolerance, report.mismatches);
  return report;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
