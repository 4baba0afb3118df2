// Computes the derivatives of a tape, for all lanes at once, by the widest vector instructions of
// the machine.
//
// The order of operations does not depend on the instruction set. All sets but the baseline fuse
// multiplications and additions.
#pragma once

#include "majorant/framework/terms/detail/tape.h"

namespace majorant::detail {

struct TapeView {
  const TapeNode* nodes;
  const Lanes *values, *numbers;
  std::int32_t result;  // the last node that is used
  int unknowns;
  bool is_damped;  // Tape::is_damped
};

// Memory for the derivatives of a tape, with result + 1 nodes of at most `unknowns` unknowns.
struct TapeScratch {
  Lanes* adjoint;         // nodes
  Lanes* derivative;      // nodes by unknowns
  std::int32_t* first;    // nodes: the first derivative of each
  std::int32_t* list;     // nodes: the first entry of its list of unknowns
  std::int32_t* length;   // nodes
  std::int32_t* unknown;  // nodes by unknowns: the lists
};

struct TapeKernels {
  const char* name;  // of the instruction set: "AVX-512"
  // Computes the gradient and, unless hessian is null, the packed lower triangle of the Hessian.
  void (*differentiate)(const TapeView& tape, const TapeScratch& scratch, Lanes* gradient,
                        Lanes* hessian);
  // Returns, one bit a lane, the lanes whose matrix is not semidefinite by a factorization, like
  // is_semidefinite() (framework/detail/packed_symmetric.h). Overwrites the matrices.
  unsigned (*indefinite)(int size, double zero_pivot, Lanes* packed);
  // Does clamp_eigenvalues() of the same file in these lanes. Returns the lanes that did not
  // converge, whose matrices are unchanged. memory: clamp_memory() numbers.
  unsigned (*clamp)(int size, double projection_weight, unsigned lanes, Lanes* packed,
                    Lanes* memory);
  static constexpr std::size_t clamp_memory(std::size_t size) { return size * (size + 3); }
};

std::vector<const TapeKernels*> all_tape_kernels();  // of this machine, the widest last
const TapeKernels& tape_kernels();                   // the widest

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
