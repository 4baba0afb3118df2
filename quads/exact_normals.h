// The sign of the dot product of two normals, each of two vectors between points as the doubles
// they are: rounding cannot change it.
//
//   // Is the corner a of the quad a, b, c, d folded?
//   sign_of_normals({a, b}, {a, d}, {a, c}, {b, d}) <= 0
//
// Filtered: tens of nanoseconds unless the normals are close to orthogonal. Finite numbers only.
#pragma once

#include "majorant/framework/types.h"

namespace majorant {

// The vector from one point to another.
struct PointPair {
  const Vector3& from;
  const Vector3& to;
};

// The sign of ((a x b) . (c x d)): 1, 0 or -1.
int sign_of_normals(const PointPair& a, const PointPair& b, const PointPair& c, const PointPair& d);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
