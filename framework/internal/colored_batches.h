// Groups a term's elements into batches of one rule each and colours the batches. Batches of one
// colour share no unknown, so they can be assembled at the same time. Some elements share an
// unknown with many others (the translation of a seam, an aligned line). They are gathered in few
// batches, since each such batch needs a colour of its own. The plan depends on the term's
// element_dofs, rules and the elimination alone, never on the number of threads.
#pragma once

#include <vector>

#include "majorant/framework/elimination.h"
#include "majorant/framework/energy_term.h"

namespace majorant {

class ColoredBatches {
 public:
  // Batches of one colour share no node.
  ColoredBatches(const ElementDofs& element_dofs, const std::vector<RuleId>& element_rule);
  // Batches of one colour share no reduced unknown.
  ColoredBatches(const ElementDofs& element_dofs, const std::vector<RuleId>& element_rule,
                 const Elimination& elimination);

  Index batch_count() const { return static_cast<Index>(rules_.size()); }
  ElementBatch batch(Index c) const {
    const auto k = to_size(c);
    return {rules_[k], std::span<const Index>(elements_.data() + starts_[k],
                                              elements_.data() + starts_[k + 1])};
  }
  // The numbers of the batches of each colour.
  const std::vector<std::vector<Index>>& colours() const { return colours_; }

 private:
  // group: elements of one group are kept together; empty: all are of one group.
  void make_batches(const ElementDofs& element_dofs, const std::vector<RuleId>& element_rule,
                    const std::vector<Index>& group);
  // touched(e, visit) calls visit(k), 0 <= k < count, for every thing that element e shares.
  template <class Touched>
  void colour(Index count, const Touched& touched);
  std::vector<Index> elements_;
  std::vector<std::size_t> starts_;
  std::vector<RuleId> rules_;
  std::vector<std::vector<Index>> colours_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
