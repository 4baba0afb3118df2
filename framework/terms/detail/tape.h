// A tape of the operations of a lambda on the unknowns of a few elements, recorded for all of them
// at once. Recording computes values; differentiate_tape() below computes derivatives.
//
// With a node's value u(a, b) and the derivative w of the result by that node, the Hessian of the
// result is the sum over all nodes of
//     w (u_aa g_a g_a^T + u_ab (g_a g_b^T + g_b g_a^T) + u_bb g_b g_b^T),
// where g_a and g_b are the gradients of a and b by the unknowns ([GM12] sum the same in reverse).
// Linear nodes have no second derivatives, and gradients store only the unknowns that they depend
// on, so most products of a full Hessian are never formed.
//
// Not for inclusion: local_term.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/terms/detail/lanes.h"

namespace majorant::detail {

struct TapeNode {
  enum Kind : std::int32_t {
    Constant,
    Unknown,     // a: its number
    Shifted,     // a + constant
    Sum,         // a + b
    Difference,  // a - b
    Negative,    // -a
    Scaled,      // c a; numbers: c
    Product,     // a b
    Function,    // f(a); numbers: f', f''
    Choice,      // a or b; numbers: 1 or 0, 0 or 1
    Function2,   // f(a, b); numbers: f_a, f_b, f_aa, f_ab, f_bb
    Damped,      // a, whose second derivatives are scaled by c; numbers: c
  };
  // The tables hold the number of operands, and of numbers, of each kind.
  static constexpr int operand_counts[] = {0, 0, 1, 2, 2, 1, 1, 2, 1, 2, 2, 1};
  static constexpr int number_counts[] = {0, 0, 0, 0, 0, 0, 1, 0, 2, 2, 5, 1};

  Kind kind;
  std::int32_t a, b;     // the operands: earlier nodes
  std::int32_t numbers;  // the first one in Tape::numbers
};

struct Tape {
  Tape() {
    nodes.reserve(kReserved);
    values.reserve(kReserved);
    numbers.reserve(kReserved);
  }
  void clear() {
    nodes.clear();
    values.clear();
    numbers.clear();
    has_choices = branches_differ = is_damped = false;
  }

  std::vector<TapeNode> nodes;
  std::vector<Lanes> values;  // of nodes
  std::vector<Lanes> numbers;
  bool has_choices = false;
  // True if a branch was taken on which the lanes disagree.
  bool branches_differ = false;
  bool is_damped = false;  // has Damped nodes

 private:
  static constexpr std::size_t kReserved = 128;  // nodes: the energy of a tetrahedron
};

// A projection of packed Hessians that is better than clamping eigenvalues.
using PackedProjection = void (*)(double projection_weight, double* packed);

// Writes gradients and, unless out.hessian is null, Hessians by `unknowns` unknowns, of lanes 0 to
// lanes - 1 to the positions from `position` on. result: a node. Hessians that are not semidefinite
// by a factorization are projected by `projection` or, if that is null, by their eigenvalues.
void differentiate_tape(Tape& tape, std::int32_t result, int unknowns, int lanes,
                        std::size_t position, double projection_weight, PackedProjection projection,
                        Workspace& workspace, LocalSystem& out);

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
