#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"

namespace majorant {

static_assert(BatchView::stride == ElementBatch::kMaxSize &&
              BatchView::stride == LocalSystem::stride);

DensityTerm::DensityTerm(DensityTraits traits, std::shared_ptr<const ElementSpace> space,
                         std::shared_ptr<const RestShapes> shapes,
                         const std::vector<Quadrature>& rules, std::shared_ptr<const void> density,
                         const DensityKernels& kernels)
    : traits_(std::move(traits)),
      rest_(given("DensityTerm: the rest shapes", std::move(shapes))),
      space_(given("DensityTerm: the space", std::move(space))),
      density_(given("DensityTerm: the density", std::move(density))),
      kernels_(kernels) {
  const auto refuse = [&](const std::string& what) {
    throw InvalidArgument(fmt::format("energy '{}': {}", traits_.name, what));
  };
  const RestShapes& rest = *rest_;
  if (rules.empty()) refuse("no quadrature rule");
  if (rest.measure.size() != space_->element_count() ||
      (rest.curved() ? rest.nodes.rows() != space_->node_count() || rest.nodes.cols() < rest.dim
                     : rest.inverse.rows() != space_->element_count() ||
                           rest.inverse.cols() != rest.dim * rest.dim))
    refuse(fmt::format("rest shapes of {} elements do not fit the space, which has {}",
                       rest.measure.size(), space_->element_count()));
  if (kernels.dims != space_->reference_dim() || rest.dim != space_->reference_dim())
    refuse(
        fmt::format("the density is for elements of {} dimensions, the rest shapes have {}, the "
                    "elements {}",
                    kernels.dims, rest.dim, space_->reference_dim()));
  for (Index e = 0; e < rest.measure.size(); ++e)
    if (!(rest.measure[e] > 0) || !std::isfinite(rest.measure[e]) ||
        (!rest.curved() && !rest.inverse.row(e).allFinite()))
      refuse(fmt::format("the rest shape of element {} is degenerate (measure {:g})", e,
                         rest.measure[e] + 0.0));  // no -0
  if (traits_.elements.value_or(space_->element_count()) != space_->element_count())
    refuse(fmt::format("data for {} elements, the space has {}", *traits_.elements,
                       space_->element_count()));
  element_dofs_.nodes = space_->cells();
  element_dofs_.block = kernels.rows;
  for (const Quadrature& q : rules) {
    rules_.push_back(std::make_unique<Rule>());
    rules_.back()->quadrature = q;
  }
}

bool DensityTerm::supports(Curvature curvature) const {
  const auto& all = traits_.curvatures;
  return std::find(all.begin(), all.end(), curvature) != all.end();
}

const DensityTerm::Rule& DensityTerm::rule(RuleId id) const {
  Rule& r = *rules_[static_cast<std::size_t>(id)];
  std::call_once(r.built, [&] {
    r.table = space_->tabulate(r.quadrature);
    r.weighted_shape_gradient = r.table.weights.asDiagonal() * r.table.shape_gradient;
    r.weighted_gradient_product = r.table.weights.asDiagonal() * r.table.gradient_product;
    if (traits_.dilatation_degree && !rest_->curved()) {
      r.modes = dilatation_modes(r.quadrature, r.table.weights, *traits_.dilatation_degree);
      r.mode_count = r.modes.count();
    }
    if (rest_->curved()) tabulate_curved(r);
  });
  return r;
}

void DensityTerm::tabulate_curved(Rule& r) const {
  const Index count = space_->element_count();
  for (Index e = 0; e < count; ++e) {
    RowMatrix rest = tabulate_rest(*rest_, *space_, r.table, e);
    rest.rightCols(1) *= space_->reference_measure();
    if (traits_.dilatation_degree) {
      const Vec weights = r.table.weights.cwiseProduct(rest.rightCols(1).col(0));
      const DilatationModes modes =
          dilatation_modes(r.quadrature, weights, *traits_.dilatation_degree);
      r.mode_count = modes.count();
      const Index columns = static_cast<Index>(rest.cols());
      rest.conservativeResize(Eigen::NoChange, columns + r.mode_count);
      rest.rightCols(r.mode_count) = modes.values;
    }
    if (e == 0) r.rest.resize(count, rest.size());
    r.rest.row(e) = Eigen::Map<const Eigen::RowVectorXd>(rest.data(), rest.size());
  }
}

ContractionView DensityTerm::Rule::view() const {
  ContractionView v{};
  v.nodes = table.nodes;
  v.points = static_cast<int>(table.weights.size());
  v.shape_gradient_count = static_cast<int>(table.shape_gradient.cols());
  v.gradient_product_count = static_cast<int>(table.gradient_product.cols());
  v.direction_count = static_cast<int>(table.directions.rows());
  v.gradient_count = static_cast<int>(table.gradient.size());
  v.directions = table.directions.data();
  v.weights = table.weights.data();
  v.shape_gradient = table.shape_gradient.data();
  v.weighted_shape_gradient = weighted_shape_gradient.data();
  v.weighted_gradient_product = weighted_gradient_product.data();
  v.gradient = table.gradient.data();
  v.hessian = table.hessian.data();
  v.pair_starts = table.pair_starts.data();
  v.mode_count = mode_count;
  v.modes = modes.values.data();
  return v;
}

int DensityTerm::rest_rows(const ContractionView& table) const {
  return rest_->dim * rest_->dim + 1 + (rest_->curved() ? table.mode_count : 0);
}

DensityTerm::Gathered DensityTerm::gather(VecIn x, const ElementBatch& batch, const Rule& rule,
                                          const ContractionView& table, Workspace& w) const {
  constexpr int stride = BatchView::stride;
  const int block = element_dofs_.block, rows = element_dofs_.local_size();
  const int per_point = rest_rows(table);
  const int rest_rows = rest_->curved() ? per_point * table.points : per_point;
  const auto count = static_cast<int>(batch.elements.size());
  const auto total =
      static_cast<std::size_t>((rows + rest_rows + 1) * stride + kernels_.scratch_size(table));
  double* memory = w.reserve(total);
  double* rest = memory + rows * stride;
  double* values = rest + rest_rows * stride;
  const int padded = (count + 7) / 8 * 8;
  Index elements[stride], first[stride];  // elements, and the first unknown of their nodes
  for (int p = 0; p < padded; ++p) elements[p] = batch.elements[std::min(p, count - 1)];
  double* to = memory;
  for (int k = 0; k < rows / block; ++k) {
    for (int p = 0; p < padded; ++p) first[p] = block * element_dofs_.nodes(elements[p], k);
    for (int c = 0; c < block; ++c, to += stride)
      for (int p = 0; p < padded; ++p) to[p] = x[first[p] + c];
  }
  to = rest;
  for (int k = 0; k < rest_rows; ++k, to += stride)
    for (int p = 0; p < padded; ++p)
      to[p] = rest_->curved()      ? rule.rest(elements[p], k)
              : k == per_point - 1 ? rest_->measure[elements[p]]
                                   : rest_->inverse(elements[p], k);
  const BatchView view{count, batch.elements.data(), memory, rest, rest_->curved() ? per_point : 0};
  return {view, values + stride, values};
}

std::shared_ptr<const void> DensityTerm::density(const TermState& state) const {
  if (state.parameters.size() == 0 || !traits_.with_parameters) return density_;
  return traits_.with_parameters(state.parameters);
}

void DensityTerm::values(VecIn x, const ElementBatch& batch, const TermState& state,
                         Workspace& workspace, std::span<double> f) const {
  if (batch.elements.empty()) return;
  const Rule& tables = rule(batch.rule);
  const ContractionView table = tables.view();
  const Gathered g = gather(x, batch, tables, table, workspace);
  kernels_.values(density(state).get(), table, g.batch, g.scratch, g.values);
  std::copy_n(g.values, batch.elements.size(), f.begin());
}

void DensityTerm::local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature,
                        const TermState& state, Workspace& workspace, LocalSystem& out) const {
  if (batch.elements.empty()) return;
  const Rule& tables = rule(batch.rule);
  const ContractionView table = tables.view();
  const Gathered g = gather(x, batch, tables, table, workspace);
  const auto local = for_comparisons(curvature.model) && kernels_.local_of_comparisons
                         ? kernels_.local_of_comparisons
                         : kernels_.local;
  local(density(state).get(), table, g.batch, curvature, g.scratch, out.value, out.gradient,
        out.hessian);
}

RowMatrix DensityTerm::pressures(VecIn x, const RowMatrix& points) const {
  if (!kernels_.pressures)
    throw InvalidArgument("DensityTerm: '" + traits_.name + "' has no projected dilatation");
  const Rule& tables = rule(0);
  const ContractionView table = tables.view();
  const int degree = *traits_.dilatation_degree;
  const Factors& cell = tables.quadrature.cell;
  const RowMatrix here = dilatation_monomials(cell, tables.quadrature.points, degree);
  const RowMatrix there = dilatation_monomials(cell, points, degree);
  const auto fit = here.colPivHouseholderQr();  // pressures are polynomials of this degree
  const Index count = space_->element_count();
  constexpr int stride = BatchView::stride;
  RowMatrix out(count, points.rows());
  std::vector<double> at_points(to_size(table.points * stride));
  std::vector<Index> elements;
  Workspace workspace;
  for (Index first = 0; first < count; first += stride) {
    elements.clear();
    for (Index e = first; e < std::min(count, first + stride); ++e) elements.push_back(e);
    const Gathered g = gather(x, {0, elements}, tables, table, workspace);
    kernels_.pressures(density_.get(), table, g.batch, g.scratch, at_points.data());
    for (std::size_t p = 0; p < elements.size(); ++p) {
      const Vec values = Eigen::Map<const Vec, 0, Eigen::InnerStride<>>(
          at_points.data() + p, table.points, Eigen::InnerStride<>(stride));
      out.row(elements[p]) = there * fit.solve(values);
    }
  }
  return out;
}

StarModel DensityTerm::star(const StarView& view, const Vector2& v) const {
  if (!kernels_.star)
    throw InvalidArgument("DensityTerm: '" + traits_.name +
                          "' is not of planar maps, or not the same on all elements");
  StarModel model;
  kernels_.star(density_.get(), view, v.x(), v.y(), model);
  return model;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
