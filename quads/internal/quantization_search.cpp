#include "majorant/quads/internal/quantization_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "majorant/quads/internal/quad_connectivity.h"
#include "majorant/quads/quad_mesh.h"

namespace majorant {

QuantizationSearch::QuantizationSearch(const SeamlessLattice& lattice, const TMesh& mesh,
                                       ArcLengths lengths, const StopCheck& stop)
    : QuantizationSearch(
          lattice, mesh,
          std::vector<Index>(mesh.arcs.size(), lengths == ArcLengths::NonNegative ? 0 : 1), stop) {}

QuantizationSearch::QuantizationSearch(const SeamlessLattice& lattice, const TMesh& mesh,
                                       std::vector<Index> least, const StopCheck& stop)
    : lattice_(lattice),
      mesh_(mesh),
      stop_(stop),
      least_(std::move(least)),
      quantization_(mesh, std::vector<double>(mesh.arcs.size(), 0), least_) {}

std::vector<Index> QuantizationSearch::at(double edge_length) {
  const std::vector<Index> edges = without_bad_quads([&] { return joined_at(edge_length); });
  return refined(edges, edge_length).value_or(edges);
}

std::vector<Index> QuantizationSearch::fewest() {
  // The edge length is so large that all target numbers are nearly 0. Among equally small numbers,
  // those on longer arcs are preferred, which makes the result unique.
  double longest = 0;
  for (const TArc& arc : mesh_.arcs) longest += static_cast<double>(arc.length());
  return without_bad_quads([&] { return joined_at(longest); });
}

std::vector<Index> QuantizationSearch::for_count(double requested) {
  double length = 0;
  const std::vector<Index> edges = without_bad_quads([&] {
    Found found = closest_to(requested);
    length = found.length;
    return std::move(found.edges);
  });
  const std::optional<std::vector<Index>> closer = refined(edges, length);
  const bool is_close =
      closer &&
      std::abs(static_cast<double>(quad_count(mesh_, *closer)) / requested - 1) <= kCountClose;
  return is_close ? *closer : edges;
}

// Raises numbers of edges, up to a limit, until no quad has a vertex twice.
template <class Numbers>
std::vector<Index> QuantizationSearch::without_bad_quads(const Numbers& numbers) {
  constexpr int kRounds = 20;
  for (int round = 0;; ++round) {
    std::vector<Index> edges = numbers();
    const std::vector<Index> more = QuadConnectivity(mesh_, edges).arcs_of_bad_quads();
    if (more.empty() || round == kRounds) return edges;
    for (const Index arc : more) raise(arc, edges[arc] + 1);
  }
}

// Raises arcs that join two such parts, one after the other; if there would be no quads, the
// longest arc without edges.
std::vector<Index> QuantizationSearch::joined_at(double edge_length) {
  set_targets(edge_length);
  for (;;) {
    std::vector<Index> edges = quantization_.numbers(SearchEffort::First, stop_);
    std::vector<Index> more = QuadConnectivity(mesh_, edges).joining_arcs();
    if (more.empty() && quad_count(mesh_, edges) == 0) more = {longest_without_edges(edges)};
    if (more.empty()) return edges;
    for (const Index arc : more) raise(arc, edges[arc] + 1);
  }
}

// Returns the numbers nearest to the lengths, if they also join nothing.
std::optional<std::vector<Index>> QuantizationSearch::refined(const std::vector<Index>& edges,
                                                              double edge_length) {
  set_targets(edge_length);
  std::vector<Index> nearest = quantization_.numbers(SearchEffort::Least, stop_);
  QuadConnectivity quads(mesh_, nearest);
  if (nearest == edges || quad_count(mesh_, nearest) == 0 || !quads.joining_arcs().empty() ||
      !quads.arcs_of_bad_quads().empty())
    return std::nullopt;
  return nearest;
}

void QuantizationSearch::raise(Index arc, Index least) {
  quantization_.raise(arc, least);
  least_[arc] = std::max(least_[arc], least);
  ++raised_;
}

void QuantizationSearch::set_targets(double edge_length) {
  std::vector<double> targets;
  for (const TArc& arc : mesh_.arcs)
    targets.push_back(static_cast<double>(arc.length()) / edge_length);
  quantization_.set_targets(targets);
}

// Longer edges make fewer quads, in steps. If a step jumps over the requested number by more than
// kCountClose, some of the arcs that lose edges in this step keep them, so that sides of equal
// lengths get different numbers. If that count is not close either, all these arcs keep their
// edges, and others lose theirs.
QuantizationSearch::Found QuantizationSearch::closest_to(double requested) {
  // Thin surfaces take two steps. Chosen, not tuned.
  constexpr int kMaxSteps = 3;
  double length = std::sqrt(static_cast<double>(lattice_.twice_area()) / 2 / requested);
  Found best;
  for (int step = 0;; ++step) {
    const auto [more, fewer] = closest_from(length, requested, best);
    const auto is_close = [&] { return std::abs(best.ratio - 1) <= kCountClose; };
    if (is_close() || !more || !fewer) return best;
    if (Found found = between(*more, *fewer, requested); found.off() < best.off())
      best = std::move(found);
    if (is_close() || step == kMaxSteps) return best;
    for (Index a = 0; a < static_cast<Index>(more->edges.size()); ++a)
      if (more->edges[a] > fewer->edges[a]) raise(a, more->edges[a]);
    length = more->length;
  }
}

// Lets arcs that lose edges from `more` to `fewer` keep them one after the other, until there are
// more quads than requested. Arcs whose target is nearest to the larger number come first. Returns
// the numbers of the closest count.
QuantizationSearch::Found QuantizationSearch::between(const Found& more, const Found& fewer,
                                                      double requested) const {
  // Each kept arc takes a search; meshes with more arcs have close counts anyway. Chosen, not
  // tuned.
  constexpr int kMaxKeptArcs = 64;
  QuantizationSearch numbers(lattice_, mesh_, least_, stop_);
  std::vector<Index> losing;
  for (Index a = 0; a < static_cast<Index>(fewer.edges.size()); ++a)
    if (more.edges[a] > fewer.edges[a]) losing.push_back(a);
  const auto lost = [&](Index a) {
    return fewer.edges[a] - static_cast<double>(mesh_.arcs[a].length()) / fewer.length;
  };
  std::stable_sort(losing.begin(), losing.end(),
                   [&](Index a, Index b) { return lost(a) < lost(b); });
  Found found = fewer, best = fewer;
  int kept = 0;
  for (const Index a : losing) {
    if (found.edges[a] >= more.edges[a]) continue;
    numbers.raise(a, found.edges[a] + 1);
    found.edges = numbers.joined_at(fewer.length);
    found.ratio = static_cast<double>(quad_count(mesh_, found.edges)) / requested;
    if (found.off() < best.off()) best = found;
    if (found.ratio >= 1 || ++kept == kMaxKeptArcs) break;
  }
  return best;
}

// best: is replaced by closer results.
QuantizationSearch::Bracket QuantizationSearch::closest_from(double length, double requested,
                                                             Found& best) {
  constexpr int kTried = 12;
  constexpr double kNearEnough = 0.005;
  // The number of consecutive longer edges with too many and no fewer quads after which the search
  // ends.
  constexpr int kMaxFutileSteps = 3;
  Bracket bracket;
  double least_ratio = std::numeric_limits<double>::infinity(), last_off = least_ratio;
  for (int tried = 0, in_vain = 0; tried < kTried && in_vain < kMaxFutileSteps; ++tried) {
    const long raised = raised_;
    Found found{length, joined_at(length), 0};
    found.ratio = static_cast<double>(quad_count(mesh_, found.edges)) / requested;
    // The lower bounds have grown, so the smaller count is no longer valid.
    if (raised_ != raised) bracket.fewer.reset();
    const double ratio = found.ratio, off = found.off();
    in_vain = ratio >= least_ratio && least_ratio > 1 ? in_vain + 1 : 0;
    least_ratio = std::min(ratio, least_ratio);
    if (off < best.off()) best = found;
    if (off <= kNearEnough) break;
    (ratio > 1 ? bracket.more : bracket.fewer) = std::move(found);
    // The number of quads is proportional to the inverse square of the edge length. This step is
    // used while it halves the deviation; then bisection.
    length *= std::sqrt(ratio);
    const auto& [more, fewer] = bracket;
    if (more && fewer && (length <= more->length || length >= fewer->length || off > last_off / 2))
      length = std::sqrt(more->length * fewer->length);
    last_off = off;
  }
  return bracket;
}

Index QuantizationSearch::longest_without_edges(const std::vector<Index>& edges) const {
  Index longest = -1;
  for (Index a = 0; a < static_cast<Index>(edges.size()); ++a)
    if (edges[a] == 0 && (longest < 0 || mesh_.arcs[a].length() > mesh_.arcs[longest].length()))
      longest = a;
  return longest;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
