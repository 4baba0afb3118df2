#include "majorant/framework/terms/local_term.h"

#include <utility>
#include <vector>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

// Has an element for each unknown with a coefficient other than 0.
class LinearTerm final : public EnergyTerm {
 public:
  LinearTerm(std::string name, Vec coefficients)
      : name_(std::move(name)), coefficients_(std::move(coefficients)) {
    if (!coefficients_.allFinite())
      throw InvalidArgument("term '" + name_ + "': a coefficient is not finite");
    std::vector<Index> used;
    for (Index k = 0; k < coefficients_.size(); ++k)
      if (coefficients_[k] != 0) used.push_back(k);
    element_dofs_.nodes = Eigen::Map<const Cells>(used.data(), static_cast<Index>(used.size()), 1);
  }
  std::string_view name() const override { return name_; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }
  Index full_size() const override { return coefficients_.size(); }

  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index unknown = element_dofs_.nodes(batch.elements[p], 0);
      f[p] = coefficients_[unknown] * x[unknown];
    }
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      out.gradient[p] = coefficients_[element_dofs_.nodes(batch.elements[p], 0)];
      if (out.hessian) out.hessian[p] = 0;
    }
  }

 private:
  std::string name_;
  Vec coefficients_;
  ElementDofs element_dofs_;
};

}  // namespace

std::shared_ptr<const EnergyTerm> linear_term(std::string name, Vec coefficients) {
  return std::make_shared<const LinearTerm>(std::move(name), std::move(coefficients));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
