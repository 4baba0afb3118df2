#include "majorant/quads/internal/two_sided_search.h"

#include <algorithm>
#include <functional>

namespace majorant {

void Frontier::clear() {
  for (const Index v : touched_) reached_[v] = {};
  touched_.clear();
  queue_.clear();
}

void Frontier::reach(Index node, double cost, Index step) {
  if (reached_[node].cost == kNever) touched_.push_back(node);
  reached_[node] = {cost, step, false};
  queue_.emplace_back(cost, node);
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

double Frontier::least_cost() {
  while (!queue_.empty() && reached_[queue_.front().second].is_final) pop();
  return queue_.empty() ? kNever : queue_.front().first;
}

Index Frontier::take() {
  const Index v = pop();
  reached_[v].is_final = true;
  return v;
}

Index Frontier::pop() {
  std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
  const Index v = queue_.back().second;
  queue_.pop_back();
  return v;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
