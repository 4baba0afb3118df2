// The unit of speed: 1 fe is one factorization and solve by CHOLMOD, with the cheapest of AMD and
// METIS, supernodal and simplicial. The settings are fixed, independently of the library's.
//
//   const UnitFe unit = measure_unit_fe(problem.pattern(), hessian, gradient, 5);
//   print(seconds / unit.seconds);   // in fe
//
// The settings are CHOLMOD's defaults except for quick_return_if_not_posdef and final_ll. The graph
// of nodes is ordered, with one thread of OpenMP and of OpenBLAS.
#pragma once

#include <array>
#include <ctime>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// Returns CPU seconds of this process, which depend little on other processes.
inline double cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct UnitFe {
  struct Variant {
    const char* name;
    double seconds;  // median CPU seconds of a factorization and a solve; inf: left out
  };
  std::array<Variant, 4> variants;
  double seconds = 0;  // of the cheapest variant
};

// values: of a positive definite matrix of this pattern. rhs: a right-hand side. repeats >= 1.
// Throws std::runtime_error if CHOLMOD fails.
UnitFe measure_unit_fe(const SparsePattern& pattern, const Vec& values, const Vec& rhs,
                       int repeats);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
