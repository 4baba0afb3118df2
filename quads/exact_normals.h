// The exact sign of the dot product of two normals. Each normal is the cross product of two vectors
// between points with the given doubles as coordinates.
//
//   const Vector3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
//   const bool is_folded = sign_of_normals({a, b}, {a, d}, {a, c}, {b, d}) <= 0;   // at a, of abcd
//
// A floating-point filter decides in tens of nanoseconds, unless the normals are nearly orthogonal.
// Finite numbers only.
#pragma once

#include "majorant/framework/types.h"

namespace majorant {

// The vector from one point to another.
struct PointPair {
  const Vector3& from;
  const Vector3& to;
};

// Returns the sign of ((a x b) . (c x d)): 1, 0 or -1.
int sign_of_normals(const PointPair& a, const PointPair& b, const PointPair& c, const PointPair& d);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
