#include "majorant/framework/terms/internal/manifold_term.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/detail/packed_symmetric.h"

namespace majorant {
namespace {

Index unknown_at(const ElementDofs& dofs, Index e, Index k) {
  return dofs.block * dofs.nodes(e, k / dofs.block) + k % dofs.block;
}

class ManifoldEquality final : public ManifoldTerm, public EqualityTerm {
 public:
  template <class... Arguments>
  explicit ManifoldEquality(Arguments&&... arguments)
      : ManifoldTerm(std::forward<Arguments>(arguments)...) {}
};

}  // namespace

// The first and second derivatives of the points of an element, one point after the other.
struct ManifoldTerm::Derivatives {
  std::vector<double> slopes, bends;
  std::vector<std::size_t> slope_starts, bend_starts;  // by owner
};

std::shared_ptr<const ManifoldTerm> ManifoldTerm::make(std::shared_ptr<const EnergyTerm> term,
                                                       std::shared_ptr<const ManifoldPoints> points,
                                                       const ManifoldPoints::Chart& chart,
                                                       ChartIs chart_is) {
  if (dynamic_cast<const EqualityTerm*>(term.get()))
    return std::make_shared<const ManifoldEquality>(std::move(term), std::move(points), chart,
                                                    chart_is);
  return std::shared_ptr<const ManifoldTerm>(
      new ManifoldTerm(std::move(term), std::move(points), chart, chart_is));
}

ManifoldTerm::ManifoldTerm(std::shared_ptr<const EnergyTerm> term,
                           std::shared_ptr<const ManifoldPoints> points,
                           const ManifoldPoints::Chart& chart, ChartIs chart_is)
    : term_(std::move(term)),
      points_(std::move(points)),
      chart_is_(chart_is),
      chart_(chart.bases.size() + chart.origins.size()) {
  chart_.head(chart.bases.size()) = chart.bases;
  chart_.tail(chart.origins.size()) = chart.origins;
  const ElementDofs& dofs = term_->element_dofs();
  const Index elements = dofs.element_count(), n = dofs.local_size();
  std::vector<std::vector<Index>> coordinates(to_size(elements));
  places_.resize(elements, n);
  owner_starts_.push_back(0);
  std::size_t most = 1;
  for (Index e = 0; e < elements; ++e) {
    std::vector<Index>& own = coordinates[to_size(e)];
    // Returns the place of the coordinates from `first` on; adds them if they are new.
    const auto place = [&](Index first, int count) {
      const auto found = std::find(own.begin(), own.end(), first);
      const auto at = static_cast<Index>(found - own.begin());
      if (found == own.end())
        for (int a = 0; a < count; ++a) own.push_back(first + a);
      return at;
    };
    for (Index k = 0; k < n; ++k) {
      const Index unknown = unknown_at(dofs, e, k), p = points_->point_of(unknown);
      if (p < 0) {
        places_(e, k) = place(points_->coordinate_of(unknown), 1);
        continue;
      }
      const auto& point = points_->points()[to_size(p)];
      places_(e, k) = place(point.first, point.manifold->dimension());
      const auto first = owners_.begin() + static_cast<std::ptrdiff_t>(owner_starts_.back());
      if (std::find(first, owners_.end(), p) == owners_.end()) owners_.push_back(p);
    }
    owner_starts_.push_back(owners_.size());
    most = std::max(most, own.size());
  }
  element_dofs_.nodes.resize(elements, static_cast<Index>(most));
  for (Index e = 0; e < elements; ++e) {
    const std::vector<Index>& own = coordinates[to_size(e)];
    element_dofs_.node_counts.push_back(static_cast<int>(own.size()));
    for (std::size_t a = 0; a < most; ++a)
      element_dofs_.nodes(e, static_cast<Index>(a)) = own[a < own.size() ? a : 0];
  }
  parameters_ = chart_is_ == ChartIs::Fixed ? own_parameters({}) : parameters_on(chart, {});
}

Vec ManifoldTerm::parameters_on(const ManifoldPoints::Chart& chart, const TermState& state) const {
  const Vec own = own_parameters(state);
  Vec all(own.size() + chart.bases.size() + chart.origins.size());
  all.head(own.size()) = own;
  all.segment(own.size(), chart.bases.size()) = chart.bases;
  all.tail(chart.origins.size()) = chart.origins;
  return all;
}

Vec ManifoldTerm::own_parameters(const TermState& state) const {
  const Index own = term_->parameter_count();
  if (own == 0) return {};
  return state.parameters.size() > 0 ? Vec(state.parameters.head(own)) : term_->parameters();
}

const double* ManifoldTerm::chart_of(const TermState& state) const {
  if (chart_is_ == ChartIs::Fixed) return chart_.data();
  const Vec& parameters = state.parameters.size() > 0 ? state.parameters : parameters_;
  return parameters.data() + term_->parameter_count();
}

TermState ManifoldTerm::inner_state(const TermState& state) const {
  return {.parameters = own_parameters(state)};
}

void ManifoldTerm::move_element(Index element, VecIn y, const double* chart, double* x,
                                Derivatives* derivatives) const {
  const ElementDofs& dofs = term_->element_dofs();
  for (Index k = 0; k < dofs.local_size(); ++k) {
    const Index unknown = unknown_at(dofs, element, k);
    if (points_->point_of(unknown) < 0) x[unknown] = y[points_->coordinate_of(unknown)];
  }
  const std::size_t first = owner_starts_[to_size(element)],
                    last = owner_starts_[to_size(element) + 1];
  const Index origins = chart_.size() - points_->coordinate_count();
  std::vector<double> t, at;
  if (derivatives) *derivatives = {};
  for (std::size_t o = first; o < last; ++o) {
    const auto& point = points_->points()[to_size(owners_[o])];
    const auto d = to_size(point.manifold->dimension()), size = to_size(point.manifold->size());
    t.resize(d);
    at.resize(size);
    for (std::size_t a = 0; a < d; ++a) {
      const Index c = point.first + static_cast<Index>(a);
      t[a] = y[c] - chart[origins + c];
    }
    double *slopes = nullptr, *bends = nullptr;
    if (derivatives) {
      derivatives->slope_starts.push_back(derivatives->slopes.size());
      derivatives->bend_starts.push_back(derivatives->bends.size());
      derivatives->slopes.resize(derivatives->slopes.size() + size * d);
      derivatives->bends.resize(derivatives->bends.size() + size * d * (d + 1) / 2);
      slopes = derivatives->slopes.data() + derivatives->slope_starts.back();
      bends = derivatives->bends.data() + derivatives->bend_starts.back();
    }
    point.manifold->retract(chart + point.base, t.data(), at.data(), slopes, bends);
    for (std::size_t k = 0; k < size; ++k) x[point.unknowns[k]] = at[k];
  }
}

void ManifoldTerm::values(VecIn y, const ElementBatch& batch, const TermState& state,
                          Workspace& workspace, std::span<double> f) const {
  const double* const chart = chart_of(state);
  double* const x = workspace.reserve(to_size(points_->unknown_count()));
  for (const Index e : batch.elements) move_element(e, y, chart, x, nullptr);
  Workspace inner;
  term_->values(Eigen::Map<const Vec>(x, points_->unknown_count()), batch, inner_state(state),
                inner, f);
}

void ManifoldTerm::local(VecIn y, const ElementBatch& batch, BlendedCurvature curvature,
                         const TermState& state, Workspace& workspace, LocalSystem& out) const {
  constexpr std::size_t stride = LocalSystem::stride;
  const ElementDofs& dofs = term_->element_dofs();
  const auto n = to_size(dofs.local_size()), m = to_size(element_dofs_.local_size());
  const double* const chart = chart_of(state);

  // Evaluates the term at its own unknowns. The Hessian is projected, if at all, in the tangent
  // coordinates.
  const bool is_blend =
      curvature.model == Curvature::Exact || curvature.model == Curvature::Projected;
  const bool projects_here = is_blend && term_->supports(Curvature::Exact) &&
                             !dynamic_cast<const ResidualTerm*>(term_.get());
  const BlendedCurvature inner_curvature =
      projects_here ? BlendedCurvature(Curvature::Exact) : curvature;
  const double bend_weight = projects_here ? 1.0
                             : is_blend    ? std::max(0.0, 1 - curvature.projection_weight)
                                           : 0.0;
  const std::size_t unknowns = to_size(points_->unknown_count()), packed = n * (n + 1) / 2;
  const std::size_t aligned = (unknowns + 7) / 8 * 8;
  double* const x = workspace.reserve(aligned + (1 + n + (out.hessian ? packed : 0)) * stride);
  LocalSystem own{x + aligned, x + aligned + stride, nullptr};
  if (out.hessian) own.hessian = own.gradient + n * stride;
  std::vector<Derivatives> derivatives(batch.elements.size());
  for (std::size_t p = 0; p < batch.elements.size(); ++p)
    move_element(batch.elements[p], y, chart, x, &derivatives[p]);
  Workspace inner;
  term_->local(Eigen::Map<const Vec>(x, points_->unknown_count()), batch, inner_curvature,
               inner_state(state), inner, own);

  Eigen::MatrixXd J(n, m), H(n, n), moved(m, m);
  Vec g(static_cast<Index>(n));
  std::vector<double> triangle(m * (m + 1) / 2);
  for (std::size_t p = 0; p < batch.elements.size(); ++p) {
    const Index e = batch.elements[p];
    const Derivatives& d = derivatives[p];
    const auto first = owners_.begin() + static_cast<std::ptrdiff_t>(owner_starts_[to_size(e)]);
    const auto last = owners_.begin() + static_cast<std::ptrdiff_t>(owner_starts_[to_size(e) + 1]);
    J.setZero();
    moved.setZero();
    for (std::size_t k = 0; k < n; ++k) {
      const auto row = static_cast<Index>(k);
      g[row] = own.gradient[k * stride + p];
      const Index unknown = unknown_at(dofs, e, row), owner = points_->point_of(unknown);
      const Index place = places_(e, row);
      if (owner < 0) {
        J(row, place) = 1;
        continue;
      }
      const auto o = static_cast<std::size_t>(std::find(first, last, owner) - first);
      const int dimension = points_->points()[to_size(owner)].manifold->dimension();
      const int at = points_->place_of(unknown);
      const double* const slopes = d.slopes.data() + d.slope_starts[o] + at * dimension;
      const double* bends =
          d.bends.data() + d.bend_starts[o] + at * dimension * (dimension + 1) / 2;
      for (int a = 0; a < dimension; ++a) {
        J(row, place + a) = slopes[a];
        for (int b = 0; b <= a; ++b, ++bends)
          moved(place + a, place + b) += bend_weight * g[row] * *bends;
      }
    }
    out.value[p] = own.value[p];
    const Vec slope = J.transpose() * g;
    for (std::size_t a = 0; a < m; ++a) out.gradient[a * stride + p] = slope[static_cast<Index>(a)];
    if (!out.hessian) continue;
    for (std::size_t i = 0, k = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k)
        H(static_cast<Index>(i), static_cast<Index>(j)) =
            H(static_cast<Index>(j), static_cast<Index>(i)) = own.hessian[k * stride + p];
    moved.triangularView<Eigen::Lower>() += J.transpose() * H * J;
    for (std::size_t i = 0, k = 0; i < m; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k)
        triangle[k] = moved(static_cast<Index>(i), static_cast<Index>(j));
    if (projects_here && curvature.projection_weight > 0)
      clamp_eigenvalues(static_cast<int>(m), curvature.projection_weight, triangle.data());
    for (std::size_t k = 0; k < triangle.size(); ++k) out.hessian[k * stride + p] = triangle[k];
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
