// The selection among candidates.
#include "majorant/parametrization/seams/internal/automatic_cut.h"

#include <algorithm>

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Candidates are identified by their strain.
template <int kStrain, int kExcess>
std::optional<CutCandidate> proposal(const CutProblem&, const AutomaticCut& best,
                                     const StopCheck& progress) {
  progress.advance(1);
  return CutCandidate{{best.is_cut, best.strain + kStrain, {}}, kExcess};
}

std::optional<CutCandidate> no_proposal(const CutProblem&, const AutomaticCut&, const StopCheck&) {
  return {};
}

std::optional<CutCandidate> polling(const CutProblem& problem, const AutomaticCut&,
                                    const StopCheck&) {
  problem.stop.poll();
  return {};
}

CutRequest request_of(const SurfaceMesh& mesh) {
  return {{}, std::vector<char>(to_size(mesh.vertex_count()), 0)};
}

double strain_after(const SurfaceMesh& mesh, const CutRequest& request,
                    std::initializer_list<CandidateMaker> makers, const StopCheck& stop = {},
                    const StopCheck& progress = {}) {
  const CutProblem problem(mesh, request, 0.02, stop);
  const std::vector<CandidateMaker> list(makers);
  return cheapest(problem, list, {std::vector<char>(to_size(mesh.half_edge_count()), 0), 0, {}},
                  progress)
      .strain;
}

TEST(CheapestCut, TakesCandidatesWithoutExcess) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(2));
  const CutRequest request = request_of(mesh);
  EXPECT_EQ(strain_after(mesh, request, {}), 0);
  EXPECT_EQ(strain_after(mesh, request, {{no_proposal}, {proposal<1, -1>}}), 1);
  EXPECT_EQ(strain_after(mesh, request, {{proposal<1, 0>}}), 1);
  EXPECT_EQ(strain_after(mesh, request, {{proposal<1, 1>}, {proposal<10, -1>}}), 10);
}

TEST(CheapestCut, RepeatsMakersAndLeavesLargeSurfacesOut) {
  const SurfaceMesh small = SurfaceMesh::from_polygons(grid(2)),
                    large = SurfaceMesh::from_polygons(grid(145));
  ASSERT_GT(large.vertex_count(), kLargeSurface);
  const CandidateMaker repeated{proposal<1, -1>, true}, for_small{proposal<10, -1>, false, true};
  EXPECT_EQ(strain_after(small, request_of(small), {repeated, for_small}),
            10 + CutProblem(small, request_of(small), 0.02).rounds());
  EXPECT_EQ(strain_after(large, request_of(large), {repeated, for_small}), 1);
}

TEST(CheapestCut, EnoughEndsTheSearchAndAStopDoesNot) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(2));
  CutRequest request = request_of(mesh);
  request.enough = StopCheck([] { return Directive::TimeLimit; });
  EXPECT_EQ(strain_after(mesh, request, {{proposal<1, -1>}, {polling}, {proposal<10, -1>}}), 1);
  const StopCheck stop([] { return Directive::Interrupt; });
  EXPECT_THROW(strain_after(mesh, request, {{polling}}, stop), Stopped);
}

TEST(CheapestCut, ReportsTheProgressOfItsMakers) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(2));
  std::vector<double> shares;
  const StopCheck progress = StopCheck().telling([&](double share) { shares.push_back(share); });
  strain_after(mesh, request_of(mesh),
               {{proposal<1, -1>, true, false, 0.25}, {proposal<1, 1>, false, false, 0.75}}, {},
               progress);
  EXPECT_EQ(shares, (std::vector<double>{0.25, 1}));
}

// A box without a lid is flattened by cuts, a bowl needs none, a sphere is opened.
TEST(AutomaticCut, UnfoldsPanelsAndOpensClosedSurfaces) {
  const auto cut_of = [](const PolygonMesh& input) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    return automatic_cut(mesh, request_of(mesh), 1.015);
  };
  const auto cuts = [](const AutomaticCut& cut) {
    return std::count(cut.is_cut.begin(), cut.is_cut.end(), 1);
  };
  EXPECT_EQ(cuts(cut_of(grid(8, [](double x, double y) { return 0.1 * x * y; }))), 0);
  const AutomaticCut cube = cut_of(voxel_surface(box(1, 1, 1)));
  EXPECT_EQ(cuts(cube), 2 * 7);
  EXPECT_TRUE(cube.unfolds);
  EXPECT_NEAR(cube.strain, 0, 1e-9);
  const AutomaticCut sphere = cut_of(cube_sphere(6));
  EXPECT_GT(cuts(sphere), 2);
  EXPECT_FALSE(sphere.unfolds);
  EXPECT_LE(sphere.strain, 0.03);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
