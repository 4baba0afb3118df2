#include "majorant/framework/internal/held_rows.h"

#include <algorithm>
#include <span>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/internal/element_visits.h"
#include "majorant/framework/internal/sensitivity_refusal.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// Batches of these elements, by rule.
class Batches {
 public:
  Batches(const TermState& state, std::vector<Index> elements) : elements_(std::move(elements)) {
    const auto rule = [&](Index e) {
      return state.element_rule.empty() ? 0 : state.element_rule[to_size(e)];
    };
    std::stable_sort(elements_.begin(), elements_.end(),
                     [&](Index a, Index b) { return rule(a) < rule(b); });
    for (std::size_t first = 0, last; first < elements_.size(); first = last) {
      last = first + 1;
      while (last < elements_.size() && last - first < ElementBatch::kMaxSize &&
             rule(elements_[last]) == rule(elements_[first]))
        ++last;
      batches_.push_back(
          {rule(elements_[first]), std::span<const Index>(elements_.data() + first, last - first)});
    }
  }
  Index batch_count() const { return static_cast<Index>(batches_.size()); }
  const ElementBatch& batch(Index c) const { return batches_[to_size(c)]; }

 private:
  std::vector<Index> elements_;
  std::vector<ElementBatch> batches_;
};

}  // namespace

Index HeldRows::count() const { return static_cast<Index>(ProblemParts::rows(problem_).size()); }

// The elimination is the same: right-hand sides enter linearly.
Vec HeldRows::moved(const Vec& change) const {
  const ConstraintRows& rows = ProblemParts::rows(problem_);
  require_size("Sensitivity: right_hand_sides", change.size(), count());
  require_finite("Sensitivity: right_hand_sides", change);
  ConstraintRows changed;
  for (Index k = 0; k < rows.auxiliary_count(); ++k) changed.add_auxiliary();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    changed.begin_row(rows.label(row));
    for (const auto* e = rows.begin(row); e != rows.end(row); ++e)
      changed.add(e->unknown, e->coefficient);
    changed.end_row(change[static_cast<Index>(row)]);
  }
  const Elimination z(problem_.full_size(), changed);
  Vec x;
  z.expand(Vec::Zero(z.reduced_size()), x);
  return x;
}

Vec HeldRows::multipliers(const Vec& slope, const Vec& u) {
  if (count() == 0) return Vec();
  const auto& k = coupling();
  if (!factors_) factorize_rows();
  Vec rest = Vec::Zero(held_count_);
  rest.head(k.rows()) = held_of(slope) - k * u;
  return factors_->solve(rest);
}

// Returns the entries of a full vector at the unknowns of the rows.
Vec HeldRows::held_of(const Vec& x) const {
  Vec out(static_cast<Index>(held_unknowns_.size()));
  for (std::size_t k = 0; k < held_unknowns_.size(); ++k)
    out[static_cast<Index>(k)] = x[held_unknowns_[k]];
  return out;
}

// Returns the rows of the Hessian by full unknowns that belong to the unknowns of constraints.
const HeldRows::Coupling& HeldRows::coupling() {
  if (coupling_) return *coupling_;
  number_held();
  using Entries = std::vector<Eigen::Triplet<double>>;
  Entries all;
  for (const TermId id : problem_.terms()) {
    const EnergyTerm& term = problem_.term(id);
    const ElementDofs& dofs = term.element_dofs();
    const TermState& state = problem_.state(id);
    const Index n = dofs.local_size();
    std::vector<Index> touching;
    for (Index e = 0; e < dofs.element_count(); ++e) {
      bool touches = false;
      for (Index k = 0; k < n && !touches; ++k) touches = held_[unknown_of(dofs, e, k)] >= 0;
      if (touches && weight_of(state, e) != 0) touching.push_back(e);
    }
    const Batches batches(state, std::move(touching));
    std::vector<Entries> parts(to_size(batches.batch_count()));
    visit_elements(
        term, batches, x_, state, true, [&](Index c, Index e, const LocalSystem& local, int p) {
          for (Index i = 0; i < n; ++i) {
            const Index row = held_[unknown_of(dofs, e, i)];
            if (row < 0) continue;
            for (Index j = 0; j < n; ++j) {
              const Index low = std::max(i, j), high = std::min(i, j);
              const auto at = to_size(low * (low + 1) / 2 + high) * LocalSystem::stride;
              parts[to_size(c)].emplace_back(row, unknown_of(dofs, e, j),
                                             weight_of(state, e) * local.hessian[at + to_size(p)]);
            }
          }
        });
    for (const Entries& part : parts) all.insert(all.end(), part.begin(), part.end());
  }
  coupling_.emplace(static_cast<Index>(held_unknowns_.size()), problem_.full_size());
  coupling_->setFromTriplets(all.begin(), all.end());
  return *coupling_;
}

void HeldRows::number_held() {
  const ConstraintRows& rows = ProblemParts::rows(problem_);
  held_.assign(to_size(problem_.full_size()), -1);
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (const auto* e = rows.begin(row); e != rows.end(row); ++e)
      if (e->unknown >= 0 && held_[to_size(e->unknown)] < 0) {
        held_[to_size(e->unknown)] = static_cast<Index>(held_unknowns_.size());
        held_unknowns_.push_back(e->unknown);
      }
}

void HeldRows::factorize_rows() {
  const ConstraintRows& rows = ProblemParts::rows(problem_);
  std::vector<Eigen::Triplet<double>> entries;
  const auto first = static_cast<Index>(held_unknowns_.size());
  held_count_ = first + rows.auxiliary_count();
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (const auto* e = rows.begin(row); e != rows.end(row); ++e)
      entries.emplace_back(e->unknown >= 0 ? held_[to_size(e->unknown)] : first + (-1 - e->unknown),
                           static_cast<Index>(row), e->coefficient);
  Eigen::SparseMatrix<double> transposed(held_count_, static_cast<Index>(rows.size()));
  transposed.setFromTriplets(entries.begin(), entries.end());
  transposed.makeCompressed();
  factors_.emplace(transposed);
  if (factors_->info() != Eigen::Success)
    refuse_sensitivity("the rows of the constraints could not be factorized");
}

Vec HeldRows::curvature_of(const Vec& moved) {
  const Coupling& rows = coupling();  // it numbers what held_of() selects
  return rows.transpose() * held_of(moved);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
