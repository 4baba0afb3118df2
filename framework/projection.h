// The point Z y + c of an elimination that is closest to another one, in a norm d^T K d.
//
//     const Vec y = projection(z, x, Identity(), diagonal);   // as Elimination::project() does
//
// Conjugate gradients on Z^T K Z y = Z^T K (x - c): every y on the way satisfies the constraints.
#pragma once

#include <utility>

#include "majorant/framework/elimination.h"

namespace majorant {

// The tolerance of constraints, relative to the coordinates: 45 unit roundoffs.
inline constexpr double kSatisfied = 1e-14;

struct ProjectionRules {
  // The squared residual, relative to the first one, at which the projection ends: 1e-10 of the
  // distance, the precision of a projection in doubles.
  double enough = 1e-20;
  // The maximum number of steps, for systems that do not converge.
  int most_steps = 1000;
};

struct Identity {
  const Vec& operator*(const Vec& d) const { return d; }
};

// Returns the y of the projection of x; reduce(x) if x satisfies the constraints to kSatisfied.
// metric: K times full_size() numbers, symmetric and positive definite on the columns of Z.
// diagonal: positive, near that of Z^T K Z.
template <class K>
Vec projection(const Elimination& z, VecIn x, const K& metric, const Vec& diagonal,
               const ProjectionRules& rules = {}) {
  double residual = 0;
  Vec y = z.reduce(x, &residual);
  if (y.size() == 0 || residual <= kSatisfied * x.cwiseAbs().maxCoeff()) return y;
  Vec image, gradient, product;
  z.expand(y, image);
  z.restrict_gradient(metric * Vec(x - image), gradient);
  Vec step = gradient.cwiseQuotient(diagonal), direction = step;
  double slope = gradient.dot(step);
  const double enough = rules.enough * slope;
  for (int k = 0; k < rules.most_steps && slope > enough; ++k) {
    z.expand_direction(direction, image);
    const Vec& force = metric * image;
    const double length = slope / image.dot(force);
    y += length * direction;
    z.restrict_gradient(force, product);
    gradient -= length * product;
    step = gradient.cwiseQuotient(diagonal);
    const double before = std::exchange(slope, gradient.dot(step));
    direction = step + (slope / before) * direction;
  }
  return y;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
