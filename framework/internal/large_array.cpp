#include "majorant/framework/internal/large_array.h"

#include <sys/mman.h>

#include <limits>
#include <new>

namespace majorant {
namespace {

// The size of a large page on x86-64 and, with pages of 4 KiB, on ARM.
constexpr std::size_t kLargePage = std::size_t(1) << 21;

}  // namespace

LargeArray large_array(std::size_t size) {
  if (size > (std::numeric_limits<std::size_t>::max() - kLargePage) / sizeof(double))
    throw std::bad_alloc();
  const std::size_t bytes = size * sizeof(double);
  const bool is_large = bytes >= kLargePage;
  void* values =
      is_large ? std::aligned_alloc(kLargePage, (bytes + kLargePage - 1) / kLargePage * kLargePage)
               : std::malloc(bytes + 1);
  if (!values) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (is_large) ::madvise(values, bytes, MADV_HUGEPAGE);  // where it fails nothing is lost
#endif
  return LargeArray(static_cast<double*>(values));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
