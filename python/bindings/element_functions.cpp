#include "element_functions.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "arrays.h"
#include "kept.h"
#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/equality_term.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/residual_term.h"

namespace majorant::python {
namespace {

// The unknowns of the elements, an element a row, and their numbers.
py::tuple arguments_of(const ElementDofs& dofs, VecIn x, std::span<const Index> batch) {
  const int n = dofs.local_size();
  const auto count = static_cast<py::ssize_t>(batch.size());
  py::array_t<double> unknowns({count, static_cast<py::ssize_t>(n)});
  Integers elements(count);
  for (py::ssize_t p = 0; p < count; ++p) {
    const Index e = batch[static_cast<std::size_t>(p)];
    elements.mutable_at(p) = e;
    for (int k = 0; k < n; ++k)
      unknowns.mutable_at(p, k) = x[dofs.block * dofs.nodes(e, k / dofs.block) + k % dofs.block];
  }
  return py::make_tuple(unknowns, elements);
}

double finite(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

class PythonTerm : public EnergyTerm {
 public:
  PythonTerm(std::string name, ElementDofs element_dofs, py::object function,
             std::vector<Curvature> curvatures, TermData data)
      : name_(std::move(name)),
        element_dofs_(std::move(element_dofs)),
        function_(std::move(function)),
        curvatures_(std::move(curvatures)),
        data_(std::move(data)) {}

  std::string_view name() const override { return name_; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return std::find(curvatures_.begin(), curvatures_.end(), c) != curvatures_.end();
  }

  Index parameter_count() const override { return static_cast<Index>(data_.numbers.size()); }
  Vec parameters() const override { return data_.numbers; }
  Index parameters_per_element() const override { return data_.per_element; }

  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace&,
              std::span<double> f) const override {
    const py::gil_scoped_acquire lock;
    const py::tuple at = arguments_of(element_dofs_, x, batch.elements);
    const py::tuple data = data_of(state, batch.elements);
    const Doubles found = function_.get().attr("evaluate")(*at, *data).cast<Doubles>();
    for (std::size_t p = 0; p < batch.elements.size(); ++p) f[p] = finite(found.at(p));
  }

  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace&, LocalSystem& out) const override {
    const py::gil_scoped_acquire lock;
    const int n = element_dofs_.local_size();
    const py::tuple at = arguments_of(element_dofs_, x, batch.elements);
    const double exact = curvature.model == Curvature::Reweighted
                             ? 0.0
                             : std::max(0.0, 1 - curvature.projection_weight);
    const py::tuple data = data_of(state, batch.elements);
    const Doubles value = function_.get().attr("evaluate")(*at, *data).cast<Doubles>();
    const py::tuple derivatives = function_.get().attr("differentiate")(*at, exact, *data);
    const Doubles gradient = derivatives[0].cast<Doubles>();
    const Doubles hessian = derivatives[1].cast<Doubles>();
    const bool clamps = !supports(Curvature::Reweighted) && curvature.projection_weight > 0;
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      out.value[p] = finite(value.at(p));
      for (int i = 0; i < n; ++i)
        out.gradient[static_cast<std::size_t>(i) * LocalSystem::stride + p] = gradient.at(p, i);
      if (!out.hessian) continue;
      std::vector<double> packed;
      for (int i = 0; i < n; ++i)
        packed.insert(packed.end(), hessian.data(p, i), hessian.data(p, i) + i + 1);
      if (clamps) clamp_eigenvalues(n, curvature.projection_weight, packed.data());
      for (std::size_t k = 0; k < packed.size(); ++k)
        out.hessian[k * LocalSystem::stride + p] = packed[k];
    }
  }

 protected:
  py::handle function() const { return function_.get(); }
  // Nothing, the vector, or the rows of the elements.
  py::tuple data_of(const TermState& state, std::span<const Index> batch) const {
    if (data_.numbers.size() == 0) return py::tuple();
    const Vec& numbers = state.parameters.size() > 0 ? state.parameters : data_.numbers;
    if (data_.per_element == 0)
      return py::make_tuple(Doubles(static_cast<py::ssize_t>(numbers.size()), numbers.data()));
    Doubles rows(
        {static_cast<py::ssize_t>(batch.size()), static_cast<py::ssize_t>(data_.per_element)});
    for (std::size_t p = 0; p < batch.size(); ++p)
      std::copy_n(numbers.data() + batch[p] * data_.per_element, data_.per_element,
                  rows.mutable_data(static_cast<py::ssize_t>(p), 0));
    return py::make_tuple(rows);
  }

 private:
  std::string name_;
  ElementDofs element_dofs_;
  Kept function_;
  std::vector<Curvature> curvatures_;
  TermData data_;
};

class PythonSquares final : public PythonTerm, public ResidualTerm {
 public:
  using PythonTerm::PythonTerm;

  void residuals(VecIn x, Index element, const TermState& state, Vec& residuals,
                 RowMatrix* jacobian) const override {
    const py::gil_scoped_acquire lock;
    const std::array<Index, 1> one{element};
    const py::tuple at = arguments_of(element_dofs(), x, one), data = data_of(state, one);
    const Doubles r = function().attr("residuals")(*at, *data).cast<Doubles>();
    residuals = Eigen::Map<const Vec>(r.data(), r.size());
    if (!jacobian) return;
    const Doubles J = function().attr("jacobian")(*at, *data).cast<Doubles>();
    *jacobian = Eigen::Map<const RowMatrix>(J.data(), r.size(), element_dofs().local_size());
  }
  std::array<double, 3> loss(double s) const override {
    const py::gil_scoped_acquire lock;
    return function().attr("loss")(s).cast<std::array<double, 3>>();
  }
};

class PythonEquality final : public PythonTerm, public EqualityTerm {
 public:
  using PythonTerm::PythonTerm;
};

// g + slack > 0; paths are not certified. As Inequality has it (framework/terms/inequality.h).
class PythonInequality final : public BarrierChecker, public ViolationMeasure {
 public:
  PythonInequality(std::string name, ElementDofs element_dofs, std::shared_ptr<const Kept> function,
                   double slack)
      : name_(std::move(name)),
        element_dofs_(std::move(element_dofs)),
        function_(std::move(function)),
        slack_(slack) {}

  std::string_view name() const override { return name_; }

  Verdict check(VecIn x) const override {
    const py::gil_scoped_acquire lock;
    std::vector<Index> all(static_cast<std::size_t>(element_dofs_.element_count()));
    std::iota(all.begin(), all.end(), Index{0});
    const py::tuple at = arguments_of(element_dofs_, x, all);
    const Doubles g = function_->get().attr("evaluate")(*at).cast<Doubles>();
    Verdict verdict;
    verdict.margin = std::numeric_limits<double>::infinity();
    for (const Index e : all) {
      const double room = g.at(e) + slack_;
      if (!(room > 0)) verdict.blocking.push_back(e);
      verdict.margin = std::min(verdict.margin, room);
    }
    verdict.feasible = verdict.blocking.empty();
    return verdict;
  }

  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }

  std::shared_ptr<const EnergyTerm> barrier() const override {
    const py::gil_scoped_acquire lock;
    return python_term(name_, element_dofs_, function_->get().attr("barrier")(slack_),
                       {Curvature::Exact, Curvature::Projected});
  }

  std::shared_ptr<const EnergyTerm> violation(double margin) const override {
    const py::gil_scoped_acquire lock;
    return python_term(name_, element_dofs_, function_->get().attr("violation")(margin - slack_),
                       {Curvature::Exact, Curvature::Projected});
  }

  // The slack is a tenth of the size of g, which is about 1, beyond what x violates.
  std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const override {
    const double violated = std::max(0.0, slack_ - check(x).margin);
    const double slack = std::max(slack_, violated + 0.1 * (1 + violated));
    return std::make_shared<const PythonInequality>(name_, element_dofs_, function_, slack);
  }

 private:
  std::string name_;
  ElementDofs element_dofs_;
  std::shared_ptr<const Kept> function_;
  double slack_;
};

}  // namespace

Curvature curvature_named(const std::string& name) {
  for (const Curvature c : kCurvatures)
    if (curvature_name(c) == name) return c;
  throw py::value_error(name);
}

std::shared_ptr<const EnergyTerm> python_term(std::string name, ElementDofs element_dofs,
                                              py::object function,
                                              std::vector<Curvature> curvatures, TermData data) {
  if (py::hasattr(function, "residuals"))
    return std::make_shared<const PythonSquares>(std::move(name), std::move(element_dofs),
                                                 std::move(function), std::move(curvatures),
                                                 std::move(data));
  return std::make_shared<const PythonTerm>(std::move(name), std::move(element_dofs),
                                            std::move(function), std::move(curvatures),
                                            std::move(data));
}

std::shared_ptr<const EnergyTerm> python_equality(std::string name, ElementDofs element_dofs,
                                                  py::object function) {
  TermData penalty{Eigen::Vector2d(0, 1).replicate(element_dofs.element_count(), 1), 2};
  return std::make_shared<const PythonEquality>(
      std::move(name), std::move(element_dofs), std::move(function),
      std::vector{Curvature::Exact, Curvature::Projected}, std::move(penalty));
}

std::shared_ptr<const BarrierChecker> python_inequality(std::string name, ElementDofs element_dofs,
                                                        py::object function) {
  return std::make_shared<const PythonInequality>(std::move(name), std::move(element_dofs),
                                                  std::make_shared<const Kept>(std::move(function)),
                                                  0.0);
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
