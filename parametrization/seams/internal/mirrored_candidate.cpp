#include "majorant/parametrization/seams/internal/mirrored_candidate.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "majorant/mesh/nearest_point.h"
#include "majorant/parametrization/seams/internal/cut_terminals.h"
#include "majorant/parametrization/seams/internal/mirrored_cuts.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// Costs count as symmetric if their mean difference is below this fraction. Visibility by rays
// differs by 0.05 between images, and by 0.5 if the direction of view is not in the plane.
constexpr double kCostTolerance = 0.2;

// A variant that cuts both halves alike.
struct MirroredWay {
  MirroredCuts::Half half;
  MirroredCuts::Ends ends;
  std::vector<char> full;  // 3 #F, before it was shortened
  AutomaticCut cut;
};

bool are_costs_mirrored(const CutProblem& problem, const MirrorPlane& plane) {
  const SurfaceMesh& mesh = problem.mesh;
  Vec cost = Vec::Zero(mesh.vertex_count()), length = cost;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    cost[mesh.from_vertex(h)] += problem.cost[h];
    length[mesh.from_vertex(h)] += mesh.edge_length(h);
  }
  const Vec factor = cost.cwiseQuotient(length);
  const VertexTree vertices(mesh.positions());
  double difference = 0, sum = 0;
  for (Index v = 0; v < mesh.vertex_count(); v += image_sample_step(mesh)) {
    const Index image = vertices.nearest(plane.image(mesh.positions().row(v)));
    difference += std::abs(factor[v] - factor[image]);
    sum += std::max(factor[v], factor[image]);
  }
  return difference <= kCostTolerance * sum;
}

// Returns the cut through these vertices and their images.
AutomaticCut routed_in_halves(const CutProblem& problem, const MirroredCuts& halves,
                              const std::vector<Index>& through, MirroredCuts::Half half,
                              MirroredCuts::Ends ends) {
  AutomaticCut cut{halves.cut(through, half, ends), 0, through};
  cut.strain = strain_of(problem, cut.is_cut);
  return cut;
}

// Shortens a cut on both sides alike; none if the result leaves more than the limit.
std::optional<AutomaticCut> shortened_in_pairs(const CutProblem& problem,
                                               const MirroredCuts& halves,
                                               const AutomaticCut& full) {
  const AutomaticCut part = shortened(problem, full, full.ends, halves.plane());
  AutomaticCut cut{halves.with_images(full.is_cut, part.is_cut), 0, {}};
  const SurfaceMesh open = problem.mesh.cut_along(cut.is_cut, nullptr);
  if (open.topology().components != 1 || !is_planar(open)) return {};
  cut.ends = halves.ends_of(cut.is_cut);
  cut.strain = strain_of(problem, cut.is_cut);
  if (cut.strain > problem.limit) return {};
  return cut;
}

// Returns the cheapest shortened cut of the four variants through these vertices, or through all
// cones if these vertices leave more than the limit.
std::optional<MirroredWay> cheapest_way(const CutProblem& problem, const MirroredCuts& halves,
                                        const std::vector<Index>& through) {
  std::optional<MirroredWay> best;
  std::set<std::vector<char>> seen;
  for (const auto half : {MirroredCuts::Half::Above, MirroredCuts::Half::Below})
    for (const auto ends : {MirroredCuts::Ends::OfHalf, MirroredCuts::Ends::OfBoth}) {
      AutomaticCut full = routed_in_halves(problem, halves, through, half, ends);
      if (full.strain > problem.limit)
        full = routed_in_halves(problem, halves, problem.cones, half, ends);
      if (full.strain > problem.limit || !seen.insert(full.is_cut).second) continue;
      std::optional<AutomaticCut> cut = shortened_in_pairs(problem, halves, full);
      if (cut && (!best || cost_of(problem, *cut) < cost_of(problem, best->cut)))
        best = {half, ends, std::move(full.is_cut), *std::move(cut)};
    }
  return best;
}

}  // namespace

std::optional<AutomaticCut> mirrored_cut(const CutProblem& problem, const AutomaticCut& best) {
  if (problem.is_faceted || problem.mesh.vertex_count() > kLargeSurface) return {};
  const std::optional<MirrorPlane> plane = mirror_plane(problem.mesh, problem.stop);
  if (!plane || !are_costs_mirrored(problem, *plane)) return {};
  const MirroredCuts halves(problem.mesh, *plane, problem.cost, problem.stop);
  if (!halves.is_parted()) return {};
  std::optional<MirroredWay> way = cheapest_way(problem, halves, terminals_on(problem, best));
  if (!way) return {};
  for (Index k = 1; k < problem.rounds(); ++k) {
    AutomaticCut next =
        routed_in_halves(problem, halves, terminals_on(problem, way->cut), way->half, way->ends);
    if (next.strain > problem.limit || next.is_cut == way->full) break;
    std::optional<AutomaticCut> cut = shortened_in_pairs(problem, halves, next);
    if (!cut || !(cost_of(problem, *cut) < cost_of(problem, way->cut))) break;
    way->cut = *std::move(cut);
    way->full = std::move(next.is_cut);
  }
  return std::move(way->cut);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
