#include "majorant/elements/det_coefficients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace majorant {
namespace {

__extension__ typedef __float128 Quad;

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;  // 2^-53
constexpr double kQuadUnit = 0x1p-113;

// First root in (0, s] of a + b t + c t^2 with a > 0; s when there is none.
double first_root(double a, double b, double c, double s) {
  if (a + std::min(b, 0.0) * s + std::min(c, 0.0) * s * s > 0) return s;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return discriminant < 0 ? s : 0;
  const double root = std::sqrt(discriminant);
  // The smaller positive root, in the form without cancellation. With b > 0 only c < 0 gets here.
  if (b > 0) return std::min(s, (b + root) / (-2 * c));
  const double denominator = root - b;
  if (!(denominator > 0)) return s;
  return std::min(s, 2 * a / denominator);
}

}  // namespace

DetCoefficients::DetCoefficients(int n) : degree_(n) {
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  const TriangleIndices& low = TriangleIndices::of_degree(n - 1);
  const TriangleIndices& det = TriangleIndices::of_degree(2 * n - 2);
  for (int r = 0; r < low.count(); ++r) {
    const auto [i, j, k] = low.multi(r);
    differences_.push_back({ix.local(i + 1, j, k), ix.local(i, j + 1, k), ix.local(i, j, k + 1)});
  }
  for (int r = 0; r < low.count(); ++r)
    for (int s = 0; s < low.count(); ++s) {
      const MultiIndex &u = low.multi(r), &v = low.multi(s);
      const int t = det.local(u[0] + v[0], u[1] + v[1], u[2] + v[2]);
      const double numerator = n * n * low.multinomial(r) * low.multinomial(s);
      products_.push_back({r, s, t, numerator / det.multinomial(t), numerator, det.multinomial(t)});
    }
}

const DetCoefficients& DetCoefficients::of_degree(int n) {
  static const std::vector<DetCoefficients> tables = [] {
    std::vector<DetCoefficients> all;
    for (int degree = 1; degree <= kMaxDegree; ++degree) all.push_back(DetCoefficients(degree));
    return all;
  }();
  return tables.at(static_cast<std::size_t>(n - 1));
}

void DetCoefficients::at(const double* c, double* out) const {
  const std::vector<double> zero(2 * static_cast<std::size_t>(control_point_count(degree_)), 0.0);
  std::vector<double> unused(2 * static_cast<std::size_t>(count()), 0.0);
  along_line(c, zero.data(), out, unused.data(), unused.data() + count());
}

void DetCoefficients::along_line(const double* c, const double* d, double* out0, double* out1,
                                 double* out2) const {
  struct Pair {
    double u0, u1, v0, v1;  // D0 u, D1 u, D0 v, D1 v
  };
  Pair p[control_point_count(7)], q[control_point_count(7)];
  const auto subtract = [](const double* a, const Difference& w) -> Pair {
    return {a[2 * w.plus0] - a[2 * w.plus2], a[2 * w.plus1] - a[2 * w.plus2],
            a[2 * w.plus0 + 1] - a[2 * w.plus2 + 1], a[2 * w.plus1 + 1] - a[2 * w.plus2 + 1]};
  };
  for (std::size_t r = 0; r < differences_.size(); ++r) {
    p[r] = subtract(c, differences_[r]);
    q[r] = subtract(d, differences_[r]);
  }
  std::fill(out0, out0 + count(), 0.0);
  std::fill(out1, out1 + count(), 0.0);
  std::fill(out2, out2 + count(), 0.0);
  for (const Product& m : products_) {
    const Pair &pr = p[m.r], &ps = p[m.s], &qr = q[m.r], &qs = q[m.s];
    out0[m.target] += m.weight * (pr.u0 * ps.v1 - pr.u1 * ps.v0);
    out1[m.target] += m.weight * (pr.u0 * qs.v1 + qr.u0 * ps.v1 - pr.u1 * qs.v0 - qr.u1 * ps.v0);
    out2[m.target] += m.weight * (qr.u0 * qs.v1 - qr.u1 * qs.v0);
  }
}

// Standard forward analysis: every product of differences carries at most 4 roundings, its weight 2
// (weights are rationals rounded once), the sum one per term; gamma_k <= 1.01 k u covers them.
template <class Real>
void DetCoefficients::with_error(const double* c, double unit, double* out, double* error) const {
  std::vector<Real> sum(static_cast<std::size_t>(count()), Real(0)), size(sum);
  const auto magnitude = [](Real a) { return a < 0 ? -a : a; };
  for (const Product& m : products_) {
    const Difference &a = differences_[static_cast<std::size_t>(m.r)],
                     &b = differences_[static_cast<std::size_t>(m.s)];
    const Real u0 = Real(c[2 * a.plus0]) - Real(c[2 * a.plus2]);
    const Real u1 = Real(c[2 * a.plus1]) - Real(c[2 * a.plus2]);
    const Real v0 = Real(c[2 * b.plus0 + 1]) - Real(c[2 * b.plus2 + 1]);
    const Real v1 = Real(c[2 * b.plus1 + 1]) - Real(c[2 * b.plus2 + 1]);
    const auto t = static_cast<std::size_t>(m.target);
    Real weight = Real(m.weight);
    if constexpr (!std::is_same_v<Real, double>) weight = Real(m.numerator) / Real(m.denominator);
    sum[t] += weight * (u0 * v1 - u1 * v0);
    size[t] += weight * (magnitude(u0 * v1) + magnitude(u1 * v0));
  }
  const double roundings = 8.0 + static_cast<double>(differences_.size());
  // Products (and the rounding of quadruple sums to double) may underflow.
  const double underflow = 1024 * roundings * std::numeric_limits<double>::denorm_min();
  for (std::size_t t = 0; t < sum.size(); ++t) {
    out[t] = static_cast<double>(sum[t]);
    error[t] = 1.01 * roundings * unit * static_cast<double>(size[t]) +
               (unit < kUnit ? 2 * kUnit * std::abs(out[t]) : 0) + underflow;
  }
}

void DetCoefficients::at_with_error(const double* c, double* out, double* error) const {
  with_error<double>(c, kUnit, out, error);
}

void DetCoefficients::at_with_error_quad(const double* c, double* out, double* error) const {
  with_error<Quad>(c, kQuadUnit, out, error);
}

PositivityProof certify_positive(int n, const double* coefficients, double error, int max_depth) {
  const int count = control_point_count(n);
  PositivityProof proof;
  double lowest = coefficients[0];  // or NaN, which min_element would step over
  for (int k = 1; k < count; ++k)
    if (coefficients[k] < lowest || std::isnan(coefficients[k])) lowest = coefficients[k];
  proof.lower_bound = lowest - error;
  if (proof.lower_bound > 0) {
    proof.result = Positivity::Certified;
    return proof;
  }
  for (int k = 0; k < std::min(count, 3); ++k)
    if (!(coefficients[k] - error > 0)) proof.result = Positivity::Violated;
  if (proof.result == Positivity::Violated || max_depth == 0) return proof;

  std::vector<double> plus(static_cast<std::size_t>(count)), minus(plus);
  bisect(n, coefficients, plus.data(), minus.data());
  // Averages round: each of the n levels adds at most one ulp of the largest coefficient.
  double largest = 0;
  for (int k = 0; k < count; ++k) largest = std::max(largest, std::abs(coefficients[k]));
  const double child_error = error + 1.01 * n * kUnit * largest;
  const PositivityProof a = certify_positive(n, plus.data(), child_error, max_depth - 1);
  proof.result = a.result;
  proof.depth = a.depth + 1;
  if (a.result != Positivity::Certified) return proof;
  const PositivityProof b = certify_positive(n, minus.data(), child_error, max_depth - 1);
  proof.result = b.result;
  proof.depth = std::max(a.depth, b.depth) + 1;
  if (b.result == Positivity::Certified) proof.lower_bound = std::min(a.lower_bound, b.lower_bound);
  return proof;
}

double largest_positive_step(int n, const double* p0, const double* p1, const double* p2, double s,
                             int max_depth) {
  const int count = control_point_count(n);
  double corner = s, all = s;
  for (int k = 0; k < count; ++k) {
    const double root = p0[k] > 0 ? first_root(p0[k], p1[k], p2[k], s) : 0.0;
    all = std::min(all, root);
    if (k < 3) corner = std::min(corner, root);
  }
  if (all >= corner || max_depth == 0) return all;
  std::vector<double> children(static_cast<std::size_t>(6 * count));
  double* c = children.data();
  bisect(n, p0, c, c + 3 * count);
  bisect(n, p1, c + count, c + 4 * count);
  bisect(n, p2, c + 2 * count, c + 5 * count);
  double step = largest_positive_step(n, c, c + count, c + 2 * count, corner, max_depth - 1);
  if (step <= all) return std::max(step, all);
  return std::max(all, largest_positive_step(n, c + 3 * count, c + 4 * count, c + 5 * count, step,
                                             max_depth - 1));
}

}  // namespace majorant
