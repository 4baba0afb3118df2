#include "majorant/elements/positivity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"

namespace majorant {

Subdivision::Subdivision(const BernsteinBasis& basis, const std::vector<EdgeBisection>& steps)
    : count_(basis.count()) {
  for (int k = 0; k < count_; ++k)
    if (basis.is_corner(k)) corners_.push_back(k);
  for (const EdgeBisection& s : steps) plans_.push_back(plan(basis, s));
}

Subdivision::Plan Subdivision::plan(const BernsteinBasis& basis, const EdgeBisection& step) {
  const auto a = to_size(step.a), b = to_size(step.b);
  // Returns the coefficient of a child whose midpoint has exponent l and whose remaining end of the
  // edge has exponent `rest`.
  const auto child = [&](const std::vector<int>& slots, int end, Exponents parent, int l,
                         int rest) {
    parent[end] = rest;
    Exponents e{};
    for (std::size_t s = 0; s < slots.size(); ++s)
      e[s] = slots[s] == EdgeBisection::kMidpoint ? l : parent[slots[s]];
    return basis.find(e);
  };
  Plan out;
  for (int k = 0; k < basis.count(); ++k) {
    Exponents e = basis.exponents(k);
    if (e[b] != 0) continue;  // one line for each function at end a
    const int n = e[a];
    if (n > kMaxDegree) throw InvalidArgument("Subdivision: degree above 31");
    out.levels = std::max(out.levels, n);
    out.lines.push_back(n);
    for (int l = 0; l <= n; ++l) {
      e[a] = n - l;
      e[b] = l;
      out.lines.push_back(basis.find(e));
    }
    for (int l = 0; l <= n; ++l) out.lines.push_back(child(step.first, step.a, e, l, n - l));
    for (int l = 0; l <= n; ++l) out.lines.push_back(child(step.second, step.b, e, l, n - l));
  }
  return out;
}

namespace {

constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A depth-first bisection, with memory for two children at every depth, allocated once.
template <class T>
class Bisection {
 public:
  Bisection(const Subdivision& cell, int max_depth) : cell_(cell), max_depth_(max_depth) {}

 protected:
  struct Children {
    T *first, *second;
  };
  Children split(int depth, const T* parent) {
    const auto level = to_size(depth), n = to_size(cell_.count());
    if (levels_.size() <= level) levels_.emplace_back(2 * n);
    T* memory = levels_[level].data();  // stays where it is when levels_ grows
    cell_.bisect(depth, parent, memory, memory + n);
    return {memory, memory + n};
  }
  const Subdivision& cell_;
  const int max_depth_;

 private:
  std::vector<std::vector<T>> levels_;
};

class Certifier : Bisection<double> {
 public:
  using Bisection::Bisection;

  PositivityProof prove(const double* a, double error, int depth) {
    PositivityProof proof;
    double lowest = a[0];  // may be NaN, which min_element would skip
    for (int k = 1; k < cell_.count(); ++k)
      if (a[k] < lowest || std::isnan(a[k])) lowest = a[k];
    proof.lower_bound = lowest - error;
    if (proof.lower_bound > 0) {
      proof.result = ProofStatus::Proven;
      return proof;
    }
    for (const int k : cell_.corners())
      if (!(a[k] - error > 0)) proof.result = ProofStatus::Violated;
    if (proof.result == ProofStatus::Undecided && depth < max_depth_)
      prove_children(a, error, depth, proof);
    return proof;
  }

 private:
  void prove_children(const double* a, double error, int depth, PositivityProof& proof) {
    // Averages round: each level adds at most half an ulp of the largest coefficient and, if half
    // of a sum underflows, half the smallest double. The sum of errors rounds as well.
    double largest = 0;
    for (int k = 0; k < cell_.count(); ++k) largest = std::max(largest, std::abs(a[k]));
    const double rounding =
        1.01 * cell_.levels(depth) * (kUnitRoundoff<double> * largest + kSmallest);
    const double child_error = std::nextafter(error + rounding, kInfinity);
    const auto [first, second] = split(depth, a);
    const PositivityProof one = prove(first, child_error, depth + 1);
    proof.result = one.result;
    proof.depth = one.depth + 1;
    if (one.result != ProofStatus::Proven) return;
    const PositivityProof two = prove(second, child_error, depth + 1);
    proof.result = two.result;
    proof.depth = std::max(one.depth, two.depth) + 1;
    if (two.result == ProofStatus::Proven)
      proof.lower_bound = std::min(one.lower_bound, two.lower_bound);
  }
};

template <int K>
class StepSearch : Bisection<StepPolynomial<K>> {
  using Base = Bisection<StepPolynomial<K>>;
  using Base::cell_;
  using Base::max_depth_;

 public:
  using Base::Base;

  double largest(const StepPolynomial<K>* p, double s, int depth) {
    double all = s;
    for (int k = 0; k < cell_.count(); ++k)
      if (!plainly_positive(p[k], all)) all = std::min(all, root(p[k], all));
    if (depth >= max_depth_) return all;
    double corner = s;
    for (const int k : cell_.corners()) corner = std::min(corner, root(p[k], corner));
    if (all >= corner) return all;
    const auto [first, second] = Base::split(depth, p);
    const double step = largest(first, corner, depth + 1);
    if (step <= all) return std::max(step, all);
    return std::max(all, largest(second, step, depth + 1));
  }

 private:
  static double root(const StepPolynomial<K>& p, double s) {
    return p.power[0] > 0 ? first_root(p, s) : 0.0;
  }
};

}  // namespace

PositivityProof certify_positive(const Subdivision& cell, const double* coefficients, double error,
                                 int max_depth) {
  return Certifier(cell, max_depth).prove(coefficients, error, 0);
}

double largest_positive_step(const Subdivision& cell, const StepPolynomial<2>* p, double s,
                             int max_depth) {
  return StepSearch<2>(cell, max_depth).largest(p, s, 0);
}

double largest_positive_step(const Subdivision& cell, const StepPolynomial<3>* p, double s,
                             int max_depth) {
  return StepSearch<3>(cell, max_depth).largest(p, s, 0);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
