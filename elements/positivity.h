// Proofs that a polynomial in Bernstein form, such as det J of an element, is positive on its cell.
//
// The polynomial is positive if all coefficients are. If that does not decide, the cell is
// bisected. [MC20] Sec. 5.2, App. E.
#pragma once

#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/internal/step_polynomial.h"

namespace majorant {

// Bisection of polynomials in Bernstein form.
//
// Every split cuts an edge of the cell at its midpoint: univariate de Casteljau at 1/2 along the
// lines of coefficients parallel to the edge, then a relabelling of the vertices of each child.
// Triangles: newest-vertex bisection ([MC20] App. E, method.md E8); tetrahedra: Kuhn simplices
// [Mau95]; squares: s and t in turn. All three keep the shapes of cells bounded.
class Subdivision {
 public:
  // The largest degree of a polynomial that is bisected: twice the highest degree of det J, plus
  // one. Chosen, not tuned.
  static constexpr int kMaxDegree = 31;

  // steps: applied cyclically by depth. Throws InvalidArgument beyond kMaxDegree.
  Subdivision(const BernsteinBasis& basis, const std::vector<EdgeBisection>& steps);

  int count() const { return count_; }                          // coefficients
  const std::vector<int>& corners() const { return corners_; }  // coefficients that are values
  // Returns the number of averages in a child's coefficient at this depth, for error bounds.
  int levels(int depth) const { return step(depth).levels; }

  // Bisects a polynomial. parent, first, second: count() coefficients of any type with + and a
  // half().
  template <class T>
  void bisect(int depth, const T* parent, T* first, T* second) const;

 private:
  // The lines of a cut one after the other: number of averages L, then L+1 coefficients of the
  // parent, of the first child (by level, from a) and of the second (by level, from b).
  struct Plan {
    int levels = 0;
    std::vector<int> lines;
  };
  const Plan& step(int depth) const { return plans_[to_size(depth) % plans_.size()]; }
  static Plan plan(const BernsteinBasis& basis, const EdgeBisection& step);
  int count_;
  std::vector<int> corners_;
  std::vector<Plan> plans_;
};

template <class T>
void Subdivision::bisect(int depth, const T* parent, T* first, T* second) const {
  const Plan& p = step(depth);
  T row[kMaxDegree + 1];
  for (const int *at = p.lines.data(), *end = at + p.lines.size(); at != end;) {
    const int n = *at++;
    const int *to_first = at + n + 1, *to_second = to_first + n + 1;
    for (int k = 0; k <= n; ++k) row[k] = parent[at[k]];
    first[to_first[0]] = row[0];
    second[to_second[0]] = row[n];
    for (int l = 1; l <= n; ++l) {
      for (int k = 0; k <= n - l; ++k) row[k] = half(row[k] + row[k + 1]);
      first[to_first[l]] = row[0];
      second[to_second[l]] = row[n - l];
    }
    at = to_second + n + 1;
  }
}

// Proves that the polynomial with these coefficients, each exact to +- error, is positive on the
// cell. Bisects down to max_depth, its own rounding included. Proven: there is a proof. Violated:
// not provably positive at a corner. Undecided: max_depth was reached.
PositivityProof certify_positive(const Subdivision& cell, const double* coefficients, double error,
                                 int max_depth);

// Returns the largest s' <= s such that the polynomial with coefficients p(t) is positive on the
// cell for all 0 <= t < s'. Bisects up to max_depth if that lengthens the step.
double largest_positive_step(const Subdivision& cell, const StepPolynomial<2>* p, double s,
                             int max_depth);
double largest_positive_step(const Subdivision& cell, const StepPolynomial<3>* p, double s,
                             int max_depth);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
