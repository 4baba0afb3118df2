#include "majorant/parametrization/scaffold/internal/pair_energy.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "majorant/elements/element_space.h"
#include "majorant/framework/error.h"
#include "majorant/framework/evaluator.h"
#include "majorant/framework/internal/backtracking.h"
#include "majorant/framework/internal/element_values.h"

namespace majorant {
namespace {

// Newton steps of a pair: three times what they need.
constexpr int kMostPairSteps = 30;
// Of the energy: the predicted decrease that ends a pair; a fifth of
// LineSearch::kResolution, since a pair's energy is a sum of few terms.
constexpr double kConverged = 1e-13;
// Steps of a line search: the last one is a millionth of the first.
constexpr int kMostTrials = 20;
// Models that are never indefinite come first.
constexpr Curvature kPreferred[] = {Curvature::Projected, Curvature::Majorizer,
                                    Curvature::CompositeMajorizer, Curvature::Reweighted,
                                    Curvature::Exact};

}  // namespace

struct PairEnergy::Pair {
  bool active = true;
  double value = 0, descent = 0, step = 0;
  Vec gradient, direction;
  Eigen::MatrixXd hessian;
};

PairEnergy::PairEnergy(std::shared_ptr<const BezierTriangleSpace> space, const RestShapes& rest,
                       const EnergySum& energy, const Quadrature& rule)
    : space_(std::move(space)), energy_(energy) {
  if (energy.empty()) throw InvalidArgument("PairEnergy: no energy");
  for (const WeightedEnergy& e : energy) terms_.push_back(e.make(space_, rest, {rule}));
  for (const Curvature c : kPreferred)
    if (!curvature_ && std::all_of(terms_.begin(), terms_.end(),
                                   [c](const auto& term) { return term->supports(c); }))
      curvature_ = c;
  find_variables();
}

void PairEnergy::find_variables() {
  variable_.assign(to_size(space_->node_count()), 0);
  for (const Index node : space_->boundary_nodes()) variable_[node] = -1;
  inner_.resize(to_size(pair_count()));
  std::vector<char> met(variable_.size(), 0);
  for (Index f = 0; f < space_->element_count(); ++f)
    for (Index l = 0; l < space_->cells().cols(); ++l) {
      const Index node = space_->cells()(f, l);
      if (variable_[node] < 0 || met[node]) continue;
      met[node] = 1;
      variable_[node] = static_cast<int>(inner_[f / 2].size());
      inner_[f / 2].push_back(node);
    }
}

// visit(unknown of x, unknown of the pair).
template <class Visit>
void PairEnergy::for_variables(Index pair, const Visit& visit) const {
  const std::vector<Index>& nodes = inner_[pair];
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (Index c = 0; c < 2; ++c) visit(2 * nodes[k] + c, 2 * static_cast<Index>(k) + c);
}

Vec PairEnergy::values(VecIn x) const {
  Vec sum = Vec::Zero(space_->element_count());
  const std::vector<RuleId> rules(to_size(space_->element_count()), 0);
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const ColoredBatches plan(terms_[k]->element_dofs(), rules);
    sum += energy_[k].weight * element_values(*terms_[k], TermState{}, plan, x);
  }
  return sum;
}

void PairEnergy::add_local(VecIn x, const DensityTerm& term, double weight,
                           std::vector<Pair>& pairs) const {
  constexpr int stride = LocalSystem::stride;
  const int size = term.element_dofs().local_size();
  Workspace workspace, memory;
  LocalSystem local;
  local.value = memory.reserve(to_size(stride * (1 + size + size * (size + 1) / 2)));
  local.gradient = local.value + stride;
  local.hessian = local.gradient + size * stride;
  const TermState state;
  const std::vector<RuleId> rules(to_size(space_->element_count()), 0);
  const ColoredBatches plan(term.element_dofs(), rules);
  std::vector<int> variable(to_size(size));
  for (Index c = 0; c < plan.batch_count(); ++c) {
    const ElementBatch batch = plan.batch(c);
    term.local(x, batch, *curvature_, state, workspace, local);
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      Pair& pair = pairs[e / 2];
      for (int i = 0; i < size; ++i) {
        const int v = variable_[space_->cells()(e, i / 2)];
        variable[i] = v < 0 ? -1 : 2 * v + i % 2;
      }
      for (int i = 0; i < size; ++i) {
        if (variable[i] < 0) continue;
        pair.gradient[variable[i]] += weight * local.gradient[to_size(i * stride) + p];
        for (int j = 0; j <= i; ++j) {
          if (variable[j] < 0) continue;
          const auto [low, high] = std::minmax(variable[i], variable[j]);
          pair.hessian(high, low) +=
              weight * local.hessian[to_size((i * (i + 1) / 2 + j) * stride) + p];
        }
      }
    }
  }
}

void PairEnergy::linearize(VecIn x, std::vector<Pair>& pairs) const {
  const Vec value = values(x);
  for (Index p = 0; p < pair_count(); ++p) {
    Pair& pair = pairs[p];
    const auto size = 2 * static_cast<Index>(inner_[p].size());
    pair.value = value[2 * p] + value[2 * p + 1];
    pair.gradient.setZero(size);
    pair.hessian.setZero(size, size);
  }
  for (std::size_t k = 0; k < terms_.size(); ++k)
    add_local(x, *terms_[k], energy_[k].weight, pairs);
}

// A pair without a direction of descent, or next to its minimum, is done.
void PairEnergy::find_directions(std::vector<Pair>& pairs) const {
  for (Pair& pair : pairs) {
    if (!pair.active) continue;
    const Eigen::LLT<Eigen::MatrixXd> factor(pair.hessian);
    pair.active = std::isfinite(pair.value) && factor.info() == Eigen::Success;
    if (!pair.active) continue;
    pair.direction = -factor.solve(pair.gradient);
    pair.descent = pair.direction.dot(pair.gradient);
    pair.active = pair.descent < -kConverged * std::abs(pair.value);
  }
}

void PairEnergy::search(Vec& x, std::vector<Pair>& pairs) const {
  Vec direction = Vec::Zero(x.size());
  std::vector<Index> open;
  for (Index p = 0; p < pair_count(); ++p) {
    if (!pairs[p].active) continue;
    for_variables(p, [&](Index i, Index k) { direction[i] = pairs[p].direction[k]; });
    open.push_back(p);
  }
  for (const Index p : open) {
    double step = 1 / kPartOfLimit;
    for (const Index f : {2 * p, 2 * p + 1})
      step = std::min(step, space_->largest_step(f, x, direction, step, ProofDepth::kStart));
    pairs[p].step = kPartOfLimit * step;
  }
  if (open.empty()) return;
  const auto attempt = [&](double part) {  // of every pair's own step
    Vec trial = x;
    for (const Index p : open)
      for_variables(p, [&](Index i, Index) { trial[i] += part * pairs[p].step * direction[i]; });
    const Vec value = values(trial);
    std::erase_if(open, [&](Index p) {
      const Pair& pair = pairs[p];
      const double limit = pair.value + kArmijo * (part * pair.step) * pair.descent;
      if (!(value[2 * p] + value[2 * p + 1] <= limit)) return false;
      for_variables(p, [&](Index i, Index) { x[i] = trial[i]; });
      return true;
    });
    return open.empty() ? kTake : kHalve;
  };
  backtrack(1, {.most_trials = kMostTrials}, attempt);
  for (const Index p : open) pairs[p].active = false;
}

void PairEnergy::minimize(Vec& x) const {
  if (!curvature_ || space_->degree() == 1) return;
  const Vec start = x;
  std::vector<Pair> pairs(to_size(pair_count()));
  const auto any_active = [&] {
    return std::any_of(pairs.begin(), pairs.end(), [](const Pair& p) { return p.active; });
  };
  for (int k = 0; k < kMostPairSteps && any_active(); ++k) {
    linearize(x, pairs);
    find_directions(pairs);
    search(x, pairs);
  }
  for (Index p = 0; p < pair_count(); ++p)
    for (const Index f : {2 * p, 2 * p + 1})
      if (space_->certify(f, x, ProofDepth::kStart).result != ProofStatus::Proven)
        for_variables(p, [&](Index i, Index) { x[i] = start[i]; });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
