#include "majorant/quads/internal/quantization.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "majorant/io/read_mesh.h"
#include "majorant/quads/internal/aligned_map.h"
#include "majorant/quads/internal/quad_connectivity.h"
#include "parametrization/fields/closed_surfaces.h"
#include "public_data.h"

namespace majorant {
namespace {

// The last request to Quantization, and its answer.
struct Instance {
  std::vector<double> required;
  std::vector<Index> least, edges;
};

// As quad_mesh() asks: arcs that would join cones get an edge, one after the other.
Instance instance_of(const SeamlessLattice& lattice, const TMesh& t_mesh, long count) {
  const double length =
      std::sqrt(static_cast<double>(lattice.twice_area()) / 2 / static_cast<double>(count));
  Instance requested;
  for (const TArc& arc : t_mesh.arcs)
    requested.required.push_back(static_cast<double>(arc.length()) / length);
  requested.least.assign(t_mesh.arcs.size(), 0);
  for (;;) {
    requested.edges =
        Quantization(t_mesh, requested.required, requested.least).numbers(SearchEffort::Least);
    const std::vector<Index> more = QuadConnectivity(t_mesh, requested.edges).joining_arcs();
    if (more.empty()) return requested;
    for (const Index arc : more) requested.least[arc] = requested.edges[arc] + 1;
  }
}

// A line: sides of each patch, half-arcs, then what was asked and said by arc.
std::string json_of(const std::string& name, const TMesh& t_mesh, const Instance& requested) {
  std::vector<std::string> patches;
  for (const TPatch& patch : t_mesh.patches) {
    std::vector<std::string> sides;
    for (const auto& side : patch.sides) sides.push_back(fmt::format("{}", side));
    patches.push_back(fmt::format("[{}]", fmt::join(sides, ", ")));
  }
  return fmt::format(
      "{{\"name\": \"{}\", \"patches\": [{}], \"wanted\": {}, \"least\": {}, \"edges\": {}}}\n",
      name, fmt::join(patches, ", "), requested.required, requested.least, requested.edges);
}

// In the file that MAJORANT_QUANTIZATIONS names, if any, for quantization_oracle_test.py.
TEST(Quantization, SidesAgree) {
  std::vector<std::pair<std::string, SurfaceMesh>> surfaces;
  surfaces.emplace_back("cube", SurfaceMesh::from_polygons(cube(6)));
  surfaces.emplace_back("sphere", SurfaceMesh::from_polygons(sphere(8)));
  if (const auto folder = public_data("closed"); !folder.empty())
    for (const auto& file : std::filesystem::directory_iterator(folder))
      surfaces.emplace_back(file.path().stem().string(),
                            SurfaceMesh::from_polygons(read_mesh(file.path().string())));
  const char* const path = std::getenv("MAJORANT_QUANTIZATIONS");
  std::ofstream file;
  if (path != nullptr) file.open(path);
  for (const auto& [name, mesh] : surfaces) {
    if (path == nullptr && mesh.face_count() > 1000) continue;
    const ResolvedSurface resolved = resolve_feature_edges(mesh);
    RunRecord record;
    SeamlessLattice lattice(resolved.mesh, aligned_map(resolved, {}, record).map);
    const TMesh t_mesh = trace_t_mesh(lattice);
    for (const long count : {500, 4000}) {
      const Instance requested = instance_of(lattice, t_mesh, count);
      for (std::size_t a = 0; a < requested.edges.size(); ++a)
        EXPECT_GE(requested.edges[a], requested.least[a]);
      for (const TPatch& patch : t_mesh.patches)
        for (std::size_t s = 0; s < 2; ++s)
          EXPECT_EQ(sum_of(patch.sides[s], requested.edges),
                    sum_of(patch.sides[s + 2], requested.edges));
      file << json_of(fmt::format("{} {}", name, count), t_mesh, requested);
    }
  }
}

double off_of(const std::vector<double>& required, const std::vector<Index>& edges) {
  double sum = 0;
  for (std::size_t a = 0; a < edges.size(); ++a)
    sum += (edges[a] - required[a]) * (edges[a] - required[a]) / std::max(required[a], 1.0);
  return sum;
}

// Where the search went on from other numbers, and where it began anew.
TEST(Quantization, IsTheLeastSumIndependentOfEarlierRequests) {
  const ResolvedSurface resolved = resolve_feature_edges(SurfaceMesh::from_polygons(sphere(8)));
  RunRecord record;
  SeamlessLattice lattice(resolved.mesh, aligned_map(resolved, {}, record).map);
  const TMesh t_mesh = trace_t_mesh(lattice);
  const auto area = static_cast<double>(lattice.twice_area()) / 2;
  std::vector<Index> least(t_mesh.arcs.size(), 0);
  Quantization going_on(t_mesh, std::vector<double>(least.size(), 0), least);
  for (const double count : {20.0, 21.0, 500.0, 520.0, 40.0, 1e5, 7.0}) {
    std::vector<double> required;
    for (const TArc& arc : t_mesh.arcs)
      required.push_back(static_cast<double>(arc.length()) * std::sqrt(count / area));
    going_on.set_targets(required);
    for (int raised = 0; raised < 3; ++raised) {
      SCOPED_TRACE(fmt::format("{} quads, {} raised", count, raised));
      const std::vector<Index> edges = going_on.numbers(SearchEffort::Least);
      const double off = off_of(required, edges);
      EXPECT_NEAR(
          off, off_of(required, Quantization(t_mesh, required, least).numbers(SearchEffort::Least)),
          1e-6 * off);
      const auto arc = static_cast<Index>((7 * raised + 1) % edges.size());
      least[arc] = edges[arc] + 1;
      going_on.raise(arc, least[arc]);
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
