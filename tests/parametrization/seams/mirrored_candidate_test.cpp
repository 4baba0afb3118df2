// Symmetric cuts.
#include "majorant/parametrization/seams/internal/mirrored_candidate.h"

#include <algorithm>

#include "majorant/parametrization/seams/internal/cut_terminals.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

constexpr double kLimit = 0.04;  // of the strain

// The surface with its field cones and a shortened cut through them.
struct Example {
  explicit Example(SurfaceMesh surface)
      : mesh(std::move(surface)), request{{}, std::vector<char>(to_size(mesh.vertex_count()), 0)} {}

  std::optional<AutomaticCut> mirrored() const {
    CutProblem problem(mesh, request, kLimit);
    problem.cones = field_cones(problem);
    return mirrored_cut(problem, shortened(problem, routed(problem, problem.cones), {}));
  }

  SurfaceMesh mesh;
  CutRequest request;
};

TEST(MirroredCandidate, OpensBothSidesOfASurfaceSymmetrically) {
  const Example example(mirrored_limbs());
  const std::optional<AutomaticCut> cut = example.mirrored();
  ASSERT_TRUE(cut);
  EXPECT_GE(mirrored_part(example.mesh, cut->is_cut), 0.9);
  EXPECT_LE(cut->strain, kLimit);
  const std::vector<SurfaceMesh> pieces = pieces_of(example.mesh, cut->is_cut);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NO_THROW(pieces.front().require_planar());
}

TEST(MirroredCandidate, IsNoneWhereTheSurfaceIsNoImageOfItself) {
  const PolygonMesh skew = transformed(limbs(8), [](const Vector3& p) -> Vector3 {
    return {p.x() + 0.9 * p.y() * p.y(), 1.2 * p.y() + 0.7 * p.z(), 0.9 * p.z() - 0.8 * p.x()};
  });
  EXPECT_FALSE(Example(SurfaceMesh::from_polygons(skew)).mirrored());
}

// Costs of seams are smaller on one side.
TEST(MirroredCandidate, IsNoneWhereCostsAreNoImages) {
  Example example(mirrored_limbs());
  const SurfaceMesh& mesh = example.mesh;
  example.request.preferences.weight.assign(to_size(mesh.half_edge_count()), 1);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.positions()(mesh.from_vertex(h), 0) + mesh.positions()(mesh.to_vertex(h), 0) > 0)
      example.request.preferences.weight[h] = 0.1;
  EXPECT_FALSE(example.mirrored());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
