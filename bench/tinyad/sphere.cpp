// A triangulated surface of genus 0 is spread over the unit sphere: a barrier prevents triangles
// from turning over, edges are short, and vertices may be attracted to the equator or to the north
// pole.
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/manifold_problem.h"
#include "rows.h"

namespace majorant::tinyad {
namespace {

enum class Pull { Nowhere, Equator, NorthPole };

// Returns the energy of a triangle, whose corners are the columns of p.
// lines: sphere
template <class T>
T energy_of(const Eigen::Matrix<T, 3, 3>& p, Pull pull) {
  using std::log;
  const T volume = p.determinant() / 6.0;
  if (!(volume > 0.0)) return T(INFINITY);
  T energy = -0.1 * log(volume);
  for (int k = 0; k < 3; ++k) {
    energy += (p.col(k) - p.col((k + 1) % 3)).squaredNorm();
    if (pull == Pull::Equator) energy += p(1, k) * p(1, k);
    if (pull == Pull::NorthPole) energy += (1.0 - p(1, k)) * (1.0 - p(1, k));
  }
  return energy;
}
// end

// The unknowns are coordinates in tangent planes, which a loop updates.
End by_lambda(Pull pull, const Input& input, Watch& watch) {
  const Cells faces = input.cells("faces");
  RowMatrix points = input.array("start");
  // lines: sphere, lambda
  RowMatrix planes(faces.rows(), 27);  // by face and corner: a point and two tangents
  const auto renew = [&] {
    for (Index f = 0; f < faces.rows(); ++f)
      for (int k = 0; k < 3; ++k) {
        const Vector3 p = points.row(faces(f, k)), u = p.unitOrthogonal();
        planes.row(f).segment<9>(9 * k) << p.transpose(), u.transpose(), p.cross(u).transpose();
      }
  };
  renew();
  const auto term = make_term<3, 2>(
      "energy", faces,
      [=](Index, const auto& z, const auto& plane) {
        using T = typename std::decay_t<decltype(z)>::Scalar;
        Eigen::Matrix<T, 3, 3> corners;
        for (int k = 0; k < 3; ++k) {
          const auto at = [&](int i) { return plane.template segment<3>(9 * k + 3 * i); };
          corners.col(k) = (at(0) + at(1) * z(0, k) + at(2) * z(1, k)).normalized();
        }
        return energy_of(corners, pull);
      },
      planes);
  ProblemBuilder builder(static_cast<Index>(2 * points.rows()));
  const TermId id = builder.add(term, 1);
  const Problem problem = builder.build();
  NewtonStepper stepper(problem, watch.options());
  Vec y = Vec::Zero(problem.size());
  SolveResult result;
  result.energy = stepper.evaluator().value(y);
  StoppingTest test(watch.options().stopping, result.energy);
  Advice advice;
  while (!(advice.stop = advice.stop ? advice.stop : test.before_step())) {
    const StepResult step = stepper.step(y, result.energy);
    watch.step(step.record, result.energy);
    advice = test.after(step);
    if (advice.polish) stepper.polish();
    for (Index v = 0; v < points.rows(); ++v) {
      const Vector3 p = points.row(v), u = p.unitOrthogonal();
      points.row(v) = (p + y[2 * v] * u + y[2 * v + 1] * p.cross(u)).normalized();
    }
    renew();
    y.setZero();
    stepper.reset(problem.with({{id, {.parameters = planes.reshaped<Eigen::RowMajor>()}}}));
  }
  result.status = advice.stop->status;
  result.y = y;
  // end
  return end_of(result);
}

// The vertices are unknowns on the unit sphere.
End by_manifold(Pull pull, const Input& input, Watch& watch) {
  const Cells faces = input.cells("faces");
  const Vec start = input.vector("start");
  // lines: sphere, manifold
  const Index count = static_cast<Index>(start.size()) / 3;
  Cells points = Cells::NullaryExpr(count, 3, [](auto v, auto k) { return 3 * v + k; });
  ManifoldProblemBuilder builder(3 * count);
  builder.on(unit_sphere(3), points);
  builder.add(make_term<3, 3>("energy", faces,
                              [pull](Index, const auto& z) { return energy_of(z.eval(), pull); }),
              1);
  const ManifoldResult result = builder.build().minimize(start, watch.options(), &watch);
  // end
  return end_of(result);
}

TinyadProblem sphere_with(const std::string& name, Pull pull) {
  return {"sphere " + name,
          sphere,
          {{"lambda", [pull](const Input& i, Watch& w) { return by_lambda(pull, i, w); }},
           {"manifold", [pull](const Input& i, Watch& w) { return by_manifold(pull, i, w); }}}};
}

}  // namespace

std::vector<TinyadProblem> sphere_embedding() {
  return {sphere_with("default", Pull::Nowhere), sphere_with("equator", Pull::Equator),
          sphere_with("northpole", Pull::NorthPole)};
}

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
