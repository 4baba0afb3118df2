// The scatter map of a problem, from local Hessian entries to the reduced matrix. It is computed
// once, so that assembly is a loop of additions into the values of a fixed pattern. The tables
// already contain Z of x = Z y + c.
#pragma once

#include <limits>
#include <vector>

#include "majorant/framework/elimination.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

// The slots of one term in the matrix. An element takes the direct path if each of its nodes is
// free or fixed as a whole. The rows of Z of a free node are then unit rows of consecutive
// unknowns, those of a fixed node are empty. In a column of the matrix, the entries of a node have
// consecutive slots. Any other element has a list of weighted contributions.
class ScatterMap {
 public:
  ScatterMap(const ElementDofs& element_dofs, const Elimination& elimination,
             const SparsePattern& pattern);

  // Returns the same map for a pattern with more entries: slot k of this pattern is places[k] of
  // the other one.
  ScatterMap moved(const std::vector<Index>& places) const;

  // A range of slots.
  struct Slots {
    Index first = 0, last = std::numeric_limits<Index>::max();

    bool has(Index slot) const { return first <= slot && slot < last; }
  };
  // Returns part `part` of `parts` parts of about equal size, each made of whole columns.
  static Slots share(const SparsePattern& pattern, Index part, Index parts);
  // Adds factor * H of the element at position p of a batch to the slots `own`, which are whole
  // columns.
  void add_hessian(Index element, const LocalSystem& local, int p, double factor, double* values,
                   const Slots& own) const;
  // Adds factor * g to the reduced gradient in the same way.
  void add_gradient(Index element, const LocalSystem& local, int p, double factor,
                    double* gradient) const;

 private:
  struct Contribution {
    int local;  // packed local entry
    Index slot;
    double coefficient;
  };
  struct Target {
    Index reduced;
    double coefficient;
  };
  void build_general(Index element, const ElementDofs& element_dofs, const Elimination& elimination,
                     const SparsePattern& pattern);

  // Finds the reduced unknowns of the nodes of an element. Returns whether the element can take the
  // direct path.
  bool find_unknowns(Index element, const ElementDofs& element_dofs, const Elimination& z);
  // Finds the slots of an element on the direct path. order: scratch.
  void find_slots(Index element, const SparsePattern& pattern, std::vector<int>& order);
  Index general_of(Index element) const { return general_of_.empty() ? -1 : general_of_[element]; }
  std::size_t pairs() const { return to_size(nodes_ * (nodes_ + 1) / 2); }

  int nodes_, block_;           // nodes of an element, unknowns of a node
  std::vector<Index> unknown_;  // #E by nodes: the first reduced unknown, or -1 for a fixed node
  // #E by pairs of nodes, packed, by block. For each column of the node that comes first: the slot
  // at which the entries of the other node begin; for a node with itself, the slot of the diagonal.
  std::vector<Index> slot_;
  std::vector<Index> general_of_;  // #E: index into the general lists, or -1; empty: all -1
  std::vector<std::vector<Contribution>> general_;
  std::vector<std::vector<std::pair<int, Target>>> general_gradient_;
};

// Returns the lower-triangular pattern that the given terms fill after elimination.
SparsePattern reduced_pattern(const std::vector<const ElementDofs*>& terms,
                              const Elimination& elimination);
// Returns the node of each reduced unknown (SparsePattern::block_of).
std::vector<Index> node_blocks(const std::vector<const ElementDofs*>& terms,
                               const Elimination& elimination);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
