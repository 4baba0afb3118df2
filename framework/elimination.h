// Exact elimination of linear constraints: {x : A x = b} = {Z y + c}.
//
// Gauss-Jordan over the rationals, row by row, so redundant rows are recognized without a floating
// point tolerance and Z solves A Z = 0 exactly. Every reduced unknown is one of the full unknowns
// (its row of Z is a unit row); rows whose coefficients are +-1 give a Z of +-1.
// Not for dense or large systems of general rows: fill-in is not controlled.
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
  };

  // Throws Error(Unsupported) naming the row when the rows contradict each other: the residual of
  // a redundant row exceeds 1e-12 times the largest right-hand side, or when an exact coefficient
  // leaves 64 bits.
  Elimination(Index full_size, const ConstraintRows& rows);

  Index full_size() const { return static_cast<Index>(starts_.size()) - 1; }
  Index reduced_size() const { return static_cast<Index>(free_.size()); }
  Index rank() const { return full_size() - reduced_size(); }

  // Row i of Z: x[i] = sum coefficient * y[reduced] + offset(i).
  const Entry* begin(Index i) const { return entries_.data() + starts_[static_cast<size_t>(i)]; }
  const Entry* end(Index i) const { return entries_.data() + starts_[static_cast<size_t>(i) + 1]; }
  double offset(Index i) const { return offset_[i]; }
  // The full unknown that reduced unknown j is.
  Index full_index(Index j) const { return free_[static_cast<size_t>(j)]; }

  void expand(VecIn y, Vec& x) const;               // x = Z y + c
  void expand_direction(VecIn dy, Vec& dx) const;   // dx = Z dy
  void restrict_gradient(VecIn gx, Vec& gy) const;  // gy = Z^T gx
  // y with Z y + c closest in the free unknowns, and the largest |x - (Z y + c)|.
  Vec reduce(VecIn x, double* residual) const;

 private:
  std::vector<std::size_t> starts_;
  std::vector<Entry> entries_;
  std::vector<Index> free_;
  Vec offset_;
};

}  // namespace majorant
