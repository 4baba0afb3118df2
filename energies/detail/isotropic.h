// Isotropic planar densities in the (alpha, beta) frame, with one formula for every curvature model
// and without an SVD.
//
// J = [[a, b], [c, d]] splits into a similarity alpha = (a+d, c-b)/2 and an anti-similarity
// beta = (a-d, b+c)/2; with A = |alpha|, B = |beta| the signed singular values are Sigma = A + B,
// sigma = A - B ([MC20] Eq. 7; method.md section 5). An isotropic density is h(Sigma, sigma), or
// k(x, y) of the invariants x = |alpha|^2, y = |beta|^2; det J = x - y, |J|^2 = 2 (x + y).
//
// A density is described at one Jacobian by its jet
//     dE   = ga alpha.d(alpha) + gb beta.d(beta)
//     d2E  = ga |d alpha|^2 + gb |d beta|^2
//            + caa (alpha.d alpha)^2 + 2 cab (alpha.d alpha)(beta.d beta) + cbb (beta.d beta)^2
// that is ga = k_A / A = 2 k_x, caa = 4 k_xx and so on. Curvature models only change coefficients.
#pragma once

#include <cmath>
#include <limits>

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/dual2.h"

namespace majorant {

// Lower bound on A in quotients by A; its inverse cube is finite.
inline constexpr double kSmallestA = 1e-75;

// Lower bound on B / A in curvatures that divide by B: ten times the root of the unit roundoff.
// Chosen, not tuned.
inline constexpr double kLeastRatio = 1e-7;

// Within this distance of 1, a quotient by a singular value minus 1 is replaced by its limit.
// Rounding leaves 1e-10 of the quotient there, and the error of the limit is about 1e-6.
inline constexpr double kNearOne = 1e-6;

template <class T>
struct IsotropicJet {
  T f, ga, gb, caa, cab, cbb;
};

// The curvature at one point, as coefficients of the same five squares:
//     pa |d alpha|^2 + pb |d beta|^2 + qa (alpha.d alpha)^2 + 2 qab (..)(..) + qb (beta.d beta)^2.
template <class T>
struct CurvatureCoefficients {
  T pa, pb, qa, qab, qb;
};

// Scalar counterparts of the batch functions, for code that serves both.
namespace scalar_math {
inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }
inline double sqrt(double a) { return std::sqrt(a); }
inline double abs(double a) { return std::fabs(a); }
}  // namespace scalar_math

template <class T>
CurvatureCoefficients<T> exact_coefficients(const IsotropicJet<T>& j) {
  return {j.ga, j.gb, j.caa, j.cab, j.cbb};
}

// Returns the projection for convex k: its Hessian's 2x2 radial block is PSD and gb >= 0, so only
// alpha's perpendicular direction (coefficient ga) can be negative. Projected and Majorizer
// coincide. projection_weight: the fraction of the negative part that is removed.
template <class T>
CurvatureCoefficients<T> convex_projection(const IsotropicJet<T>& j, const T& x,
                                           const T& projection_weight) {
  using namespace scalar_math;
  const T away = projection_weight * min(j.ga, T(0.0));
  return {j.ga - away, j.gb, j.caa + away / max(x, T(kSmallestA * kSmallestA)), j.cab, j.cbb};
}

// Returns the projection for any k: eigenvalues of the 2x2 radial block and of both perpendicular
// directions are clamped at 0, or the fraction `projection_weight` of the negative ones is removed.
template <class T>
CurvatureCoefficients<T> general_projection(const IsotropicJet<T>& j, const T& x, const T& y,
                                            const T& projection_weight) {
  using namespace scalar_math;
  const T kept = T(1.0) - projection_weight;
  const auto clamped = [&kept](const T& value) { return max(value, kept * value); };
  const T zero(0.0), tiny(std::numeric_limits<double>::min());
  const T ax = max(x, tiny), by = max(y, tiny);
  const T a = sqrt(ax), b = sqrt(by);
  const T p = j.ga + j.caa * x, r = j.gb + j.cbb * y, q = j.cab * (a * b);
  const T mean = T(0.5) * (p + r), half = T(0.5) * (p - r);
  const T radius = sqrt(half * half + q * q);
  const T low = mean - radius, high = mean + radius;
  const T low_kept = clamped(low);
  const T ratio =
      select(radius > zero, (clamped(high) - low_kept) / max(radius + radius, tiny), zero);
  const T pp = low_kept + ratio * (p - low), rr = low_kept + ratio * (r - low), qq = ratio * q;
  CurvatureCoefficients<T> c;
  c.pa = clamped(j.ga);
  c.pb = clamped(j.gb);
  c.qa = (pp - c.pa) / ax;
  c.qab = qq / (a * b);
  c.qb = select(y > tiny, (rr - c.pb) / by, zero);
  return c;
}

// Returns the majorizer of [MC20] App. A, Eq. A.1 (H^t of Eq. 11, sign corrected): the 2x2 block is
// unchanged, the perpendicular coefficients are ((h_S)_+ + (h_s)_+)/A and ((h_S)_+ - (h_s)_-)/B.
// The latter grows without bound as B -> 0 (method.md N2), so B is kept above kLeastRatio A.
template <class T>
CurvatureCoefficients<T> composite_majorizer(const IsotropicJet<T>& j, const T& x, const T& y) {
  using namespace scalar_math;
  const T zero(0.0), sx = max(x, T(kSmallestA * kSmallestA)), guard = T(kLeastRatio) * sqrt(sx);
  const T a = sqrt(sx), b = max(sqrt(y), guard);
  const T kA = j.ga * a, kB = j.gb * b;
  const T hS = T(0.5) * (kA + kB), hs = T(0.5) * (kA - kB);
  CurvatureCoefficients<T> c;
  c.pa = (max(hS, zero) + max(hs, zero)) / a;
  c.pb = (max(hS, zero) - min(hs, zero)) / b;
  c.qa = j.caa + (j.ga - c.pa) / sx;
  c.qab = j.cab;
  // The radial entry is k_BB. If B is at its lower bound, beta has no direction.
  c.qb = select(y > guard * guard, j.cbb + (j.gb - c.pb) / max(y, guard * guard), zero);
  return c;
}

// Writes the packed curvature in z = (alpha0, alpha1, beta0, beta1).
template <class T>
void write_curvature(const CurvatureCoefficients<T>& c, const T (&z)[4], PointModel<T, 4>& m) {
  const T qa0 = c.qa * z[0], qa1 = c.qa * z[1], qb0 = c.qb * z[2], qb1 = c.qb * z[3];
  const T qc0 = c.qab * z[0], qc1 = c.qab * z[1];
  m.k[0] = c.pa + qa0 * z[0];
  m.k[1] = qa1 * z[0];
  m.k[2] = c.pa + qa1 * z[1];
  m.k[3] = qc0 * z[2];
  m.k[4] = qc1 * z[2];
  m.k[5] = c.pb + qb0 * z[2];
  m.k[6] = qc0 * z[3];
  m.k[7] = qc1 * z[3];
  m.k[8] = qb1 * z[2];
  m.k[9] = c.pb + qb1 * z[3];
}

// Writes SLIM's proxy [RPPSH17] Eq. 12: 2 tr(dJ^T W^2 dJ), W^2 = U diag(w(Sigma), w(sigma)) U^T
// with w(t) = p'(t) / (2 (t - 1)), at t = 1 its limit p''(1) / 2. U rotates by half the angle of
// alpha beta (as complex numbers), so no SVD is needed:
//     4 m (|d alpha|^2 + |d beta|^2) + 8 d Re(conj(u) d alpha d beta),
//     u = alpha beta / |alpha beta|,
// where m and d are half the sum and half the difference of the weights. Within kNearOne of 1 the
// limit is used.
template <class T>
void write_reweighted(const IsotropicJet<T>& j, const T& x, const T& y, const T (&z)[4],
                      PointModel<T, 4>& m) {
  using namespace scalar_math;
  const T zero(0.0), tiny(kSmallestA), near(kNearOne);
  const T a = sqrt(x), b = sqrt(y), kA = j.ga * a, kB = j.gb * b;
  const T kAA = j.ga + j.caa * x, kBB = j.gb + j.cbb * y, kAB = j.cab * a * b;
  const auto weight = [&](const T& excess, const T& slope, const T& curvature) {
    const T safe = select(abs(excess) > near, excess, T(1.0));
    return max(T(0.5) * select(abs(excess) > near, slope / safe, curvature), zero);
  };
  const T half(0.5), quarter(0.25);
  const T w0 = weight(a + b - T(1.0), half * (kA + kB), quarter * (kAA + kAB + kAB + kBB));
  const T w1 = weight(a - b - T(1.0), half * (kA - kB), quarter * (kAA - kAB - kAB + kBB));
  const T mean = T(2.0) * (w0 + w1), difference = T(2.0) * (w0 - w1) / max(a * b, tiny);
  const T u0 = difference * (z[0] * z[2] - z[1] * z[3]);
  const T u1 = difference * (z[0] * z[3] + z[1] * z[2]);
  m.k[0] = m.k[2] = m.k[5] = m.k[9] = mean;
  m.k[1] = m.k[8] = zero;
  m.k[3] = u0;   // d alpha0 d beta0
  m.k[4] = u1;   // d alpha1 d beta0
  m.k[6] = u1;   // d alpha0 d beta1
  m.k[7] = -u0;  // d alpha1 d beta1
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
