#include "majorant/parametrization/seams/internal/mirror_plane.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "majorant/mesh/nearest_point.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"

namespace majorant {
namespace {

// The largest fraction of vertices without a vertex near their image.
constexpr double kMaxFarImages = 0.01;

struct Inertia {
  Vector3 centroid = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // moments around the centroid, over the area
};

// Returns the moments of the surface, exactly.
Inertia inertia_of(const SurfaceMesh& mesh) {
  Inertia inertia;
  double area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double a = area_vector(mesh, f).norm();
    Vector3 middle = Vector3::Zero();
    for (Index k = 0; k < 3; ++k) middle += mesh.positions().row(mesh.faces()(f, k)) / 3;
    inertia.centroid += a * middle;
    area += a;
  }
  if (!(area > 0)) return inertia;
  inertia.centroid /= area;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double a = area_vector(mesh, f).norm() / area;
    Vector3 middle = Vector3::Zero();
    for (Index k = 0; k < 3; ++k) {
      const Vector3 p = mesh.positions().row(mesh.faces()(f, k)).transpose() - inertia.centroid;
      middle += p / 3;
      inertia.second += a / 12 * p * p.transpose();
    }
    inertia.second += a * 9 / 12 * middle * middle.transpose();
  }
  return inertia;
}

}  // namespace

Index image_sample_step(const SurfaceMesh& mesh) {
  constexpr Index kMaxComparedVertices = 2000;
  return 1 + mesh.vertex_count() / kMaxComparedVertices;
}

double mean_edge_length(const SurfaceMesh& mesh) {
  double sum = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) sum += mesh.edge_length(h);
  return sum / static_cast<double>(mesh.half_edge_count());
}

std::optional<MirrorPlane> mirror_plane(const SurfaceMesh& mesh, const StopCheck& stop) {
  const Inertia inertia = inertia_of(mesh);
  const Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia.second).eigenvectors();
  std::vector<Vector3> normals;
  for (Index k = 0; k < 3; ++k) {
    normals.emplace_back(axes.col(k));
    normals.emplace_back(Vector3::Unit(k));
  }
  const VertexTree vertices(mesh.positions());
  const double near = mean_edge_length(mesh);
  const Index step = image_sample_step(mesh);
  std::optional<MirrorPlane> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3& normal : normals) {
    stop.poll();
    const MirrorPlane plane{normal, normal.dot(inertia.centroid)};
    double sum = 0;
    Index apart = 0, all = 0;
    for (Index v = 0; v < mesh.vertex_count(); v += step, ++all) {
      const Vector3 p = plane.image(mesh.positions().row(v));
      const double distance = (mesh.positions().row(vertices.nearest(p)).transpose() - p).norm();
      sum += distance;
      apart += distance > near;
      if (apart > kMaxFarImages * (mesh.vertex_count() / step + 1)) break;
    }
    if (apart > kMaxFarImages * all || !(sum < least)) continue;
    least = sum;
    best = plane;
  }
  return best;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
