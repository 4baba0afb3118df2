#include "majorant/parametrization/fields/internal/principal_directions.h"

#include <Eigen/Geometry>
#include <cmath>

namespace majorant {
namespace {

// Returns the curvature tensors around the vertices. normal: #F, unit.
std::vector<Eigen::Matrix3d> vertex_tensors(const SurfaceMesh& mesh,
                                            const std::vector<Vector3>& normal) {
  std::vector<Eigen::Matrix3d> tensor(to_size(mesh.vertex_count()), Eigen::Matrix3d::Zero());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h) continue;  // the boundary has -1
    const Vector3 t = edge_vector(mesh, h);
    const Vector3 &n = normal[face_of(h)], &m = normal[face_of(o)];
    const double bend = std::atan2(n.cross(m).dot(t), n.dot(m));
    const double length =
        (mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h)))
            .norm();
    for (const Index v : {mesh.from_vertex(h), mesh.to_vertex(h)})
      tensor[v] += 0.5 * bend * length * t * t.transpose();
  }
  return tensor;
}

}  // namespace

std::vector<std::complex<double>> principal_directions(const SurfaceMesh& mesh,
                                                       const FieldGeometry& geometry) {
  std::vector<Vector3> normal;
  std::vector<double> vertex_area(to_size(mesh.vertex_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    normal.push_back(edge_vector(mesh, 3 * f).cross(edge_vector(mesh, 3 * f + 1)).normalized());
    for (int k = 0; k < 3; ++k) vertex_area[mesh.faces()(f, k)] += geometry.face_area[f] / 3;
  }
  const std::vector<Eigen::Matrix3d> tensor = vertex_tensors(mesh, normal);
  std::vector<std::complex<double>> directions;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = to_size(mesh.faces()(f, k));
      sum += tensor[v] / (3 * vertex_area[v]);
    }
    const Vector3 x = edge_vector(mesh, 3 * f), y = normal[f].cross(x);
    const double a = x.dot(sum * x), b = x.dot(sum * y), d = y.dot(sum * y);
    // The square of (k1 - k2) e^{2 i angle} points along the fourth power.
    const std::complex<double> deviator(a - d, 2 * b);
    const double mean = (a + d) / 2, half = std::abs(deviator) / 2;
    const double size = std::abs(mean + half) + std::abs(mean - half) + 1 / std::sqrt(mesh.area());
    const std::complex<double> square = deviator * deviator;
    directions.push_back(half > 0 ? square / std::abs(square) * (2 * half / size)
                                  : std::complex<double>(0));
    if (!std::isfinite(std::abs(directions.back()))) directions.back() = 0;  // underflow
  }
  return directions;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
