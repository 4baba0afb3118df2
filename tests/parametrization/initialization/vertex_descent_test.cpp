// Newton's method on one vertex: sums over a star equal changes of the whole energy, and every step
// decreases it without inverting a triangle.
#include "majorant/parametrization/initialization/internal/vertex_descent.h"

#include <numbers>

#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/problem.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// Returns the sum over all faces, not divided by the area.
Problem whole(const SurfaceMesh& mesh, const EnergySum& energy) {
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh.faces(), mesh.vertex_count(), 1);
  ProblemBuilder builder(2 * mesh.vertex_count());
  const RestShapes rest = flat_triangles(mesh.positions(), mesh.faces());
  for (const WeightedEnergy& e : energy)
    builder.add(e.make(space, rest, {lattice_rule(1)}), e.weight);
  return builder.build();
}

struct Sheet {
  std::shared_ptr<const SurfaceMesh> mesh;
  CollapsingMesh left;
  Vec uv;
  VertexDescent descent;

  Sheet(std::shared_ptr<const SurfaceMesh> m, const EnergySum& energy)
      : mesh(m),
        left(m->faces(), m->opposites(), m->vertex_count()),
        uv(tutte_map(*m)),
        descent(left, m->positions(), energy, uv) {
    descent.measure_all();
  }
};

std::vector<EnergySum> energies() {
  const auto skew = density<2, 2>("skew", [](const auto& J) {
    return J.squaredNorm() / J.determinant() + 0.1 * J(0, 0) * J(0, 0);
  });
  return {{{symmetric_dirichlet(), 1.0}},
          {{mips(), 0.3}, {symmetric_dirichlet(), 0.1}},
          {{find_energy("log-isometric")->make, 2.0}},
          {{energy_factory(skew), 1.0}, {symmetric_dirichlet(), 1.0}}};
}

// The change of the sum over the star is the change of the whole energy, and every step decreases
// it.
TEST(VertexDescent, LowersTheEnergyByTheReportedDecrease) {
  for (const EnergySum& energy : energies()) {
    SCOPED_TRACE(energy.front().make.traits().name);
    Sheet s(generated("wavy_disk"), energy);
    Evaluator evaluator(whole(*s.mesh, energy));
    double before = evaluator.value(s.uv);
    int moved = 0;
    for (Index v = 0; v < s.mesh->vertex_count(); v += 7) {
      const double mean = s.descent.mean_energy(v);
      const Vector2 from = s.descent.place(v);
      const double mean_after = s.descent.improve(v, 3);
      EXPECT_LE(mean_after, mean);
      EXPECT_NEAR(s.descent.mean_energy(v), mean_after, 1e-12 * std::abs(mean_after));
      double star = 0;
      s.left.for_each_leaving(v,
                              [&](Index h) { star += rest_shape(*s.mesh, face_of(h)).measure[0]; });
      const double after = evaluator.value(s.uv);
      EXPECT_NEAR(after - before, star * (mean_after - mean), 1e-10 * before) << "vertex " << v;
      before = after;
      moved += s.descent.place(v) != from ? 1 : 0;
    }
    EXPECT_GT(moved, s.mesh->vertex_count() / 10);
  }
}

// At the minimum over one vertex, the whole gradient with respect to it is 0: the derivatives are
// those of f.
TEST(VertexDescent, EndsWhereTheGradientVanishes) {
  for (const EnergySum& energy : energies()) {
    SCOPED_TRACE(energy.front().make.traits().name);
    Sheet s(surface(grid(6, bumpy)), energy);
    Evaluator evaluator(whole(*s.mesh, energy));
    Vec before, after;
    for (const Index v : {0, 3, 24, 30, 48}) {
      evaluator.gradient(s.uv, before);
      s.descent.improve(v, 50);
      evaluator.gradient(s.uv, after);
      const double least = s.mesh->area() * 1e-2;
      EXPECT_LT(after.segment<2>(2 * v).norm(), 0.05 * before.segment<2>(2 * v).norm() + least)
          << v;
      EXPECT_TRUE(s.descent.has_area_margin(v));
    }
  }
}

TEST(VertexDescent, TakesStarsOfManyTriangles) {
  const EnergySum energy{{symmetric_dirichlet(), 1.0}};
  Sheet s(surface(cone(150, true)), energy);
  Evaluator evaluator(whole(*s.mesh, energy));
  s.descent.put(0, Vector2(0.2, 0.1));
  const double before = evaluator.value(s.uv);
  EXPECT_NEAR(s.descent.mean_energy(0), before / s.mesh->area(), 1e-10 * before);
  s.descent.improve(0, 30);
  EXPECT_LT(s.descent.place(0).norm(), 1e-3);  // at the centre, by symmetry
  EXPECT_LT(evaluator.value(s.uv), before);
}

TEST(VertexDescent, SeesTrianglesWithoutRoom) {
  Sheet s(surface(cone(6, true)), {{symmetric_dirichlet(), 1.0}});
  EXPECT_TRUE(s.descent.has_area_margin(0));
  const Vector2 a = s.descent.place(1), b = s.descent.place(2);
  s.descent.put(0, 0.5 * (a + b));  // on an edge, up to rounding
  EXPECT_FALSE(s.descent.has_area_margin(0));
  s.descent.put(0, 3 * a);
  EXPECT_FALSE(s.descent.has_area_margin(0));
}

// Collapses vertices as long as the map of the remaining mesh has area margins.
void collapse_all(Sheet& s, Ears ears) {
  for (Index h = 0; h < 3 * s.left.face_slots(); ++h) {
    if (!s.left.has_face(face_of(h))) continue;
    if (ears == Ears::Stay && s.left.is_ear(s.left.from(h))) continue;
    if (!s.left.may_collapse(h, CollapsingMesh::End::Start, 16)) continue;
    const Index u = s.left.to(h);
    s.left.collapse(h, CollapsingMesh::End::Start);
    s.descent.measure_star(u);
    if (s.descent.has_area_margin(u)) continue;
    const auto back = s.left.restore();
    s.descent.measure_star(back.vertex);
  }
}

double image_area(const Sheet& s) {
  double sum = 0;
  for (Index f = 0; f < s.left.face_slots(); ++f) {
    if (!s.left.has_face(f)) continue;
    const Vector2 a = s.descent.place(s.left.from(3 * f)),
                  b = s.descent.place(s.left.from(3 * f + 1)),
                  c = s.descent.place(s.left.from(3 * f + 2));
    sum += cross(Vector2(b - a), Vector2(c - a)) / 2;
  }
  return sum;
}

// With positive faces, the area of the image does not grow with any reinserted vertex.
TEST(Reinsertion, WithinTheImageItGrowsNowhere) {
  for (const char* name : {"cap", "ribbon", "wavy_disk"}) {
    SCOPED_TRACE(name);
    Sheet s(generated(name), {{symmetric_dirichlet(), 1.0}});
    collapse_all(s, Ears::Stay);
    EXPECT_LT(s.left.vertices_left(), s.mesh->vertex_count() / 2);
    double area = image_area(s);
    while (s.left.vertices_left() < s.mesh->vertex_count()) {
      const auto back = s.left.restore();
      s.descent.measure_star(back.vertex);
      ASSERT_TRUE(put_back_within(s.left, s.mesh->positions(), s.descent, back)) << back.vertex;
      if (s.left.on_boundary(back.vertex))
        s.descent.improve_within(back.vertex, 4);
      else
        s.descent.improve(back.vertex, 4);
      EXPECT_TRUE(s.descent.has_area_margin(back.vertex));
      const double now = image_area(s);
      EXPECT_LE(now, (1 + 1e-14) * area) << back.vertex;
      area = now;
    }
  }
}

// At the end of a slit, nearly the whole star of a vertex returns from its neighbour. No position
// is allowed in which faces cross the slit, which is a few degrees wide.
TEST(Reinsertion, KeepsASlitOpen) {
  constexpr Index kRays = 7;
  constexpr double kStep = 350.0 / 6 * std::numbers::pi / 180;
  RowMatrix positions(kRays + 2, 3);
  positions.row(0) << 0, 0, 0;        // the reinserted vertex
  positions.row(1) << 0.1, -0.05, 0;  // the vertex to which it collapsed
  Cells faces(kRays, 3);
  faces.row(0) << 0, 1, 2;
  for (Index k = 0; k < kRays; ++k) {
    positions.row(k + 2) << std::cos(k * kStep), std::sin(k * kStep), 0;
    if (k > 0) faces.row(k) << 0, k + 1, k + 2;
  }
  Sheet s(std::make_shared<const SurfaceMesh>(SurfaceMesh::from_arrays(positions, faces)),
          {{symmetric_dirichlet(), 1.0}});
  Index h = s.left.leaving(0);
  ASSERT_EQ(s.left.to(h), 1);
  ASSERT_TRUE(s.left.may_collapse(h, CollapsingMesh::End::Start, 16));
  s.left.collapse(h, CollapsingMesh::End::Start);
  for (Index v = 0; v < kRays + 2; ++v)
    s.descent.put(v, v == 1 ? Vector2(0, 0) : s.mesh->positions().row(v).head<2>().transpose());
  const double area = image_area(s);
  const auto back = s.left.restore();
  s.descent.measure_all();
  ASSERT_TRUE(put_back_within(s.left, s.mesh->positions(), s.descent, back));
  EXPECT_TRUE(s.descent.has_area_margin(0));
  EXPECT_LE(image_area(s), area);
}

// Reinserts all vertices of a map in turn, without improvement.
TEST(Reinsertion, FindsAPlaceForEveryVertex) {
  for (const char* name : {"cap", "ribbon", "wavy_disk"}) {
    SCOPED_TRACE(name);
    Sheet s(generated(name), {{symmetric_dirichlet(), 1.0}});
    const Vec start = s.uv;
    collapse_all(s, Ears::Leave);
    EXPECT_LT(s.left.vertices_left(), s.mesh->vertex_count() / 2);
    while (s.left.vertices_left() < s.mesh->vertex_count()) {
      const auto back = s.left.restore();
      s.descent.measure_star(back.vertex);
      ASSERT_TRUE(put_back(s.left, s.mesh->positions(), s.descent, back)) << back.vertex;
      EXPECT_TRUE(s.descent.has_area_margin(back.vertex));
    }
    EXPECT_NE(s.uv, start);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
