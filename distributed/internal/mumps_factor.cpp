#include "distributed/internal/mumps_factor.h"

#include <petscmat.h>

#include "distributed/internal/petsc_call.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

// Per cent of the memory that MUMPS expects to need, on top; chosen; its own 20 are for
// matrices without delayed pivots.
constexpr PetscInt kMoreMemory = 60;

}  // namespace

// MAT_SPD stays unset: as a definite matrix (SYM = 1) MUMPS would not report negative pivots.
MumpsFactor::MumpsFactor(Mat matrix) : matrix_(matrix) {
  require_petsc(MatGetFactor(matrix_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor_));
  require_petsc(MatMumpsSetIcntl(factor_, 13, 1));  // the root on one rank, so that it is counted
  require_petsc(MatMumpsSetIcntl(factor_, 14, kMoreMemory));
  require_petsc(MatMumpsSetIcntl(factor_, 24, 1));  // pivots that vanish are counted
}

MumpsFactor::~MumpsFactor() { MatDestroy(&factor_); }

FactorStatus MumpsFactor::factorize() {
  MatFactorInfo info;
  require_petsc(MatFactorInfoInitialize(&info));
  if (!analysed_) {
    IS rows = nullptr, columns = nullptr;
    require_petsc(MatGetOrdering(matrix_, MATORDERINGEXTERNAL, &rows, &columns));
    require_petsc(MatCholeskyFactorSymbolic(factor_, matrix_, rows, &info));
    ISDestroy(&rows);
    ISDestroy(&columns);
    analysed_ = true;
  }
  require_petsc(MatCholeskyFactorNumeric(factor_, matrix_, &info));
  MatFactorError error = MAT_FACTOR_NOERROR;
  require_petsc(MatFactorGetError(factor_, &error));
  if (error == MAT_FACTOR_OUTMEMORY)
    throw Error(ErrorKind::Unsupported,
                "MUMPS has not enough memory for the factor; use more ranks, or cg-hypre");
  if (error != MAT_FACTOR_NOERROR) return FactorStatus::NotPositiveDefinite;
  PetscInt negative = 0, zero = 0, positive = 0;
  require_petsc(MatGetInertia(factor_, &negative, &zero, &positive));
  return negative == 0 && zero == 0 ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
}

void MumpsFactor::solve(::Vec r, ::Vec p) const { require_petsc(MatSolve(factor_, r, p)); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
