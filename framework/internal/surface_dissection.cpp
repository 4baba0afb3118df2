#include "majorant/framework/internal/surface_dissection.h"

#include <camd.h>
#include <metis.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <new>
#include <numeric>
#include <span>
#include <utility>

#include "majorant/framework/internal/coarse_graph.h"
#include "majorant/framework/internal/metis_scope.h"
#include "majorant/framework/internal/vertex_cut.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

// The largest part that is not divided further. Smaller parts take more separators, larger ones
// more fill-in.
constexpr Index kUndivided = 1000;
// The number of coarse nodes for each part, and the number below which coarsening ends.
constexpr Index kCoarsePart = 16, kFewCoarse = 10000;
// The distance from a border of parts, in edges, within which the smallest separator is searched.
constexpr Index kBand = 4;
// Options of METIS: the permitted imbalance of the halves in thousandths, and the number of
// divisions, of which METIS takes the best.
constexpr idx_t kImbalance = 100, kDivisions = 4;

constexpr Index kSeparator = -1;

// The parts of a graph. The parts of a half, a quarter and so on have successive numbers: on level
// l, the first half of each of 2^l ranges is to be separated from the second.
class Division {
 public:
  Division(const BlockNeighbours& near, int levels)
      : count_(Index(1) << levels), parts_(to_size(near.size())) {
    const CoarseGraph coarse(near, std::max(kCoarsePart * count_, kFewCoarse));
    coarse_parts_.assign(to_size(coarse.graph.size()), 0);
    std::vector<Index> all(coarse_parts_.size());
    std::iota(all.begin(), all.end(), 0);
    {
      const MetisScope scope;
      divide(coarse.graph, all, 0, count_);
    }
    for (std::size_t k = 0; k < parts_.size(); ++k) parts_[k] = coarse_parts_[coarse.node_of[k]];
  }
  Index count() const { return count_; }
  std::vector<Index> take() { return std::move(parts_); }

 private:
  // nodes: the nodes of `graph`, as numbers of the whole coarse graph.
  void divide(const WeightedGraph& graph, const std::vector<Index>& nodes, Index first,
              Index last) {
    for (const Index node : nodes) coarse_parts_[node] = first;
    if (last - first == 1 || graph.size() < 2) return;
    const std::vector<Index> half = halves(graph);
    const Index middle = first + (last - first) / 2;
    for (const Index side : {0, 1}) {
      std::vector<Index> some, whole;
      for (Index k = 0; k < graph.size(); ++k)
        if (half[k] == side) {
          some.push_back(k);
          whole.push_back(nodes[k]);
        }
      divide(graph.among(some), whole, side == 0 ? first : middle, side == 0 ? middle : last);
    }
  }
  static std::vector<Index> halves(const WeightedGraph& graph) {
    std::vector<Index> out(to_size(graph.size()), 0);
    if (graph.near.nodes.empty()) {  // METIS requires an edge
      std::fill(out.begin() + graph.size() / 2, out.end(), 1);
      return out;
    }
    std::array<idx_t, METIS_NOPTIONS> options;
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_UFACTOR] = kImbalance;
    options[METIS_OPTION_NCUTS] = kDivisions;
    idx_t nodes = graph.size(), weights = 1, parts = 2, cut = 0;
    const auto input = [](const std::vector<Index>& in) { return const_cast<idx_t*>(in.data()); };
    if (METIS_PartGraphRecursive(&nodes, &weights, input(graph.near.starts),
                                 input(graph.near.nodes), input(graph.weights), nullptr,
                                 input(graph.edge_weights), &parts, nullptr, nullptr,
                                 options.data(), &cut, out.data()) != METIS_OK)
      throw std::bad_alloc();
    return out;
  }

  Index count_;
  std::vector<Index> coarse_parts_, parts_;
};

// A range of parts whose halves are to be separated.
struct Range {
  Index first, middle, last;

  bool has(Index part) const { return part >= first && part < last; }
  bool is_second(Index part) const { return part >= middle; }
};

// Nodes and their new parts.
using Changes = std::vector<std::pair<Index, Index>>;

// Finds separators, one after the other.
class SeparatorSearch {
 public:
  SeparatorSearch(const BlockNeighbours& near, const std::vector<Index>& parts)
      : near_(near), parts_(parts), number_(to_size(near.size()), -1) {}

  // border: nodes of the range; it contains all that have neighbours in the other half. sizes: the
  // sizes of all parts.
  Changes separate(const Range& range, std::span<const Index> border,
                   std::span<const Index> sizes) {
    find_band(range, border);
    if (band_.empty()) return {};
    Index first = std::accumulate(sizes.begin() + range.first, sizes.begin() + range.middle, 0);
    Index second = std::accumulate(sizes.begin() + range.middle, sizes.begin() + range.last, 0);
    for (const Index node : band_) --(range.is_second(parts_[node]) ? second : first);
    const VertexCut cut = cut_of_band(range);
    const auto difference = [&](const std::vector<Side>& of) {
      return std::abs(first + std::ranges::count(of, Side::Sources) - second -
                      std::ranges::count(of, Side::Sinks));
    };
    const bool is_second = difference(cut.near_sinks()) < difference(cut.near_sources());
    Changes changes = changes_of(range, is_second ? cut.near_sinks() : cut.near_sources());
    for (const Index node : band_) number_[node] = -1;
    return changes;
  }

 private:
  using Side = VertexCut::Side;
  using Terminal = VertexCut::Terminal;

  void find_band(const Range& range, std::span<const Index> border) {
    band_.clear();
    const auto add = [&](Index node) {
      if (number_[node] >= 0) return;
      number_[node] = static_cast<Index>(band_.size());
      band_.push_back(node);
    };
    for (const Index node : border) add(node);
    layers_.assign(1, 0);
    for (Index layer = 0; layer < kBand; ++layer) {
      const std::size_t first = layers_.back(), last = band_.size();
      layers_.push_back(last);
      for (std::size_t k = first; k < last; ++k)
        for (const Index other : near_.of(band_[k]))
          if (range.has(parts_[other])) add(other);
    }
  }

  // Terminals are the nodes of the band next to nodes of the range outside of it. If a half has
  // none, its last nodes are terminals.
  VertexCut cut_of_band(const Range& range) const {
    BlockNeighbours near;
    std::vector<Terminal> terminals(band_.size(), Terminal::None);
    const auto terminal = [&](std::size_t k) {
      return range.is_second(parts_[band_[k]]) ? Terminal::Sink : Terminal::Source;
    };
    for (std::size_t k = 0; k < band_.size(); ++k) {
      for (const Index other : near_.of(band_[k])) {
        if (number_[other] >= 0)
          near.nodes.push_back(number_[other]);
        else if (range.has(parts_[other]))
          terminals[k] = terminal(k);
      }
      near.starts.push_back(static_cast<Index>(near.nodes.size()));
    }
    for (const Terminal kind : {Terminal::Source, Terminal::Sink})
      if (std::ranges::find(terminals, kind) == terminals.end())
        for (std::size_t k = band_.size(), end = 0; k-- > end;)
          if (terminal(k) == kind) {
            if (end == 0) end = *(std::ranges::upper_bound(layers_, k) - 1);  // of its layer
            terminals[k] = kind;
          }
    return {std::move(near), std::move(terminals)};
  }

  // A node that changes to the other half takes the part of a neighbour there.
  Changes changes_of(const Range& range, const std::vector<Side>& sides) const {
    Changes changes;
    std::vector<Index> parts(band_.size()), open;
    const auto is_second = [&](std::size_t k) { return sides[k] == Side::Sinks; };
    for (std::size_t k = 0; k < band_.size(); ++k) {
      const Index part = parts_[band_[k]];
      if (sides[k] == Side::Separator) {
        parts[k] = kSeparator;
        changes.emplace_back(band_[k], kSeparator);
      } else if (is_second(k) != range.is_second(part)) {
        parts[k] = kSeparator;
        open.push_back(static_cast<Index>(k));
      } else {
        parts[k] = part;
      }
    }
    for (bool has_changed = true; has_changed && !open.empty();) {
      const std::size_t before = open.size();
      std::erase_if(open, [&](Index k) {
        for (const Index other : near_.of(band_[k])) {
          const Index part = number_[other] >= 0 ? parts[number_[other]] : parts_[other];
          if (!range.has(part) || range.is_second(part) != is_second(to_size(k))) continue;
          parts[k] = part;
          changes.emplace_back(band_[k], part);
          return true;
        }
        return false;
      });
      has_changed = open.size() < before;
    }
    for (const Index k : open)
      changes.emplace_back(band_[k], is_second(to_size(k)) ? range.middle : range.first);
    return changes;
  }

  const BlockNeighbours& near_;
  const std::vector<Index>& parts_;
  std::vector<Index> number_;  // in the band; -1: not there
  std::vector<Index> band_;
  std::vector<std::size_t> layers_;  // the first node of each layer in the band
};

// The nodes of each part, ascending.
struct Buckets {
  std::vector<Index> starts, nodes;

  Buckets(const std::vector<Index>& parts, Index count) : starts(to_size(count) + 1, 0) {
    for (const Index part : parts)
      if (part >= 0) ++starts[part + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    nodes.resize(to_size(starts.back()));
    std::vector<Index> next(starts.begin(), starts.end() - 1);
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (parts[k] >= 0) nodes[next[parts[k]]++] = static_cast<Index>(k);
  }
  std::span<Index> of(Index part) {
    return {nodes.data() + starts[part], nodes.data() + starts[part + 1]};
  }
};

// Orders parts by CAMD, one after the other.
class PartOrder {
 public:
  explicit PartOrder(const BlockNeighbours& near)
      : near_(near), number_(to_size(near.size()), -1) {}

  // Orders the nodes of a part; their neighbours outside of it are eliminated after all of them.
  void sort(std::span<Index> part) {
    std::vector<Index> nodes(part.begin(), part.end());
    const std::size_t own = nodes.size();
    for (std::size_t k = 0; k < own; ++k) number_[nodes[k]] = static_cast<Index>(k);
    for (std::size_t k = 0; k < own; ++k)
      for (const Index other : near_.of(nodes[k]))
        if (number_[other] < 0) {
          number_[other] = static_cast<Index>(nodes.size());
          nodes.push_back(other);
        }
    const std::size_t size = nodes.size();
    std::vector<Index> starts, lengths, entries, constraints(size, 1);
    std::fill_n(constraints.begin(), own, 0);
    for (std::size_t k = 0; k < size; ++k) {
      starts.push_back(static_cast<Index>(entries.size()));
      for (const Index other : near_.of(nodes[k]))
        if (const Index number = number_[other]; number >= 0 && (k < own || to_size(number) < own))
          entries.push_back(number);
      lengths.push_back(static_cast<Index>(entries.size()) - starts.back());
    }
    for (const Index node : nodes) number_[node] = -1;
    const auto used = static_cast<Index>(entries.size());
    entries.resize(entries.size() + entries.size() / 2 + size);  // working memory
    // Eight arrays of scratch memory that CAMD needs.
    std::vector<Index> scratch(8 * (size + 1)), order(size);
    const auto array = [&](std::size_t k) { return scratch.data() + k * (size + 1); };
    double info[CAMD_INFO];
    camd_2(static_cast<Index>(size), starts.data(), entries.data(), lengths.data(),
           static_cast<Index>(entries.size()), used, array(0), array(1), order.data(), array(2),
           array(3), array(4), array(5), nullptr, info, constraints.data(), array(6));
    for (std::size_t k = 0; k < own; ++k) part[k] = nodes[order[k]];
  }

 private:
  const BlockNeighbours& near_;
  std::vector<Index> number_;  // in the part; -1: not there
};

// One object for each thread, made at its first use.
template <class T>
class ForThreads {
 public:
  explicit ForThreads(int threads) : all_(to_size(threads)) {}
  template <class... A>
  T& of(int thread, const A&... arguments) {
    if (!all_[thread]) all_[thread] = std::make_unique<T>(arguments...);
    return *all_[thread];
  }

 private:
  std::vector<std::unique_ptr<T>> all_;
};

class SurfaceDissection {
 public:
  SurfaceDissection(const BlockNeighbours& near, int levels)
      : near_(near), threads_(ThreadCount::current()), searches_(threads_) {
    {
      Division division(near, levels);
      count_ = division.count();
      parts_ = division.take();
    }
    sizes_.assign(to_size(count_), 0);
    for (const Index part : parts_) ++sizes_[part];
    for (Index node = 0; node < near.size(); ++node)
      if (std::ranges::any_of(near.of(node), [&](Index k) { return parts_[k] != parts_[node]; }))
        border_.push_back(node);
    for (Index ranges = 1; ranges < count_; ranges *= 2) separate(ranges);
  }

  std::vector<Index> order() {
    Buckets buckets(parts_, count_);
    ForThreads<PartOrder> orders(threads_);
    parallel_tasks(
        count_, [&](Index part, int thread) { orders.of(thread, near_).sort(buckets.of(part)); },
        threads_);
    std::vector<Index> out = std::move(buckets.nodes);
    out.insert(out.end(), separators_.rbegin(), separators_.rend());
    return out;
  }

 private:
  void separate(Index ranges) {
    const Index width = count_ / ranges;
    const auto range = [&](Index k) {
      return Range{k * width, k * width + width / 2, (k + 1) * width};
    };
    std::vector<std::vector<Index>> borders(to_size(ranges));
    for (const Index node : border_) {
      if (parts_[node] < 0) continue;
      const Index k = parts_[node] / width;
      const Range own = range(k);
      if (std::ranges::any_of(near_.of(node), [&](Index other) {
            const Index part = parts_[other];
            return own.has(part) && own.is_second(part) != own.is_second(parts_[node]);
          }))
        borders[k].push_back(node);
    }
    std::vector<Changes> changes(to_size(ranges));
    parallel_tasks(
        ranges,
        [&](Index k, int thread) {
          changes[k] = searches_.of(thread, near_, parts_).separate(range(k), borders[k], sizes_);
        },
        threads_);
    for (const Changes& of_one : changes) {
      for (const auto& [node, part] : of_one) {
        --sizes_[parts_[node]];
        parts_[node] = part;
        if (part == kSeparator) {
          separators_.push_back(node);
          continue;
        }
        ++sizes_[part];
        border_.push_back(node);
        for (const Index other : near_.of(node)) border_.push_back(other);
      }
    }
  }

  const BlockNeighbours& near_;
  int threads_;
  Index count_ = 1;
  std::vector<Index> parts_;   // of nodes
  std::vector<Index> sizes_;   // of parts
  std::vector<Index> border_;  // contains all nodes with neighbours in other parts
  std::vector<Index> separators_;
  ForThreads<SeparatorSearch> searches_;
};

}  // namespace

std::vector<Index> surface_dissection(const BlockNeighbours& near) {
  int levels = 0;
  while (near.size() >> levels > kUndivided) ++levels;
  return SurfaceDissection(near, levels).order();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
