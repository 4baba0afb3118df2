// The energy of cones against its definition; its changes against the energies of changed cones.
#include "majorant/parametrization/fields/internal/cone_potential.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

struct ConedSurface {
  SurfaceMesh mesh;
  FieldGeometry geometry;
  std::vector<int> quarter_turns;
};

std::vector<ConedSurface> coned_surfaces() {
  std::vector<ConedSurface> all;
  for (const PolygonMesh& input :
       {cube_sphere(4), torus(12, 8, 0), bar_with_holes(1, 1), grid(6, bumpy)}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    const FieldGeometry geometry(mesh);
    const auto size = to_size(mesh.vertex_count());
    std::vector<int> turns(size, 4);
    for (std::size_t v = 0; v < size; ++v)
      if (geometry.is_boundary[v]) turns[v] = 0;
    // Inner vertices; on closed surfaces the turns have the sum that topology requires.
    std::vector<std::size_t> inner;
    for (std::size_t v = 0; v < size; ++v)
      if (turns[v] == 4) inner.push_back(v);
    int missing = 4 * mesh.topology().euler_characteristic();
    for (std::size_t k = 3; missing != 0; k = (k + 7) % inner.size()) {
      const int step = missing > 0 ? -1 : 1;
      turns[inner[k]] += step;
      missing += step;
    }
    --turns[inner[5]];
    ++turns[inner[inner.size() / 2]];
    all.push_back({mesh, geometry, turns});
  }
  return all;
}

// Returns the logarithm of the scale by its definition, with dense least squares.
Vec log_scale(const ConedSurface& surface) {
  const SurfaceMesh& mesh = surface.mesh;
  const Index n = mesh.vertex_count();
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
  Vec charge(n);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index a = mesh.from_vertex(h), b = mesh.to_vertex(h);
    const Vector3 edge = mesh.positions().row(b) - mesh.positions().row(a);
    const Index o = mesh.opposite(h);
    if (o < h) continue;  // the scale is 1 on the boundary
    const double area =
        surface.geometry.face_area[face_of(h)] + surface.geometry.face_area[face_of(o)];
    const double k = area / (1.5 * edge.squaredNorm());
    laplacian(a, a) += k;
    laplacian(b, b) += k;
    laplacian(a, b) -= k;
    laplacian(b, a) -= k;
  }
  for (Index v = 0; v < n; ++v) {
    charge[v] = surface.geometry.angle_sum[v] - kQuarter * surface.quarter_turns[v];
    if (!surface.geometry.is_boundary[v]) continue;
    laplacian.row(v) = Eigen::RowVectorXd::Unit(n, v);
    charge[v] = 0;
  }
  return laplacian.completeOrthogonalDecomposition().solve(charge);
}

TEST(ConePotential, EnergiesAreThoseOfTheScale) {
  for (const ConedSurface& surface : coned_surfaces()) {
    const SurfaceMesh& mesh = surface.mesh;
    Vec u = log_scale(surface), part = Vec::Zero(mesh.vertex_count());
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (int k = 0; k < 3; ++k)
        part[mesh.faces()(f, k)] += surface.geometry.face_area[f] / (3 * mesh.area());
    double gradient = 0;
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      const Index o = mesh.opposite(h);
      if (o < h) continue;
      const Index a = mesh.from_vertex(h), b = mesh.to_vertex(h);
      const double length = (mesh.positions().row(b) - mesh.positions().row(a)).norm();
      const double area =
          surface.geometry.face_area[face_of(h)] + surface.geometry.face_area[face_of(o)];
      gradient += 0.5 * area / (1.5 * length * length) * (u[b] - u[a]) * (u[b] - u[a]);
    }
    if (mesh.boundary_loops().empty()) u.array() -= part.dot(u);
    const double variance = part.dot(u.cwiseAbs2());
    const auto energy = [&](ConeEnergy kind) {
      return ConePotential(mesh, surface.geometry, surface.quarter_turns, kind).energy();
    };
    EXPECT_NEAR(energy(ConeEnergy::Rotation), gradient, 1e-8 * gradient);
    EXPECT_NEAR(energy(ConeEnergy::Scale), variance, 1e-8 * variance);
  }
}

TEST(ConePotential, ChangesAreThoseOfOtherCones) {
  for (const ConedSurface& surface : coned_surfaces())
    for (const ConeEnergy kind : {ConeEnergy::Rotation, ConeEnergy::Scale}) {
      std::vector<int> turns = surface.quarter_turns;
      const auto potential = [&] {
        return ConePotential(surface.mesh, surface.geometry, turns, kind);
      };
      ConePotential moved = potential();
      for (const auto& [from, to] : {std::pair<Index, Index>{3, 17}, {17, 9}, {0, 11}, {11, 3}}) {
        const double change = moved.change(from, to), before = potential().energy();
        if (!surface.geometry.is_boundary[from]) --turns[from];
        if (!surface.geometry.is_boundary[to]) ++turns[to];
        const double after = potential().energy();
        EXPECT_NEAR(change, after - before, 1e-9 * (1 + after));
        moved.move(from, to);
        EXPECT_NEAR(moved.energy(), after, 1e-9 * (1 + after));
      }
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
