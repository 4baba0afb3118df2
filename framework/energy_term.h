// An energy term: a sum over elements of functions of few unknowns each.
//
// This is the raw extension point, for elements of many unknowns, curvature models of your own, or
// memory shared by a batch. Not for densities of a Jacobian: make_energy() (energies/make_energy.h)
// applies the chain rule. Not for functions that a lambda can express: make_term()
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
// time, each call with its own Workspace and output. Values that change between steps are in
// TermState, which the term receives as an argument. check_derivatives() at the end of this file
// tests an implementation.
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
  // #E: the number of nodes of each element; empty: all. After them, a row of `nodes` repeats one
  // of its nodes, and local systems have zeros.
  std::vector<int> node_counts = {};
  Index element_count() const { return static_cast<Index>(nodes.rows()); }
  int local_size() const { return static_cast<int>(nodes.cols()) * block; }
  int node_count(Index e) const {
    return node_counts.empty() ? static_cast<int>(nodes.cols()) : node_counts[to_size(e)];
  }
};

std::string_view curvature_name(Curvature curvature);  // "projected", "paper-majorizer", ...

using RuleId = int;  // a term's own numbering of its quadrature rules; 0 is its default rule

// The elements of one call, all with the same quadrature rule.
struct ElementBatch {
  static constexpr int kMaxSize = 128;
  RuleId rule = 0;
  std::span<const Index> elements;  // at most kMaxSize
};

// A change of a term's state: each given value replaces the term's value, all others stay.
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
  // EnergyTerm::parameter_count() numbers; empty: the initial parameters of the term.
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
  virtual RuleId rule_count() const { return 1; }  // entries of element_rule are below it
  // The number of TermState::parameters: numbers beside x on which the energy depends, and which
  // may change between steps, such as the point of a linearization or the parameter of a homotopy.
  virtual Index parameter_count() const { return 0; }
  // The initial parameters.
  virtual Vec parameters() const { return {}; }
  // The number K if element e depends on parameters K e to K e + K - 1 alone; 0 if on any
  // parameters.
  virtual Index parameters_per_element() const { return 0; }
  // The number of unknowns that a problem with this term must have; negative: any number that
  // contains those of element_dofs().
  virtual Index full_size() const { return -1; }

  // Writes f[p] = energy of the batch's element p at x: +inf outside the domain, never NaN, without
  // weights.
  virtual void values(VecIn x, const ElementBatch& batch, const TermState& state,
                      Workspace& workspace, std::span<double> f) const = 0;

  // Computes values, gradients and, unless out.hessian is null, curvature. x lies in the domain.
  // Values and gradients are the same, up to rounding, with and without a Hessian and under every
  // curvature. A term that supports Exact and Projected blends them as curvature.h defines.
  virtual void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature,
                     const TermState& state, Workspace& workspace, LocalSystem& out) const = 0;
};

// Compares the derivatives of an energy term with finite differences: the first thing to run on a
// new EnergyTerm.
//
//   DerivativeReport report = check_derivatives(*energy, x);
//   if (!report.ok()) std::cerr << report.message();   // names the element and the block
//
// Differences of values() check the gradient, and differences of the gradient check the Hessian
// under Curvature::Exact. Other supported curvature models must be positive semidefinite, and
// blends of Exact and Projected must lie between the two. local() without a Hessian must give the
// same gradient; a term that writes through the null pointer crashes here. Elements evaluated
// together must give the values that each gives alone. x must lie inside the domain, away from its
// boundary and from kinks. If there are more than kMaxCheckedElements elements, or elements of more
// than 30 unknowns, a sample is checked, which is the same in every call.

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
  Index checked = 0, elements = 0;             // the number of checked elements, and of all
                                               // elements
  bool ok() const { return mismatches.empty(); }
  // One line per mismatch, and a last line if a sample was checked; empty if ok().
  std::string message() const;
};

inline constexpr Index kMaxCheckedElements = 1000;

// tolerance: relative to the largest entry of the element's gradient or Hessian. Added to that
// entry are the energy divided by the size of the element, and its change by a displacement of 1e-5
// of that size. state: as for the term's evaluation.
DerivativeReport check_derivatives(const EnergyTerm& term, VecIn x, double tolerance = 1e-5,
                                   const TermState& state = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
