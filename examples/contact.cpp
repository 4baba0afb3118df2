// A block of rubber falls onto another one, and they never touch: implicit Euler, each step the
// minimum of inertia, elasticity and a barrier between vertices and edges that are close [LFS20]. A
// FeasibilityChecker ends a step of the minimizer before a vertex would pass through an edge.
//
// Sample run:
//   example_contact
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "meshes.h"
#include "outcome.h"
using namespace majorant;

// The squared distance of point z_0 to the segment from z_1 to z_2.
template <class Z>
auto squared_distance(const Z& z) {
  using std::max, std::min;
  using T = typename Z::Scalar;
  const auto edge = (z.col(2) - z.col(1)).eval(), r = (z.col(0) - z.col(1)).eval();
  const T t = min(max(T(r.dot(edge) / edge.squaredNorm()), T(0.0)), T(1.0));
  return T((r - t * edge).squaredNorm());
}

Eigen::Matrix<double, 2, 3> corners(VecIn x, const auto& pair) {
  return Eigen::Map<const Eigen::Matrix2Xd>(x.data(), 2, x.size() / 2)(Eigen::all, pair);
}

class NoCrossing final : public FeasibilityChecker {
 public:
  explicit NoCrossing(const Cells& pairs) : pairs_(pairs) {}
  std::string_view name() const override { return "no vertex passes through an edge"; }
  Verdict check(VecIn x) const override {
    double least = 1e10;
    for (const auto& pair : pairs_.rowwise())
      least = std::min(least, squared_distance(corners(x, pair)));
    return {least > 0, std::sqrt(least), {}, {}};
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    const auto cross = [](const auto& a, const auto& b) { return a[0] * b[1] - a[1] * b[0]; };
    StepBound bound{s, {}};
    for (const auto& pair : pairs_.rowwise()) {
      const auto z = corners(x, pair), dz = corners(d, pair);
      const Vector2 e = z.col(2) - z.col(1), r = z.col(0) - z.col(1);
      const Vector2 de = dz.col(2) - dz.col(1), dr = dz.col(0) - dz.col(1);
      // The vertex is on the line of the edge at the roots of A t^2 + B t + C.
      const double A = cross(de, dr), B = cross(e, dr) + cross(de, r), C = cross(e, r);
      const double q = -0.5 * (B + std::copysign(std::sqrt(B * B - 4 * A * C), B));
      for (const double t : {q / A, C / q}) {
        const double along = (e + t * de).dot(r + t * dr) / (e + t * de).squaredNorm();
        if (t > 0 && t < bound.step && std::abs(along - 0.5) < 0.501) bound = {t, {pair[0]}};
      }
    }
    return bound;
  }

 private:
  Cells pairs_;
};

int main() {
  // 1. Two blocks, the second one above the first and turned a little; a lower side is held.
  const ExampleMesh block = square(6);
  const Index n = static_cast<Index>(block.points.rows());
  Points3 points(2 * n, 3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()).matrix();
  points << block.points, (block.points * turn).rowwise() + Eigen::RowVector3d(0.4, 2.4, 0);
  Cells cells(2 * block.cells.rows(), 3);
  cells << block.cells, block.cells.array() + n;
  const FixedUnknowns ground = held(points.leftCols(2), {0, 1, 2, 3, 4, 5, 6});
  // 2. Rubber, and the masses of its vertices.
  const RestShapes rest = flat_triangles(points, cells);
  const auto space = std::make_shared<const BezierTriangleSpace>(cells, 2 * n, 1);
  const auto rubber =
      make_energy(space, rest, density<2, 2>("neo-Hooke", [](const auto& F) {
                    using std::log;
                    const auto log_J = log(F.determinant());
                    return 200.0 * (0.5 * (F.squaredNorm() - 2.0) - log_J + log_J * log_J);
                  }));
  Vec mass = Vec::Zero(2 * n);
  for (Index e = 0; e < cells.rows(); ++e)
    for (const Index k : cells.row(e)) mass[k] += rest.measure[e] / 3;
  // 3. Half a second in steps of a hundredth; the barrier reaches to distances of 0.03.
  const double h = 0.01, reach = 0.03 * 0.03;
  const Cells nodes = Vec::LinSpaced(2 * n, 0, 2 * n - 1).cast<Index>(),
              pairs = boundary_pairs(cells);
  const auto wall = std::make_shared<const NoCrossing>(pairs);
  Vec x = unknowns_of(points.leftCols(2)), v = Vec::Zero(x.size());
  SolveResult result;
  result.status = Status::Converged;
  double least = 1;
  for (int k = 0; k < 50 && result.status == Status::Converged; ++k) {
    const Vec target = x + h * v - 9.81 * h * h * Vec::Unit(2, 1).replicate(2 * n, 1);
    const auto inertia = make_term<1, 2>("inertia", nodes, [&](Index i, const auto& z) {
      return 0.5 * mass[i] * (z.col(0) - target.segment<2>(2 * i)).squaredNorm();
    });
    std::vector<Index> close;
    for (Index i = 0; i < pairs.rows(); ++i)
      if (squared_distance(corners(x, pairs.row(i))) < 25 * reach) close.push_back(i);
    const Cells near = pairs(close, Eigen::all);
    const auto barrier = make_term<3, 2>("contact", near, [=](Index, const auto& z) {
      using std::log;
      const auto s = squared_distance(z) / reach;
      return s < 1.0 ? -(s - 1.0) * (s - 1.0) * log(s) : 0.0 * s;
    });
    ProblemBuilder builder(4 * n);
    builder.add(inertia, 1 / (h * h)).add(rubber, 1).add(barrier, 1).add(ground).add(wall);
    const Problem problem = builder.build();
    result = NewtonMinimizer().minimize(problem, problem.reduce(x), {});
    v = (problem.expand(result.y) - x) / h;
    x += h * v;
    least = std::min(least, wall->check(x).margin);
  }
  return outcome(result, "least distance", least, 0.025, 0.003);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
