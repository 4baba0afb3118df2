#include "element_functions.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "arrays.h"
#include "kept.h"
#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/equality_term.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/joint_term.h"
#include "majorant/framework/residual_term.h"

namespace majorant::python {
namespace {

// Elements with equally many nodes, as indices into the computed elements.
struct SizeGroup {
  int nodes;
  std::vector<std::size_t> places;
};

std::vector<SizeGroup> groups_of(const ElementDofs& dofs, std::span<const Index> elements) {
  std::map<int, std::vector<std::size_t>> by_size;
  for (std::size_t p = 0; p < elements.size(); ++p)
    by_size[dofs.node_count(elements[p])].push_back(p);
  std::vector<SizeGroup> groups;
  for (auto& [nodes, places] : by_size) groups.push_back({nodes, std::move(places)});
  return groups;
}

// Returns the unknowns (q, k) and the indices of a group's elements. The same unknown of all
// elements is one contiguous vector.
py::tuple arguments_of(const ElementDofs& dofs, VecIn x, std::span<const Index> elements,
                       const SizeGroup& group) {
  const auto count = static_cast<py::ssize_t>(group.places.size());
  py::array_t<double> unknowns({static_cast<py::ssize_t>(group.nodes * dofs.block), count});
  Integers numbers(count);
  Index* const e = numbers.mutable_data();
  for (std::size_t p = 0; p < group.places.size(); ++p) e[p] = elements[group.places[p]];
  double* to = unknowns.mutable_data();
  for (int k = 0; k < group.nodes; ++k)
    for (int c = 0; c < dofs.block; ++c, to += count)
      for (py::ssize_t p = 0; p < count; ++p) to[p] = x[dofs.block * dofs.nodes(e[p], k) + c];
  return py::make_tuple(unknowns.attr("T"), numbers);
}

double finite(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

// The results of a function for some elements: one row of numbers for each, in the order of
// LocalSystem's entries. Missing entries are 0.
struct Computed {
  std::size_t count = 0;
  std::vector<double> value, gradient, hessian;
};

// Copies the rows of a group's elements to their places among all elements.
void place_rows(const Doubles& rows, const SizeGroup& group, std::size_t count,
                std::vector<double>& to) {
  const std::size_t some = group.places.size();
  const double* from = rows.data();
  for (std::size_t k = 0; k < static_cast<std::size_t>(rows.shape(0)); ++k, from += some)
    for (std::size_t p = 0; p < some; ++p) to[k * count + group.places[p]] = from[p];
}

// The results of several batches, which are computed together.
class ComputedBatches final : public EnergyTerm {
 public:
  ComputedBatches(const EnergyTerm& term, Computed computed,
                  std::map<const Index*, std::size_t> places)
      : term_(term), computed_(std::move(computed)), places_(std::move(places)) {}

  std::string_view name() const override { return term_.name(); }
  const ElementDofs& element_dofs() const override { return term_.element_dofs(); }
  bool supports(Curvature c) const override { return term_.supports(c); }

  void values(VecIn, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    std::copy_n(computed_.value.data() + places_.at(batch.elements.data()), batch.elements.size(),
                f.data());
  }
  void local(VecIn, const ElementBatch& batch, BlendedCurvature, const TermState&, Workspace&,
             LocalSystem& out) const override {
    const std::size_t first = places_.at(batch.elements.data()), some = batch.elements.size();
    const auto copy = [&](const std::vector<double>& rows, double* to) {
      for (std::size_t at = first; at < rows.size(); at += computed_.count)
        to = std::copy_n(rows.data() + at, some, to) + (LocalSystem::stride - some);
    };
    copy(computed_.value, out.value);
    copy(computed_.gradient, out.gradient);
    if (out.hessian) copy(computed_.hessian, out.hessian);
  }

 private:
  const EnergyTerm& term_;
  Computed computed_;
  std::map<const Index*, std::size_t> places_;  // by the address of a batch's elements
};

class PythonTerm : public EnergyTerm, public JointTerm {
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

  std::unique_ptr<const EnergyTerm> computed(
      VecIn x, std::span<const ElementBatch> batches, const TermState& state,
      std::optional<BlendedCurvature> curvature) const override {
    std::vector<Index> elements;
    std::map<const Index*, std::size_t> places;
    for (const ElementBatch& batch : batches) {
      places[batch.elements.data()] = elements.size();
      elements.insert(elements.end(), batch.elements.begin(), batch.elements.end());
    }
    return std::make_unique<const ComputedBatches>(*this, compute(x, elements, state, curvature),
                                                   std::move(places));
  }
  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace& workspace,
              std::span<double> f) const override {
    computed(x, {&batch, 1}, state, {})->values(x, batch, state, workspace, f);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    computed(x, {&batch, 1}, state, curvature)->local(x, batch, curvature, state, workspace, out);
  }

 protected:
  py::handle function() const { return function_.get(); }
  // Returns the data of these elements: nothing, the whole vector, or one row for each element.
  py::tuple data_of(const TermState& state, std::span<const Index> elements) const {
    if (data_.numbers.size() == 0) return py::tuple();
    const Vec& numbers = state.parameters.size() > 0 ? state.parameters : data_.numbers;
    if (data_.per_element == 0)
      return py::make_tuple(Doubles(static_cast<py::ssize_t>(numbers.size()), numbers.data()));
    Doubles rows(
        {static_cast<py::ssize_t>(elements.size()), static_cast<py::ssize_t>(data_.per_element)});
    for (std::size_t p = 0; p < elements.size(); ++p)
      std::copy_n(numbers.data() + elements[p] * data_.per_element, data_.per_element,
                  rows.mutable_data(static_cast<py::ssize_t>(p), 0));
    return py::make_tuple(rows);
  }

 private:
  // Calls the function once for each size of elements.
  Computed compute(VecIn x, std::span<const Index> elements, const TermState& state,
                   std::optional<BlendedCurvature> curvature) const {
    const py::gil_scoped_acquire lock;
    const auto n = static_cast<std::size_t>(element_dofs_.local_size());
    Computed out{elements.size(), std::vector<double>(elements.size()), {}, {}};
    if (curvature) {
      out.gradient.assign(n * out.count, 0.0);
      out.hessian.assign(n * (n + 1) / 2 * out.count, 0.0);
    }
    for (const SizeGroup& group : groups_of(element_dofs_, elements)) {
      std::vector<Index> members;
      for (const std::size_t p : group.places) members.push_back(elements[p]);
      const py::tuple at = arguments_of(element_dofs_, x, elements, group);
      const py::tuple data = data_of(state, members);
      if (!curvature) {
        const Doubles value = function_.get().attr("evaluate")(*at, *data).cast<Doubles>();
        for (std::size_t p = 0; p < members.size(); ++p)
          out.value[group.places[p]] = finite(value.data()[p]);
        continue;
      }
      const double exact = curvature->model == Curvature::Reweighted
                               ? 0.0
                               : std::max(0.0, 1 - curvature->projection_weight);
      const py::tuple all = function_.get().attr("linearize")(*at, exact, *data);
      const Doubles value = all[0].cast<Doubles>();
      for (std::size_t p = 0; p < members.size(); ++p)
        out.value[group.places[p]] = finite(value.data()[p]);
      place_rows(all[1].cast<Doubles>(), group, out.count, out.gradient);
      place_rows(all[2].cast<Doubles>(), group, out.count, out.hessian);
      if (!supports(Curvature::Reweighted) && curvature->projection_weight > 0)
        project(group, curvature->projection_weight, out);
    }
    return out;
  }

  void project(const SizeGroup& group, double weight, Computed& computed) const {
    const int n = group.nodes * element_dofs_.block;
    std::vector<double> packed(static_cast<std::size_t>(n * (n + 1) / 2));
    for (const std::size_t p : group.places) {
      double* const entries = computed.hessian.data() + p;
      for (std::size_t k = 0; k < packed.size(); ++k) packed[k] = entries[k * computed.count];
      make_semidefinite(n, weight, packed.data());
      for (std::size_t k = 0; k < packed.size(); ++k) entries[k * computed.count] = packed[k];
    }
  }

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
    const SizeGroup alone{element_dofs().node_count(element), {0}};
    const py::tuple at = arguments_of(element_dofs(), x, one, alone), data = data_of(state, one);
    const Doubles r = function().attr("residuals")(*at, *data).cast<Doubles>();
    residuals = Eigen::Map<const Vec>(r.data(), r.size());
    if (!jacobian) return;
    const Doubles J = function().attr("jacobian")(*at, *data).cast<Doubles>();
    jacobian->setZero(r.size(), element_dofs().local_size());
    const Index own = alone.nodes * element_dofs().block;
    jacobian->leftCols(own) = Eigen::Map<const RowMatrix>(J.data(), r.size(), own);
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

// The checker of g + slack > 0, as in framework/terms/inequality.h; paths are not certified.
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
    std::vector<double> g(all.size());
    for (const SizeGroup& group : groups_of(element_dofs_, all)) {
      const py::tuple at = arguments_of(element_dofs_, x, all, group);
      const Doubles some = function_->get().attr("evaluate")(*at).cast<Doubles>();
      for (std::size_t p = 0; p < group.places.size(); ++p) g[group.places[p]] = some.data()[p];
    }
    Verdict verdict;
    verdict.margin = std::numeric_limits<double>::infinity();
    for (const Index e : all) {
      const double room = g[static_cast<std::size_t>(e)] + slack_;
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

  // The slack exceeds the violation v at x by 0.1 (1 + v), since g has size about 1.
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

ElementDofs elements_of(const Integers& nodes, const Integers& counts, int block) {
  return {matrix<Cells>(nodes), block, {counts.data(), counts.data() + counts.size()}};
}

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
