// lay_out() of conformal_metric.h: all faces rotated into one frame, positions by walking, then one
// least-squares correction.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/conformal_metric.h"
#include "majorant/parametrization/fields/edge_laplacian.h"

namespace majorant {
namespace {

SurfaceMesh disk_of(const SurfaceMesh& mesh, const ConformalMetric& metric,
                    const std::vector<char>& is_cut) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::Usage, fmt::format("{}{}", message_prefix(mesh), what));
  };
  if (is_cut.size() != to_size(mesh.half_edge_count()))
    refuse(fmt::format("{} cut flags for {} half-edges; give 3 per face", is_cut.size(),
                       mesh.half_edge_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0 && !is_cut[h] != !is_cut[mesh.opposite(h)])
      refuse(fmt::format("edge ({}, {}) is cut on one side only; flag both half-edges",
                         user_vertex(mesh, mesh.from_vertex(h)),
                         user_vertex(mesh, mesh.to_vertex(h))));
  if (metric.edge_vectors.rows() != mesh.half_edge_count())
    refuse("the conformal metric belongs to another surface");
  SurfaceMesh disk = mesh.cut_along(is_cut, nullptr);
  const Topology& topology = disk.topology();
  if (topology.components != 1 || topology.boundary_loops != 1 ||
      topology.euler_characteristic() != 1)
    refuse(
        fmt::format("the cut surface is not a disk ({} components, {} boundary loops, Euler "
                    "characteristic {}); cut it along a graph whose complement is a disk",
                    topology.components, topology.boundary_loops, topology.euler_characteristic()));
  return disk;
}

// The faces of the disk one after the other, breadth first from a face in its middle (the last one
// that a sweep from the boundary reaches), so that few steps lead to each. `crossed`: per face the
// half-edge it is entered through, -1 for the first.
struct FaceOrder {
  std::vector<Index> faces, crossed;

  explicit FaceOrder(const SurfaceMesh& disk) {
    for (Index h = 0; h < disk.half_edge_count(); ++h)
      if (disk.opposite(h) < 0) faces.push_back(face_of(h));
    sweep(disk);
    faces = {faces.back()};
    sweep(disk);
  }

 private:
  void sweep(const SurfaceMesh& disk) {
    crossed.assign(to_size(disk.face_count()), -1);
    std::vector<char> seen(crossed.size(), 0);
    for (const Index f : faces) seen[f] = 1;
    for (std::size_t done = 0; done < faces.size(); ++done)
      for (Index k = 0; k < 3; ++k) {
        const Index h = disk.opposite(3 * faces[done] + k);
        if (h < 0 || seen[face_of(h)]) continue;
        seen[face_of(h)] = 1;
        crossed[face_of(h)] = h;
        faces.push_back(face_of(h));
      }
  }
};

// The metric's edge vectors (3 #F by 2) with all faces in the frame of the first; scaled so that
// the longest is 1.
Points2 aligned_vectors(const SurfaceMesh& disk, const FaceOrder& order,
                        const ConformalMetric& metric) {
  const double longest = metric.edge_vectors.rowwise().norm().maxCoeff();
  Points2 vectors = metric.edge_vectors / (longest > 0 ? longest : 1);
  for (const Index f : order.faces) {
    const Index here = order.crossed[f];
    if (here < 0) continue;
    // The rotation that makes the edge the opposite of what it is in the face that comes before.
    const Eigen::RowVector2d a = vectors.row(here), b = -vectors.row(disk.opposite(here));
    const double norms = a.norm() * b.norm();
    if (!(norms > 0)) continue;
    const double c = a.dot(b) / norms, s = cross(a, b) / norms;
    Eigen::Matrix2d rotation;  // of rows
    rotation << c, s, -s, c;
    vectors.middleRows(3 * f, 3) *= rotation;
  }
  return vectors;
}

// Positions of the vertices of the disk by walking along its half-edges, face by face.
Points2 walk(const SurfaceMesh& disk, const FaceOrder& order, const Points2& vectors) {
  Points2 positions = Points2::Zero(disk.vertex_count(), 2);
  std::vector<char> placed(to_size(disk.vertex_count()), 0);
  placed[disk.faces()(order.faces.front(), 0)] = 1;
  for (const Index f : order.faces) {
    const Index entered = order.crossed[f];
    Index h = entered < 0 ? 3 * f : entered;
    for (int side = 0; side < 2; ++side, h = next(h)) {
      const Index b = disk.to_vertex(h);
      if (placed[b]) continue;
      positions.row(b) = positions.row(disk.from_vertex(h)) + vectors.row(h);
      placed[b] = 1;
    }
  }
  return positions;
}

// Minimizes the sum of |x_b - x_a - vector|^2 / |vector|^2 over all half-edges, starting from
// `positions`: where they fit already, nothing but rounding is added. Leaves them alone when the
// system cannot be solved.
void improve(const SurfaceMesh& disk, const Points2& vectors, Points2& positions) {
  std::vector<Index> row_of;
  for (Index v = 0; v < disk.vertex_count(); ++v) row_of.push_back(v - 1);  // vertex 0 stays
  const EdgeLaplacian laplacian(disk.faces(), row_of);
  const Vec weights = vectors.rowwise().squaredNorm().cwiseInverse();
  if (!weights.allFinite()) return;
  const auto solver = make_direct_solver();
  solver->analyze(laplacian.pattern());
  if (factorize_shifted(*solver, laplacian.pattern(), laplacian.values(weights)).status !=
      FactorStatus::Ok)
    return;
  Points2 residual = Points2::Zero(disk.vertex_count(), 2);
  for (Index h = 0; h < disk.half_edge_count(); ++h) {
    const Index a = disk.from_vertex(h), b = disk.to_vertex(h);
    const Eigen::RowVector2d gap =
        weights[h] * (vectors.row(h) - (positions.row(b) - positions.row(a)));
    residual.row(b) += gap;
    residual.row(a) -= gap;
  }
  for (Index c = 0; c < 2; ++c) {
    Vec correction;
    solver->solve(residual.col(c).tail(laplacian.pattern().size), correction);
    if (correction.allFinite()) positions.col(c).tail(correction.size()) += correction;
  }
}

double area_of(const SurfaceMesh& disk, const Points2& positions) {
  double area = 0;
  for (Index f = 0; f < disk.face_count(); ++f) {
    const auto side = [&](Index k) -> Vector2 {
      return (positions.row(disk.faces()(f, k)) - positions.row(disk.faces()(f, 0))).transpose();
    };
    area += 0.5 * std::abs(cross(side(1), side(2)));
  }
  return area;
}

}  // namespace

CornerPoints lay_out(const SurfaceMesh& mesh, const ConformalMetric& metric,
                     const std::vector<char>& is_cut) {
  const SurfaceMesh disk = disk_of(mesh, metric, is_cut);
  const FaceOrder order(disk);
  // Faces and corners of the disk are those of the mesh, and so are its half-edges.
  const Points2 vectors = aligned_vectors(disk, order, metric);
  Points2 positions = walk(disk, order, vectors);
  improve(disk, vectors, positions);
  const double area = area_of(disk, positions);
  if (area > 0) positions *= std::sqrt(mesh.area() / area);
  CornerPoints corners(mesh.face_count(), 6);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k)
      corners.row(f).segment<2>(2 * k) = positions.row(disk.faces()(f, k));
  return corners;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
