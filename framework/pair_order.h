// Sorts the numbers 0 to count - 1 by a pair of numbers that each of them has, by counting:
// half-edges by the ends of their edges, corners by vertex and texture coordinate.
//
//   const std::array<std::pair<Index, Index>, 3> ends{{{0, 1}, {0, 2}, {0, 1}}};   // low, high
//   const PairOrder sides(3, 3, [&](Index h) { return ends[h]; });   // of 3 vertices, 3 half-edges
//   std::size_t inner = 0;
//   sides.for_each_run([&](std::span<const PairOrder::Entry> edge) { inner += edge.size() > 1; });
//   const bool is_edge = sides.find(0, 2) >= 0;
#pragma once

#include <algorithm>
#include <compare>
#include <span>
#include <vector>

#include "majorant/framework/parallel.h"
#include "majorant/framework/types.h"

namespace majorant {

class PairOrder {
 public:
  struct Entry {
    Index second, number;
    auto operator<=>(const Entry&) const = default;
  };

  // pair(k): a std::pair or an aggregate of two numbers, the first below `firsts`. k is left out if
  // the first number is negative. Takes O(firsts + count) unless one first number has very many
  // entries.
  template <class Pair>
  PairOrder(Index firsts, Index count, const Pair& pair) : begin_(to_size(firsts) + 1, 0) {
    for (Index k = 0; k < count; ++k)
      if (const auto [first, ignored] = pair(k); first >= 0) ++begin_[first];
    for (std::size_t f = 1; f < begin_.size(); ++f) begin_[f] += begin_[f - 1];
    entries_.resize(to_size(begin_.back()));
    for (Index k = count - 1; k >= 0; --k)
      if (const auto [first, second] = pair(k); first >= 0) entries_[--begin_[first]] = {second, k};
    parallel_for(firsts, kPiece, [&](Index f) { sort(begin_[f], begin_[f + 1]); });
  }

  // Returns the entries with this first number, ordered by the second number, then by the entry.
  std::span<const Entry> of(Index first) const {
    return {entries_.data() + begin_[first], entries_.data() + begin_[first + 1]};
  }

  // Returns the smallest number with this pair; -1 if there is none.
  Index find(Index first, Index second) const {
    for (const Entry& entry : of(first))
      if (entry.second >= second) return entry.second == second ? entry.number : -1;
    return -1;
  }

  // Calls visit(entries) for the entries of each pair, pairs ascending.
  template <class Visit>
  void for_each_run(const Visit& visit) const {
    for (Index f = 0; f + 1 < static_cast<Index>(begin_.size()); ++f)
      for (std::span<const Entry> left = of(f); !left.empty();) {
        std::size_t size = 1;
        while (size < left.size() && left[size].second == left[0].second) ++size;
        visit(left.first(size));
        left = left.subspan(size);
      }
  }

 private:
  static constexpr Index kPiece = 4096;  // groups a task: some 50 us of sorting
  static constexpr Index kShort = 24;    // ranges that insertion sorts faster

  // Sorts ranges whose entries are ascending by their numbers.
  void sort(Index first, Index last) {
    Entry* const begin = entries_.data() + first;
    Entry* const end = entries_.data() + last;
    if (last - first > kShort) return std::sort(begin, end);
    for (Entry* e = begin; e != end; ++e) {
      const Entry entry = *e;
      Entry* to = e;
      for (; to != begin && to[-1].second > entry.second; --to) *to = to[-1];
      *to = entry;
    }
  }

  std::vector<Index> begin_;  // the first entry of each first number, and the end
  std::vector<Entry> entries_;
};

// Pairs numbered 0, 1, ... in the order of their first occurrence.
struct NumberedPairs {
  std::vector<Index> number;  // by the number that has the pair
  std::vector<Index> first;   // by the number of the pair: its first occurrence
};

// firsts, count, pair: as for PairOrder; no number may be left out.
template <class Pair>
NumberedPairs numbered_in_order(Index firsts, Index count, const Pair& pair) {
  NumberedPairs result;
  result.number.resize(to_size(count));
  const PairOrder order(firsts, count, pair);
  order.for_each_run([&](std::span<const PairOrder::Entry> run) {
    for (const auto& [ignored, k] : run) result.number[k] = run[0].number;
  });
  for (Index k = 0; k < count; ++k) {
    if (result.number[k] < k) {
      result.number[k] = result.number[result.number[k]];
    } else {
      result.number[k] = static_cast<Index>(result.first.size());
      result.first.push_back(k);
    }
  }
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
