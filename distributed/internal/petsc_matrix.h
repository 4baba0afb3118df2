// The sum of the ranks' matrices as one of PETSc's, assembled again and again on one pattern.
//
//     PetscMatrix matrix(pattern, partition);
//     matrix.set(values, shift);
//     matrix.to_petsc(r, matrix.right_hand_side());
#pragma once

#include <vector>

#include "majorant/framework/partition.h"
#include "majorant/framework/sparse_pattern.h"

struct _p_Mat;  // of PETSc: what a Mat and a Vec point to
struct _p_Vec;

namespace majorant {

class PetscMatrix {
 public:
  // Both outlive the matrix.
  PetscMatrix(const SparsePattern& pattern, const Partition& partition);
  ~PetscMatrix();
  PetscMatrix(const PetscMatrix&) = delete;
  PetscMatrix& operator=(const PetscMatrix&) = delete;

  // H + shift I; values parallel to pattern.rows.
  void set(const Vec& values, double shift);

  _p_Mat* mat() const { return mat_; }
  _p_Vec* right_hand_side() const { return r_; }
  _p_Vec* solution() const { return p_; }
  // The owned entries; and back, copies filled in.
  void to_petsc(const Vec& from, _p_Vec* to) const;
  void from_petsc(_p_Vec* from, Vec& to) const;

 private:
  const SparsePattern& pattern_;
  const Partition& partition_;
  _p_Mat* mat_ = nullptr;
  _p_Vec *r_ = nullptr, *p_ = nullptr;
  std::vector<double> entries_;  // scratch
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
