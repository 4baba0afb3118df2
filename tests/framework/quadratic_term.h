// A term made of one random quadratic per element: f_e = 1/2 x^T H x + g^T x, scaled by its rule.
#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "majorant/framework/elimination.h"
#include "majorant/framework/energy_term.h"
#include "random.h"

namespace majorant::test {

class QuadraticTerm final : public EnergyTerm {
 public:
  QuadraticTerm(ElementDofs element_dofs, Random& random, bool definite = false)
      : element_dofs_(std::move(element_dofs)) {
    const int n = element_dofs_.local_size();
    for (Index e = 0; e < element_dofs_.element_count(); ++e) {
      Eigen::MatrixXd a(n, n);
      for (int i = 0; i < n; ++i) a.row(i) = random.vector(n).transpose();
      hessians_.push_back(definite ? Eigen::MatrixXd(a * a.transpose())
                                   : Eigen::MatrixXd(a + a.transpose()));
      gradients_.push_back(random.vector(n));
    }
  }
  std::string_view name() const override { return "random quadratics"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override { return c != Curvature::Reweighted; }
  RuleId rule_count() const override { return 4; }

  Index full(Index e, int i) const {
    return element_dofs_.block * element_dofs_.nodes(e, i / element_dofs_.block) +
           i % element_dofs_.block;
  }
  static double scale(RuleId rule) { return 1 + 0.5 * rule; }
  const Eigen::MatrixXd& hessian(Index e) const { return hessians_[static_cast<std::size_t>(e)]; }
  const Vec& gradient(Index e) const { return gradients_[static_cast<std::size_t>(e)]; }

  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const Vec local = gather(x, e);
      f[p] = scale(batch.rule) * (0.5 * local.dot(hessian(e) * local) + gradient(e).dot(local));
    }
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const double s = scale(batch.rule);
      const Vec g = s * (hessian(e) * gather(x, e) + gradient(e));
      for (int i = 0, k = 0; i < element_dofs_.local_size(); ++i) {
        out.gradient[static_cast<std::size_t>(i) * LocalSystem::stride + p] = g[i];
        for (int j = 0; out.hessian && j <= i; ++j, ++k)
          out.hessian[static_cast<std::size_t>(k) * LocalSystem::stride + p] = s * hessian(e)(i, j);
      }
    }
  }

  // Adds the dense Hessian and gradient in the full unknowns.
  void add_dense(VecIn x, const TermState& state, Eigen::MatrixXd& h, Vec& g) const {
    for (Index e = 0; e < element_dofs_.element_count(); ++e) {
      const double rule = state.element_rule.empty()
                              ? scale(0)
                              : scale(state.element_rule[static_cast<std::size_t>(e)]);
      const double w =
          rule * state.weight * (state.element_weight.size() ? state.element_weight[e] : 1.0);
      const Vec local = hessian(e) * gather(x, e) + gradient(e);
      for (int i = 0; i < local.size(); ++i) {
        g[full(e, i)] += w * local[i];
        for (int j = 0; j < local.size(); ++j) h(full(e, i), full(e, j)) += w * hessian(e)(i, j);
      }
    }
  }

 private:
  Vec gather(VecIn x, Index e) const {
    Vec local(element_dofs_.local_size());
    for (int i = 0; i < local.size(); ++i) local[i] = x[full(e, i)];
    return local;
  }
  ElementDofs element_dofs_;
  std::vector<Eigen::MatrixXd> hessians_;
  std::vector<Vec> gradients_;
};

inline ElementDofs random_elements(Random& random, Index elements, int nodes, Index node_count,
                                   int block) {
  ElementDofs s{Cells(elements, nodes), block};
  for (Index e = 0; e < elements; ++e)
    for (int k = 0; k < nodes; ++k) s.nodes(e, k) = random.integer(0, node_count - 1);
  return s;
}

// Returns elements of consecutive nodes: a mesh-like pattern of many batches.
inline ElementDofs band_elements(Index elements, int nodes, int block) {
  ElementDofs s{Cells(elements, nodes), block};
  for (Index e = 0; e < elements; ++e)
    for (int k = 0; k < nodes; ++k) s.nodes(e, k) = e + k;
  return s;
}

inline Eigen::MatrixXd dense_z(const Elimination& z) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(z.full_size(), z.reduced_size());
  for (Index i = 0; i < z.full_size(); ++i)
    for (const auto& e : z.row(i)) m(i, e.reduced) += e.coefficient;
  return m;
}

// Constraint rows with given coefficients.
class Rows final : public Constraint {
 public:
  Rows& row(std::vector<std::pair<Index, long>> entries, double rhs) {
    rows_.push_back({std::move(entries), rhs});
    return *this;
  }
  void append_rows(ConstraintRows& out) const override {
    for (const auto& [entries, rhs] : rows_) {
      out.begin_row("test row");
      for (const auto& [unknown, coefficient] : entries) out.add(unknown, coefficient);
      out.end_row(rhs);
    }
  }

 private:
  std::vector<std::pair<std::vector<std::pair<Index, long>>, double>> rows_;
};

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
