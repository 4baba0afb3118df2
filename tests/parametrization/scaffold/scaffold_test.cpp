// Scaffolds of any degree: numbers of nodes, and the invariants of elevation, growth, flips and
// relaxation.
#include "majorant/parametrization/scaffold/scaffold.h"

#include <algorithm>
#include <random>
#include <set>

#include "expected_error.h"
#include "majorant/constraints/constraints.h"
#include "majorant/framework/problem.h"
#include "mesh/list_edits.h"
#include "parametrization/scaffold/bezier_mesh_helpers.h"

namespace majorant {
namespace {

constexpr int kDepth = 9;

// A map and the scaffold around it, of one degree.
struct Around {
  BezierMap map;
  Scaffold scaffold;
  Vec joint() const { return scaffold.joined(map.control_points()); }
  bool certified(VecIn x) const {
    return is_certified(map.space(), x.head(map.control_points().size())) &&
           LocalInjectivity(scaffold.space(), Vec::Ones(scaffold.face_count()), kDepth)
               .check(x)
               .feasible;
  }
};

Around around(const PolygonMesh& polygons, int degree) {
  const auto mesh = surface(polygons);
  BezierMap map =
      BezierMap::linear(mesh, uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); }));
  Scaffold scaffold(map.shared_space(), map.control_points());
  while (map.degree() < degree) {
    map = map.elevated();
    scaffold = scaffold.elevated(map.shared_space());
  }
  return {map, scaffold};
}

// Returns the unit square without two of its 36 squares.
PolygonMesh two_holes() {
  PolygonMesh mesh = grid(6);
  for (const std::size_t square : {22, 13}) erase_lists(mesh.polygons, 2 * square, 2);
  mesh.polygon_lines.resize(mesh.polygons.size());
  return mesh;
}

// Bends image and scaffold, which fill [-1, 2]^2: to the right and, in waves, upwards. `a` is the
// displacement of the centre. Control points are moved, so that curves result; nothing folds for a
// <= 0.5.
Vec bent(const Vec& x, double a) {
  Vec out = x;
  for (Index k = 0; k < x.size(); k += 2) {
    const double u = (x[k] - 0.5) / 1.5, v = (x[k + 1] - 0.5) / 1.5;
    const double inside = (1 - u * u) * (1 - v * v);
    out[k] += a * inside;
    out[k + 1] += 0.08 * inside * std::sin(5 * u);
  }
  return out;
}

// Expects that control points of faces at nodes of the image have exactly its coordinates.
void expect_image(const Scaffold& scaffold, Index image_nodes, VecIn x) {
  Index compared = 0;
  for (Index f = 0; f < scaffold.face_count(); ++f)
    for (Index l = 0; l < scaffold.space()->cells().cols(); ++l)
      if (const Index node = scaffold.space()->cells()(f, l); node < image_nodes) {
        EXPECT_EQ(scaffold.mesh().point(f, static_cast<int>(l)), x.segment<2>(2 * node));
        ++compared;
      }
  EXPECT_GT(compared, 0);
}

double energy(const Scaffold& scaffold, VecIn joint) {
  ProblemBuilder builder(joint.size());
  TermState state;
  state.element_rule = scaffold.levels();
  builder.add(scaffold.energy_term(), state);
  const Problem problem = builder.build();
  return Evaluator(problem).value(problem.reduce(joint));
}

TEST(ScaffoldNumbering, NodesOfTheImageKeepTheirNumbers) {
  for (const PolygonMesh& polygons : {grid(3), two_holes()})
    for (int n = 1; n <= 4; ++n) {
      const Around a = around(polygons, n);
      const Index own = a.map.space().node_count();
      std::set<Index> shared, others;
      for (const Index node : a.scaffold.space()->cells().reshaped())
        (node < own ? shared : others).insert(node);
      const std::vector<Index> boundary = a.map.space().boundary_nodes();
      EXPECT_EQ(shared, std::set<Index>(boundary.begin(), boundary.end()));
      EXPECT_EQ(static_cast<Index>(others.size()), a.scaffold.joint_node_count() - own);
      EXPECT_EQ(*others.begin(), own);  // no number is missing
      EXPECT_EQ(*others.rbegin(), a.scaffold.joint_node_count() - 1);
      for (const Index node : a.scaffold.frame_nodes()) EXPECT_TRUE(others.contains(node));
    }
}

TEST(ScaffoldNumbering, SharedNodesAreWhereBothHaveThem) {
  for (const PolygonMesh& polygons : {grid(3), two_holes()})
    for (int n = 1; n <= 4; ++n) {
      const Around a = around(polygons, n);
      const Vec x = a.joint();
      EXPECT_TRUE(a.certified(x));
      EXPECT_EQ(x.head(a.map.control_points().size()), a.map.control_points());
      // The scaffold's points are averages of its corners, and x is the image: equal up to
      // rounding.
      for (Index f = 0; f < a.scaffold.face_count(); ++f)
        for (Index l = 0; l < a.scaffold.space()->cells().cols(); ++l)
          EXPECT_LE((a.scaffold.mesh().point(f, static_cast<int>(l)) -
                     x.segment<2>(2 * a.scaffold.space()->cells()(f, l)))
                        .norm(),
                    1e-14);
    }
}

TEST(ScaffoldElevation, KeepsShapes) {
  std::mt19937 random(3);
  for (int n = 1; n <= 4; ++n) {
    Around a = around(grid(4), n);
    const Vec x = bent(a.joint(), 0.3);
    a.scaffold.take(x);
    const BezierMap map = a.map.with(a.map.shared_space(), x.head(a.map.control_points().size()));
    const BezierMap high = map.elevated();
    const Scaffold more = a.scaffold.elevated(high.shared_space());
    EXPECT_EQ(more.mesh().faces, a.scaffold.mesh().faces);
    const Eigen::MatrixXd e = elevation_matrix(n);
    const Vec joint = more.joined(high.control_points());
    for (Index f = 0; f < more.face_count(); ++f) {
      const Eigen::Map<const RowMatrix> low(a.scaffold.mesh().points.row(f).data(), e.cols(), 2);
      const RowMatrix expected = e * low;
      for (Index l = 0; l < e.rows(); ++l)
        EXPECT_LE((joint.segment<2>(2 * more.space()->cells()(f, l)) - expected.row(l).transpose())
                      .norm(),
                  1e-14);
    }
    EXPECT_TRUE((Around{high, more}.certified(joint)));
    EXPECT_EQ(more.frame_nodes().size(),
              a.scaffold.frame_nodes().size() / static_cast<std::size_t>(n) * to_size(n + 1));
  }
}

TEST(ScaffoldUpkeep, FlipsAndRelaxingKeepTheImage) {
  for (int n = 1; n <= 4; ++n) {
    Around a = around(two_holes(), n);
    const Index own = a.map.space().node_count();
    Vec x = bent(a.joint(), 0.5);
    ASSERT_TRUE(a.certified(x)) << n;
    a.scaffold.take(x);
    expect_image(a.scaffold, own, x);
    long performed = 0;
    double before = energy(a.scaffold, x);
    for (int round = 0; round < 3; ++round) {
      const FlipCounts counts = a.scaffold.flip();
      EXPECT_LE(counts.performed, counts.intended);
      performed += counts.performed;
      expect_image(a.scaffold, own, x);
      Vec now = a.scaffold.joined(x);
      EXPECT_TRUE(a.certified(now));
      before = energy(a.scaffold, now);
      a.scaffold.relax(5, kDepth);
      expect_image(a.scaffold, own, x);
      now = a.scaffold.joined(x);
      EXPECT_EQ(now.head(2 * own), x.head(2 * own));
      EXPECT_TRUE(a.certified(now));
      EXPECT_LE(energy(a.scaffold, now), before);
    }
    EXPECT_GT(performed, 0);
  }
}

TEST(ScaffoldUpkeep, AFrameThatIsTightGrows) {
  for (int n = 1; n <= 3; ++n) {
    Around a = around(grid(4), n);
    const Index own = a.map.space().node_count();
    const Vec far = bent(a.joint(), 0);
    a.scaffold.take(far);
    EXPECT_FALSE(a.scaffold.grow());
    const Vec x = bent(a.joint(), 0.5);
    const Index faces = a.scaffold.face_count();
    a.scaffold.take(x);
    ASSERT_TRUE(a.scaffold.grow());
    EXPECT_GT(a.scaffold.face_count(), faces);
    expect_image(a.scaffold, own, x);
    const Vec joint = a.scaffold.joined(x);
    EXPECT_TRUE(a.certified(joint));
    for (const Index node : a.scaffold.frame_nodes())  // the first frame: [-1, 2]^2
      EXPECT_GE((joint.segment<2>(2 * node).array() - 0.5).abs().maxCoeff(), 1.5 + 2.9);
    EXPECT_FALSE(a.scaffold.grow());
  }
}

TEST(ScaffoldStart, AnImageThatMeetsItselfIsRefused) {
  const auto mesh = surface(grid(4));
  const Vec x = uv_of(*mesh, [](const Vector3& p) {
    const double angle = 7 * p.x(), r = 1 + p.y();  // more than one winding
    return Vector2(r * std::cos(angle), r * std::sin(angle));
  });
  const BezierMap map = BezierMap::linear(mesh, x);
  error_message(ErrorKind::Infeasible, [&] { Scaffold(map.shared_space(), x); });
}

TEST(ScaffoldInjectivityTest, NamesFacesOfImageAndScaffold) {
  const Around a = around(grid(3), 2);
  const auto image = std::make_shared<const LocalInjectivity>(
      a.map.shared_space(), Vec::Ones(a.map.space().element_count()));
  const auto around_it = std::make_shared<const LocalInjectivity>(
      a.scaffold.space(), Vec::Ones(a.scaffold.face_count()));
  const Index faces = a.map.space().element_count();
  const ScaffoldInjectivity both(image, faces, around_it);
  const Vec x = a.joint();
  EXPECT_TRUE(both.check(x).feasible);
  Vec d = Vec::Zero(x.size());  // moves a corner of the image far outwards: scaffold triangles fold
  d[0] = d[1] = -40;
  const StepBound bound = both.max_step(x, d, 1.0);
  EXPECT_LT(bound.step, 1);
  ASSERT_FALSE(bound.blocking.empty());
  for (const Index e : bound.blocking) EXPECT_GE(e, faces);
  const Verdict verdict = both.check(x + d);
  EXPECT_FALSE(verdict.feasible);
  EXPECT_TRUE(std::any_of(verdict.blocking.begin(), verdict.blocking.end(),
                          [&](Index e) { return e >= faces; }));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
