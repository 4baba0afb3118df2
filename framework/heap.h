// Memory that is free in the heap of the process.
//
//   release_free_memory();
#pragma once

#include <malloc.h>

namespace majorant {

// Gives it back to the system. The heap keeps it otherwise, to be fast, and a great demand comes on
// top of it. With glibc; with other libraries nothing happens.
inline void release_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
