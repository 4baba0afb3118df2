// Numbering of shared control points: counts, continuity, elevation.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/internal/node_lattice.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/framework/error.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;

using Edge = std::pair<Index, Index>;

// Returns each edge with its (face, side) pairs.
std::map<Edge, std::vector<std::pair<Index, int>>> edges_of(const Cells& faces) {
  std::map<Edge, std::vector<std::pair<Index, int>>> edges;
  for (Index f = 0; f < faces.rows(); ++f)
    for (int e = 0; e < 3; ++e) {
      const Index a = faces(f, e), b = faces(f, (e + 1) % 3);
      edges[{std::min(a, b), std::max(a, b)}].push_back({f, e});
    }
  return edges;
}

Cells tetrahedron() {
  Cells f(4, 3);
  f << 0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0;
  return f;
}

// The number of coordinates, not only of nodes, has to fit an integer.
TEST(Nodes, RefuseMoreThanAnIntegerCounts) {
  constexpr Index kMost = 715827882;  // 3 times that is below 2^31
  EXPECT_EQ(with_more_nodes(kMost - 3, 3), kMost);
  for (const std::size_t more : {std::size_t{4}, std::size_t{1} << 40}) try {
      with_more_nodes(kMost - 3, more);
      FAIL() << more;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::Unsupported);
      EXPECT_NE(std::string(e.what()).find("nodes"), std::string::npos) << e.what();
    }
}

class Space : public testing::TestWithParam<int> {
 protected:
  int n() const { return GetParam(); }
  test::Mesh mesh_ = test::grid(4, 3, 0.25);
  BezierTriangleSpace space_{mesh_.faces, static_cast<Index>(mesh_.positions.rows()), GetParam()};
};

void expect_counts(const Cells& faces, Index vertices, int n) {
  const LatticeNumbering lattice = number_lattice(faces, vertices, n);
  const auto edges = static_cast<Index>(edges_of(faces).size());
  const auto f = static_cast<Index>(faces.rows());
  EXPECT_EQ(lattice.node_count, vertices + edges * (n - 1) + f * ((n - 1) * (n - 2) / 2));
  std::set<Index> used(lattice.cells.data(), lattice.cells.data() + lattice.cells.size());
  EXPECT_EQ(static_cast<Index>(used.size()), lattice.node_count);
  EXPECT_EQ(*used.begin(), 0);
  EXPECT_EQ(*used.rbegin(), lattice.node_count - 1);
}

TEST_P(Space, Counts) {
  expect_counts(mesh_.faces, static_cast<Index>(mesh_.positions.rows()), n());
  expect_counts(tetrahedron(), 4, n());
  EXPECT_EQ(space_.nodes_per_element(), control_point_count(n()));
  EXPECT_EQ(space_.element_count(), 24);
  EXPECT_EQ(space_.reference_dim(), 2);
  EXPECT_EQ(space_.cells().leftCols(3), mesh_.faces);
}

TEST_P(Space, NeighboursShareEdgePointsInReversedOrder) {
  const TriangleIndices& ix = TriangleIndices::of_degree(n());
  std::set<Index> boundary, inner_edge_points;
  for (const auto& [edge, sides] : edges_of(mesh_.faces)) {
    const auto at = [&, &sides = sides](std::size_t side, int s) {
      return space_.cells()(sides[side].first,
                            ix.edge(sides[side].second)[static_cast<std::size_t>(s)]);
    };
    for (int s = 0; s <= n(); ++s) {
      if (sides.size() == 1) boundary.insert(at(0, s));
      EXPECT_EQ(at(0, s), sides.size() == 1 ? at(0, s) : at(1, n() - s));
      EXPECT_TRUE(s == 0 || s == n() || inner_edge_points.insert(at(0, s)).second);
    }
  }
  EXPECT_EQ(space_.boundary_nodes(), std::vector<Index>(boundary.begin(), boundary.end()));
  EXPECT_TRUE(BezierTriangleSpace(tetrahedron(), 4, n()).boundary_nodes().empty());
}

TEST_P(Space, EveryAssignmentIsContinuous) {
  Random random(1);
  const Vec x = random.vector(2 * space_.node_count());
  int shared = 0;
  for (const auto& [edge, sides] : edges_of(mesh_.faces)) {
    if (sides.size() < 2) continue;
    ++shared;
    for (const double t : {0.0, 0.3, 0.5, 0.9}) {
      const auto point = [&, &sides = sides](std::size_t side, double s) {
        Barycentric xi = Barycentric::Zero();
        xi[sides[side].second] = 1 - s;
        xi[(sides[side].second + 1) % 3] = s;
        return test::map_point(space_, x, sides[side].first, xi);
      };
      EXPECT_LE((point(0, t) - point(1, 1 - t)).norm(), 1e-14);
    }
  }
  EXPECT_EQ(shared, 29);
}

TEST_P(Space, AffineMapsAreReproduced) {
  Eigen::Matrix2d a;
  a << 2, -1, 0.5, 3;
  const Vector2 t(7, -4);
  const Points2 flat = test::flat(mesh_.positions);
  Points2 uv = (flat * a.transpose()).rowwise() + t.transpose();
  const Vec x = test::linear_map(space_, uv);
  Random random(2);
  for (Index f = 0; f < space_.element_count(); ++f) {
    const Barycentric xi = random.barycentric();
    Vector2 p(0, 0);
    for (int k = 0; k < 3; ++k) p += xi[k] * flat.row(mesh_.faces(f, k)).transpose();
    EXPECT_LE((test::map_point(space_, x, f, xi) - (a * p + t)).norm(), 1e-14 * 40);
    EXPECT_NEAR(test::det_at(space_, x, f, xi), 6.5 * test::rest_determinants(mesh_)[f],
                1e-13 * 40);
    EXPECT_EQ(space_.certify(f, x, 2).result, ProofStatus::Proven);
  }
}

class SpaceBelowAnother : public Space {};
TEST_P(SpaceBelowAnother, ElevationKeepsTheMap) {
  const BezierTriangleSpace higher(mesh_.faces, space_.vertex_count(), n() + 1);
  Random random(3);
  const Vec x = random.vector(2 * space_.node_count());
  const Vec y = space_.elevate(x, higher);
  ASSERT_EQ(y.size(), 2 * higher.node_count());
  EXPECT_EQ(y.head(2 * space_.vertex_count()), x.head(2 * space_.vertex_count()));
  for (Index f = 0; f < space_.element_count(); ++f) {
    const Barycentric xi = random.barycentric();
    EXPECT_LE((test::map_point(space_, x, f, xi) - test::map_point(higher, y, f, xi)).norm(),
              1e-14);
    EXPECT_NEAR(test::det_at(space_, x, f, xi), test::det_at(higher, y, f, xi), 1e-12);
  }
}

// certify() and largest_step() use det J of the element's control points.
TEST_P(Space, CertificatesSeeTheRightElement) {
  Vec x = test::linear_map(space_, test::flat(mesh_.positions));
  const Index target = 9;
  // Moves the element's last node far across: only adjacent elements may change.
  const Index node = space_.cells()(target, space_.nodes_per_element() - 1);
  x.segment<2>(2 * node) += Vector2(40, 25);
  for (Index f = 0; f < space_.element_count(); ++f) {
    bool touched = false;
    for (Index k = 0; k < space_.nodes_per_element(); ++k) touched |= space_.cells()(f, k) == node;
    const PositivityProof proof = space_.certify(f, x, 4);
    EXPECT_TRUE(touched || proof.result == ProofStatus::Proven) << f;
  }
  EXPECT_NE(space_.certify(target, x, 4).result, ProofStatus::Proven);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Space, testing::Range(1, BezierTriangleSpace::kMaxDegree + 1));
INSTANTIATE_TEST_SUITE_P(Degrees, SpaceBelowAnother,
                         testing::Range(1, BezierTriangleSpace::kMaxDegree));

TEST(SpaceErrors, DegreesAndNonManifoldEdges) {
  const Cells faces = tetrahedron();
  EXPECT_THROW(BezierTriangleSpace(faces, 4, 0), InvalidArgument);
  EXPECT_THROW(BezierTriangleSpace(faces, 4, 9), InvalidArgument);
  Cells fan(3, 3);
  fan << 0, 1, 2, 0, 1, 3, 1, 0, 4;
  EXPECT_THROW(BezierTriangleSpace(fan, 5, 2), InvalidArgument);
}

TEST(FlatTriangles, FrameAndMeasure) {
  const test::Mesh mesh = test::grid(5, 4, 0.3, 0.8);
  const RestShapes rest = flat_triangles(mesh.positions, mesh.faces);
  const Vec det = test::rest_determinants(mesh);
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::Matrix2d j = rest.inverse_of(f).inverse();
    EXPECT_NEAR(j.determinant(), det[f], 1e-13);
    EXPECT_NEAR(rest.measure[f], det[f] / 2, 1e-13);
    EXPECT_EQ(j(1, 0), 0);  // e0 = p0 - p2 along x
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        const Vector3 u =
            mesh.positions.row(mesh.faces(f, a)) - mesh.positions.row(mesh.faces(f, 2));
        const Vector3 v =
            mesh.positions.row(mesh.faces(f, b)) - mesh.positions.row(mesh.faces(f, 2));
        EXPECT_NEAR(j.col(a).dot(j.col(b)), u.dot(v), 1e-13);  // an isometry of the plane of f
      }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
