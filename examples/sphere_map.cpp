// A closed surface of genus 0 mapped onto the unit sphere without a turned triangle: its vertices
// are directions, unknowns on a manifold. Triangles are neo-Hookean, and J > 0 is their domain.
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/manifold_problem.h"
#include "meshes.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. A surface with bumps up to three times as far out as its hollows; directions start the map.
  const auto [directions, faces] = octasphere(5);
  RowMatrix surface = directions;
  for (auto p : surface.rowwise()) p *= 1 + 0.5 * std::sin(4 * p[0]) * std::cos(5 * p[1] + p[2]);
  // 2. Of each triangle its inverse metric and its area, the whole scaled to that of the sphere.
  const Index count = faces.rows();
  std::vector<Eigen::Matrix2d> metric(count);
  Vec area(count);
  for (Index f = 0; f < count; ++f) {
    Eigen::Matrix<double, 3, 2> edges;
    for (int k : {0, 1})
      edges.col(k) = (surface.row(faces(f, k + 1)) - surface.row(faces(f, 0))).transpose();
    metric[f] = edges.transpose() * edges;
    area[f] = std::sqrt(metric[f].determinant()) / 2;
  }
  const double scale = 4 * std::numbers::pi / area.sum();
  area *= scale;
  for (auto& m : metric) m = (scale * m).inverse().eval();
  const auto rubber = make_term<3, 3>("neo-Hooke", faces, [&](Index f, const auto& z) {
    using std::log;
    const auto edges = (z.template rightCols<2>().colwise() - z.col(0)).eval();
    const auto stretch = (metric[f] * (edges.transpose() * edges)).trace();
    return area[f] * (0.5 * stretch - 1.0 - log(z.determinant() / (2 * area[f])));
  });
  // 3. Solve, and count what is turned.
  ManifoldProblemBuilder builder(static_cast<Index>(directions.size()));
  Cells unknowns =
      Cells::NullaryExpr(directions.rows(), 3, [](auto i, auto k) { return 3 * i + k; });
  builder.on(unit_sphere(3), unknowns);
  builder.add(rubber, 1.0);
  const Vec start = directions.reshaped<Eigen::RowMajor>();
  const ManifoldResult result = builder.build().minimize(start);
  int turned = 0;
  for (Index f = 0; f < count; ++f) {
    Eigen::Matrix3d corners;
    for (int k : {0, 1, 2}) corners.col(k) = result.x.segment<3>(3 * faces(f, k));
    turned += !(corners.determinant() > 0);
  }
  return outcome(result, "turned triangles", turned, 0, 0);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
