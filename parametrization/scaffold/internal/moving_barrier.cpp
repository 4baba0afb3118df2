#include "majorant/parametrization/scaffold/internal/moving_barrier.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/det_coefficients.h"
#include "majorant/framework/backtracking.h"

namespace majorant {
namespace {

// Upper bound on steps towards positive B_l; flips that fail stop long before.
constexpr int kMaxBarrierSteps = 40;
// Upper bound on steps with all B_l positive; mostly two are enough.
constexpr int kMaxQualitySteps = 12;
// Steps end at a relative decrease of F below this: F need not be minimal, since a scaffold's
// triangles are relaxed anyway.
constexpr double kGoodEnough = 1e-2;
// The largest min B - mu, relative to 1 - min B [TGRL13].
constexpr double kWidestGap = 0.1;
// The smallest such gap: closer barriers make F too stiff for further progress.
constexpr double kSmallestGap = 1e-3;
// The shortest fraction of a Newton step that is tried; a shorter one gains far less than
// kGoodEnough.
constexpr double kShortestStep = 1e-6;

double squared(double x) { return x * x; }

// A term of F_mu and its derivatives by b.
struct BarrierValue {
  double value, first, second;
};

BarrierValue barrier(double b, double mu) {
  const double gap = b - mu, log = std::log(gap / (1 - mu));
  return {log * log + squared(b - 1), 2 * log / gap + 2 * (b - 1), 2 * (1 - log) / (gap * gap) + 2};
}

double objective(const Vec& b, double mu) {
  if (!(b.minCoeff() > mu)) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const double x : b) sum += squared(std::log((x - mu) / (1 - mu))) + squared(x - 1);
  return sum;
}

// Coordinates in which the corners of the grid are those of the unit square, as far as an affine
// map allows. Results are then the same for all affine images of a quadrilateral.
struct Frame {
  Eigen::RowVector2d origin;
  Eigen::Matrix2d axes;  // rows

  Frame(const Points2& grid, int n) : origin(grid.row(0)) {
    const auto corner = [&](int p, int q) { return grid.row(n * (q * (n + 1) + p)); };
    axes.row(0) = 0.5 * (corner(1, 0) - corner(0, 0) + corner(1, 1) - corner(0, 1));
    axes.row(1) = 0.5 * (corner(0, 1) - corner(0, 0) + corner(1, 1) - corner(1, 0));
  }
  Points2 enter(const Points2& grid) const {
    return (grid.rowwise() - origin) * axes.inverse().eval();
  }
  Points2 leave(const Points2& grid) const { return (grid * axes).rowwise() + origin; }
};

}  // namespace

struct MovingBarrier::Workspace {
  Vec b, slope, bend;           // B_l along a direction d: b + t slope + t^2 bend
  Eigen::MatrixXd derivatives;  // of B_l by the variables
  Eigen::MatrixXd weighted;
  Model model;
};

const MovingBarrier& MovingBarrier::of_degree(int degree) {
  static std::array<std::once_flag, kMaxDegree> made;
  static std::array<std::unique_ptr<const MovingBarrier>, kMaxDegree> tables;
  const std::size_t k = to_size(degree - 1);
  std::call_once(made.at(k), [&] { tables[k].reset(new MovingBarrier(degree)); });
  return *tables[k];
}

MovingBarrier::MovingBarrier(int degree)
    : degree_(degree), coefficients_per_half_(control_point_count(2 * degree - 2)) {
  add_pairs();
}

int MovingBarrier::row(int half, int node) const {
  const auto [i, j, k] = TriangleIndices::of_degree(degree_).multi(node);
  const int upper = (j + k) * (degree_ + 1) + j;
  return half == 0 ? upper : (degree_ + 1) * (degree_ + 1) - 1 - upper;
}

int MovingBarrier::inner_point(int row) const {
  const int p = row % (degree_ + 1), q = row / (degree_ + 1);
  const bool inside = p > 0 && p < degree_ && q > 0 && q < degree_;
  return inside ? (q - 1) * (degree_ - 1) + p - 1 : -1;
}

// det J is bilinear and alternating in the control points: its coefficients are sums of weight *
// cross(c_a, c_b) over pairs a < b. The weights of a pair are the coefficients for c_a = (1, 0),
// c_b = (0, 1) and all other points 0. A pair has at most three, at the exponents a + b less one in
// two of the coordinates.
void MovingBarrier::add_pairs() {
  Cells face(1, 3);
  face << 0, 1, 2;
  const DetCoefficients det(BezierTriangleSpace(face, 3, degree_).element());
  double scale = 1;  // of det.scaled()
  for (int k = 2; k <= 2 * degree_ - 2; ++k) scale *= k;
  const TriangleIndices& nodes = TriangleIndices::of_degree(degree_);
  const TriangleIndices& products = TriangleIndices::of_degree(2 * degree_ - 2);
  const int count = nodes.count();
  std::vector<std::int64_t> c(to_size(2 * count));
  std::vector<Pair> triangle;
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      c[2 * a] = c[2 * b + 1] = 1;
      const std::vector<std::int64_t> weights = det.scaled(c);
      c[2 * a] = c[2 * b + 1] = 0;
      const MultiIndex &i = nodes.multi(a), &j = nodes.multi(b);
      Pair pair{a, b, -1, -1, 0, {}, 0};
      for (std::size_t x = 0; x < 3; ++x) {
        MultiIndex m{i[0] + j[0], i[1] + j[1], i[2] + j[2]};
        --m[x];
        --m[(x + 1) % 3];
        if (*std::min_element(m.begin(), m.end()) < 0) continue;
        const int l = products.local(m[0], m[1], m[2]);
        if (weights[l] != 0)
          pair.target[to_size(pair.targets++)] = {l, static_cast<double>(weights[l]) / scale};
      }
      if (pair.targets > 0) triangle.push_back(pair);
    }
  for (const int half : {0, 1})
    for (Pair pair : triangle) {
      pair.half = half;
      pair.a = row(half, pair.a);
      pair.b = row(half, pair.b);
      pair.variable_a = inner_point(pair.a);
      pair.variable_b = inner_point(pair.b);
      for (Target& target : pair.target) target.coefficient += half * coefficients_per_half_;
      pairs_.push_back(pair);
    }
}

std::array<double, 2> MovingBarrier::straight_determinants(const Points2& grid) const {
  const int n = degree_, a = 0, d = n, c = n * (n + 1), b = c + n;
  const Vector2 corner = grid.row(a), diagonal = Vector2(grid.row(b)) - corner;
  return {cross(diagonal, Vector2(grid.row(c)) - corner),
          -cross(diagonal, Vector2(grid.row(d)) - corner)};
}

// Calls add(pair, coefficient l, weight / straight determinant).
template <class Add>
void MovingBarrier::for_targets(const Points2& grid, const Add& add) const {
  const std::array<double, 2> straight = straight_determinants(grid);
  const std::array<double, 2> scale{1 / straight[0], 1 / straight[1]};
  for (const Pair& pair : pairs_)
    for (int k = 0; k < pair.targets; ++k) {
      const Target& t = pair.target[k];
      add(pair, t.coefficient, t.weight * scale[pair.half]);
    }
}

void MovingBarrier::evaluate(const Points2& grid, Vec& b) const {
  b.setZero(coefficient_count());
  for_targets(grid, [&](const Pair& pair, int l, double weight) {
    b[l] += weight * cross(grid.row(pair.a), grid.row(pair.b));
  });
}

Vec MovingBarrier::coefficients(const Points2& grid) const {
  Vec b;
  evaluate(grid, b);
  return b;
}

void MovingBarrier::differentiate(const Points2& grid, Eigen::MatrixXd& derivatives) const {
  derivatives.setZero(coefficient_count(), variable_count());
  for_targets(grid, [&](const Pair& pair, int l, double weight) {
    if (const int v = 2 * pair.variable_a; v >= 0) {
      derivatives(l, v) += weight * grid(pair.b, 1);
      derivatives(l, v + 1) -= weight * grid(pair.b, 0);
    }
    if (const int v = 2 * pair.variable_b; v >= 0) {
      derivatives(l, v) -= weight * grid(pair.a, 1);
      derivatives(l, v + 1) += weight * grid(pair.a, 0);
    }
  });
}

// w.b and w.derivatives are given at the grid.
void MovingBarrier::fill_model(const Points2& grid, double mu, Workspace& w) const {
  Vec first(w.b.size()), root(w.b.size());
  w.model.value = 0;
  for (Index l = 0; l < w.b.size(); ++l) {
    const BarrierValue term = barrier(w.b[l], mu);
    w.model.value += term.value;
    first[l] = term.first;
    root[l] = std::sqrt(term.second);  // > 1.9 for mu <= 0: the logarithm's part is -0.05 or more
  }
  w.model.gradient.noalias() = w.derivatives.transpose() * first;
  w.weighted.noalias() = root.asDiagonal() * w.derivatives;
  w.model.gauss_newton.noalias() = w.weighted.transpose() * w.weighted;
  w.model.hessian = w.model.gauss_newton;
  for_targets(grid, [&](const Pair& pair, int l, double weight) {
    if (pair.variable_a < 0 || pair.variable_b < 0) return;
    const int i = 2 * pair.variable_a, j = 2 * pair.variable_b;
    const double second = weight * first[l];
    w.model.hessian(i, j + 1) += second;
    w.model.hessian(j + 1, i) += second;
    w.model.hessian(i + 1, j) -= second;
    w.model.hessian(j, i + 1) -= second;
  });
}

MovingBarrier::Model MovingBarrier::model(const Points2& grid, double mu) const {
  Workspace w;
  evaluate(grid, w.b);
  differentiate(grid, w.derivatives);
  fill_model(grid, mu, w);
  return w.model;
}

void MovingBarrier::move(Points2& grid, const Vec& direction, double t) const {
  for (int row = 0; row < grid.rows(); ++row)
    if (const int v = 2 * inner_point(row); v >= 0)
      grid.row(row) += t * direction.segment<2>(v).transpose();
}

// Takes one Newton step from w.b, with the Gauss-Newton matrix if the Hessian is not positive
// definite. Returns the relative decrease of F_mu, 0 if no step length decreases it. Sets w.b to
// its values at the new grid.
double MovingBarrier::step(Points2& grid, double mu, Workspace& w) const {
  differentiate(grid, w.derivatives);
  fill_model(grid, mu, w);
  Eigen::LLT<Eigen::MatrixXd> factor(w.model.hessian);
  if (factor.info() != Eigen::Success) factor.compute(w.model.gauss_newton);
  if (factor.info() != Eigen::Success) return 0;
  const Vec direction = -factor.solve(w.model.gradient);
  const double descent = direction.dot(w.model.gradient);
  if (!(descent < 0)) return 0;
  w.slope.noalias() = w.derivatives * direction;
  Points2 ahead = grid;
  move(ahead, direction, 1);
  evaluate(ahead, w.bend);
  w.bend -= w.b + w.slope;
  double value = 0;
  const auto attempt = [&](double t) {
    const Vec b = w.b + t * w.slope + (t * t) * w.bend;
    value = objective(b, mu);
    return value <= w.model.value + kArmijo * t * descent ? kTake : kHalve;
  };
  const std::optional<double> t = backtrack(1, {.smallest = kShortestStep}, attempt);
  if (!t) return 0;
  move(grid, direction, *t);
  evaluate(grid, w.b);
  return (w.model.value - value) / w.model.value;
}

double MovingBarrier::minimize(Points2& grid) const {
  const Frame frame(grid, degree_);
  Points2 x = frame.enter(grid);
  Workspace w;
  evaluate(x, w.b);
  if (variable_count() == 0) return w.b.minCoeff();
  double gap = kWidestGap;
  int quality = 0;
  for (int k = 0; k < kMaxBarrierSteps && quality < kMaxQualitySteps; ++k) {
    const double worst = w.b.minCoeff();
    if (!std::isfinite(worst)) break;
    const bool positive = worst > 0;
    const double decrease = step(x, positive ? 0.0 : worst - gap * (1 - worst), w);
    if (positive) ++quality;
    if (decrease > kGoodEnough) continue;
    if (positive || gap <= kSmallestGap) break;
    gap *= 0.5;
  }
  const Points2 moved = frame.leave(x);
  for (int row = 0; row < grid.rows(); ++row)
    if (inner_point(row) >= 0) grid.row(row) = moved.row(row);
  return w.b.minCoeff();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
