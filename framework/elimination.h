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

#include <algorithm>
#include <cstddef>
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

  Index full_size() const { return static_cast<Index>(unknown_.size()); }
  Index auxiliary_size() const { return auxiliary_size_; }
  Index reduced_size() const { return static_cast<Index>(free_.size()); }
  // Independent rows.
  Index rank() const { return full_size() + auxiliary_size() - reduced_size(); }

  // The entries of a row of Z.
  class Row {
   public:
    const Entry* begin() const { return entries_ ? entries_ : &unit_; }
    const Entry* end() const { return begin() + size_; }
    std::size_t size() const { return size_; }
    bool operator==(const Row& other) const {
      return std::equal(begin(), end(), other.begin(), other.end());
    }

   private:
    friend class Elimination;
    const Entry* entries_ = nullptr;  // of a row of several, or of none
    std::size_t size_ = 1;
    Entry unit_{0, 1};
  };
  // x[i] = sum coefficient * y[reduced] + offset(i)
  Row row(Index i) const {
    Row row;
    if (is_other(i)) {
      const std::size_t first = others_[other_of(i)].entries;
      row.entries_ = entries_.data() + first;
      row.size_ = others_[other_of(i) + 1].entries - first;
    } else {
      row.unit_.reduced = unknown_[to_size(i)];
    }
    return row;
  }
  double offset(Index i) const { return is_other(i) ? others_[other_of(i)].offset : 0; }
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

  // A row that is no unit row, or has an offset.
  struct Other {
    std::size_t entries;  // where its own begin
    double offset;
  };
  bool is_other(Index i) const { return unknown_[to_size(i)] < 0; }
  std::size_t other_of(Index i) const { return to_size(-1 - unknown_[to_size(i)]); }

  std::vector<Index> unknown_;  // of x[i]: the reduced unknown that it is, or -1 - its place below
  std::vector<Other> others_;   // and one more, past the end
  std::vector<Entry> entries_;
  std::vector<Index> free_;
  Index auxiliary_size_ = 0;
  std::vector<Definition> definitions_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
