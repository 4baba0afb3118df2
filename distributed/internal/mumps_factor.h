// A matrix factorized by MUMPS, on all ranks.
//
//     MumpsFactor factor(matrix.mat());      // analysed once a pattern
//     if (factor.factorize() == FactorStatus::Ok) factor.solve(r, p);
#pragma once

#include "majorant/framework/linear_solver.h"

struct _p_Mat;  // of PETSc: what a Mat and a Vec point to
struct _p_Vec;

namespace majorant {

class MumpsFactor {
 public:
  explicit MumpsFactor(_p_Mat* matrix);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  // Of the values that the matrix has now; by its inertia, not by what a Cholesky variant believes.
  // Throws Error(Unsupported) where MUMPS runs out of memory or fails otherwise.
  FactorStatus factorize();
  void solve(_p_Vec* r, _p_Vec* p) const;

 private:
  _p_Mat *matrix_, *factor_ = nullptr;
  bool analysed_ = false;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
