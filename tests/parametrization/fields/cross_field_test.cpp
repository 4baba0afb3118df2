// Cross fields satisfy the topological conditions: Poincare-Hopf, transport around vertices,
// holonomy. On some surfaces the smoothest field is known.
#include "majorant/parametrization/fields/cross_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "expected_error.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/cut_graph.h"
#include "majorant/parametrization/fields/internal/cone_potential.h"
#include "majorant/parametrization/fields/internal/field_geometry.h"
#include "mesh/surfaces_of_any_genus.h"
#include "public_data.h"

namespace majorant {
namespace {

constexpr double kRightAngle = kPi / 2;

// Returns branch `branch` of face f as a vector in space.
Vector3 branch_vector(const SurfaceMesh& mesh, const CrossField& field, Index f, int branch) {
  const auto p = [&](int k) -> Vector3 { return mesh.positions().row(mesh.faces()(f, k)); };
  const Vector3 x = (p(1) - p(0)).normalized(), n = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
  return Eigen::AngleAxisd(field.angle[f] + branch * kRightAngle, n) * x;
}

// Returns the angle from half-edge h to the branch, in the plane of its face, seen from outside.
double angle_to_edge(const SurfaceMesh& mesh, const CrossField& field, Index h, int branch) {
  const auto p = [&](int k) -> Vector3 { return mesh.positions().row(mesh.faces()(h / 3, k)); };
  const Vector3 n = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
  const Vector3 edge =
      mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h));
  const Vector3 b = branch_vector(mesh, field, h / 3, branch);
  return std::atan2(edge.cross(b).dot(n), edge.dot(b));
}

// Returns the rotation from the branch, transported over h and turned, to the branch of the
// neighbour.
double rotation(const SurfaceMesh& mesh, const CrossField& field, Index h) {
  const double here = angle_to_edge(mesh, field, h, field.turns[h]);
  // the edge runs the other way
  const double there = angle_to_edge(mesh, field, mesh.opposite(h), 0) + kPi;
  return std::remainder(there - here, 2 * kPi);
}

double energy(const SurfaceMesh& mesh, const CrossField& field) {
  double sum = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) > h) sum += std::pow(rotation(mesh, field, h), 2);
  return sum;
}

std::vector<double> angle_sums(const SurfaceMesh& mesh) {
  std::vector<double> sum(to_size(mesh.vertex_count()), 0);
  for (Index c = 0; c < mesh.half_edge_count(); ++c) {
    const Vector3 p = mesh.positions().row(mesh.from_vertex(c));
    const Vector3 a = mesh.positions().row(mesh.to_vertex(c)).transpose() - p;
    const Vector3 b = mesh.positions().row(mesh.faces()(c / 3, (c % 3 + 2) % 3)).transpose() - p;
    sum[mesh.from_vertex(c)] += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return sum;
}

void expect_proper_field(const SurfaceMesh& mesh, const CrossField& field) {
  ASSERT_EQ(field.angle.size(), mesh.face_count());
  ASSERT_EQ(field.turns.size(), to_size(mesh.half_edge_count()));
  ASSERT_EQ(field.quarter_turns.size(), to_size(mesh.vertex_count()));
  EXPECT_TRUE(field.angle.allFinite());
  std::vector<double> left = angle_sums(mesh);
  std::vector<int> turns(left.size(), 0), valence(left.size(), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    ++valence[mesh.to_vertex(h)];
    if (mesh.opposite(h) < 0) {
      EXPECT_EQ(field.turns[h], 0);
      continue;
    }
    EXPECT_GE(field.turns[h], 0);
    EXPECT_EQ((field.turns[h] + field.turns[mesh.opposite(h)]) % 4, 0);
    EXPECT_LT(field.turns[h], 4);
    turns[mesh.to_vertex(h)] += field.turns[h];
    left[mesh.to_vertex(h)] -= rotation(mesh, field, h);
  }
  std::vector<char> boundary(left.size(), 0);
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) boundary[v] = 1;
  int index_sum = 0;
  for (std::size_t v = 0; v < left.size(); ++v) {
    const int q = field.quarter_turns[v];
    if (boundary[v]) {
      EXPECT_EQ(q, 0);
      continue;
    }
    // Modulo 4: rotations are known up to full turns.
    EXPECT_NEAR(std::remainder(left[v] / kRightAngle - q, 4), 0, 1e-6) << "vertex " << v;
    EXPECT_EQ(((turns[v] - q) % 4 + 4) % 4, 0) << "vertex " << v;
    EXPECT_GE(q, 1);
    EXPECT_LE(q, std::max(4, 2 * valence[v] - 1));
    index_sum += 4 - q;
  }
  if (mesh.boundary_loops().empty()) {
    EXPECT_EQ(index_sum, 4 * mesh.topology().euler_characteristic());
  }
}

// Expects a combed field: turns are 0 off the cut, and only the numbering of branches has changed.
void expect_combs(const SurfaceMesh& mesh, const CrossField& field) {
  const std::vector<char> is_cut = cut_graph(mesh, cone_vertices(field));
  CrossField combed = field;
  comb(mesh, is_cut, combed);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (!is_cut[h]) {
      EXPECT_EQ(combed.turns[h], 0);
    }
  for (Index f = 0; f < mesh.face_count(); ++f)
    EXPECT_NEAR(std::remainder(combed.angle[f] - field.angle[f], kRightAngle), 0, 1e-9);
  EXPECT_EQ(combed.quarter_turns, field.quarter_turns);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0) {
      EXPECT_NEAR(rotation(mesh, combed, h), rotation(mesh, field, h), 1e-9);
    }
  expect_proper_field(mesh, combed);
}

std::vector<Cone> cones_of(const CrossField& field) {
  std::vector<Cone> cones;
  for (const Index v : cone_vertices(field)) cones.push_back({v, field.quarter_turns[v]});
  return cones;
}

TEST(CrossField, IsConsistentOnEverySurface) {
  for (const auto& [name, input] : surfaces_of_any_genus()) {
    SCOPED_TRACE(name);
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    CrossFieldOptions curved, some_edges;
    curved.curvature_weight = 10;
    some_edges.aligned.assign(to_size(mesh.half_edge_count()), 0);
    some_edges.aligned[0] = 1;
    for (const CrossFieldOptions& options : {CrossFieldOptions(), curved, some_edges}) {
      const CrossField field = smoothest_cross_field(mesh, options);
      expect_proper_field(mesh, field);
      expect_combs(mesh, field);
    }
  }
}

TEST(CrossField, SphereHasTheConesOfTheCube) {
  for (const int n : {4, 7}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube_sphere(n));
    const CrossField field = smoothest_cross_field(mesh);
    const std::vector<Cone> cones = cones_of(field);
    ASSERT_EQ(cones.size(), 8u);
    for (const Cone& cone : cones) EXPECT_EQ(cone.quarter_turns, 3);
    // Distances are close to those of the corners of a cube.
    for (const Cone& a : cones)
      for (const Cone& b : cones)
        if (a.vertex != b.vertex) {
          EXPECT_GT((mesh.positions().row(a.vertex) - mesh.positions().row(b.vertex)).norm(), 0.7);
        }
  }
}

TEST(CrossField, BoxHasConesAtItsCorners) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(voxel_surface(box(6, 4, 3)));
  for (const double weight : {0.0, 10.0}) {
    CrossFieldOptions options;
    options.curvature_weight = weight;
    const CrossField field = smoothest_cross_field(mesh, options);
    const std::vector<Cone> cones = cones_of(field);
    EXPECT_EQ(cones.size(), 8u);
    for (const Cone& cone : cones) {
      const Vector3 p = mesh.positions().row(cone.vertex);
      EXPECT_TRUE((p.x() == 0 || p.x() == 6) && (p.y() == 0 || p.y() == 4) &&
                  (p.z() == 0 || p.z() == 3));
      EXPECT_EQ(cone.quarter_turns, 3);
    }
    EXPECT_LT(energy(mesh, field), 1e-6);  // parallel to the edges
  }
}

TEST(CrossField, FlatAndToroidalSurfacesNeedNoCones) {
  // A torus around a far axis: r = 2 + cos t becomes 8 + cos t.
  const auto thin_torus = transformed(torus(80, 12, 0), [](const Vector3& p) -> Vector3 {
    const double r = std::hypot(p.x(), p.y());
    return {p.x() * (r + 6) / r, p.y() * (r + 6) / r, p.z()};
  });
  for (const PolygonMesh& input : {grid(6), grid_without(9, {20, 24, 60}), thin_torus}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    EXPECT_TRUE(cone_vertices(smoothest_cross_field(mesh)).empty());
  }
  const SurfaceMesh flat_mesh = SurfaceMesh::from_polygons(grid_without(9, {20, 24, 60}));
  EXPECT_LT(energy(flat_mesh, smoothest_cross_field(flat_mesh)), 1e-10);
}

TEST(CrossField, FollowsPrincipalDirections) {
  // Parallels and meridians of a torus; corner 0 -> corner 1 is along one of them or a diagonal.
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(60, 30, 0));
  CrossFieldOptions options;
  options.curvature_weight = 30;
  const CrossField field = smoothest_cross_field(mesh, options);
  EXPECT_TRUE(cone_vertices(field).empty());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vector3 p = mesh.positions().row(mesh.faces()(f, 0));
    const Vector3 parallel = Vector3(-p.y(), p.x(), 0).normalized();
    double closest = 0;
    for (int k = 0; k < 4; ++k)
      closest = std::max(closest, branch_vector(mesh, field, f, k).dot(parallel));
    EXPECT_GT(closest, std::cos(0.15)) << f;
  }
}

TEST(CrossField, FollowsAlignedEdges) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(8, bumpy));
  CrossFieldOptions options;
  options.aligned.assign(to_size(mesh.half_edge_count()), 0);
  std::vector<Index> flagged;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) < 0 || (h % 3 == 1 && h % 50 == 1)) {
      options.aligned[h] = 1;
      flagged.push_back(h);
    }
  const CrossField field = smoothest_cross_field(mesh, options);
  expect_proper_field(mesh, field);
  std::vector<int> count(to_size(mesh.face_count()), 0);
  for (const Index h : flagged) {
    ++count[h / 3];
    if (mesh.opposite(h) >= 0) ++count[mesh.opposite(h) / 3];
  }
  for (const Index h : flagged)
    for (const Index side : {h, mesh.opposite(h)})
      if (side >= 0 && count[side / 3] == 1) {
        EXPECT_NEAR(std::remainder(angle_to_edge(mesh, field, side, 0), kRightAngle), 0, 1e-9);
      }
}

TEST(CrossField, FollowsTheLongestOfAllEdges) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(5));
  CrossFieldOptions options;
  options.aligned.assign(to_size(mesh.half_edge_count()), 1);  // diagonals are the longest edges
  const CrossField field = smoothest_cross_field(mesh, options);
  expect_proper_field(mesh, field);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vector3 b = branch_vector(mesh, field, f, 0);
    EXPECT_NEAR(std::abs(b.x()), std::sqrt(0.5), 1e-9);
  }
}

// Returns a flat disk whose border has teeth of 34 degrees, and a circle of inner vertices.
PolygonMesh saw_blade(Index teeth) {
  PolygonMesh blade;
  const Index n = 2 * teeth;
  for (const bool is_inner : {false, true})
    for (Index i = 0; i < n; ++i) {
      const bool is_tip = i % 2 != 0;
      const double angle = 4 * kRightAngle * (i / 2 + (is_tip ? 0.9 : 0.0)) / teeth;
      const double radius = is_inner ? 0.6 : (is_tip ? 1.2 : 1.0);
      blade.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
  blade.positions.emplace_back(0, 0, 0);
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    blade.polygons.push_back(std::vector<Index>{i, next, n + next});
    blade.polygons.push_back(std::vector<Index>{i, n + next, n + i});
    blade.polygons.push_back(std::vector<Index>{n + i, n + next, 2 * n});
  }
  return blade;
}

TEST(CrossField, TeethAreFollowedWithoutConesInside) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(saw_blade(48));
  CrossFieldOptions options;
  options.aligned.assign(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) options.aligned[h] = mesh.opposite(h) < 0;
  const CrossField field = smoothest_cross_field(mesh, options);
  expect_proper_field(mesh, field);
  // The field has the cones of a disk; four quads at the root of each tooth would add 48.
  EXPECT_EQ(cone_vertices(field).size(), 4u);
}

// Two curved sheets joined by one square whose vertices lie on the boundary: cones have to pass it.
TEST(CrossField, CancelsConesAcrossNarrowPlaces) {
  const auto bumps = [](double x, double y) {
    return 0.3 * std::sin(9 * x) * std::sin(9 * y) + 0.2 * std::cos(7 * x + y);
  };
  const SurfaceMesh mesh =
      SurfaceMesh::from_polygons(grid_without(9, {4, 13, 22, 31, 49, 58, 67, 76}, bumps));
  for (const double cost : {0.0, 10.0}) {
    CrossFieldOptions options;
    options.cone_cost = cost;
    const CrossField field = smoothest_cross_field(mesh, options);
    expect_proper_field(mesh, field);
    EXPECT_TRUE(cost == 0 || cone_vertices(field).empty());  // all cones leave over the boundary
  }
}

TEST(CrossField, ConesDoNotDependOnPlaceOrScale) {
  for (const auto& [name, input] : surfaces_of_any_genus()) {
    SCOPED_TRACE(name);
    // Symmetric surfaces have several fields of equal energy, among which rounding decides: break
    // the symmetry.
    const auto bent = transformed(input, [](const Vector3& p) -> Vector3 {
      return p + 0.05 * Vector3(std::sin(p.y() + 1.3 * p.x()), std::cos(2 * p.z() + 0.3 * p.y()),
                                std::sin(1.7 * p.x() - p.z()));
    });
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    const auto moved = transformed(
        bent, [&](const Vector3& p) -> Vector3 { return 1000 * (turn * p) + Vector3(5, 6, 7); });
    const SurfaceMesh a = SurfaceMesh::from_polygons(bent), b = SurfaceMesh::from_polygons(moved);
    EXPECT_EQ(smoothest_cross_field(a).quarter_turns, smoothest_cross_field(b).quarter_turns);
  }
}

TEST(CrossField, FewerConesAtAHigherCost) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(bar_with_holes(2, 3));
  for (const ConeEnergy energy : {ConeEnergy::Rotation, ConeEnergy::Scale}) {
    std::size_t last = 1000;
    for (const double cost : {0.0, 0.3, 100.0}) {
      CrossFieldOptions options;
      options.cone_energy = energy;
      options.cone_cost = cost;
      const CrossField field = smoothest_cross_field(mesh, options);
      expect_proper_field(mesh, field);
      EXPECT_LE(cone_vertices(field).size(), last);
      last = cone_vertices(field).size();
    }
    EXPECT_LE(last, 8u);  // chi = -2: minus eight quarter turns, no opposite pair is left
  }
}

// The cones of the minimum of either energy have a lower value of it than the cones of the other.
TEST(CrossField, ConesAreThoseOfTheRequestedEnergy) {
  const auto bumps = transformed(cube_sphere(16), [](const Vector3& p) -> Vector3 {
    double height = 1;
    for (const Vector3& bump : {Vector3(0.8, 0.6, 0), Vector3(-0.6, 0, 0.8), Vector3(0, 0.6, -0.8)})
      height += 0.5 * std::exp(-(p - bump).squaredNorm() / 0.02);
    return height * p;
  });
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(bumps);
  const FieldGeometry geometry(mesh);
  const auto field_of = [&](ConeEnergy energy, double cost) {
    CrossFieldOptions options;
    options.cone_energy = energy;
    options.cone_cost = cost;
    const CrossField field = smoothest_cross_field(mesh, options);
    expect_proper_field(mesh, field);
    expect_combs(mesh, field);
    return field;
  };
  const auto worth = [&](const CrossField& field, ConeEnergy energy, double cost) {
    double sum = ConePotential(mesh, geometry, field.quarter_turns, energy).energy();
    for (const int turns : field.quarter_turns) sum += cost * std::abs(turns - 4);
    return sum;
  };
  constexpr double kOfRotation = 0.1, kOfScale = 0.003;
  const CrossField smooth = field_of(ConeEnergy::Rotation, kOfRotation);
  const CrossField even = field_of(ConeEnergy::Scale, kOfScale);
  EXPECT_LT(worth(smooth, ConeEnergy::Rotation, kOfRotation),
            worth(even, ConeEnergy::Rotation, kOfRotation));
  EXPECT_LT(worth(even, ConeEnergy::Scale, kOfScale), worth(smooth, ConeEnergy::Scale, kOfScale));
}

TEST(CrossField, NoVertexHasFewerTurnsThanRequested) {
  // Two spikes with angle sums of at most half a turn at their tips.
  const auto needles = transformed(cube_sphere(8), [](const Vector3& p) -> Vector3 {
    return {p.x(), p.y(), p.z() + 3 * p.z() * std::exp(-30 * (p.x() * p.x() + p.y() * p.y()))};
  });
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(needles);
  for (const ConeEnergy energy : {ConeEnergy::Rotation, ConeEnergy::Scale})
    for (const int least : {1, 2, 3}) {
      SCOPED_TRACE(least);
      CrossFieldOptions options;
      options.cone_energy = energy;
      options.cone_cost = 1e-4;
      options.least_quarter_turns = least;
      const CrossField field = smoothest_cross_field(mesh, options);
      expect_proper_field(mesh, field);
      const auto fewest = std::min_element(field.quarter_turns.begin(), field.quarter_turns.end());
      EXPECT_GE(*fewest, least);
    }
}

TEST(CrossField, RefusesOptionsThatAreNotValid) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(2));
  CrossFieldOptions options;
  options.curvature_weight = -1;
  EXPECT_THROW(smoothest_cross_field(mesh, options), InvalidArgument);
  options.curvature_weight = 0;
  for (const int turns : {0, 5}) {
    options.least_quarter_turns = turns;
    EXPECT_THROW(smoothest_cross_field(mesh, options), InvalidArgument);
  }
  options.least_quarter_turns = 1;
  options.aligned = {1, 0};
  EXPECT_THROW(smoothest_cross_field(mesh, options), InvalidArgument);
}

TEST(PrescribedCones, AreMetExactly) {
  for (const auto& [name, input] : surfaces_of_any_genus()) {
    SCOPED_TRACE(name);
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    const CrossField smooth = smoothest_cross_field(mesh);
    const CrossField field = cross_field_with_cones(mesh, cones_of(smooth));
    EXPECT_EQ(field.quarter_turns, smooth.quarter_turns);
    expect_proper_field(mesh, field);
    expect_combs(mesh, field);
    EXPECT_LE(energy(mesh, field), 1.5 * energy(mesh, smooth) + 1e-6);
  }
}

TEST(PrescribedCones, AnywhereOnATorusAndOnADisk) {
  const SurfaceMesh wheel = SurfaceMesh::from_polygons(torus(20, 12, 0));
  const std::vector<Cone> pair{{7, 3}, {140, 5}};
  const SurfaceMesh disk = SurfaceMesh::from_polygons(grid(8));
  const std::vector<Cone> lone{{40, 1}, {22, 7}, {58, 3}};
  const SurfaceMesh ring = SurfaceMesh::from_polygons(grid_without(9, {20, 24, 60}));
  const std::vector<Cone> off_ring{{55, 2}};
  for (const auto& [mesh, cones] :
       {std::pair{&wheel, pair}, {&disk, lone}, {&ring, off_ring}, {&wheel, {}}, {&ring, {}}}) {
    const CrossField field = cross_field_with_cones(*mesh, cones);
    expect_proper_field(*mesh, field);
    expect_combs(*mesh, field);
    EXPECT_EQ(cone_vertices(field).size(), cones.size());
    for (const Cone& cone : cones) EXPECT_EQ(field.quarter_turns[cone.vertex], cone.quarter_turns);
  }
  EXPECT_LT(energy(ring, cross_field_with_cones(ring, {})), 1e-10);  // flat: a parallel field
}

TEST(PrescribedCones, RefusesImpossibleCones) {
  const SurfaceMesh sphere = SurfaceMesh::from_polygons(octahedron());
  const SurfaceMesh disk = SurfaceMesh::from_polygons(grid(4));
  const auto message = [](const SurfaceMesh& mesh, const std::vector<Cone>& cones) {
    return error_message(ErrorKind::Usage, [&] { cross_field_with_cones(mesh, cones); });
  };
  expect_contains(message(sphere, {{0, 3}}), {"sum", " 1,", "must be 8"});
  expect_contains(message(sphere, {}), {"sum", " 0,", "must be 8"});
  expect_contains(message(sphere, {{0, 2}, {0, 2}}), {"vertex 0", "twice"});
  expect_contains(message(sphere, {{3, 0}}), {"vertex 3", "at least 1"});
  expect_contains(message(sphere, {{2, 8}}), {"vertex 2", "4 faces", "at most 7"});
  expect_contains(message(sphere, {{6, 3}}), {"no vertex 6"});
  expect_contains(message(disk, {{0, 3}}), {"vertex 0", "boundary"});
}

TEST(Comb, RefusesCutsThatLeaveConesInside) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(voxel_surface(box(3, 3, 3)));
  CrossField field = smoothest_cross_field(mesh);
  const std::vector<char> uncut(to_size(mesh.half_edge_count()), 0);
  expect_contains(error_message(ErrorKind::Usage, [&] { comb(mesh, uncut, field); }),
                  {"edge", "combed"});
}

TEST(CrossField, PublicMeshes) {
  const std::filesystem::path folder = public_data("closed");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const std::string& file : obj_files(folder)) {
    SCOPED_TRACE(file);
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(obj_file(file));
    const CrossField field = smoothest_cross_field(mesh);
    expect_proper_field(mesh, field);
    expect_combs(mesh, field);
    EXPECT_EQ(cross_field_with_cones(mesh, cones_of(field)).quarter_turns, field.quarter_turns);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
