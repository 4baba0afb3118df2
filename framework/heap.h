// Returns free memory of the process's heap to the system:
//
//   release_free_memory();
#pragma once

#include <malloc.h>

namespace majorant {

// The heap keeps free memory, to be fast, so a large allocation would come on top of it. Works with
// glibc; does nothing with other C libraries.
inline void release_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
