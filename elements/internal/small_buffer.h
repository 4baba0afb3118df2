// Uninitialized scratch memory of a function, on the stack if it is small.
#pragma once

#include <cstddef>
#include <memory>

namespace majorant {

template <class T, std::size_t N>
class SmallBuffer {
 public:
  explicit SmallBuffer(std::size_t size) {
    if (size > N) heap_ = std::make_unique_for_overwrite<T[]>(size);
  }
  T* data() { return heap_ ? heap_.get() : local_; }

 private:
  T local_[N];
  std::unique_ptr<T[]> heap_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
