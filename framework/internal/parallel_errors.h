// Exceptions out of OpenMP regions, where they would end the program:
//
//   const auto work = [](Index) {};
//   ParallelErrors errors;
//   #pragma omp parallel for
//   for (Index e = 0; e < 100000; ++e)
//     errors.guard([&] { stop.poll(); work(e); });   // stopped, or out of memory
//   errors.rethrow();
//
// Work after the first failure is skipped.
#pragma once

#include <atomic>
#include <exception>

namespace majorant {

class ParallelErrors {
 public:
  template <class Work>
  void guard(Work&& work) noexcept {
    if (failed_.load(std::memory_order_relaxed)) return;
    try {
      work();
    } catch (...) {
      if (!failed_.exchange(true)) error_ = std::current_exception();
    }
  }
  // The first failure of all threads. After the region.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::atomic<bool> failed_{false};
  std::exception_ptr error_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
