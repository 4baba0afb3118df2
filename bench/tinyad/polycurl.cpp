// Integrable PolyVector fields: two vectors per triangle of a closed surface, smooth across edges
// and free of curl there, by Gauss-Newton with a falling weight of smoothness.
//
// The compared energy is that at the last weight of the example, without the proximal term.
#include <complex>

#include "majorant/framework/terms/least_squares.h"
#include "rows.h"

namespace majorant::tinyad {
namespace {

constexpr int kWeights = 12;  // number of weights of smoothness, each kFall times the one before
constexpr double kFall = 0.8;
constexpr int kStepsAtWeight = 5;

// lines: polycurl
using Complex = std::complex<double>;
struct Transport {
  Complex e, g, t2,
      t4;  // of an edge: its directions in both triangles, and the transport between them
};

std::vector<Transport> transports(const RowMatrix& positions, const Cells& edges,
                                  const RowMatrix& bases) {
  std::vector<Transport> out;
  for (const auto& edge : edges.rowwise()) {
    const Vector3 along = (positions.row(edge[1]) - positions.row(edge[0])).normalized();
    const auto seen_in = [&](Index f) {
      const auto basis = bases.row(f);
      return Complex(basis.head<3>().dot(along), -basis.tail<3>().dot(along));
    };
    const Complex e = seen_in(edge[2]), g = seen_in(edge[3]), t = e / g;
    out.push_back({e, g, t * t, t * t * t * t});
  }
  return out;
}
// end

// lines: polycurl
template <class T>
T squared(const T& x) {
  return x * x;
}

// Returns differences of polynomial coefficients across an edge: four for smoothness, three for
// curl.
template <class Z>
auto smoothness_of(const Transport& at, const Z& z) {
  using T = typename Z::Scalar;
  const std::complex<T> a(z(0, 0), z(1, 0)), b(z(2, 0), z(3, 0)), c(z(0, 1), z(1, 1)),
      d(z(2, 1), z(3, 1));
  const auto t4 = std::complex<T>(at.t4.real(), at.t4.imag());
  const auto t2 = std::complex<T>(at.t2.real(), at.t2.imag());
  const auto r0 = a * a * b * b * t4 - c * c * d * d, r2 = c * c + d * d - (a * a + b * b) * t2;
  return std::array{r0.real(), r0.imag(), r2.real(), r2.imag()};
}
template <class Z>
auto curl_of(const Transport& at, const Z& z) {
  const auto along = [&](int i, int side) {
    const Complex e = side == 0 ? at.e : at.g;
    return (z(i, side) * e.real() - z(i + 1, side) * e.imag());
  };
  const auto a = along(0, 0), b = along(2, 0), c = along(0, 1), d = along(2, 1);
  const auto r0 = squared(a * b) - squared(c * d);
  const auto r2 = squared(c) + squared(d) - squared(a) - squared(b);
  const auto q = (squared(b) - squared(a)) * c * d - (squared(d) - squared(c)) * a * b;
  return std::array{100.0 * r0, 10.0 * r2, std::sqrt(10.0) * q};
}

// Keeps the angle from the first to the second vector of a triangle between 0 and 180 degrees.
template <class Z>
auto barrier_of(const Z& z) {
  using T = typename Z::Scalar;
  const T x = (z[3] * z[0] - z[2] * z[1]) / 0.9;
  if (!(x > 0.0)) return T(INFINITY);
  return x < 1.0 ? T(std::sqrt(0.1) * (1.0 / (x * x * x - 3.0 * x * x + 3.0 * x) - 1.0)) : T(0.0);
}
// end

// One term on edges and one on triangles, whose data change after each step.
End by_lambda(const Input& input, Watch& watch) {
  const RowMatrix &positions = input.array("positions"), &bases = input.array("bases");
  const Cells edges = input.cells("edges");
  const Vec start = input.vector("start");
  // lines: polycurl, lambda
  const std::vector<Transport> transport = transports(positions, edges, bases);
  const Index count = static_cast<Index>(start.size()) / 4;
  const auto across = make_least_squares<2, 4>(
      "across edges", edges.rightCols<2>(),
      [&](Index e, const auto& z, const auto& smooth) {
        const auto s = smoothness_of(transport[e], z);
        const auto c = curl_of(transport[e], z);
        const double w = std::sqrt(smooth[0]);
        return std::array{w * s[0], w * s[1], w * s[2], w * s[3], c[0], c[1], c[2]};
      },
      Vec::Ones(1));
  const auto inside = make_least_squares<1, 4>(
      "in triangles", Cells(Eigen::VectorXi::LinSpaced(count, 0, count - 1)),
      [&](Index f, const auto& z, const auto& last) {
        const double near = std::sqrt(f == 0 ? 100 : 1e-3);
        const auto d = [&](int k) { return near * (z[k] - (f == 0 ? start[k] : last[k])); };
        return std::array{d(0), d(1), d(2), d(3), barrier_of(z)};
      },
      start.reshaped<Eigen::RowMajor>(count, 4));
  ProblemBuilder builder(static_cast<Index>(start.size()));
  const TermId edge_term = builder.add(across, 2), face_term = builder.add(inside, 2);
  Problem problem = builder.build();
  NewtonOptions gauss_newton = watch.options();
  gauss_newton.blend.below = 0;
  NewtonStepper stepper(problem, gauss_newton);
  Vec x = start;
  double smooth = 1, energy = 0;
  for (int step = 0; step < kWeights * kStepsAtWeight; ++step) {
    if (step > 0 && step % kStepsAtWeight == 0) smooth *= kFall;
    problem = problem.with(
        {{edge_term, {.parameters = Vec::Constant(1, smooth)}}, {face_term, {.parameters = x}}});
    stepper.reset(problem);
    energy = stepper.evaluator().value(x);
    const StepResult taken = stepper.step(x, energy);
    // not counted
    const bool is_last = step >= (kWeights - 1) * kStepsAtWeight;
    watch.step(taken.record, is_last ? energy : INFINITY);
    // counted
  }
  // end
  SolveResult result;
  result.status = Status::Converged;
  result.y = x;
  Evaluator evaluator(problem.with({{face_term, {.parameters = x}}}));
  return {result, evaluator.value(x)};
}

// The weights are those of terms, and the descent at each weight continues until it slows down. No
// proximal term is needed, since Newton's method has a line search and shifts.
End by_terms(const Input& input, Watch& watch) {
  const RowMatrix &positions = input.array("positions"), &bases = input.array("bases");
  const Cells edges = input.cells("edges");
  const Vec start = input.vector("start");
  // lines: polycurl, terms
  const std::vector<Transport> transport = transports(positions, edges, bases);
  const Index count = static_cast<Index>(start.size()) / 4;
  const Cells pairs = edges.rightCols<2>();
  const Cells triangles = Eigen::VectorXi::LinSpaced(count, 0, count - 1);
  ProblemBuilder builder(static_cast<Index>(start.size()));
  const TermId smoothness =
      builder.add(make_least_squares<2, 4>(
                      "smoothness", pairs,
                      [&](Index e, const auto& z) { return smoothness_of(transport[e], z); }),
                  2);
  builder.add(make_least_squares<2, 4>(
                  "curl", pairs, [&](Index e, const auto& z) { return curl_of(transport[e], z); }),
              2);
  builder.add(make_least_squares<1, 4>("convexity", triangles,
                                       [](Index, const auto& z) { return barrier_of(z); }),
              2);
  builder.add(make_least_squares<1, 4>("held", Cells{{0}},
                                       [&](Index, const auto& z) {
                                         return (10.0 * (z.col(0) - start.head<4>())).eval();
                                       }),
              2);
  NewtonStepper stepper(builder.build(), watch.options());
  SolveResult result;
  result.y = start;
  for (int k = 0; k < kWeights; ++k) {
    const bool is_last = k + 1 == kWeights;
    const double smooth = 2 * std::pow(kFall, k);
    stepper.reset(builder.build().with({{smoothness, {.weight = smooth}}}));
    const StoppingRules rules = is_last ? watch.options().stopping : brief_rules(2, 0.1);
    result = stepper.minimize(result.y, rules, is_last ? &watch : nullptr);
    // not counted
    for (const IterationRecord& record : result.iterations)
      if (!is_last) watch.step(record, INFINITY);
    // counted
  }
  // end
  return end_of(result);
}

}  // namespace

std::vector<TinyadProblem> polycurl() {
  return {{"polycurl", frame_field, {{"lambda", by_lambda}, {"terms", by_terms}}}};
}

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
