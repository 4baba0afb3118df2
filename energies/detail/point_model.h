// What a density says about one Jacobian. No includes: kernels compiled for special instruction
// sets see this file.
#pragma once

namespace majorant {

// Value, gradient and packed lower triangle of the curvature by N coordinates of J.
template <class T, int N>
struct PointModel {
  T f;
  T g[N];
  T k[N * (N + 1) / 2];  // entry (i, j), i >= j, at i (i + 1) / 2 + j
};

}  // namespace majorant
