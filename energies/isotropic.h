// Isotropic densities in the (alpha, beta) frame: no SVD, one formula for every curvature model.
//
// J = [[a, b], [c, d]] splits into a similarity alpha = (a+d, c-b)/2 and an anti-similarity
// beta = (a-d, b+c)/2; with A = |alpha|, B = |beta| the signed singular values are Sigma = A + B,
// sigma = A - B ([MC20] Eq. 7; method.md section 5). An isotropic density is h(Sigma, sigma), or
// k(x, y) of the invariants x = |alpha|^2, y = |beta|^2; det J = x - y, |J|^2 = 2 (x + y).
//
// A density is described at one Jacobian by its jet
//   dE   = ga alpha.d(alpha) + gb beta.d(beta)
//   d2E  = ga |d alpha|^2 + gb |d beta|^2
//          + caa (alpha.d alpha)^2 + 2 cab (alpha.d alpha)(beta.d beta) + cbb (beta.d beta)^2
// that is ga = k_A / A = 2 k_x, caa = 4 k_xx and so on. Curvature models only change coefficients.
#pragma once

#include <cmath>
#include <limits>

#include "majorant/energies/dual2.h"

namespace majorant {

enum class Domain { PositiveDeterminant, Everywhere };
// Convex: k(A, B) = h(A+B, A-B) is convex in (A, B) and increasing in B. A declared trait; it
// cannot be found out from code, and without it Curvature::Majorizer is refused.
enum class Convexity { Convex, Unknown };

// A below which quotients by A stop growing: its inverse cube is finite.
inline constexpr double kSmallestA = 1e-75;

template <class T>
struct IsotropicJet {
  T f, ga, gb, caa, cab, cbb;
};

// The curvature at one point, as coefficients of the same five squares:
//   pa |d alpha|^2 + pb |d beta|^2 + qa (alpha.d alpha)^2 + 2 qab (..)(..) + qb (beta.d beta)^2.
template <class T>
struct CurvatureCoefficients {
  T pa, pb, qa, qab, qb;
};

// Scalar counterparts of the batch functions, so that one code serves both.
namespace scalar_math {
inline double select(bool c, double a, double b) { return c ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }
inline double sqrt(double a) { return std::sqrt(a); }
}  // namespace scalar_math

template <class T>
CurvatureCoefficients<T> exact_coefficients(const IsotropicJet<T>& j) {
  return {j.ga, j.gb, j.caa, j.cab, j.cbb};
}

// Convex k: its Hessian's 2x2 radial block is PSD and gb >= 0; only alpha's perpendicular direction
// (coefficient ga) can be negative. Projection and composite majorizer coincide.
template <class T>
CurvatureCoefficients<T> convex_projection(const IsotropicJet<T>& j, const T& x) {
  using namespace scalar_math;
  const T negative = min(j.ga, T(0.0));
  return {j.ga - negative, j.gb, j.caa + negative / max(x, T(kSmallestA * kSmallestA)), j.cab,
          j.cbb};
}

// Eigenvalues of the 2x2 radial block and of both perpendicular directions clamped at 0.
template <class T>
CurvatureCoefficients<T> general_projection(const IsotropicJet<T>& j, const T& x, const T& y) {
  using namespace scalar_math;
  const T zero(0.0), tiny(std::numeric_limits<double>::min());
  const T ax = max(x, tiny), by = max(y, tiny);
  const T a = sqrt(ax), b = sqrt(by);
  const T p = j.ga + j.caa * x, r = j.gb + j.cbb * y, q = j.cab * (a * b);
  const T mean = T(0.5) * (p + r), half = T(0.5) * (p - r);
  const T radius = sqrt(half * half + q * q);
  const T low = mean - radius, high = mean + radius;
  const T low_kept = max(low, zero);
  const T ratio =
      select(radius > zero, (max(high, zero) - low_kept) / max(radius + radius, tiny), zero);
  const T pp = low_kept + ratio * (p - low), rr = low_kept + ratio * (r - low), qq = ratio * q;
  CurvatureCoefficients<T> c;
  c.pa = max(j.ga, zero);
  c.pb = max(j.gb, zero);
  c.qa = (pp - c.pa) / ax;
  c.qab = qq / (a * b);
  c.qb = select(y > tiny, (rr - c.pb) / by, zero);
  return c;
}

// [MC20] App. A, Eq. A.1 (H^t of Eq. 11, sign corrected): 2x2 block as it is, perpendicular
// coefficients ((h_S)_+ + (h_s)_+)/A and ((h_S)_+ - (h_s)_-)/B. The latter grows without bound as
// B -> 0 (method.md N2): B is kept above 1e-7 A.
template <class T>
CurvatureCoefficients<T> paper_majorizer(const IsotropicJet<T>& j, const T& x, const T& y) {
  using namespace scalar_math;
  const T zero(0.0), guard = T(1e-7) * sqrt(x);
  const T a = sqrt(x), b = max(sqrt(y), guard);
  const T kA = j.ga * a, kB = j.gb * b;
  const T hS = T(0.5) * (kA + kB), hs = T(0.5) * (kA - kB);
  CurvatureCoefficients<T> c;
  c.pa = (max(hS, zero) + max(hs, zero)) / a;
  c.pb = (max(hS, zero) - min(hs, zero)) / b;
  c.qa = j.caa + (j.ga - c.pa) / x;
  c.qab = j.cab;
  // Radial entry k_BB; where B is guarded beta carries no direction.
  c.qb = select(y > guard * guard, j.cbb + (j.gb - c.pb) / max(y, guard * guard), zero);
  return c;
}

}  // namespace majorant
