#include "majorant/maps/bezier_map.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/singular_values.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/maps/rest_shapes_of.h"

namespace majorant {

BezierMap::BezierMap(std::shared_ptr<const SurfaceMesh> mesh,
                     std::shared_ptr<const BezierTriangleSpace> space, Vec control_points,
                     std::shared_ptr<const Seams> seams)
    : mesh_(given("BezierMap: the mesh", std::move(mesh))),
      space_(given("BezierMap: the space", std::move(space))),
      seams_(seams ? std::move(seams) : std::make_shared<const Seams>()),
      x_(std::make_shared<const Vec>(std::move(control_points))) {
  require_size("BezierMap: the control points", x_->size(), 2 * space_->node_count());
  if (space_->element_count() != mesh_->face_count())
    throw InvalidArgument(fmt::format("BezierMap: a space over {} faces for a mesh of {}",
                                      space_->element_count(), mesh_->face_count()));
}

BezierMap BezierMap::linear(std::shared_ptr<const SurfaceMesh> mesh, Vec uv,
                            std::shared_ptr<const Seams> seams) {
  require_given("BezierMap: the mesh", mesh);
  auto space = std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), 1);
  return BezierMap(std::move(mesh), std::move(space), std::move(uv), std::move(seams));
}

BezierMap BezierMap::with(std::shared_ptr<const BezierTriangleSpace> space,
                          Vec control_points) const {
  return BezierMap(mesh_, std::move(space), std::move(control_points), seams_);
}

Vector2 BezierMap::evaluate(Index face, const Barycentric& xi) const {
  require_index("BezierMap: face", face, mesh_->face_count());
  const Vec b = bernstein_values(degree(), xi);
  Vector2 uv = Vector2::Zero();
  for (Index k = 0; k < b.size(); ++k) uv += b[k] * x_->segment<2>(2 * space_->cells()(face, k));
  return uv;
}

Eigen::Matrix2d BezierMap::jacobian(Index face, const Barycentric& xi) const {
  require_index("BezierMap: face", face, mesh_->face_count());
  const Eigen::MatrixX2d g = bernstein_gradients(degree(), xi);
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
  for (Index k = 0; k < g.rows(); ++k) j += x_->segment<2>(2 * space_->cells()(face, k)) * g.row(k);
  return j * rest_shape(*mesh_, face).inverse_of(0);
}

std::pair<double, double> BezierMap::singular_values(Index face, const Barycentric& xi) const {
  return majorant::singular_values(jacobian(face, xi));
}

Points2 BezierMap::corner_uv() const {
  Points2 uv(3 * mesh_->face_count(), 2);
  for (Index f = 0; f < mesh_->face_count(); ++f)
    for (Index k = 0; k < 3; ++k) uv.row(3 * f + k) = control_uv().row(space_->cells()(f, k));
  return uv;
}

Points2 BezierMap::sample(const std::vector<Barycentric>& points) const {
  const auto count = static_cast<Index>(points.size());
  Eigen::MatrixXd basis(count, space_->nodes_per_element());
  for (Index l = 0; l < count; ++l) basis.row(l) = bernstein_values(degree(), points[l]);
  Points2 uv(count * space_->element_count(), 2);
  Points2 local(space_->nodes_per_element(), 2);
  for (Index f = 0; f < space_->element_count(); ++f) {
    for (Index k = 0; k < local.rows(); ++k)
      local.row(k) = x_->segment<2>(2 * space_->cells()(f, k));
    uv.middleRows(f * count, count) = basis * local;
  }
  return uv;
}

BezierMap BezierMap::elevated() const {
  auto higher = std::make_shared<const BezierTriangleSpace>(mesh_->faces(), mesh_->vertex_count(),
                                                            degree() + 1);
  Vec x = space_->elevate(*x_, *higher);
  return with(std::move(higher), std::move(x));
}

// A Bezier space of degree K has the numbering of the points of the K-fold subdivision.
BezierMap::Refinement BezierMap::refine(int k) const {
  if (k < 1 || k > TriangleIndices::kMaxDegree)
    throw InvalidArgument(fmt::format("BezierMap::refine: K is {}, 1..{} are possible", k,
                                      TriangleIndices::kMaxDegree));
  const TriangleIndices& ix = TriangleIndices::of_degree(k);
  const LatticeNumbering numbering = number_lattice(mesh_->faces(), mesh_->vertex_count(), k);
  Refinement r;
  r.positions.resize(numbering.node_count, 3);
  r.uv.resize(numbering.node_count, 2);
  r.triangles.resize(mesh_->face_count() * k * k, 3);
  std::vector<Barycentric> points;
  for (int l = 0; l < ix.count(); ++l)
    points.push_back(Barycentric(ix.multi(l)[0], ix.multi(l)[1], ix.multi(l)[2]) / k);
  const Points2 uv = sample(points);
  Index t = 0;
  for (Index f = 0; f < mesh_->face_count(); ++f) {
    const auto node = [&](int i, int j) { return numbering.cells(f, ix.local(i, j, k - i - j)); };
    for (int l = 0; l < ix.count(); ++l) {
      const Index p = numbering.cells(f, l);
      r.uv.row(p) = uv.row(f * ix.count() + l);
      const Barycentric& xi = points[l];
      r.positions.row(p) = xi[0] * mesh_->positions().row(mesh_->faces()(f, 0)) +
                           xi[1] * mesh_->positions().row(mesh_->faces()(f, 1)) +
                           xi[2] * mesh_->positions().row(mesh_->faces()(f, 2));
    }
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < k - i; ++j) {
        r.triangles.row(t++) << node(i + 1, j), node(i, j + 1), node(i, j);
        if (i + j < k - 1)
          r.triangles.row(t++) << node(i, j + 1), node(i + 1, j), node(i + 1, j + 1);
      }
  }
  return r;
}

BezierMesh bezier_mesh(int degree, const Cells& faces, const Cells& cells, VecIn x) {
  BezierMesh mesh;
  mesh.degree = degree;
  mesh.faces = faces;
  mesh.opposite = opposite_half_edges(faces);
  mesh.points.resize(cells.rows(), 2 * cells.cols());
  for (Index f = 0; f < cells.rows(); ++f)
    for (Index l = 0; l < cells.cols(); ++l)
      mesh.points.row(f).segment<2>(2 * l) = x.segment<2>(2 * cells(f, l));
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
