// Elements of any size in one term, from one lambda: polygons of 3 to 12 corners, stencils, groups.
//
//   const ElementLists faces{{0, 1, 2}, {2, 1, 3, 4, 5}};      // a triangle, a pentagon
//   auto round = make_term<3>("round", faces, [](Index, const auto& z) {
//     const auto center = (z.rowwise().sum() * (1.0 / static_cast<double>(z.cols()))).eval();
//     return (z.colwise() - center).squaredNorm();
//   });
//   builder.add(round, 1.0);
//
// It works as make_term<N, Block> (local_term.h) does, except that z has as many columns as the
// element has nodes. ElementLists may come from any mesh,
//
//   ElementLists corners;                                      // mesh.faces() of OpenMesh and CGAL
//   for (const auto& face : {std::vector{0, 1, 2}}) corners.emplace_back(face.begin(), face.end());
//
// and elements may have more than 30 unknowns. Up to 24 unknowns are differentiated at once (one
// size of dual numbers up to 12, another up to 24), more of them in slices of 12, two at a time. An
// element of n unknowns then calls the lambda about (n / 12)^2 / 2 times for a Hessian, so elements
// of hundreds of unknowns are slow. A lambda that takes z alone is called once for up to eight
// successive elements of one size.
//
// Not for elements of one size, for which make_term<N, Block> is faster.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/terms/detail/element_term.h"

namespace majorant {

// The nodes of each element, one or more.
using ElementLists = std::vector<std::vector<Index>>;

namespace detail {

// The unknowns of a slice: a Hessian of two slices is as large as that of a hexahedron's corners.
inline constexpr int kSlice = 12;

template <class T, int Block>
using ListValues = Eigen::Matrix<T, Block, Eigen::Dynamic>;

// name: the name of the term, for messages. Throws InvalidArgument as make_term() below does.
ElementDofs dofs_of_lists(const std::string& name, const ElementLists& lists, int block);

// True if the lambda takes the unknowns without the number of the element.
template <int Block, class F, class... Data>
inline constexpr bool takes_lists_alone =
    std::is_invocable_v<const F&, const ListValues<double, Block>&, const Data&...>;

// is_recorded: the lambda does not take the number of the element. shares_data: all elements have
// the same data, of doubles.
struct ListTraits {
  bool is_recorded = false, shares_data = true;
};

template <int Block, class F, class Numbers, ListTraits Traits>
class ListTerm final : public EnergyTerm {
 public:
  ListTerm(std::string name, const ElementLists& lists, F f, Numbers numbers)
      : name_(std::move(name)),
        element_dofs_(dofs_of_lists(name_, lists, Block)),
        f_(std::move(f)),
        numbers_(std::move(numbers)) {}

  std::string_view name() const override { return name_; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }
  Index parameter_count() const override { return numbers_.count(); }
  Vec parameters() const override { return numbers_.all(); }
  Index parameters_per_element() const override { return numbers_.per_element(); }

  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace&,
              std::span<double> f) const override {
    ListValues<double, Block> z;
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      gather(x, e, z);
      f[p] = inside_domain(call(e, z, state));
    }
  }

  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    if constexpr (Traits.is_recorded)
      if (out.hessian) return differentiate_recorded(x, batch, curvature, state, workspace, out);
    const int size = element_dofs_.local_size();
    constexpr std::size_t stride = LocalSystem::stride;
    std::vector<double> gradient(to_size(size)), packed;
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const int n = Block * element_dofs_.node_count(e);
      if (!out.hessian) {
        for (int first = 0; first < n; first += 2 * kSlice)
          differentiate<Dual1<double, 2 * kSlice>>(x, e, state, first, first + kSlice, out.value[p],
                                                   gradient, nullptr);
      } else if constexpr (!Traits.is_recorded) {
        packed.assign(to_size(n * (n + 1) / 2), 0.0);
        if (n <= kSlice)
          differentiate<Dual2<double, kSlice>>(x, e, state, 0, n, out.value[p], gradient, &packed);
        else
          for (int second = kSlice; second < n; second += kSlice)
            for (int first = 0; first < second; first += kSlice)
              differentiate<Dual2<double, 2 * kSlice>>(x, e, state, first, second, out.value[p],
                                                       gradient, &packed);
        if (curvature.projection_weight > 0)
          make_semidefinite(n, curvature.projection_weight, packed.data());
        packed.resize(to_size(size * (size + 1) / 2), 0.0);
        for (std::size_t k = 0; k < packed.size(); ++k) out.hessian[k * stride + p] = packed[k];
      }
      for (int k = 0; k < size; ++k)
        out.gradient[to_size(k) * stride + p] = k < n ? gradient[to_size(k)] : 0.0;
    }
  }

 private:
  template <class T>
  void gather(VecIn x, Index e, ListValues<T, Block>& z) const {
    z.resize(Block, element_dofs_.node_count(e));
    for (Index i = 0; i < z.cols(); ++i)
      for (int c = 0; c < Block; ++c) z(c, i) = T(x[Block * element_dofs_.nodes(e, i) + c]);
  }

  // Differentiates by up to kSlice unknowns from `first` on, and by as many from `second` on.
  template <class Variable>
  void differentiate(VecIn x, Index e, const TermState& state, int first, int second, double& value,
                     std::vector<double>& gradient, std::vector<double>* packed) const {
    const int n = Block * element_dofs_.node_count(e);
    ListValues<Variable, Block> z;
    gather(x, e, z);
    std::vector<int> unknowns;
    for (const int from : {first, second})
      for (int k = from; k < std::min(n, from + kSlice); ++k) {
        z(k % Block, k / Block).d[unknowns.size()] = 1.0;
        unknowns.push_back(k);
      }
    const Variable result = call(e, z, state);
    value = inside_domain(result.v);
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      gradient[to_size(unknowns[i])] = result.d[i];
      if constexpr (Variable::order == 2)
        for (std::size_t j = 0; j <= i; ++j) {
          const int row = unknowns[i], column = unknowns[j];
          (*packed)[to_size(row * (row + 1) / 2 + column)] = result.h[i * (i + 1) / 2 + j];
        }
    }
  }

  // Differentiates elements with the same number of nodes together.
  void differentiate_recorded(VecIn x, const ElementBatch& batch, BlendedCurvature curvature,
                              const TermState& state, Workspace& workspace,
                              LocalSystem& out) const {
    const std::size_t count = batch.elements.size(), size = to_size(element_dofs_.local_size());
    for (std::size_t k = 0; k < size; ++k)
      std::fill_n(out.gradient + k * LocalSystem::stride, count, 0.0);
    for (std::size_t k = 0; k < size * (size + 1) / 2; ++k)
      std::fill_n(out.hessian + k * LocalSystem::stride, count, 0.0);
    const auto nodes_at = [&](std::size_t p) {
      return element_dofs_.node_count(batch.elements[p]);
    };
    const auto alike = [&](std::size_t p, std::size_t q) { return nodes_at(p) == nodes_at(q); };
    Tape tape;
    for_lanes(count, tape, alike, [&](std::size_t first, std::size_t some) {
      const LaneElements elements(batch.elements.subspan(first, some));
      const TapeNumber result = record(x, elements, state, tape);
      const Lanes values = result.values();
      for (int i = 0; i < elements.count(); ++i)
        out.value[first + to_size(i)] = inside_domain(values[i]);
      differentiate_tape(tape, result.node(), Block * nodes_at(first), elements.count(), first,
                         curvature.projection_weight, nullptr, workspace, out);
    });
  }
  TapeNumber record(VecIn x, const LaneElements& elements, const TermState& state,
                    Tape& tape) const {
    tape.clear();
    ListValues<TapeNumber, Block> z(Block, element_dofs_.node_count(elements[0]));
    for (Index k = 0; k < z.size(); ++k) {
      Lanes values;
      for (int i = 0; i < kLanes; ++i)
        values[i] = x[Block * element_dofs_.nodes(elements[i], k / Block) + k % Block];
      z.data()[k] = TapeNumber::unknown(tape, values, static_cast<int>(k));
    }
    if constexpr (std::is_same_v<Numbers, NoNumbers>)
      return f_(std::as_const(z));
    else if constexpr (Traits.shares_data)
      return f_(std::as_const(z), numbers_(0, state));
    else
      return f_(std::as_const(z), recorded_data(numbers_, elements, state, tape));
  }

  template <class T>
  T call(Index e, const ListValues<T, Block>& z, const TermState& state) const {
    if constexpr (std::is_same_v<Numbers, NoNumbers>) {
      if constexpr (Traits.is_recorded)
        return f_(z);
      else
        return f_(e, z);
    } else {
      if constexpr (Traits.is_recorded)
        return f_(z, numbers_(e, state));
      else
        return f_(e, z, numbers_(e, state));
    }
  }
  static double inside_domain(double f) {
    return std::isnan(f) ? std::numeric_limits<double>::infinity() : f;
  }

  std::string name_;
  ElementDofs element_dofs_;
  F f_;
  Numbers numbers_;
};

template <int Block, class F, class... Data>
constexpr bool require_function_of_lists() {
  using Numbers = ListValues<double, Block>;
  using Variables = ListValues<Dual1<double, 2 * kSlice>, Block>;
  constexpr bool fits = std::is_invocable_v<const F&, Index, const Numbers&, const Data&...> &&
                        std::is_invocable_v<const F&, Index, const Variables&, const Data&...>;
  static_assert(
      fits,
      "the lambda takes (Index element, const auto& z), or const auto& z alone where it needs no "
      "number of its element; z is Block by the nodes of the element; with data one more argument, "
      "const auto& data");
  return fits;
}

template <int Block, ListTraits Traits, class F, class Numbers>
std::shared_ptr<const EnergyTerm> list_term(std::string name, const ElementLists& nodes, F f,
                                            Numbers numbers) {
  return std::make_shared<const ListTerm<Block, F, Numbers, Traits>>(
      std::move(name), nodes, std::move(f), std::move(numbers));
}

}  // namespace detail

// Makes the term of f(Index e, ListValues<T, Block> z) -> T, or f(z). Throws InvalidArgument for an
// element without nodes, and for negative nodes.
template <int Block = 1, class F>
std::shared_ptr<const EnergyTerm> make_term(std::string name, const ElementLists& nodes, F f) {
  using detail::ListTraits, detail::list_term, detail::NoNumbers;
  if constexpr (detail::takes_lists_alone<Block, F>)
    return list_term<Block, ListTraits{true}>(std::move(name), nodes, std::move(f), NoNumbers{});
  else if constexpr (detail::require_function_of_lists<Block, F>())
    return list_term<Block, ListTraits{}>(std::move(name), nodes, std::move(f), NoNumbers{});
  else
    return nullptr;
}

// Makes the term of f(Index e, ListValues<T, Block> z, data) -> T, or f(z, data). data: as for
// make_term<N, Block>.
template <int Block = 1, class F, class Matrix>
std::shared_ptr<const EnergyTerm> make_term(std::string name, const ElementLists& nodes, F f,
                                            const Eigen::MatrixBase<Matrix>& data) {
  using detail::ListTraits, detail::list_term;
  using Row = detail::ElementNumbers::Row;
  detail::ElementNumbers numbers(name, data, static_cast<Index>(nodes.size()));
  constexpr bool is_shared = Matrix::ColsAtCompileTime == 1;
  if constexpr (detail::takes_lists_alone<Block, F, Row>)
    return list_term<Block, ListTraits{true, is_shared}>(std::move(name), nodes, std::move(f),
                                                         std::move(numbers));
  else if constexpr (detail::require_function_of_lists<Block, F, Row>())
    return list_term<Block, ListTraits{}>(std::move(name), nodes, std::move(f), std::move(numbers));
  else
    return nullptr;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
