// An energy term: a sum over elements of functions of few unknowns each.
//
// This is the raw extension point, for elements of many unknowns, models of curvature of one's own,
// or memory shared by a batch. Not for densities of a Jacobian, whose chain rule make_energy()
// (energies/make_energy.h) does, nor for what a lambda says: make_term()
// (framework/terms/local_term.h).
//
//   class Springs final : public EnergyTerm {
//     std::string_view name() const override { return "springs"; }
//     const ElementDofs& element_dofs() const override ...     // 2 points each
//     bool supports(Curvature c) const override { return c == Curvature::Exact; }
//     void values(VecIn, const ElementBatch&, const TermState&, Workspace&, std::span<double>) ...
//     void local(VecIn x, const ElementBatch&, BlendedCurvature, const TermState&, Workspace&,
//                LocalSystem&) ...
//   };
//
// A term is immutable and thread-safe: the evaluator calls it for different batches at the same
// time, each call with its own Workspace and output. What changes between steps is in TermState,
// which the term receives by argument. check_derivatives() at the end of this file tests an
// implementation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/curvature.h"
#include "majorant/framework/types.h"

namespace majorant {

// Elements as lists of nodes; a node is `block` consecutive unknowns of x, so the local unknown
// `block * i + c` of element e is x[block * nodes(e, i) + c].
struct ElementDofs {
  Cells nodes;    // #E by nodes per element
  int block = 1;  // unknowns per node
  // #E: the nodes that each element has; empty: all. Behind them a row repeats one of its nodes,
  // and local systems have 0.
  std::vector<int> node_counts = {};
  Index element_count() const { return static_cast<Index>(nodes.rows()); }
  int local_size() const { return static_cast<int>(nodes.cols()) * block; }
  int node_count(Index e) const {
    return node_counts.empty() ? static_cast<int>(nodes.cols()) : node_counts[to_size(e)];
  }
};

std::string_view curvature_name(Curvature curvature);  // "projected", "paper-majorizer", ...

using RuleId = int;  // a term's own numbering of its quadrature rules; 0 is its default rule

// Elements that one call treats: all use the same rule.
struct ElementBatch {
  static constexpr int kMaxSize = 128;
  RuleId rule = 0;
  std::span<const Index> elements;  // at most kMaxSize
};

// A change of a term's state: what is given replaces what the term has, the rest stays.
struct TermChange {
  std::optional<double> weight = {};
  std::optional<Vec> element_weight = {};
  std::optional<std::vector<RuleId>> element_rule = {};
  std::optional<Vec> parameters = {};
};

// The part of a term that may change between steps without changing unknowns or sparsity pattern.
struct TermState {
  double weight = 1.0;                    // of the whole term
  Vec element_weight = {};                // #E factors, empty = all 1
  std::vector<RuleId> element_rule = {};  // #E, empty = all 0
  // EnergyTerm::parameter_count() numbers; empty: those that the term was made with.
  Vec parameters = {};

  operator TermChange() const { return {weight, element_weight, element_rule, parameters}; }
};

// Scratch memory of one thread: grows, never shrinks, contents undefined.
class Workspace {
 public:
  double* reserve(std::size_t count) {
    if (buffer_.size() < count + kAlign) buffer_.resize(count + kAlign);
    auto address = reinterpret_cast<std::uintptr_t>(buffer_.data());
    return buffer_.data() + (kAlign - address / sizeof(double) % kAlign) % kAlign;
  }

 private:
  static constexpr std::size_t kAlign = 8;  // doubles: 64 bytes
  std::vector<double> buffer_;
};

// Values, gradients and packed lower triangles of one batch, structure of arrays: entry k of the
// element at position p of the batch is at [k * stride + p]; Hessian entry (i, j), i >= j, is
// k = i (i + 1) / 2 + j. Arrays are 64-byte aligned. hessian == nullptr asks for values and
// gradients only: the curvature argument is ignored then.
struct LocalSystem {
  static constexpr int stride = ElementBatch::kMaxSize;
  double* value = nullptr;     // 1 by stride
  double* gradient = nullptr;  // local_size by stride
  double* hessian = nullptr;   // local_size (local_size + 1) / 2 by stride, or null
};

class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  virtual std::string_view name() const = 0;
  virtual const ElementDofs& element_dofs() const = 0;  // constant for the term's lifetime
  virtual bool supports(Curvature curvature) const = 0;
  virtual RuleId rule_count() const { return 1; }  // TermState::element_rule says one of these
  // The number of TermState::parameters: numbers that the energy depends on beside x and that may
  // change between steps, such as the point of a linearization or the parameter of a homotopy.
  virtual Index parameter_count() const { return 0; }
  // Those that the term was made with.
  virtual Vec parameters() const { return {}; }
  // K where element e depends on the parameters K e to K e + K - 1 alone; 0: on any of them.
  virtual Index parameters_per_element() const { return 0; }
  // The number of unknowns that a problem with this term has to have; negative: any that has those
  // of element_dofs().
  virtual Index full_size() const { return -1; }

  // f[p] = energy of the batch's element p at x, +inf outside the domain, never NaN. Weights are
  // not the term's business.
  virtual void values(VecIn x, const ElementBatch& batch, const TermState& state,
                      Workspace& workspace, std::span<double> f) const = 0;

  // Values, gradients and, unless out.hessian is null, curvature. x lies in the domain. Values and
  // gradients are the same, up to rounding, with and without it and under every curvature. A term
  // that supports Exact and Projected blends them as curvature.h says.
  virtual void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature,
                     const TermState& state, Workspace& workspace, LocalSystem& out) const = 0;
};

// Compares the derivatives of an energy term with finite differences: the first thing to run on a
// new EnergyTerm.
//
//   DerivativeReport report = check_derivatives(*energy, x);
//   if (!report.ok()) std::cerr << report.message();   // names the element and the block
//
// Differences of values() check the gradient, differences of the gradient check the Hessian under
// Curvature::Exact; the other curvature models the term supports are checked to be positive
// semidefinite, blends of Exact and Projected to lie between them; local() without a Hessian has to
// give the same gradient (a term that writes through the null pointer crashes here); elements
// evaluated together have to give what each gives alone. x must lie inside the domain, away from
// its boundary and from kinks. Of more than kMaxCheckedElements elements a sample is checked, of
// elements of more than 30 unknowns a smaller one: the same elements in every call.

struct DerivativeMismatch {
  Index element;
  std::string block;  // "gradient[3]", "hessian(4, 1)", "gradient[3] without hessian", "... among
                      // others": wrong only where elements are evaluated together
  double computed, expected;
};

struct DerivativeReport {
  double gradient_error = 0;  // largest, relative to the element's largest gradient entry
  double hessian_error = 0;   // likewise
  std::vector<DerivativeMismatch> mismatches;  // of each element at most one of every kind
  Index checked = 0, elements = 0;             // so many of so many elements were checked
  bool ok() const { return mismatches.empty(); }
  // One line per mismatch, and a last one where these are of a sample; empty where ok().
  std::string message() const;
};

inline constexpr Index kMaxCheckedElements = 1000;

// tolerance: relative to the largest entry of the element's gradient or Hessian (plus the energy
// itself divided by the size of the element, plus what 1e-5 of it changes). state: as for the
// term's evaluation.
DerivativeReport check_derivatives(const EnergyTerm& term, VecIn x, double tolerance = 1e-5,
                                   const TermState& state = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
