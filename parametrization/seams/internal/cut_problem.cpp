#include "majorant/parametrization/seams/internal/cut_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/mesh/cut_graph.h"
#include "majorant/parametrization/seams/cut_paths.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/cut_tree.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// The fraction of the strain limit at which cuts of large surfaces aim. Their maps have 3 % more
// strain than estimated, and a second cut would take as long as the first.
constexpr double kLargeSurfaceAim = 0.95;
// The approximate number of branches of a cut: one for every two edges of a small mesh, fewer on
// larger ones, such that the solves (one a branch, each linear in the vertices) take a second.
constexpr Index kMaxBranches = 150, kMinBranches = 40, kVertexSolves = 600000;

double half_sum_along(const AutomaticCut& cut, const Vec& values) {
  double sum = 0;
  for (Index h = 0; h < values.size(); ++h)
    if (cut.is_cut[h]) sum += 0.5 * values[h];
  return sum;
}

bool all_on_creases(const SurfaceMesh& mesh, const std::vector<Index>& vertices,
                    const std::vector<char>& creases) {
  std::vector<char> is_creased(to_size(mesh.vertex_count()), 0);
  const Vec sharp = sharpness(mesh, creases);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (sharp[h] > 0) is_creased[mesh.from_vertex(h)] = is_creased[mesh.to_vertex(h)] = 1;
  return !vertices.empty() &&
         std::all_of(vertices.begin(), vertices.end(), [&](Index v) { return is_creased[v] != 0; });
}

}  // namespace

CutProblem::CutProblem(const SurfaceMesh& surface, const CutRequest& request_in,
                       double strain_limit, const StopCheck& check)
    : mesh(surface),
      request(request_in),
      cost(cut_costs(surface, request.preferences, request.whole)),
      plain_cost(cut_costs(surface, {request.preferences.creases, {}}, request.whole)),
      limit(surface.vertex_count() > kLargeSurface ? kLargeSurfaceAim * strain_limit
                                                   : strain_limit),
      defect(angle_defects(surface)),
      curved(curved_vertices(defect, request.whole)),
      is_faceted(all_on_creases(surface, curved, request.preferences.creases)),
      flattening(std::make_shared<FlatteningSystem>(surface)),
      stop(check.silent()) {}

std::vector<Index> curved_vertices(const Vec& defect, const std::vector<char>& is_whole) {
  std::vector<Index> curved;
  for (Index v = 0; v < defect.size(); ++v)
    if (std::abs(defect[v]) > kCurved && !is_whole[v]) curved.push_back(v);
  return curved;
}

Index CutProblem::rounds() const { return std::max(kLargeSurface / mesh.vertex_count(), Index{1}); }

double cost_of(const CutProblem& problem, const AutomaticCut& cut) {
  return half_sum_along(cut, problem.cost) / std::sqrt(problem.mesh.area());
}

double plain_cost_of(const CutProblem& problem, const AutomaticCut& cut) {
  return half_sum_along(cut, problem.plain_cost) / std::sqrt(problem.mesh.area());
}

double length_of(const CutProblem& problem, const AutomaticCut& cut) {
  return half_sum_along(cut, edge_lengths(problem.mesh));
}

double strain_of(const CutProblem& problem, const std::vector<char>& is_cut) {
  return FlatteningStrain(*problem.flattening, is_cut, -1, problem.stop).strain();
}

std::vector<char> straight_cut_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                                     const Vec& cost, const StopCheck& stop) {
  const std::vector<char> is_cut = cut_graph(mesh, through, cost, stop);
  std::vector<char> straight = is_cut;
  smooth_cuts(mesh, through, cost, straight, stop);
  const SurfaceMesh open = mesh.cut_along(straight, nullptr);
  return open.topology().components == 1 && is_planar(open) ? straight : is_cut;
}

AutomaticCut routed(const CutProblem& problem, const std::vector<Index>& terminals) {
  AutomaticCut cut{straight_cut_graph(problem.mesh, terminals, problem.cost, problem.stop), 0,
                   terminals};
  cut.strain = strain_of(problem, cut.is_cut);
  return cut;
}

AutomaticCut shortened(const CutProblem& problem, const AutomaticCut& full,
                       const std::vector<Index>& terminals,
                       const std::optional<MirrorPlane>& mirror, const StopCheck& progress) {
  const SurfaceMesh& mesh = problem.mesh;
  const StopCheck check = progress.asking([&problem] { return problem.stop(); });
  std::vector<char> is_terminal(to_size(mesh.vertex_count()), 0);
  for (const Index v : terminals) is_terminal[v] = 1;
  const Index branches =
      std::clamp(kVertexSolves / mesh.vertex_count(), kMinBranches, kMaxBranches);
  CutTree tree(*problem.flattening, full.is_cut, is_terminal, problem.cost, branches, check);
  if (mirror) tree.shorten_in_pairs(*mirror, kSameImageEdges * mean_edge_length(mesh));
  const double limit = std::max(problem.limit, full.strain);
  tree.shorten(full.strain, limit, problem.stop);
  // Steps are undone in proportion if the worth of branches was estimated too low.
  std::size_t steps = tree.steps_within(limit);
  while (steps > 0) {
    CutTree::State state = tree.after(steps);
    const double reached = strain_of(problem, state.is_cut);
    if (reached <= limit) return {std::move(state.is_cut), reached, std::move(state.ends)};
    const double aim = full.strain + (tree.strain_after(steps) - full.strain) *
                                         (limit - full.strain) / (reached - full.strain);
    steps = std::min(steps - 1, tree.steps_within(aim));
  }
  return {full.is_cut, full.strain, tree.after(0).ends};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
