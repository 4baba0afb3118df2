// Exact numbers for tests, which reveal rounding errors. They compile slowly, and are included only
// where needed.
#pragma once

// g++ 12 warns that boost's small integers are uninitialized.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <boost/multiprecision/cpp_int.hpp>

namespace majorant::test {

using Rational = boost::multiprecision::cpp_rational;

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
