// Numbers that are written before they are read, as many as a factor has.
//
//   const LargeArray values = large_array(1000);   // throws std::bad_alloc
//   values[0] = 1;
//
// The array is in pages of 2 MiB, where the system has them for who asks: touching memory for the
// first time costs as much as a Cholesky factorization of a mesh writes into it, page by page.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace majorant {

struct FreedByMalloc {
  void operator()(double* values) const { std::free(values); }
};
using LargeArray = std::unique_ptr<double[], FreedByMalloc>;

LargeArray large_array(std::size_t size);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
