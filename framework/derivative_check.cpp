#include "majorant/framework/derivative_check.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace majorant {
namespace {

struct LocalValues {
  double value;
  Vec gradient;
  Eigen::MatrixXd hessian;
};

// One element of a term, evaluated alone.
class ElementProbe {
 public:
  ElementProbe(const EnergyTerm& term, const TermState& state, Index element)
      : term_(term), state_(state), element_{element} {
    const Stencils& s = term.stencils();
    for (Index k = 0; k < s.nodes.cols(); ++k)
      for (int c = 0; c < s.block; ++c) unknowns_.push_back(s.block * s.nodes(element, k) + c);
    chunk_.rule = state.element_rule.empty()
                      ? 0
                      : state.element_rule[static_cast<std::size_t>(element)];
    chunk_.elements = element_;
  }

  const std::vector<Index>& unknowns() const { return unknowns_; }

  double value(VecIn x) {
    double f = 0;
    term_.values(x, chunk_, state_, kernel_, {&f, 1});
    return f;
  }

  LocalValues local(VecIn x, Curvature curvature) {
    const auto n = static_cast<int>(unknowns_.size());
    constexpr int stride = LocalSystem::stride;
    LocalSystem out;
    out.value = memory_.reserve(static_cast<std::size_t>((1 + n + n * (n + 1) / 2) * stride));
    out.gradient = out.value + stride;
    out.hessian = out.gradient + n * stride;
    term_.local(x, chunk_, curvature, state_, kernel_, out);
    LocalValues v{out.value[0], Vec(n), Eigen::MatrixXd(n, n)};
    for (int i = 0, k = 0; i < n; ++i) {
      v.gradient[i] = out.gradient[i * stride];
      for (int j = 0; j <= i; ++j, ++k) v.hessian(i, j) = v.hessian(j, i) = out.hessian[k * stride];
    }
    return v;
  }

 private:
  const EnergyTerm& term_;
  const TermState& state_;
  std::array<Index, 1> element_;
  Chunk chunk_;
  std::vector<Index> unknowns_;
  Workspace kernel_, memory_;
};

struct Worst {
  double error = 0;
  DerivativeMismatch mismatch{};
  void update(double relative, Index element, std::string block, double computed, double expected) {
    if (!(relative <= error)) {  // NaN counts
      error = std::isnan(relative) ? std::numeric_limits<double>::infinity() : relative;
      mismatch = {element, std::move(block), computed, expected};
    }
  }
};

constexpr std::array<std::pair<Curvature, const char*>, 4> kSemidefinite{
    {{Curvature::Projected, "projected"},
     {Curvature::Majorizer, "majorizer"},
     {Curvature::PaperMajorizer, "paper-majorizer"},
     {Curvature::Reweighted, "reweighted"}}};

}  // namespace

std::string DerivativeReport::message() const {
  std::string text;
  for (const DerivativeMismatch& m : mismatches)
    text += fmt::format("element {}: {} is {:.9g}, expected {:.9g}\n", m.element, m.block,
                        m.computed, m.expected);
  return text;
}

DerivativeReport check_derivatives(const EnergyTerm& term, VecIn x, double tolerance,
                                   const TermState& state) {
  DerivativeReport report;
  Vec y = x;
  const bool exact = term.supports(Curvature::Exact);
  for (Index e = 0; e < term.stencils().element_count(); ++e) {
    ElementProbe probe(term, state, e);
    const auto n = static_cast<int>(probe.unknowns().size());
    Curvature first = Curvature::Exact;
    for (const auto& c : kSemidefinite)
      if (!exact && term.supports(c.first)) first = c.first;
    const LocalValues at = probe.local(x, first);
    double size = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j)
        size = std::max(size, std::abs(x[probe.unknowns()[static_cast<std::size_t>(i)]] -
                                       x[probe.unknowns()[static_cast<std::size_t>(j)]]));
    if (size == 0) size = 1;
    const double h = 1e-5 * size;
    const double g_scale = at.gradient.cwiseAbs().maxCoeff() + std::abs(at.value) / size;
    const double h_scale = at.hessian.cwiseAbs().maxCoeff() + g_scale / size;
    Worst gradient, hessian, definite;
    gradient.update(std::abs(at.value - probe.value(x)) / (g_scale * size), e, "value", at.value,
                    probe.value(x));
    for (int i = 0; i < n; ++i) {
      const Index u = probe.unknowns()[static_cast<std::size_t>(i)];
      y[u] = x[u] + h;
      const double above = probe.value(y);
      const Vec g_above = exact ? probe.local(y, Curvature::Exact).gradient : Vec();
      y[u] = x[u] - h;
      const double g = (above - probe.value(y)) / (2 * h);
      gradient.update(std::abs(at.gradient[i] - g) / g_scale, e, fmt::format("gradient[{}]", i),
                      at.gradient[i], g);
      if (exact) {
        const Vec column = (g_above - probe.local(y, Curvature::Exact).gradient) / (2 * h);
        for (int j = 0; j < n; ++j)
          hessian.update(std::abs(at.hessian(j, i) - column[j]) / h_scale, e,
                         fmt::format("hessian({}, {})", j, i), at.hessian(j, i), column[j]);
      }
      y[u] = x[u];
    }
    for (const auto& [curvature, label] : kSemidefinite) {
      if (!term.supports(curvature)) continue;
      const Eigen::MatrixXd k = probe.local(x, curvature).hessian;
      const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues()[0];
      definite.update(std::max(0.0, -lowest) / h_scale, e, fmt::format("curvature {}", label),
                      lowest, 0);
    }
    report.gradient_error = std::max(report.gradient_error, gradient.error);
    report.hessian_error = std::max(report.hessian_error, hessian.error);
    for (const Worst* worst : {&gradient, &hessian, &definite})
      if (worst->error > tolerance) report.mismatches.push_back(worst->mismatch);
  }
  return report;
}

}  // namespace majorant
