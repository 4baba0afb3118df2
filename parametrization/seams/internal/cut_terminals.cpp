#include "majorant/parametrization/seams/internal/cut_terminals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"

namespace majorant {
namespace {

// Vertices of least weight are below this fraction of the mean weight. Cuts of public meshes
// through such vertices cost up to a tenth less.
constexpr double kLeastWeightRatio = 0.7;
// Vertices are compressed if the stress function is at least this fraction of its maximum.
constexpr double kCompressedRatio = 0.5;

std::vector<Index> largest_defects(const CutProblem& problem) {
  std::vector<Index> vertices(to_size(problem.mesh.vertex_count()));
  for (Index v = 0; v < problem.mesh.vertex_count(); ++v) vertices[v] = v;
  std::stable_sort(vertices.begin(), vertices.end(), [&](Index a, Index b) {
    return std::abs(problem.defect[a]) > std::abs(problem.defect[b]);
  });
  vertices.resize(std::min(vertices.size(), kMaxTerminals));
  return vertices;
}

// Shortest paths, by plain cost, from sources and the boundary to all vertices.
struct NearestSources {
  std::vector<double> distance;
  std::vector<Index> source;  // #V, -1 where none is reached
};

NearestSources nearest_sources(const CutProblem& problem, const std::vector<Index>& sources) {
  const SurfaceMesh& mesh = problem.mesh;
  const auto size = to_size(mesh.vertex_count());
  std::vector<std::vector<Index>> leaving(size);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0) leaving[mesh.from_vertex(h)].push_back(h);
  NearestSources nearest{std::vector<double>(size, std::numeric_limits<double>::infinity()),
                         std::vector<Index>(size, -1)};
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  const auto start_at = [&](Index v) {
    nearest.distance[v] = 0;
    nearest.source[v] = v;
    front.emplace(0, v);
  };
  const std::vector<char> is_boundary = mesh.boundary_flags();
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (is_boundary[v]) start_at(v);
  for (const Index v : sources) start_at(v);
  while (!front.empty()) {
    const auto [d, v] = front.top();
    front.pop();
    if (d > nearest.distance[v]) continue;
    for (const Index h : leaving[v]) {
      const Index w = mesh.to_vertex(h);
      if (d + problem.plain_cost[h] >= nearest.distance[w]) continue;
      nearest.distance[w] = d + problem.plain_cost[h];
      nearest.source[w] = nearest.source[v];
      front.emplace(nearest.distance[w], w);
    }
  }
  return nearest;
}

}  // namespace

std::vector<Index> field_cones(const CutProblem& problem, const StopCheck& progress) {
  CrossFieldOptions field;
  field.stop = progress;
  std::vector<Index> cones;
  try {
    cones = smoothest_field_cones(problem.mesh, field);
  } catch (const Error&) {  // the mesh is too coarse for a field
    cones = largest_defects(problem);
  }
  std::erase_if(cones, [&](Index v) { return problem.request.whole[v] != 0; });
  return cones;
}

std::vector<Index> least_weighted_vertices(const CutProblem& problem) {
  const SurfaceMesh& mesh = problem.mesh;
  const std::vector<double>& edge_weight = problem.request.preferences.weight;
  if (edge_weight.empty()) return {};
  Vec sum = Vec::Zero(mesh.vertex_count()), length = sum;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    sum[mesh.from_vertex(h)] += edge_weight[h] * mesh.edge_length(h);
    length[mesh.from_vertex(h)] += mesh.edge_length(h);
  }
  const double bound = kLeastWeightRatio * sum.sum() / length.sum();
  const Vec weight = sum.cwiseQuotient(length);
  std::vector<char> is_least = problem.request.whole;
  for (char& flag : is_least) flag = !flag;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index v = mesh.from_vertex(h), w = mesh.to_vertex(h);
    if (weight[v] >= weight[w]) is_least[v] = 0;
  }
  std::vector<Index> least;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (is_least[v] && weight[v] < bound) least.push_back(v);
  std::stable_sort(least.begin(), least.end(),
                   [&](Index a, Index b) { return weight[a] < weight[b]; });
  least.resize(std::min(least.size(), kMaxTerminals));
  return least;
}

std::vector<Index> compressed_vertices(const CutProblem& problem, const AutomaticCut& cut) {
  const SurfaceMesh& mesh = problem.mesh;
  const FlatteningStrain sheet(*problem.flattening, cut.is_cut, -1, problem.stop);
  Vec stress = Vec::Zero(mesh.vertex_count());
  std::vector<char> is_boundary = mesh.boundary_flags();
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (cut.is_cut[h]) is_boundary[mesh.from_vertex(h)] = 1;
  if (std::isfinite(sheet.strain()))
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (const Index v = mesh.from_vertex(h); !is_boundary[v])
        stress[v] = std::abs(sheet.apply({{h, 1.0}}));
  std::vector<char> is_largest(is_boundary.size(), 1);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (stress[mesh.from_vertex(h)] < stress[mesh.to_vertex(h)])
      is_largest[mesh.from_vertex(h)] = 0;
  const double bound = kCompressedRatio * stress.maxCoeff();
  std::vector<Index> vertices;
  for (Index v = 0; v < stress.size(); ++v)
    if (stress[v] > 0 && stress[v] >= bound && is_largest[v] && !problem.request.whole[v])
      vertices.push_back(v);
  return vertices;
}

std::vector<Index> terminals_on(const CutProblem& problem, const AutomaticCut& cut) {
  const SurfaceMesh& mesh = problem.mesh;
  std::vector<char> is_met(to_size(mesh.vertex_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (cut.is_cut[h]) is_met[mesh.from_vertex(h)] = 1;
  std::vector<Index> on = cut.ends;
  for (const Index v : problem.cones)
    if (is_met[v]) on.push_back(v);
  return on;
}

double least_cost_through(const CutProblem& problem, const std::vector<Index>& vertices) {
  const SurfaceMesh& mesh = problem.mesh;
  constexpr double kUnreached = std::numeric_limits<double>::infinity();
  const auto [distance, source] = nearest_sources(problem, vertices);
  std::vector<double> apart(distance.size(), kUnreached);  // by source: distance of the nearest one
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index v = mesh.from_vertex(h), w = mesh.to_vertex(h);
    if (mesh.opposite(h) < 0 || source[v] == source[w]) continue;
    apart[source[v]] =
        std::min(apart[source[v]], distance[v] + problem.plain_cost[h] + distance[w]);
  }
  double sum = 0;
  for (const Index v : vertices)
    if (apart[v] < kUnreached) sum += 0.5 * apart[v];
  return sum;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
