#include "majorant/elements/step_polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace majorant {
namespace {

// Where the convex hull of the control polygon of a cubic on [0, 1] meets 0 first; b[0] > 0 and
// not all others are.
double hull_root(const double (&b)[4]) {
  double root = 1;
  for (int k = 1; k < 4; ++k) {
    if (b[k] > 0) continue;
    for (int i = 0; i < k; ++i)
      if (b[i] > 0) root = std::min(root, (i + (k - i) * (b[i] / (b[i] - b[k]))) / 3);
  }
  return root;
}

// Control values of the cubic on [t, 1].
void cut(double (&b)[4], double t) {
  for (int level = 3; level > 0; --level)
    for (int k = 0; k < level; ++k) b[k] += t * (b[k + 1] - b[k]);
}

}  // namespace

double first_root(const StepPolynomial<2>& p, double s) {
  const auto [a, b, c] = p.power;
  if (plainly_positive(p, s)) return s;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return discriminant < 0 ? s : 0;
  const double root = std::sqrt(discriminant);
  // The smaller positive root, in the form without cancellation. With b > 0 only c < 0 gets here.
  if (b > 0) return std::min(s, (b + root) / (-2 * c));
  const double denominator = root - b;
  if (!(denominator > 0)) return s;
  return std::min(s, 2 * a / denominator);
}

// Bezier clipping from the left: p is positive up to the first zero of the convex hull of its
// control polygon. Quadratic convergence to a simple root, halving at a double one.
double first_root(const StepPolynomial<3>& p, double s) {
  constexpr int kMaxClips = 64;
  const auto [p0, p1, p2, p3] = p.power;
  if (plainly_positive(p, s)) return s;
  const double q1 = p1 * s, q2 = p2 * s * s, q3 = p3 * s * s * s;
  double b[4] = {p0, p0 + q1 / 3, p0 + (2 * q1 + q2) / 3, p0 + q1 + q2 + q3};
  if (!std::isfinite(b[0] + b[1] + b[2] + b[3])) return 0;
  double left = 0;
  for (int k = 0; k < kMaxClips && b[0] > 0; ++k) {
    if (b[1] > 0 && b[2] > 0 && b[3] > 0) return s;
    const double t = hull_root(b), advance = t * (1 - left);
    left += advance;
    if (!(advance > std::numeric_limits<double>::epsilon() * left)) break;
    cut(b, t);
  }
  return left * s;
}

}  // namespace majorant
