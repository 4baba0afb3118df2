// Curvature directions and smoothest directions on surfaces with known directions.
#include "majorant/parametrization/fields/internal/smoothest_directions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "majorant/parametrization/fields/internal/aligned_edges.h"
#include "majorant/parametrization/fields/internal/principal_directions.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

using Complex = std::complex<double>;

// Returns sum weight |z_f e^{4 i transport} - z_g|^2.
double roughness(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                 const std::vector<Complex>& z) {
  double sum = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o > h)
      sum += geometry.weight[h] *
             std::norm(z[face_of(h)] * std::polar(1.0, 4 * geometry.transport[h]) - z[face_of(o)]);
  }
  return sum;
}

TEST(PrincipalDirections, AreZeroOnPlanesAndFollowTheAxisOfACylinder) {
  const SurfaceMesh plane = SurfaceMesh::from_polygons(grid(4));
  for (const Complex& q : principal_directions(plane, FieldGeometry(plane)))
    EXPECT_EQ(std::abs(q), 0);
  const SurfaceMesh bent = SurfaceMesh::from_polygons(transformed(grid(12), [](const Vector3& p) {
    return Vector3(std::sin(p.x()), 1.7 * p.y(), std::cos(p.x()));
  }));
  const FieldGeometry geometry(bent);
  const std::vector<Complex> q = principal_directions(bent, geometry);
  for (Index f = 0; f < bent.face_count(); ++f) {
    // The axis relative to the first edge of the face.
    const Vector3 x = edge_vector(bent, 3 * f),
                  n = x.cross(edge_vector(bent, 3 * f + 1)).normalized();
    const double axis = std::atan2(n.cross(x).y(), x.y());
    EXPECT_GT(std::abs(q[f]), 0.1);
    EXPECT_LT(std::abs(q[f]), 1);
    EXPECT_NEAR(std::remainder(std::arg(q[f]) - 4 * axis, 2 * kPi), 0, 0.1);
  }
}

TEST(SmoothestDirections, AreParallelOnPlanesAndSmootherThanTheirStart) {
  // Diagonals at 45 degrees would hide a wrong sign of the transport.
  const SurfaceMesh plane = SurfaceMesh::from_polygons(
      transformed(grid(6), [](const Vector3& p) { return Vector3(p.x(), 1.7 * p.y(), 0); }));
  const FieldGeometry flat_geometry(plane);
  const Vec no_face = Vec::Constant(plane.face_count(), kNotAligned);
  const std::vector<Complex> zero(to_size(plane.face_count()), 0);
  EXPECT_LT(roughness(plane, flat_geometry,
                      smoothest_directions(plane, flat_geometry, no_face, zero, 0, {})),
            1e-9);

  const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(16, 10, 0));
  const FieldGeometry geometry(mesh);
  const Vec fixed = Vec::Constant(mesh.face_count(), kNotAligned);
  const std::vector<Complex> q = principal_directions(mesh, geometry);
  const std::vector<Complex> z = smoothest_directions(mesh, geometry, fixed, q, 0, {});
  double mass_of_q = 0, mass_of_z = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    mass_of_q += geometry.face_area[f] / mesh.area() * std::norm(q[f]);
    mass_of_z += geometry.face_area[f] / mesh.area() * std::norm(z[f]);
  }
  EXPECT_NEAR(mass_of_z, 1, 1e-12);
  EXPECT_LE(roughness(mesh, geometry, z), roughness(mesh, geometry, q) / mass_of_q);
}

TEST(SmoothestDirections, FixedFacesKeepTheirAnglesAndStrongDataWins) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(12, 8, 0));
  const FieldGeometry geometry(mesh);
  const std::vector<Complex> q = principal_directions(mesh, geometry);
  Vec fixed = Vec::Constant(mesh.face_count(), kNotAligned);
  fixed[3] = 0.4;
  const std::vector<Complex> z = smoothest_directions(mesh, geometry, fixed, q, 1e9, {});
  EXPECT_NEAR(std::abs(z[3] - std::polar(1.0, 1.6)), 0, 1e-14);
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (f != 3) {
      EXPECT_NEAR(std::abs(z[f] - q[f]), 0, 1e-4);
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
