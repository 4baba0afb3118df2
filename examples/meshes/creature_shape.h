// The shape of the demo creature: an implicit surface { p : field(p) = 0 } of this project's own.
//
//   const bool is_inside = creature::field({0.0, 0.5, 0.0}) < 0.0;
//
// A sitting long-eared animal: one ear up, one flopped, folds in the ears, on the belly and at the
// nape, big eyes, a snout, a raised paw and a curled tail. It is a union of ellipsoids and tapered
// capsules, each joined to the rest with its own rounding. Ears, limbs and tail are long and thin:
// a flat map has to squeeze or stretch them, which makes the animal a test of a parametrization.
//
// x points to its left, y up, z forward; it is 2.6 high. Distances are first order: right in sign,
// and right in size near the surface.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace creature {

using Vec = Eigen::Vector3d;

// Union of two distances, rounded off where they differ by less than `width`.
inline double blend(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * h * h;
}

inline double carve(double a, double hole, double width) { return -blend(-a, hole, width); }

// First-order distance to an ellipsoid. `long_axis` is the direction of radii.y(), `front` the one
// of radii.z() as far as it can be orthogonal.
inline double ellipsoid(const Vec& p, const Vec& centre, const Vec& radii,
                        const Vec& long_axis = Vec::UnitY(), const Vec& front = Vec::UnitZ()) {
  Eigen::Matrix3d axes;
  axes.col(1) = long_axis.normalized();
  axes.col(0) = axes.col(1).cross(front).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const Vec scaled = (axes.transpose() * (p - centre)).cwiseQuotient(radii);
  const double k = scaled.norm();
  const double slope = scaled.cwiseQuotient(radii).norm();
  return slope > 0.0 ? k * (k - 1.0) / slope : -radii.minCoeff();
}

// Distance to a capsule whose radius goes linearly from ra at a to rb at b.
inline double limb(const Vec& p, const Vec& a, const Vec& b, double ra, double rb) {
  const Vec axis = b - a;
  const double t = std::clamp(axis.dot(p - a) / axis.squaredNorm(), 0.0, 1.0);
  return (p - a - t * axis).norm() - (ra + t * (rb - ra));
}

inline double bump(const Vec& p, const Vec& centre, double radius) {
  return std::exp(-(p - centre).squaredNorm() / (radius * radius));
}

inline double torso(const Vec& p) {
  double d = ellipsoid(p, {0, 0.54, 0}, {0.46, 0.56, 0.42});
  d = blend(d, ellipsoid(p, {0, 0.42, 0.12}, {0.48, 0.38, 0.42}), 0.15);
  // Rolls of skin across the belly, and one at the nape.
  const double level = p.y() - 0.15 * p.x() * p.x();
  d -= 0.050 * std::cos(17.0 * (level - 0.40)) * bump(p, {0, 0.48, 0.58}, 0.40);
  return blend(d, limb(p, {-0.20, 0.98, -0.20}, {0.20, 0.98, -0.20}, 0.15, 0.15), 0.10);
}

inline double head(const Vec& p) {
  double d = ellipsoid(p, {0, 1.42, 0.06}, {0.48, 0.41, 0.43});
  d = blend(d, ellipsoid(p, {0, 1.22, 0.22}, {0.47, 0.21, 0.30}), 0.10);             // cheeks
  d = blend(d, ellipsoid(p, {0, 1.27, 0.52}, {0.21, 0.15, 0.26}), 0.08);             // snout
  d = carve(d, limb(p, {-0.22, 1.17, 0.60}, {0.0, 1.12, 0.80}, 0.035, 0.04), 0.04);  // mouth
  d = carve(d, limb(p, {0.24, 1.19, 0.58}, {0.0, 1.12, 0.80}, 0.035, 0.04), 0.04);
  d = blend(d, ellipsoid(p, {0, 1.37, 0.77}, {0.13, 0.10, 0.10}), 0.02);  // nose
  for (const double side : {-1.0, 1.0}) {
    d = blend(d, ellipsoid(p, {side * 0.20, 1.55, 0.42}, {0.16, 0.18, 0.15}), 0.02);  // eyes
  }
  return d;
}

inline double ears(const Vec& p) {
  // Left: up, leaning outward, with a deep fold inside.
  const Vec up(0.34, 1.0, -0.14);
  const Vec ahead(0.20, 0.0, 1.0);
  double left = ellipsoid(p, {0.42, 2.10, -0.06}, {0.22, 0.56, 0.13}, up, ahead);
  left = carve(left, ellipsoid(p, {0.45, 2.11, 0.09}, {0.135, 0.44, 0.17}, up, ahead), 0.05);
  // Right: rises from the head, then flops outward.
  const Vec rise(-0.55, 1.0, -0.1);
  const Vec flop(-0.55, -1.0, 0.25);
  const Vec outside(-0.6, 0.5, 1.0);
  double right = ellipsoid(p, {-0.42, 1.84, -0.02}, {0.18, 0.32, 0.12}, rise, ahead);
  right = blend(right, ellipsoid(p, {-0.79, 1.74, 0.06}, {0.22, 0.46, 0.12}, flop, outside), 0.14);
  right = carve(right, ellipsoid(p, {-0.84, 1.70, 0.19}, {0.13, 0.36, 0.15}, flop, outside), 0.05);
  return std::min(left, right);
}

inline double limbs(const Vec& p) {
  // The left paw waves, the right one rests on the belly.
  double d = limb(p, {0.34, 0.84, 0.06}, {0.70, 0.76, 0.20}, 0.14, 0.11);
  d = blend(d, limb(p, {0.70, 0.76, 0.20}, {0.92, 1.10, 0.36}, 0.11, 0.085), 0.06);
  d = blend(d, ellipsoid(p, {0.95, 1.20, 0.40}, {0.16, 0.16, 0.12}), 0.05);
  d = blend(d, limb(p, {0.95, 1.20, 0.40}, {0.78, 1.30, 0.44}, 0.07, 0.06), 0.04);  // thumb
  double right = limb(p, {-0.36, 0.84, 0.06}, {-0.62, 0.58, 0.22}, 0.14, 0.11);
  right = blend(right, limb(p, {-0.62, 0.58, 0.22}, {-0.36, 0.52, 0.58}, 0.11, 0.09), 0.06);
  right = blend(right, ellipsoid(p, {-0.30, 0.54, 0.62}, {0.15, 0.14, 0.13}), 0.05);
  d = std::min(d, right);
  for (const double side : {-1.0, 1.0}) {
    const Vec out(side * 0.45, 0.0, 1.0);
    const Vec heel(side * 0.40, 0.12, 0.30);
    double leg = ellipsoid(p, {side * 0.36, 0.24, 0.08}, {0.22, 0.27, 0.34});
    leg = blend(leg, limb(p, heel, heel + 0.46 * out, 0.13, 0.12), 0.06);
    leg = blend(leg, ellipsoid(p, heel + 0.48 * out + Vec(0, 0.10, 0), {0.16, 0.24, 0.12}), 0.05);
    d = blend(d, leg, 0.05);
  }
  return d;
}

// A spiral behind the back; t = 0 inside the body, t = 1 at the tip.
inline Vec tail_curve(double t) {
  const double angle = 5.4 * t;
  const double radius = 0.46 * (1.0 - 0.62 * t);
  return {-0.36 - radius * std::sin(angle) - 0.10 * t, 0.62 - radius * std::cos(angle),
          -0.20 - 0.60 * std::min(1.0, 2.6 * t)};
}

inline double tail(const Vec& p) {
  constexpr int parts = 12;
  double d = std::numeric_limits<double>::max();
  for (int i = 0; i < parts; ++i) {
    const double t = static_cast<double>(i) / parts;
    const double next = static_cast<double>(i + 1) / parts;
    d = blend(d, limb(p, tail_curve(t), tail_curve(next), 0.17 - 0.10 * t, 0.17 - 0.10 * next),
              0.02);
  }
  return d;
}

// Negative inside the animal.
inline double field(const Vec& p) {
  double d = blend(torso(p), head(p), 0.12);
  d = blend(d, ears(p), 0.10);
  d = blend(d, limbs(p), 0.06);
  return blend(d, tail(p), 0.10);
}

// Points inside the parts of the animal. The mesher starts from surface points around them,
// otherwise a coarse mesh misses an ear.
inline const std::array<Vec, 9> landmarks = {
    Vec(0.0, 0.5, 0.0),    Vec(0.0, 1.4, 0.0),     Vec(0.43, 2.10, -0.13),
    Vec(-0.76, 1.71, 0.0), Vec(0.95, 1.20, 0.40),  Vec(-0.30, 0.54, 0.62),
    Vec(0.60, 0.22, 0.76), Vec(-0.60, 0.22, 0.76), tail_curve(0.8)};

// The cut visits these points in this order: tip of the tail, spine, back of the head, back and tip
// of the left ear, back and tip of the right ear.
inline const std::array<Vec, 7> cut_points = {
    tail_curve(1.1),        Vec(0.0, 0.70, -0.45),   Vec(0.0, 1.50, -0.40), Vec(0.42, 2.10, -0.25),
    Vec(0.62, 2.66, -0.14), Vec(-0.72, 1.68, -0.05), Vec(-1.02, 1.32, 0.16)};

}  // namespace creature

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
