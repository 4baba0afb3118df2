#include "majorant/quads/internal/quantization.h"

#include <algorithm>
#include <memory>

#include "majorant/framework/error.h"
#include "majorant/quads/internal/branch_and_bound.h"

namespace majorant {

class Quantization::Relaxed {
 public:
  Relaxed(const TMesh& mesh, const std::vector<Index>& least)
      : network_(mesh), search_(network_.node_count()), flow_(network_, least) {}

  void set_targets(const std::vector<double>& targets) {
    costs_.clear();
    for (const double w : targets) costs_.push_back({w, 1 / std::max(w, 1.0)});
    flow_.set_costs(costs_);
  }
  void raise(Index arc, Index least) { flow_.set_least(arc, least); }

  std::vector<Index> numbers(SearchEffort effort, const StopCheck& stop) {
    std::vector<Index> edges;
    if (flow_.balance(search_, stop)) edges = branch_and_bound(flow_, search_, effort, stop);
    if (static_cast<Index>(edges.size()) < flow_.arc_count())
      throw Error(ErrorKind::Infeasible,
                  "no whole numbers of quads were found for the sides of all patches");
    return edges;
  }

 private:
  const FlowNetwork network_;
  std::vector<MinCostFlow::Cost> costs_;
  TwoSidedSearch search_;
  MinCostFlow flow_;
};

Quantization::Quantization(const TMesh& mesh, const std::vector<double>& targets,
                           const std::vector<Index>& least)
    : relaxed_(std::make_unique<Relaxed>(mesh, least)) {
  set_targets(targets);
}

Quantization::~Quantization() = default;

void Quantization::set_targets(const std::vector<double>& targets) {
  relaxed_->set_targets(targets);
}

void Quantization::raise(Index arc, Index least) { relaxed_->raise(arc, least); }

std::vector<Index> Quantization::numbers(SearchEffort effort, const StopCheck& stop) {
  return relaxed_->numbers(effort, stop);
}

Index sum_of(const std::vector<Index>& half_arcs, const std::vector<Index>& edges) {
  Index sum = 0;
  for (const Index h : half_arcs) sum += edges[arc_of(h)];
  return sum;
}

long quad_count(const TMesh& mesh, const std::vector<Index>& edges) {
  long count = 0;
  for (const TPatch& patch : mesh.patches)
    count += long{sum_of(patch.sides[0], edges)} * sum_of(patch.sides[1], edges);
  return count;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
