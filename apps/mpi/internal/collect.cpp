#include "apps/mpi/internal/collect.h"

#include <utility>

namespace majorant {
namespace {

using Messages = std::vector<Ranks::Message>;

template <class List>
List broadcast_list(const Ranks& ranks, List of_first) {
  of_first.resize(ranks.of_first(of_first.size()));
  ranks.broadcast(std::as_writable_bytes(std::span(of_first)));
  return of_first;
}

}  // namespace

std::vector<double> scattered(const Ranks& ranks, std::vector<std::vector<double>> of_ranks) {
  double size = 0;
  std::vector<double> sizes;
  Messages none, counts, lists;
  if (ranks.rank() > 0) {
    ranks.exchange(none, Messages{{0, {&size, 1}}});
    std::vector<double> mine(static_cast<std::size_t>(size));
    ranks.exchange(none, Messages{{0, mine}});
    return mine;
  }
  for (const auto& list : of_ranks) sizes.push_back(static_cast<double>(list.size()));
  for (int r = 1; r < ranks.count(); ++r) {
    counts.push_back({r, {&sizes[static_cast<std::size_t>(r)], 1}});
    lists.push_back({r, of_ranks[static_cast<std::size_t>(r)]});
  }
  ranks.exchange(counts, none);
  ranks.exchange(lists, none);
  return std::move(of_ranks.front());
}

std::vector<std::vector<double>> gathered(const Ranks& ranks, std::vector<double> mine) {
  auto size = static_cast<double>(mine.size());
  Messages none, counts, lists;
  if (ranks.rank() > 0) {
    ranks.exchange(Messages{{0, {&size, 1}}}, none);
    ranks.exchange(Messages{{0, mine}}, none);
    return {};
  }
  std::vector<double> sizes(static_cast<std::size_t>(ranks.count()));
  for (int r = 1; r < ranks.count(); ++r)
    counts.push_back({r, {&sizes[static_cast<std::size_t>(r)], 1}});
  ranks.exchange(none, counts);
  std::vector<std::vector<double>> all(sizes.size());
  all[0] = std::move(mine);
  for (int r = 1; r < ranks.count(); ++r) {
    auto& list = all[static_cast<std::size_t>(r)];
    list.resize(static_cast<std::size_t>(sizes[static_cast<std::size_t>(r)]));
    lists.push_back({r, list});
  }
  ranks.exchange(none, lists);
  return all;
}

std::vector<double> broadcast(const Ranks& ranks, std::vector<double> of_first) {
  return broadcast_list(ranks, std::move(of_first));
}

std::string broadcast(const Ranks& ranks, std::string of_first) {
  return broadcast_list(ranks, std::move(of_first));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
