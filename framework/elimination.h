// Exact elimination of linear constraints: {x : A x = b} = {Z y + c}.
//
// Rows of integers are reduced over the rationals, row by row, so redundant ones are recognized
// without a floating point tolerance and Z solves A Z = 0 exactly; other rows follow, to within
// rounding (affine_presolve.h). Every reduced unknown is one of the full unknowns (its row of Z is
// a unit row) or an auxiliary unknown of the constraints. Rows of integers are divided by their
// common factor and solved for the first unknown, in numerical order, with coefficient +-1 (where
// there is none: for the first unknown, and Z gets fractions); auxiliary unknowns come last, so a
// point that can be expressed by them is. Not for dense or large systems of general rows: fill-in
// is not controlled.
#pragma once

#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/framework/types.h"

namespace majorant {

class Elimination {
 public:
  struct Entry {
    Index reduced;
    double coefficient;
    bool operator==(const Entry&) const = default;
  };

  // Throws Error(Unsupported) naming the row when the rows contradict each other: the residual of
  // a redundant row of integers exceeds 1e-12 times the largest right-hand side; else as
  // solve_rows().
  Elimination(Index full_size, const ConstraintRows& rows);

  Index full_size() const { return static_cast<Index>(starts_.size()) - 1; }
  Index auxiliary_size() const { return auxiliary_size_; }
  Index reduced_size() const { return static_cast<Index>(free_.size()); }
  // Independent rows.
  Index rank() const { return full_size() + auxiliary_size() - reduced_size(); }

  // Row i of Z: x[i] = sum coefficient * y[reduced] + offset(i).
  const Entry* begin(Index i) const { return entries_.data() + starts_[static_cast<size_t>(i)]; }
  const Entry* end(Index i) const { return entries_.data() + starts_[static_cast<size_t>(i) + 1]; }
  double offset(Index i) const { return offset_[i]; }
  // The full unknown that reduced unknown j is; full_size() + a for auxiliary unknown a.
  Index full_index(Index j) const { return free_[static_cast<size_t>(j)]; }

  // Returns whether rows 0 to full_unknowns - 1 of Z are those of `other`.
  bool begins_like(const Elimination& other, Index full_unknowns) const;

  void expand(VecIn y, Vec& x) const;               // x = Z y + c
  void expand_direction(VecIn dy, Vec& dx) const;   // dx = Z dy
  void restrict_gradient(VecIn gx, Vec& gy) const;  // gy = Z^T gx
  // y that equals x in the free unknowns (auxiliary ones: see ConstraintRows::add_auxiliary), and
  // the largest |x - (Z y + c)|.
  Vec reduce(VecIn x, double* residual) const;
  // y whose Z y + c is the point closest to x, up to 1e-10 of the distance; reduce(x) where x
  // satisfies the constraints to rounding.
  Vec project(VecIn x) const;

 private:
  // value = constant + sum coefficient * (x, auxiliary values)[unknown]
  struct Definition {
    Index auxiliary;
    double constant;
    std::vector<Entry> terms;
  };
  void define_auxiliaries(const ConstraintRows& rows);

  std::vector<std::size_t> starts_;
  std::vector<Entry> entries_;
  std::vector<Index> free_;
  Index auxiliary_size_ = 0;
  std::vector<Definition> definitions_;
  Vec offset_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
