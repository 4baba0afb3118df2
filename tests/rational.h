// Exact numbers for tests: what rounding hides shows here. Slow to compile: included where needed.
#pragma once

// g++ 12 believes that boost's small integers are used uninitialized.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <boost/multiprecision/cpp_int.hpp>

namespace majorant::test {

using Rational = boost::multiprecision::cpp_rational;

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
