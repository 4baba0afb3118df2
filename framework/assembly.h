// The scatter map of a problem, from local Hessian entries to the reduced matrix: computed once, so
// that assembly is a loop of additions into the values of a fixed pattern. The tables already
// contain Z of x = Z y + c.
#pragma once

#include <vector>

#include "majorant/framework/elimination.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

// Slots of one term. An element whose unknowns are all free or fixed (every row of Z has at most
// one entry, equal to 1) takes the direct path; any other element has a list of weighted
// contributions.
class ScatterMap {
 public:
  ScatterMap(const ElementDofs& element_dofs, const Elimination& elimination,
             const SparsePattern& pattern);

  // Returns the same map in a pattern that has more entries: slot k of the old one is places[k]
  // there.
  ScatterMap moved(const std::vector<Index>& places) const;

  // Adds factor * H of the element at position p of a batch.
  void add_hessian(Index element, const LocalSystem& local, int p, double factor,
                   double* values) const;
  // Adds factor * g likewise, into the reduced gradient.
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

  // The slots of an element with these reduced unknowns, packed. order: scratch.
  void find_slots(const Index* reduced, const SparsePattern& pattern, std::vector<int>& order,
                  Index* direct) const;

  int local_size_, packed_size_;
  std::vector<Index> direct_;      // #E by packed_size: slot, or -1 for dropped entries
  std::vector<Index> reduced_;     // #E by local_size: reduced unknown, or -1
  std::vector<Index> general_of_;  // #E: index into the general lists, or -1
  std::vector<std::vector<Contribution>> general_;
  std::vector<std::vector<std::pair<int, Target>>> general_gradient_;
};

// The lower-triangular pattern that the given terms fill after elimination.
SparsePattern reduced_pattern(const std::vector<const ElementDofs*>& terms,
                              const Elimination& elimination);
// The node that each reduced unknown belongs to: SparsePattern::block_of.
std::vector<Index> node_blocks(const std::vector<const ElementDofs*>& terms,
                               const Elimination& elimination);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
