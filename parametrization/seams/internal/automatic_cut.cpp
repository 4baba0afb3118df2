#include "majorant/parametrization/seams/internal/automatic_cut.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "majorant/parametrization/seams/internal/cut_terminals.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/mirrored_candidate.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// The length by which a cut without any strain may exceed the best one, in square roots of the
// area. It lets boxes, tins and square tubes be unfolded whole.
constexpr double kUnfoldedExcess = 1;
// Upper bound on the cost and length of a mirrored cut, relative to the best one. The mirror plane
// is in full view, so edges along it cost more.
constexpr double kMirroredRatio = 1.15;
// Upper bound on searches for compressed vertices while the first cut leaves more than the limit.
constexpr int kMaxCompressedRounds = 6;

StopCheck either(const StopCheck& one, const StopCheck& other) {
  return one.asking([=] {
    const Directive why = one();
    return why == Directive::Continue ? other() : why;
  });
}

// Returns the cut through these vertices, shortened, if that is cheaper than the best one.
std::optional<CutCandidate> shortened_route(const CutProblem& problem,
                                            const std::vector<Index>& terminals,
                                            const AutomaticCut& best, const StopCheck& progress) {
  const AutomaticCut full = routed(problem, terminals);
  if (full.strain > std::max(problem.limit, best.strain)) return {};
  AutomaticCut cut = shortened(problem, full, terminals, {}, progress);
  const double excess = cost_of(problem, cut) - cost_of(problem, best);
  if (!(excess < 0)) return {};
  return CutCandidate{std::move(cut), excess};
}

// The candidate makers follow.

std::optional<CutCandidate> shortened_first_cut(const CutProblem& problem, const AutomaticCut& best,
                                                const StopCheck& progress) {
  AutomaticCut cut = shortened(problem, best, problem.cones, {}, progress);
  const double excess = cost_of(problem, cut) - cost_of(problem, best);
  return CutCandidate{std::move(cut), excess};
}

// Proposes a cut through vertices of least weight, where seams are welcome.
std::optional<CutCandidate> through_least_weights(const CutProblem& problem,
                                                  const AutomaticCut& best,
                                                  const StopCheck& /*progress*/) {
  const std::vector<Index> least = least_weighted_vertices(problem);
  if (least.empty()) return {};
  std::vector<Index> terminals = problem.cones;
  terminals.insert(terminals.end(), least.begin(), least.end());
  return shortened_route(problem, terminals, best, {});
}

// Proposes a cut through the ends and the cones of the best cut; on small surfaces also one through
// the ends of that cut.
std::optional<CutCandidate> rerouted(const CutProblem& problem, const AutomaticCut& best,
                                     const StopCheck& progress) {
  std::optional<CutCandidate> first =
      shortened_route(problem, terminals_on(problem, best), best, progress);
  if (problem.rounds() == 1) return first;
  const AutomaticCut& base = first ? first->cut : best;
  std::optional<CutCandidate> second = shortened_route(problem, base.ends, base, {});
  if (!second) return first;
  second->excess = cost_of(problem, second->cut) - cost_of(problem, best);
  return second;
}

// Proposes a cut through all vertices that are not flat, so that the surface unfolds.
std::optional<CutCandidate> unfolded(const CutProblem& problem, const AutomaticCut& best,
                                     const StopCheck& /*progress*/) {
  const double most = plain_cost_of(problem, best) + kUnfoldedExcess;
  if (least_cost_through(problem, problem.curved) > most * std::sqrt(problem.mesh.area()))
    return {};
  AutomaticCut cut = routed(problem, problem.curved);
  cut.unfolds = true;
  if (!problem.is_faceted && !(cut.strain < best.strain)) return {};
  const double excess = plain_cost_of(problem, cut) - most;
  return CutCandidate{std::move(cut), excess};
}

// Proposes a cut that is its own mirror image if the surface is, as users expect of a character.
std::optional<CutCandidate> mirrored(const CutProblem& problem, const AutomaticCut& best,
                                     const StopCheck& /*progress*/) {
  if (problem.request.images == Images::Ignored || best.unfolds) return {};
  std::optional<AutomaticCut> cut = mirrored_cut(problem, best);
  if (!cut || length_of(problem, *cut) > kMirroredRatio * length_of(problem, best)) return {};
  const double excess = cost_of(problem, *cut) - kMirroredRatio * cost_of(problem, best);
  return CutCandidate{*std::move(cut), excess};
}

constexpr CandidateMaker kMakers[] = {
    {.make = shortened_first_cut, .share = 0.5},
    {.make = through_least_weights, .is_for_small_surfaces = true},
    {.make = rerouted, .is_repeated = true, .share = 0.5},
    {.make = unfolded},
    {.make = mirrored},
};
// The makers for a surface that needs no cut.
constexpr CandidateMaker kFoldingMakers[] = {{.make = unfolded}};

// Returns the cut through all cones and, while that leaves more strain than the limit, through the
// most compressed vertices.
AutomaticCut first_cut(const CutProblem& problem, std::vector<Index> terminals) {
  AutomaticCut cut = routed(problem, terminals);
  for (int k = 0; k < kMaxCompressedRounds && cut.strain > problem.limit; ++k) {
    const std::vector<Index> more = compressed_vertices(problem, cut);
    if (more.empty()) break;
    terminals.insert(terminals.end(), more.begin(), more.end());
    cut = routed(problem, terminals);
  }
  return cut;
}

}  // namespace

AutomaticCut cheapest(const CutProblem& problem, std::span<const CandidateMaker> makers,
                      AutomaticCut best, const StopCheck& progress) {
  CutProblem search = problem;
  if (const StopCheck& enough = problem.request.enough; enough.may_stop())
    search.stop = either(problem.stop, enough);
  double share = 0;
  try {
    for (const CandidateMaker& maker : makers) {
      const StopCheck part = progress.between(share, share + maker.share);
      share += maker.share;
      if (maker.is_for_small_surfaces && search.rounds() == 1) continue;
      for (Index k = 0; k < (maker.is_repeated ? search.rounds() : 1); ++k) {
        std::optional<CutCandidate> candidate =
            maker.make(search, best, k == 0 ? part : StopCheck());
        if (!candidate || !(candidate->excess <= 0)) break;
        best = std::move(candidate->cut);
      }
    }
  } catch (const Stopped&) {
    problem.stop.poll();
  }
  return best;
}

AutomaticCut automatic_cut(const SurfaceMesh& mesh, const CutRequest& request, double max_stretch,
                           const StopCheck& stop) {
  CutProblem problem(mesh, request, strain_of_stretch(max_stretch), stop);
  if (is_planar(mesh)) {
    AutomaticCut uncut{std::vector<char>(to_size(mesh.half_edge_count()), 0), 0, {}};
    uncut.strain = strain_of(problem, uncut.is_cut);
    if (uncut.strain <= problem.limit)
      return problem.is_faceted ? cheapest(problem, kFoldingMakers, std::move(uncut)) : uncut;
  }
  const std::vector<Index> cones = field_cones(problem, stop.between(0, 1.0 / 3));
  AutomaticCut first = first_cut(problem, cones);
  problem.cones = first.ends;
  return cheapest(problem, kMakers, std::move(first), stop.between(1.0 / 3, 1));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
