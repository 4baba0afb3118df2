// Exact elimination of linear constraints: {x : A x = b} = {Z y + c}.
//
// Rows of integers are reduced over the rationals, row by row, so redundant rows are recognized
// without a floating point tolerance and Z solves A Z = 0 exactly. Other rows follow, to within
// rounding (affine_presolve.h). Every reduced unknown is a full unknown (its row of Z is a unit
// row) or an auxiliary unknown of the constraints. Rows of integers are divided by their common
// factor and solved for the first unknown, in numerical order, whose coefficient is +-1. Without
// such an unknown they are solved for the first one, and Z gets fractions. Auxiliary unknowns come
// last, so that points are expressed by them where possible. Not for dense or large systems of
// general rows: fill-in is not controlled.
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

  // Throws Error(Unsupported) naming the row if rows contradict each other: the residual of a
  // redundant integer row exceeds 1e-12 times the largest right-hand side. Other rows throw as in
  // solve_rows().
  Elimination(Index full_size, const ConstraintRows& rows);

  Index full_size() const { return static_cast<Index>(unknown_.size()); }
  Index auxiliary_size() const { return auxiliary_size_; }
  Index reduced_size() const { return static_cast<Index>(free_.size()); }
  // The number of independent rows.
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
    const Entry* entries_ = nullptr;  // of a row without a single unit entry
    std::size_t size_ = 1;
    Entry unit_{0, 1};
  };
  // Row i: x[i] = sum coefficient * y[reduced] + offset(i)
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
  // The full unknown of reduced unknown j; full_size() + a for auxiliary unknown a.
  Index full_index(Index j) const { return free_[static_cast<size_t>(j)]; }

  // Returns whether rows 0 to full_unknowns - 1 of Z are equal to those of `other`.
  bool begins_like(const Elimination& other, Index full_unknowns) const;

  void expand(VecIn y, Vec& x) const;               // x = Z y + c
  void expand_direction(VecIn dy, Vec& dx) const;   // dx = Z dy
  void restrict_gradient(VecIn gx, Vec& gy) const;  // gy = Z^T gx
  // Returns the y that equals x in the free unknowns (auxiliary ones:
  // ConstraintRows::add_auxiliary), and writes the largest |x - (Z y + c)| to `residual`.
  Vec reduce(VecIn x, double* residual) const;
  // Returns the y whose Z y + c is closest to x, up to 1e-10 of the distance; reduce(x) if x
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

  // A row that is not a unit row, or has an offset.
  struct Other {
    std::size_t entries;  // the first of its entries
    double offset;
  };
  bool is_other(Index i) const { return unknown_[to_size(i)] < 0; }
  std::size_t other_of(Index i) const { return to_size(-1 - unknown_[to_size(i)]); }

  std::vector<Index> unknown_;  // of x[i]: its reduced unknown, or -1 - its index in others_
  std::vector<Other> others_;   // and one more, past the end
  std::vector<Entry> entries_;
  std::vector<Index> free_;
  Index auxiliary_size_ = 0;
  std::vector<Definition> definitions_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
