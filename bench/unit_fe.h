// The unit of speed: 1 fe is one factorization and solve by CHOLMOD, the cheapest of AMD and METIS,
// supernodal and simplicial, with settings that never change - whatever the library does by then.
//
//   const UnitFe unit = measure_unit_fe(problem.pattern(), hessian, gradient, 5);
//   print(seconds / unit.seconds);   // in fe
//
// The settings are those of revision 5be666c: CHOLMOD's defaults but for quick_return_if_not_posdef
// and final_ll; the graph of nodes ordered, with one thread of OpenMP and of OpenBLAS.
#pragma once

#include <array>
#include <ctime>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// Seconds of the processor in this process: what others do at the same time hardly counts.
inline double cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct UnitFe {
  struct Variant {
    const char* name;
    double seconds;  // of the processor; a factorization and a solve, median; inf: left out
  };
  std::array<Variant, 4> variants;
  double seconds = 0;  // of the cheapest
};

// values, rhs: of a positive definite matrix of that pattern, and a right-hand side. repeats >= 1.
// Throws std::runtime_error when CHOLMOD fails.
UnitFe measure_unit_fe(const SparsePattern& pattern, const Vec& values, const Vec& rhs,
                       int repeats);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
