// The equalities g = 0 of a problem at a point, and Newton's equations with them.
//
//   const EqualityRows rows(problem, equality_terms(problem), x);
//   const double largest = rows.values().lpNorm<Eigen::Infinity>();
//
// One row an element, the terms one after the other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "majorant/framework/elimination.h"
#include "majorant/framework/problem.h"

namespace majorant {

// The terms of a problem that are equalities (EqualityTerm), in their order.
std::vector<TermId> equality_terms(const Problem& problem);

// The multipliers and penalties of all rows, in the form of states of the terms.
struct EqualityState {
  Vec multipliers, penalties;
};
EqualityState equality_state(const Problem& problem, const std::vector<TermId>& ids);
TermChanges equality_changes(const Problem& problem, const std::vector<TermId>& ids,
                             const EqualityState& state);
// Returns the parts of a vector of all rows that belong to each term.
std::vector<Vec> by_equality(const Problem& problem, const std::vector<TermId>& ids,
                             const Vec& rows);

class EqualityRows {
 public:
  // x: full unknowns, in the domain of all of them.
  EqualityRows(const Problem& problem, std::vector<TermId> ids, const Vec& x);

  Index count() const { return static_cast<Index>(values_.size()); }
  const Vec& values() const { return values_; }  // g
  // The norms of the derivatives of g by the full unknowns, or 1 if that is larger: g divided by
  // its scale is about the distance to its zero.
  const Vec& scales() const { return scales_; }
  // The norms themselves.
  const Vec& norms() const { return norms_; }
  // Returns the largest |g| / scale, 0 without rows, and its row.
  double violation(Index* row = nullptr) const;
  // Returns the origin of a row: "'rods' at element 3, which begins with unknown 6".
  std::string name(Index row) const;

  // Returns A dx and A^T q; A is the derivative of g by the full unknowns.
  Vec times(const Vec& dx) const;
  Vec transposed_times(const Vec& q) const;
  // Returns the diagonal of A^T diag(weights) A.
  Vec diagonal_of_squares(const Vec& weights) const;

 private:
  template <class Visit>
  void visit(const Visit& visit) const;

  const Problem& problem_;
  std::vector<TermId> ids_;
  std::vector<RowMatrix> gradients_;  // by term
  Vec values_, norms_, scales_;
};

// The solution p, q of H p + A^T q = r and A p = s, given solve(b) = (H + A^T R A)^-1 b with the
// diagonal R of the penalties. Conjugate gradients on q, preconditioned by R, converge faster for
// larger R, also for dependent rows. p, r and b are by the unknowns of the problem. residual is
// that of the second equation, relative to its value at q = 0.
struct SaddlePoint {
  Vec p, q;
  double residual = 0;
};
SaddlePoint solve_with_equalities(const std::function<Vec(const Vec& b)>& solve,
                                  const Elimination& elimination, const EqualityRows& rows,
                                  const Vec& penalties, const Vec& r, const Vec& s);

// Returns the place of an element for messages: "unknown 3", "element 2, which begins with unknown
// 6".
std::string place_of(const EnergyTerm& term, Index element);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
