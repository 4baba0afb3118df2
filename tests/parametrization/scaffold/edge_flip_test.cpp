// Flips of Bezier triangles: invariants, refused flips, Delaunay triangulations.
#include "majorant/parametrization/scaffold/internal/edge_flip.h"

#include <Eigen/LU>
#include <map>
#include <random>
#include <set>

#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "parametrization/scaffold/bezier_mesh_helpers.h"

namespace majorant {
namespace {

// Returns triangles (a, b, c) and (b, a, d) of vertices a = 0, b = 1, c = 2, d = 3, corners
// rotated.
PlaneTriangulation quad(const Vector2& a, const Vector2& d, const Vector2& b, const Vector2& c,
                        unsigned rotation = 0) {
  std::array<Index, 3> first{0, 1, 2}, second{1, 0, 3};
  std::rotate(first.begin(), first.begin() + rotation % 3, first.end());
  std::rotate(second.begin(), second.begin() + rotation / 3 % 3, second.end());
  PlaneTriangulation t{Points2(4, 2), cells_of({first, second})};
  t.points << a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1];
  return t;
}

// Returns a strictly convex quadrilateral of points near an ellipse.
PlaneTriangulation random_quad(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  const double stretch = std::exp(2 * uniform(random));
  std::array<Vector2, 4> p;
  for (std::size_t k = 0; k < 4; ++k) {
    const double t = kPi / 2 * (static_cast<double>(k) + uniform(random) * 0.9);
    p[k] = {stretch * std::cos(t), std::sin(t)};
  }
  return quad(p[0], p[1], p[2], p[3], random() % 9);
}

Index inner_half_edge(const BezierMesh& mesh) {
  for (Index h = 0; h < 6; ++h)
    if (mesh.opposite[h] >= 0) return h;
  return -1;
}

std::set<std::pair<double, double>> boundary_points(const BezierMesh& mesh) {
  std::set<std::pair<double, double>> out;
  for (Index h = 0; h < 3 * mesh.face_count(); ++h)
    if (mesh.opposite[h] < 0)
      for (const int l : TriangleIndices::of_degree(mesh.degree).edge(h % 3))
        out.insert({mesh.point(h / 3, l)[0], mesh.point(h / 3, l)[1]});
  return out;
}

TEST(FlipEdge, OfRandomQuadrilaterals) {
  std::mt19937 random(1);
  for (int n = 1; n <= 8; ++n) {
    const int count = n <= 5 ? 300 : 30;
    int performed = 0;
    for (int trial = 0; trial < count; ++trial) {
      const BezierMesh before = curved(random_quad(random), n, 0.4, random());
      BezierMesh mesh = before;
      const Index h = inner_half_edge(mesh), o = mesh.opposite[h];
      if (!flip_edge(mesh, h)) {
        EXPECT_TRUE(same_bits(mesh, before));
        continue;
      }
      ++performed;
      expect_sound(mesh);
      EXPECT_EQ(mesh.opposite[h], o);
      EXPECT_EQ(mesh.from_vertex(h), 3);
      EXPECT_EQ(mesh.to_vertex(h), 2);
      EXPECT_EQ(boundary_points(mesh), boundary_points(before));
      EXPECT_EQ(boundary_points(mesh).size(), to_size(4 * n));
      EXPECT_NEAR(enclosed_area(mesh), enclosed_area(before), 1e-12 * enclosed_area(before));
    }
    RecordProperty("performed_" + std::to_string(n), performed);
    EXPECT_GE(performed, count * 95 / 100) << n;
  }
}

// Four flips turn the diagonal once around: the same faces in the same rows.
TEST(FlipEdge, BackAndForth) {
  std::mt19937 random(2);
  for (int n = 1; n <= 5; ++n)
    for (int trial = 0; trial < 30; ++trial) {
      const BezierMesh before = curved(random_quad(random), n, 0.15, random());
      BezierMesh mesh = before;
      const Index h = inner_half_edge(mesh);
      for (int k = 0; k < 4; ++k) ASSERT_TRUE(flip_edge(mesh, h)) << n;
      expect_sound(mesh);
      EXPECT_EQ(mesh.faces, before.faces);
      EXPECT_EQ(mesh.opposite, before.opposite);
      EXPECT_EQ(boundary_points(mesh), boundary_points(before));
      if (n == 1) {
        EXPECT_EQ(mesh.points, before.points);
      }
    }
}

// A parallelogram's control points are the straight ones for either diagonal.
TEST(FlipEdge, OfParallelogramsIsStraight) {
  for (int n = 1; n <= 8; ++n)
    for (unsigned rotation = 0; rotation < 9; ++rotation) {
      const PlaneTriangulation t = quad({0, 0}, {3, 1}, {4, 3}, {1, 2}, rotation);
      BezierMesh mesh = curved(t, n, 0, 1);
      ASSERT_TRUE(flip_edge(mesh, inner_half_edge(mesh)));
      const SharedPoints shared(mesh);
      const RowMatrix straight = shared.space.node_positions(t.points);
      for (Index v = 0; v < straight.rows(); ++v)
        EXPECT_LT((shared.x.segment<2>(2 * v).transpose() - straight.row(v)).norm(), 1e-13);
    }
}

TEST(FlipEdge, RefusesTheImpossible) {
  const double thin = 1e-16;
  const std::vector<PlaneTriangulation> impossible{
      quad({0, 0}, {2, -0.5}, {1, 0}, {2, 0.6}),       // not convex
      quad({0, 0}, {1, -1}, {2, 0}, {3, 1}),           // three corners in line
      quad({0, 0}, {1, -thin}, {2, 0}, {1, thin}, 4),  // slivers before and after
      quad({1, 1e9}, {2, 1e9}, {1, 1e9}, {0.5, 1e9}),  // area 0
  };
  for (int n = 1; n <= 5; ++n)
    for (std::size_t k = 0; k < impossible.size(); ++k) {
      const BezierTriangleSpace space(impossible[k].faces, 4, n);
      const RowMatrix x = space.node_positions(impossible[k].points);
      const Vec flat = Eigen::Map<const Vec>(x.data(), x.size());
      const BezierMesh before = bezier_mesh(n, impossible[k].faces, space.cells(), flat);
      BezierMesh mesh = before;
      for (Index h = 0; h < 6; ++h) EXPECT_FALSE(flip_edge(mesh, h)) << k << " " << n;
      EXPECT_TRUE(same_bits(mesh, before));
      std::vector<char> none;
      EXPECT_EQ(make_delaunay(mesh, none).intended, 0);
      EXPECT_TRUE(same_bits(mesh, before));
    }
}

// Convex chords, but an angle of tangents above pi at a corner that would belong to one triangle.
TEST(FlipEdge, RefusesReflexTangents) {
  for (int n = 2; n <= 5; ++n) {
    const PlaneTriangulation t = quad({0, 0}, {1, -1}, {3, 0}, {1, 1});
    const BezierTriangleSpace space(t.faces, 4, n);
    const RowMatrix straight = space.node_positions(t.points);
    Vec x = Eigen::Map<const Vec>(straight.data(), straight.size());
    for (const double side : {-1.0, 1.0}) {  // next to a, along ad and ac
      const Index d = side < 0 ? 3 : 2;
      for (Index v = 4; v < space.node_count(); ++v)
        if ((straight.row(v) - t.points.row(d) / n).norm() < 1e-12)
          x.segment<2>(2 * v) = Vector2(-0.05, side / n);
    }
    const BezierMesh before = bezier_mesh(n, t.faces, space.cells(), x);
    ASSERT_TRUE(is_certified(space, x)) << n;
    BezierMesh mesh = before;
    EXPECT_FALSE(flip_edge(mesh, 0));
    EXPECT_TRUE(same_bits(mesh, before));
  }
}

TEST(FlipEdge, RefusesBoundariesAndEdgesThatExist) {
  // A vertex inside a triangle: a flip of one of its edges would duplicate an edge of the triangle.
  PlaneTriangulation t{Points2(4, 2), cells_of({{0, 1, 3}, {1, 2, 3}, {2, 0, 3}})};
  t.points << 0, 0, 4, 0, 0, 4, 1, 1;
  BezierMesh mesh = curved(t, 2, 0, 1);
  const BezierMesh before = mesh;
  for (Index h = 0; h < 9; ++h) EXPECT_FALSE(flip_edge(mesh, h));
  EXPECT_TRUE(same_bits(mesh, before));
  EXPECT_THROW(flip_edge(mesh, 9), InvalidArgument);
  EXPECT_THROW(flip_edge(mesh, -1), InvalidArgument);
  mesh.degree = 9;
  EXPECT_THROW(flip_edge(mesh, 0), InvalidArgument);
  mesh.degree = 2;
  std::vector<char> wrong(8, 0);
  EXPECT_THROW(make_delaunay(mesh, wrong), InvalidArgument);
  // Two triangles glued along two edges; a tetrahedron, where the flipped edge always exists. The
  // positions allow every flip.
  for (const Cells& faces :
       {cells_of({{0, 1, 2}, {1, 0, 2}}), cells_of({{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}})}) {
    BezierMesh closed;
    closed.faces = faces;
    closed.opposite = opposite_half_edges(faces);
    closed.points.setZero(faces.rows(), 6);
    closed.points.row(0) << 0, 0, 1, 1, 0, 1;
    closed.points.row(1) << 1, 1, 0, 0, 1, 0;
    const BezierMesh as_made = closed;
    for (Index h = 0; h < 3; ++h) EXPECT_FALSE(flip_edge(closed, h));
    EXPECT_TRUE(same_bits(closed, as_made));
  }
}

// Up to the rounding of the transformation, flips commute with affine maps.
TEST(FlipEdge, CommutesWithAffineMaps) {
  std::mt19937 random(5);
  for (int n = 1; n <= 5; ++n)
    for (const double scale : {1e-6, 0.3, 1.0, 1e6})
      for (int trial = 0; trial < 10; ++trial) {
        const BezierMesh before = curved(random_quad(random), n, 0.25, random());
        const double angle = trial;
        Eigen::Matrix2d a;
        a << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
        if (trial % 2) a = a * (Eigen::Matrix2d() << 1, 0.7, 0, 1.3).finished();
        a *= scale;
        BezierMesh plain = before, image = before;
        const auto mapped = [&](BezierMesh mesh) {
          for (Index f = 0; f < mesh.face_count(); ++f)
            for (Index l = 0; l < mesh.points.cols() / 2; ++l)
              mesh.points.row(f).segment<2>(2 * l) = (a * mesh.point(f, static_cast<int>(l)));
          return mesh;
        };
        image = mapped(before);
        const bool done = flip_edge(plain, inner_half_edge(plain));
        ASSERT_EQ(flip_edge(image, inner_half_edge(image)), done);
        EXPECT_LT((image.points - mapped(plain).points).norm(), 1e-9 * image.points.norm());
      }
}

TEST(FlipEdge, ManyAtRandomStaySound) {
  for (int n = 1; n <= 4; ++n) {
    BezierMesh mesh = curved(jittered_grid(8, 0.2, 7), n, 0.1, 8);
    const double area = enclosed_area(mesh);
    const auto boundary = boundary_points(mesh);
    std::mt19937 random(9);
    int performed = 0;
    for (int k = 0; k < 1500; ++k)
      performed += flip_edge(mesh, static_cast<Index>(random() % mesh.opposite.size()));
    EXPECT_GT(performed, 100);
    expect_sound(mesh);
    EXPECT_NEAR(enclosed_area(mesh), area, 1e-12);
    EXPECT_EQ(boundary_points(mesh), boundary);
  }
}

// Expects no corner inside a circumcircle by more than rounding, by brute force.
void expect_empty_circles(const BezierMesh& mesh, const Points2& points) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vector2 a = points.row(mesh.faces(f, 0)), b = points.row(mesh.faces(f, 1)),
                  c = points.row(mesh.faces(f, 2));
    for (Index v = 0; v < points.rows(); ++v) {
      Eigen::Matrix3d m;
      int k = 0;
      for (const Vector2& p : {a, b, c}) {
        const Vector2 e = p - points.row(v).transpose();
        m.row(k++) << e[0], e[1], e.squaredNorm();
      }
      EXPECT_LT(m.determinant(), 1e-13);
    }
  }
}

TEST(MakeDelaunay, OfRandomPoints) {
  for (unsigned seed = 1; seed <= 5; ++seed)
    for (const PlaneTriangulation& t :
         {inserted_points(150, seed), jittered_grid(12, 0.45, seed), jittered_grid(12, 0, seed)}) {
      BezierMesh mesh = curved(t, 1, 0, 1);
      std::vector<char> none;
      const FlipCounts counts = make_delaunay(mesh, none);
      EXPECT_EQ(counts.performed, counts.intended);
      expect_sound(mesh);
      expect_empty_circles(mesh, t.points);
      EXPECT_EQ(make_delaunay(mesh, none).intended, 0);  // cocircular points do not alternate
    }
}

// A flip that is not performed is impossible: a triangle with curved sides would have an angle
// above pi or a fold. For long thin triangles about one per cent of the flips are refused.
TEST(MakeDelaunay, OfCurvedTriangles) {
  for (int n = 2; n <= 4; ++n) {
    const auto performed_part = [n](const std::string& name, const auto& start) {
      FlipCounts all;
      for (unsigned seed = 1; seed <= 5; ++seed) {
        BezierMesh mesh = start(seed);
        std::vector<char> none;
        const FlipCounts counts = make_delaunay(mesh, none);
        EXPECT_LE(counts.performed, counts.intended);
        all.intended += counts.intended;
        all.performed += counts.performed;
        expect_sound(mesh);
        EXPECT_EQ(make_delaunay(mesh, none).performed, 0);
      }
      EXPECT_GT(all.intended, 300);
      const std::string of = "_" + name + "_" + std::to_string(n);
      testing::Test::RecordProperty("intended" + of, static_cast<int>(all.intended));
      testing::Test::RecordProperty("performed" + of, static_cast<int>(all.performed));
      return static_cast<double>(all.performed) / static_cast<double>(all.intended);
    };
    const auto grid = [n](unsigned s) { return curved(jittered_grid(14, 0.35, s), n, 0.1, s); };
    const auto thin = [n](unsigned s) { return curved(inserted_points(120, s), n, 0.05, s); };
    EXPECT_GE(performed_part("grid", grid), 0.99) << n;
    EXPECT_GE(performed_part("thin", thin), 0.98) << n;
  }
}

TEST(MakeDelaunay, RespectsFixedEdges) {
  for (int n = 1; n <= 3; ++n) {
    const PlaneTriangulation t = inserted_points(80, 3);
    BezierMesh mesh = curved(t, n, 0.03, 4);
    std::mt19937 random(5);
    std::vector<char> is_fixed(mesh.opposite.size(), 0);
    std::map<std::pair<Index, Index>, std::vector<Vector2>> fixed;
    const auto curve = [&](Index h) {
      std::vector<Vector2> points;
      for (const int l : TriangleIndices::of_degree(n).edge(h % 3))
        points.push_back(mesh.point(h / 3, l));
      return points;
    };
    for (Index h = 0; h < 3 * mesh.face_count(); ++h)
      if (mesh.opposite[h] > h && random() % 4 == 0) {
        is_fixed[h] = is_fixed[mesh.opposite[h]] = 1;
        fixed[{mesh.from_vertex(h), mesh.to_vertex(h)}] = curve(h);
      }
    EXPECT_GT(make_delaunay(mesh, is_fixed).performed, 20);
    expect_sound(mesh);
    std::size_t found = 0;
    for (Index h = 0; h < 3 * mesh.face_count(); ++h) {
      const auto held = fixed.find({mesh.from_vertex(h), mesh.to_vertex(h)});
      if (held != fixed.end()) {
        ++found;
        EXPECT_TRUE(is_fixed[h]);
        EXPECT_EQ(curve(h), held->second);
      } else if (mesh.opposite[h] < 0) {
        EXPECT_FALSE(is_fixed[h]);
      } else {
        EXPECT_EQ(is_fixed[h], is_fixed[mesh.opposite[h]]);
      }
    }
    EXPECT_EQ(found, fixed.size());
    EXPECT_EQ(std::count(is_fixed.begin(), is_fixed.end(), 1), 2 * static_cast<long>(fixed.size()));
    EXPECT_EQ(make_delaunay(mesh, is_fixed).performed, 0);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
