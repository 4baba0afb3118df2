// Rotations averaged over a graph: the orientations of cameras from measured rotations between
// pairs of them, some of which are wrong. Unknowns are 3 by 3 matrices on the manifold of
// rotations.
#include <Eigen/Geometry>
#include <random>

#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/manifold_problem.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. Two hundred orientations, each measured from a dozen others with an error of a degree; one
  // measurement in ten is of something else.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto turned = [&](double angle) {
    const Eigen::Vector3d axis(normal(random), normal(random), normal(random));
    return Eigen::AngleAxisd(angle * normal(random), axis.normalized()).toRotationMatrix();
  };
  constexpr Index cameras = 200, measured = 12 * cameras;
  std::vector<Eigen::Matrix3d> truth, between;
  for (Index i = 0; i < cameras; ++i) truth.push_back(turned(2));
  Cells pairs(measured, 2);
  for (Index e = 0; e < measured; ++e) {
    const Index i = e / 12, j = (i + 1 + e % 12 * (e % 12)) % cameras;
    pairs.row(e) << i, j;
    const Eigen::Matrix3d right = truth[i].transpose() * truth[j] * turned(0.017);
    between.push_back(random() % 10 == 0 ? turned(2) : right);
  }
  // 2. |R_j - R_i M|, 0 where the measurement is met; a loss bounds what wrong ones may cost.
  const auto difference = [&between](Index e, const auto& z) {
    auto r = z.col(1).eval();
    for (int i = 0; i < 9; ++i)
      for (int k = 0; k < 3; ++k) r[i] -= z(i - i % 3 + k, 0) * between[e](k, i % 3);
    return r;
  };
  const auto agree = make_least_squares<2, 9>("agree", pairs, difference, cauchy_loss(0.1));
  // 3. Solve from 20 degrees beside the truth.
  ManifoldProblemBuilder builder(9 * cameras);
  builder.on(rotation_matrices(),
             Cells::NullaryExpr(cameras, 9, [](auto i, auto k) { return 9 * i + k; }));
  builder.add(agree, 1.0);
  Vec start(9 * cameras);
  for (Index i = 0; i < cameras; ++i)
    start.segment<9>(9 * i) = (truth[i] * turned(0.35)).eval().reshaped<Eigen::RowMajor>();
  const ManifoldResult result = builder.build().minimize(start);
  // 4. The mean error in degrees, against the first camera, whose orientation nothing says.
  const auto found = [&](Index i) -> Eigen::Matrix3d {
    return result.x.segment<9>(9 * i).reshaped<Eigen::RowMajor>(3, 3);
  };
  const Eigen::Matrix3d frame = truth[0] * found(0).transpose();
  double error = 0;
  for (Index i = 0; i < cameras; ++i)
    error += Eigen::AngleAxisd(frame * found(i) * truth[i].transpose()).angle() / cameras;
  return outcome(result, "mean error in degrees", error * 180 / std::numbers::pi, 0.4, 0.4);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
