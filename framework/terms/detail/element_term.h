// The common base of all terms made of a lambda: gathers an element's unknowns, as numbers or as
// variables of differentiation, and writes the results. Not for inclusion: local_term.h.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "majorant/framework/dual2.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/equality_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/residual_term.h"
#include "majorant/framework/terms/detail/tape_number.h"

// Dual numbers as the scalars of Eigen's small matrices, mixed with doubles. Norms, products,
// determinants and inverses up to 4 by 4 work; decompositions do not.
namespace Eigen {

template <int N, int Order>
struct NumTraits<majorant::Dual<double, N, Order>> : NumTraits<double> {
  using Real = majorant::Dual<double, N, Order>;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = Order == 2 ? N * N / 2 : N,
    AddCost = ReadCost,
    MulCost = Order == 2 ? 3 * N * N : 2 * N
  };
};

template <int N, int Order, class Operation>
struct ScalarBinaryOpTraits<majorant::Dual<double, N, Order>, double, Operation> {
  using ReturnType = majorant::Dual<double, N, Order>;
};
template <int N, int Order, class Operation>
struct ScalarBinaryOpTraits<double, majorant::Dual<double, N, Order>, Operation> {
  using ReturnType = majorant::Dual<double, N, Order>;
};

template <>
struct NumTraits<majorant::detail::TapeNumber> : NumTraits<double> {
  using Real = majorant::detail::TapeNumber;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 64,
    MulCost = 64
  };
};
template <class Operation>
struct ScalarBinaryOpTraits<majorant::detail::TapeNumber, double, Operation> {
  using ReturnType = majorant::detail::TapeNumber;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, majorant::detail::TapeNumber, Operation> {
  using ReturnType = majorant::detail::TapeNumber;
};

}  // namespace Eigen

namespace majorant {

// The unknowns of an element's N nodes, a column of Block each; T is double or a dual number.
template <class T, int Block, int N>
using NodeValues = Eigen::Matrix<T, Block, N>;

namespace detail {

// More unknowns as Dual2 would be too large for the stack.
inline constexpr int kMostUnknowns = 30;

// The numbers that a lambda takes beside z, which may change between steps: TermState::parameters.
class ElementNumbers {
 public:
  using Row = Eigen::Map<const Vec>;
  // data: a column, which every element gets as a whole, or another matrix, of which element e gets
  // row e. Throws InvalidArgument if data is empty, has another number of rows, or is not finite.
  // term: the name of the term.
  template <class Matrix>
  ElementNumbers(const std::string& term, const Eigen::MatrixBase<Matrix>& data, Index elements) {
    constexpr bool is_shared = Matrix::ColsAtCompileTime == 1;
    const RowMatrix rows = data;
    if (is_shared ? rows.size() == 0 : rows.cols() == 0)
      throw InvalidArgument("term '" + term + "': its data are empty");
    if (!is_shared && rows.rows() != elements)
      throw InvalidArgument("term '" + term + "': " + std::to_string(rows.rows()) +
                            " rows of data for " + std::to_string(elements) + " elements");
    if (!rows.allFinite()) throw InvalidArgument("term '" + term + "': its data are not finite");
    numbers_ = rows.template reshaped<Eigen::RowMajor>();
    per_element_ = is_shared ? 0 : rows.cols();
  }
  Index count() const { return numbers_.size(); }
  const Vec& all() const { return numbers_; }
  Index per_element() const { return per_element_; }
  Row operator()(Index e, const TermState& state) const {
    const Vec& now = state.parameters.size() > 0 ? state.parameters : numbers_;
    if (per_element_ == 0) return {now.data(), now.size()};
    return {now.data() + e * per_element_, per_element_};
  }

 private:
  Vec numbers_;
  Index per_element_;  // 0: an element gets all of them
};

// Elements evaluated together, one a lane; lanes behind the last element repeat it.
class LaneElements {
 public:
  explicit LaneElements(std::span<const Index> elements) : elements_(elements) {}
  int count() const { return static_cast<int>(elements_.size()); }
  Index operator[](int lane) const { return elements_[to_size(std::min(lane, count() - 1))]; }

 private:
  std::span<const Index> elements_;
};

// The numbers of several elements, one lane each.
using RecordedData = Eigen::Vector<TapeNumber, Eigen::Dynamic>;
inline RecordedData recorded_data(const ElementNumbers& numbers, const LaneElements& elements,
                                  const TermState& state, Tape& tape) {
  RecordedData data(numbers.per_element());
  for (Index k = 0; k < data.size(); ++k) {
    Lanes values;
    for (int i = 0; i < kLanes; ++i) values[i] = numbers(elements[i], state)[k];
    data[k] = TapeNumber::data(tape, values);
  }
  return data;
}

// Calls differentiate(first, count) for groups of elements of a batch: as many as there are lanes,
// all with same(first, other). If their branches differ, calls it again for each element alone.
template <class Same, class Differentiate>
void for_lanes(std::size_t size, const Tape& tape, const Same& same,
               const Differentiate& differentiate) {
  for (std::size_t first = 0, count = 0; first < size; first += count) {
    for (count = 1; count < kLanes && first + count < size && same(first, first + count);) ++count;
    differentiate(first, count);
    if (!tape.branches_differ) continue;
    for (std::size_t i = 0; i < count; ++i) differentiate(first + i, 1);
  }
}

// Stands for the numbers of a lambda that takes none.
struct NoNumbers {
  static constexpr Index count() { return 0; }
  static Vec all() { return {}; }
  static constexpr Index per_element() { return 0; }
};

// Returns true for a lambda of elements; otherwise fails to compile, with one line for each unmet
// condition. Data: the type of the numbers beside z, or nothing.
template <int N, int Block, class F, class... Data>
constexpr bool require_function_of_elements() {
  using Numbers = NodeValues<double, Block, N>;
  using Variables = NodeValues<Dual1<double, N * Block>, Block, N>;
  constexpr bool few = N * Block <= kMostUnknowns;
  constexpr bool fits = std::is_invocable_v<const F&, Index, const Numbers&, const Data&...> &&
                        std::is_invocable_v<const F&, Index, const Variables&, const Data&...>;
  static_assert(few,
                "an element has at most 30 unknowns, N Block: use a density for maps of higher "
                "degree, an EnergyTerm for all else");
  static_assert(fits,
                "the lambda takes (Index element, const auto& z), or const auto& z alone where it "
                "needs no number of its element; z is Block by N; with data one more argument, "
                "const auto& data");
  return few && fits;
}

// True if the lambda takes the unknowns without the number of the element.
template <int N, int Block, class F, class... Data>
inline constexpr bool takes_unknowns_alone =
    std::is_invocable_v<const F&, const NodeValues<double, Block, N>&, const Data&...>;

// Wraps such a lambda as one that takes the number of the element.
template <class F>
struct WithoutElement {
  F f;
  template <class Z, class... Data>
  auto operator()(Index, const Z& z, const Data&... data) const {
    return f(z, data...);
  }
};

// A Model has these members, all const:
//     nodes, block                       constexpr, N and Block
//     supports(Curvature)
//     value(e, z, data...)               of element e, z of doubles; NaN: outside the domain
//     model(e, z, curvature, data...)    z of Dual1 or Dual2; the second derivatives of what it
//                                        returns, if it has any, are the curvature
// data is a row of `Numbers`; it is omitted for NoNumbers. A model of least squares also has
//     visit_residuals(e, z, visit, data...)    z of doubles or Dual1; calls visit(residual)
//     rho(s)                                   as ResidualTerm::loss()
//
// A model of equalities has is_equality, and two numbers an element. A model that is evaluated for
// several elements at a time has, instead of the second derivatives of model(),
//     record(z, data...)                 z of TapeNumber; a model of least squares has
//                                        record(curvature, z, data...), whose second derivatives
//                                        are the curvature
//     projection                         a PackedProjection
//     shares_data                        constexpr: all elements have the same data, of doubles
struct NoResiduals {};
template <class Model>
inline constexpr bool has_residuals = requires(const Model& model) {
  model.rho(1.0);
};
template <class Model>
inline constexpr bool is_recorded = requires(const Model& model) {
  model.projection;
};
struct NoEqualities {};
template <class Model>
inline constexpr bool has_equalities = requires {
  Model::is_equality;
};

template <class Model, class Numbers = NoNumbers>
class ElementTerm final
    : public EnergyTerm,
      public std::conditional_t<has_residuals<Model>, ResidualTerm, NoResiduals>,
      public std::conditional_t<has_equalities<Model>, EqualityTerm, NoEqualities> {
 public:
  static constexpr int N = Model::nodes, Block = Model::block, size = N * Block;

  ElementTerm(std::string name, Cells nodes, Model model, Numbers numbers = {})
      : name_(std::move(name)),
        element_dofs_{std::move(nodes), Block},
        model_(std::move(model)),
        numbers_(std::move(numbers)) {
    if (element_dofs_.nodes.cols() != N)
      throw InvalidArgument("term '" + name_ + "': its lambda takes " + std::to_string(N) +
                            " nodes, the list has " + std::to_string(element_dofs_.nodes.cols()) +
                            " columns");
    for (Index e = 0; e < element_dofs_.nodes.rows(); ++e)
      for (int k = 0; k < N; ++k)
        if (element_dofs_.nodes(e, k) < 0)
          throw InvalidArgument("term '" + name_ + "': node " + std::to_string(k) + " of element " +
                                std::to_string(e) + " is " +
                                std::to_string(element_dofs_.nodes(e, k)) +
                                ", they are counted from 0");
  }

  std::string_view name() const override { return name_; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature curvature) const override { return model_.supports(curvature); }
  Index parameter_count() const override { return numbers_.count(); }
  Vec parameters() const override { return numbers_.all(); }
  Index parameters_per_element() const override { return numbers_.per_element(); }

  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace&,
              std::span<double> f) const override {
    NodeValues<double, Block, N> z;
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      for_each_unknown(e, [&](int k, Index unknown) { z(k % Block, k / Block) = x[unknown]; });
      f[p] = inside_domain(
          with_numbers(e, state, [&](const auto&... data) { return model_.value(e, z, data...); }));
    }
  }

  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    if (!out.hessian)
      differentiate<Dual1<double, size>>(x, batch, curvature, state, out);
    else if constexpr (is_recorded<Model>)
      differentiate_recorded(x, batch, curvature, state, workspace, out);
    else
      differentiate<Dual2<double, size>>(x, batch, curvature, state, out);
  }

  // The members of ResidualTerm, if the model has residuals.
  void residuals(VecIn x, Index element, const TermState& state, Vec& residuals,
                 RowMatrix* jacobian) const {
    if (jacobian) {
      std::vector<Dual1<double, size>> all;
      residuals_of<Dual1<double, size>>(x, element, state, all);
      const auto count = static_cast<Index>(all.size());
      residuals.resize(count);
      jacobian->resize(count, size);
      for (Index i = 0; i < count; ++i) {
        residuals[i] = all[to_size(i)].v;
        for (int k = 0; k < size; ++k) (*jacobian)(i, k) = all[to_size(i)].d[to_size(k)];
      }
    } else {
      std::vector<double> all;
      residuals_of<double>(x, element, state, all);
      residuals = Eigen::Map<const Vec>(all.data(), static_cast<Index>(all.size()));
    }
  }
  std::array<double, 3> loss(double s) const { return model_.rho(s); }

 private:
  template <class T>
  void residuals_of(VecIn x, Index e, const TermState& state, std::vector<T>& all) const {
    NodeValues<T, Block, N> z;
    for_each_unknown(e, [&](int k, Index unknown) {
      if constexpr (std::is_same_v<T, double>)
        z(k % Block, k / Block) = x[unknown];
      else
        z(k % Block, k / Block) = T::variable(x[unknown], k);
    });
    with_numbers(e, state, [&](const auto&... data) {
      model_.visit_residuals(
          e, z, [&all](const T& r) { all.push_back(r); }, data...);
    });
  }
  template <class Variable>
  void differentiate(VecIn x, const ElementBatch& batch, BlendedCurvature curvature,
                     const TermState& state, LocalSystem& out) const {
    constexpr std::size_t stride = LocalSystem::stride;
    NodeValues<Variable, Block, N> z;
    for (int k = 0; k < size; ++k) z(k % Block, k / Block) = Variable::variable(0, k);
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      for_each_unknown(e, [&](int k, Index unknown) { z(k % Block, k / Block).v = x[unknown]; });
      const Variable result = with_numbers(
          e, state, [&](const auto&... data) { return model_.model(e, z, curvature, data...); });
      out.value[p] = inside_domain(result.v);
      for (std::size_t k = 0; k < result.d.size(); ++k) out.gradient[k * stride + p] = result.d[k];
      for (std::size_t k = 0; k != result.h.size(); ++k) out.hessian[k * stride + p] = result.h[k];
    }
  }
  void differentiate_recorded(VecIn x, const ElementBatch& batch, BlendedCurvature curvature,
                              const TermState& state, Workspace& workspace,
                              LocalSystem& out) const {
    Tape tape;
    const auto alike = [](std::size_t, std::size_t) { return true; };
    for_lanes(batch.elements.size(), tape, alike, [&](std::size_t first, std::size_t count) {
      const LaneElements elements(batch.elements.subspan(first, count));
      const TapeNumber result = record(x, elements, curvature, state, tape);
      const Lanes values = result.values();
      for (int i = 0; i < elements.count(); ++i)
        out.value[first + to_size(i)] = inside_domain(values[i]);
      differentiate_tape(tape, result.node(), size, elements.count(), first,
                         has_residuals<Model> ? 0.0 : curvature.projection_weight,
                         model_.projection, workspace, out);
    });
  }
  TapeNumber record(VecIn x, const LaneElements& elements, BlendedCurvature curvature,
                    const TermState& state, Tape& tape) const {
    tape.clear();
    Lanes unknowns[size];
    for (int i = 0; i < kLanes; ++i)
      for_each_unknown(elements[i], [&](int k, Index unknown) { unknowns[k][i] = x[unknown]; });
    NodeValues<TapeNumber, Block, N> z;
    for (int k = 0; k < size; ++k)
      z(k % Block, k / Block) = TapeNumber::unknown(tape, unknowns[k], k);
    const auto recorded = [&](const auto&... data) {
      if constexpr (has_residuals<Model>)
        return model_.record(curvature, z, data...);
      else
        return model_.record(z, data...);
    };
    if constexpr (std::is_same_v<Numbers, NoNumbers>)
      return recorded();
    else if constexpr (Model::shares_data)
      return recorded(numbers_(0, state));
    else
      return recorded(recorded_data(numbers_, elements, state, tape));
  }
  // Calls call(numbers of element e), or call() if there are none.
  template <class Call>
  auto with_numbers(Index e, const TermState& state, const Call& call) const {
    if constexpr (std::is_same_v<Numbers, NoNumbers>)
      return call();
    else
      return call(numbers_(e, state));
  }
  template <class Visit>
  void for_each_unknown(Index e, const Visit& visit) const {
    for (int i = 0, k = 0; i < N; ++i)
      for (int c = 0; c < Block; ++c, ++k) visit(k, Block * element_dofs_.nodes(e, i) + c);
  }
  static double inside_domain(double f) {
    return std::isnan(f) ? std::numeric_limits<double>::infinity() : f;
  }

  std::string name_;
  ElementDofs element_dofs_;
  Model model_;
  Numbers numbers_;
};

// Returns the term of a model, with data or without.
template <class Model, class... Matrix>
std::shared_ptr<const EnergyTerm> element_term(std::string name, Cells nodes, Model model,
                                               const Eigen::MatrixBase<Matrix>&... data) {
  if constexpr (sizeof...(Matrix) == 0) {
    return std::make_shared<const ElementTerm<Model>>(std::move(name), std::move(nodes),
                                                      std::move(model));
  } else {
    ElementNumbers numbers(name, data..., static_cast<Index>(nodes.rows()));
    return std::make_shared<const ElementTerm<Model, ElementNumbers>>(
        std::move(name), std::move(nodes), std::move(model), std::move(numbers));
  }
}

}  // namespace detail
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
