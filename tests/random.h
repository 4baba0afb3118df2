// Reproducible random numbers of tests.
#pragma once

#include <random>

#include "majorant/framework/types.h"

namespace majorant::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low = -1, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vec vector(Index size, double low = -1, double high = 1) {
    Vec v(size);
    for (double& x : v) x = uniform(low, high);
    return v;
  }
  // Returns barycentric coordinates inside the triangle, not on its boundary.
  Vector3 barycentric() {
    Vector3 b(uniform(0.01, 1), uniform(0.01, 1), uniform(0.01, 1));
    return b / b.sum();
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
