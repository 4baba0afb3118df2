// A disk mapped into the plane with least symmetric Dirichlet energy, from Tutte's map.
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/energies.h"
#include "majorant/framework/terms/local_term.h"
#include "rows.h"

namespace majorant::tinyad {
namespace {

End by_lambda(const Input& input, Watch& watch) {
  const RowMatrix& positions = input.array("positions");
  const Cells faces = input.cells("faces");
  const Vec start = input.vector("start");
  // lines: parametrization, lambda
  std::vector<Eigen::Matrix2d> inverse(faces.rows());
  Vec area(faces.rows());
  for (Index f = 0; f < faces.rows(); ++f) {
    const Vector3 u = positions.row(faces(f, 1)) - positions.row(faces(f, 0));
    const Vector3 v = positions.row(faces(f, 2)) - positions.row(faces(f, 0));
    Eigen::Matrix2d rest;
    rest << u.norm(), u.dot(v) / u.norm(), 0, u.cross(v).norm() / u.norm();
    area[f] = rest.determinant() / 2;
    inverse[f] = rest.inverse();
  }
  const auto energy = make_term<3, 2>("energy", faces, [&](Index f, const auto& z) {
    using T = typename std::decay_t<decltype(z)>::Scalar;
    const auto edges = z.template rightCols<2>().colwise() - z.col(0);
    const auto J = (edges * inverse[f]).eval();
    if (!(J.determinant() > 0.0)) return T(INFINITY);
    return T(area[f] * (J.squaredNorm() + J.inverse().squaredNorm()));
  });
  ProblemBuilder builder(start.size());
  builder.add(energy, 1);
  const NewtonMinimizer newton(watch.options());
  const SolveResult result = newton.minimize(builder.build(), start, &watch);
  // end
  return end_of(result);
}

End by_energy(const Input& input, Watch& watch) {
  const Points3 positions = input.array("positions");
  const Cells faces = input.cells("faces");
  const Vec start = input.vector("start");
  // lines: parametrization, energy
  const auto space = std::make_shared<const BezierTriangleSpace>(faces, positions.rows(), 1);
  const RestShapes rest = flat_triangles(positions, faces);
  ProblemBuilder builder(start.size());
  builder.add(symmetric_dirichlet()(space, rest), 1);
  builder.add(std::make_shared<const LocalInjectivity>(space, 2 * rest.measure));
  const NewtonMinimizer newton(watch.options());
  const SolveResult result = newton.minimize(builder.build(), start, &watch);
  // end
  return end_of(result);
}

}  // namespace

std::vector<TinyadProblem> parametrization() {
  return {{"parametrization", disk, {{"lambda", by_lambda}, {"energy", by_energy}}}};
}

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
