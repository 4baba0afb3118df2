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
  // So long that none is wanted anywhere, but of numbers that are as few those on longer arcs: the
  // same ones however they are found.
  double longest = 0;
  for (const TArc& arc : mesh_.arcs) longest += static_cast<double>(arc.length());
  return without_bad_quads([&] { return joined_at(longest); });
}

std::vector<Index> QuantizationSearch::for_count(double asked) {
  double length = 0;
  const std::vector<Index> edges = without_bad_quads([&] {
    Found found = closest_to(asked);
    length = found.length;
    return std::move(found.edges);
  });
  const std::optional<std::vector<Index>> closer = refined(edges, length);
  const bool is_close = closer && std::abs(static_cast<double>(quad_count(mesh_, *closer)) / asked -
                                           1) <= kCountClose;
  return is_close ? *closer : edges;
}

// Numbers with more and more edges, up to a bound, until no quad has a vertex twice.
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

// Arcs that would join two of these get an edge, one after the other; where there would be no
// quads then, the longest arc without edges does.
std::vector<Index> QuantizationSearch::joined_at(double edge_length) {
  want(edge_length);
  for (;;) {
    std::vector<Index> edges = quantization_.numbers(Effort::First, stop_);
    std::vector<Index> more = QuadConnectivity(mesh_, edges).joining_arcs();
    if (more.empty() && quad_count(mesh_, edges) == 0) more = {longest_without_edges(edges)};
    if (more.empty()) return edges;
    for (const Index arc : more) raise(arc, edges[arc] + 1);
  }
}

// The numbers nearest to the lengths, where these join nothing either.
std::optional<std::vector<Index>> QuantizationSearch::refined(const std::vector<Index>& edges,
                                                              double edge_length) {
  want(edge_length);
  std::vector<Index> nearest = quantization_.numbers(Effort::Least, stop_);
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

void QuantizationSearch::want(double edge_length) {
  std::vector<double> wanted;
  for (const TArc& arc : mesh_.arcs)
    wanted.push_back(static_cast<double>(arc.length()) / edge_length);
  quantization_.want(wanted);
}

// Longer edges make fewer quads, in steps. Where one step passes by what was asked by more than
// kCountClose, some of the arcs that lose edges there keep them: sides of equal lengths get
// different numbers then. Where that is not close either, all of them keep their edges, so that
// others lose theirs instead.
QuantizationSearch::Found QuantizationSearch::closest_to(double asked) {
  // Chosen: a needle of 1,000 quads takes two.
  constexpr int kMostSteps = 3;
  double length = std::sqrt(static_cast<double>(lattice_.twice_area()) / 2 / asked);
  Found best;
  for (int step = 0;; ++step) {
    const auto [more, fewer] = closest_from(length, asked, best);
    const auto is_close = [&] { return std::abs(best.ratio - 1) <= kCountClose; };
    if (is_close() || !more || !fewer) return best;
    if (Found found = between(*more, *fewer, asked); found.off() < best.off())
      best = std::move(found);
    if (is_close() || step == kMostSteps) return best;
    for (Index a = 0; a < static_cast<Index>(more->edges.size()); ++a)
      if (more->edges[a] > fewer->edges[a]) raise(a, more->edges[a]);
    length = more->length;
  }
}

// Arcs that lose edges from `more` to `fewer` keep them, one after the other, those that were
// closest to keeping them first, until there are more quads than asked. Returns the numbers of the
// closest count.
QuantizationSearch::Found QuantizationSearch::between(const Found& more, const Found& fewer,
                                                      double asked) const {
  // Each takes a search; meshes of so many arcs have close counts without. Chosen.
  constexpr int kMostKept = 64;
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
    found.ratio = static_cast<double>(quad_count(mesh_, found.edges)) / asked;
    if (found.off() < best.off()) best = found;
    if (found.ratio >= 1 || ++kept == kMostKept) break;
  }
  return best;
}

// best: what is closer replaces it.
QuantizationSearch::Bracket QuantizationSearch::closest_from(double length, double asked,
                                                             Found& best) {
  constexpr int kTried = 12;
  constexpr double kNearEnough = 0.005;
  // Longer edges in a row that make no fewer quads, all more than asked, after which still longer
  // ones are not tried.
  constexpr int kMostInVain = 3;
  Bracket bracket;
  double least_ratio = std::numeric_limits<double>::infinity(), last_off = least_ratio;
  for (int tried = 0, in_vain = 0; tried < kTried && in_vain < kMostInVain; ++tried) {
    const long raised = raised_;
    Found found{length, joined_at(length), 0};
    found.ratio = static_cast<double>(quad_count(mesh_, found.edges)) / asked;
    // Those were of fewer edges.
    if (raised_ != raised) bracket.fewer.reset();
    const double ratio = found.ratio, off = found.off();
    in_vain = ratio >= least_ratio && least_ratio > 1 ? in_vain + 1 : 0;
    least_ratio = std::min(ratio, least_ratio);
    if (off < best.off()) best = found;
    if (off <= kNearEnough) break;
    (ratio > 1 ? bracket.more : bracket.fewer) = std::move(found);
    // As many as of squares, while that halves what they are off; else by bisection.
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
