#include "majorant/quads/internal/arc_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/quad_mesh.h"

namespace majorant {

ArcNumbers::ArcNumbers(const SeamlessLattice& lattice, const TMesh& mesh, Arcs arcs,
                       const StopCheck& stop)
    : lattice_(lattice),
      mesh_(mesh),
      stop_(stop),
      quantization_(mesh, std::vector<double>(mesh.arcs.size(), 0),
                    std::vector<Index>(mesh.arcs.size(), arcs == Arcs::Joined ? 0 : 1)) {}

std::vector<Index> ArcNumbers::at(double edge_length) {
  const std::vector<Index> edges = without_bad_quads([&] { return joined_at(edge_length); });
  return refined(edges, edge_length).value_or(edges);
}

std::vector<Index> ArcNumbers::fewest() {
  // So long that none is wanted anywhere, but of numbers that are as few those on longer arcs: the
  // same ones however they are found.
  double longest = 0;
  for (const TArc& arc : mesh_.arcs) longest += static_cast<double>(arc.length());
  return without_bad_quads([&] { return joined_at(longest); });
}

std::vector<Index> ArcNumbers::for_count(double asked) {
  double length = 0;
  const std::vector<Index> edges = without_bad_quads([&] { return closest_to(asked, length); });
  const std::optional<std::vector<Index>> closer = refined(edges, length);
  const bool is_close = closer && std::abs(static_cast<double>(quad_count(mesh_, *closer)) / asked -
                                           1) <= kCountClose;
  return is_close ? *closer : edges;
}

// Numbers with more and more edges, up to a bound, until no quad has a vertex twice.
template <class Numbers>
std::vector<Index> ArcNumbers::without_bad_quads(const Numbers& numbers) {
  constexpr int kRounds = 20;
  for (int round = 0;; ++round) {
    std::vector<Index> edges = numbers();
    const std::vector<Index> more = ExtractedQuads(lattice_, mesh_, edges).arcs_of_bad_quads();
    if (more.empty() || round == kRounds) return edges;
    for (const Index arc : more) quantization_.raise(arc, edges[arc] + 1);
  }
}

// Arcs that would join two of these get an edge, one after the other; where there would be no
// quads then, the longest arc without edges does.
std::vector<Index> ArcNumbers::joined_at(double edge_length) {
  want(edge_length);
  for (;;) {
    std::vector<Index> edges = quantization_.numbers(Effort::First, stop_);
    std::vector<Index> more = ExtractedQuads(lattice_, mesh_, edges).joining_arcs();
    if (more.empty() && quad_count(mesh_, edges) == 0) more = {longest_without_edges(edges)};
    if (more.empty()) return edges;
    for (const Index arc : more) quantization_.raise(arc, edges[arc] + 1);
  }
}

// The numbers nearest to the lengths, where these join nothing either.
std::optional<std::vector<Index>> ArcNumbers::refined(const std::vector<Index>& edges,
                                                      double edge_length) {
  want(edge_length);
  std::vector<Index> nearest = quantization_.numbers(Effort::Least, stop_);
  ExtractedQuads quads(lattice_, mesh_, nearest);
  if (nearest == edges || quad_count(mesh_, nearest) == 0 || !quads.joining_arcs().empty() ||
      !quads.arcs_of_bad_quads().empty())
    return std::nullopt;
  return nearest;
}

void ArcNumbers::want(double edge_length) {
  std::vector<double> wanted;
  for (const TArc& arc : mesh_.arcs)
    wanted.push_back(static_cast<double>(arc.length()) / edge_length);
  quantization_.want(wanted);
}

// length receives that of their edges.
std::vector<Index> ArcNumbers::closest_to(double asked, double& length) {
  constexpr int kSteps = 12;
  constexpr double kNearEnough = 0.005;
  // Longer edges in a row that make no fewer quads, all more than asked, after which still longer
  // ones are not tried.
  constexpr int kMostInVain = 3;
  double next = std::sqrt(static_cast<double>(lattice_.twice_area()) / 2 / asked);
  std::vector<Index> best;
  double least_off = std::numeric_limits<double>::infinity(), least_ratio = least_off;
  for (int step = 0, in_vain = 0; step < kSteps && in_vain < kMostInVain; ++step) {
    std::vector<Index> edges = joined_at(next);
    const double ratio = static_cast<double>(quad_count(mesh_, edges)) / asked;
    const double off = std::abs(std::log(ratio));
    in_vain = ratio >= least_ratio && least_ratio > 1 ? in_vain + 1 : 0;
    least_ratio = std::min(ratio, least_ratio);
    if (off < least_off) {
      least_off = off;
      length = next;
      best = std::move(edges);
    }
    if (off <= kNearEnough) break;
    next *= std::sqrt(ratio);
  }
  return best;
}

Index ArcNumbers::longest_without_edges(const std::vector<Index>& edges) const {
  Index longest = -1;
  for (Index a = 0; a < static_cast<Index>(edges.size()); ++a)
    if (edges[a] == 0 && (longest < 0 || mesh_.arcs[a].length() > mesh_.arcs[longest].length()))
      longest = a;
  return longest;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
