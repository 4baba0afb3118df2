// Runs CHOLMOD and the solvers above it on one thread:
//
//   const OneBlasThread alone;   // until the end of this block
#pragma once

#include <dlfcn.h>

#include <mutex>

namespace majorant {

// CHOLMOD and its BLAS compute on one thread while an object of this class exists. CHOLMOD's loops
// request a number of OpenMP threads, which a default of one does not change; without active levels
// a loop runs on its caller alone. These levels belong to the calling thread. OpenBLAS's number of
// threads belongs to the process: the first object sets it to one, the last one restores it. Both
// functions are looked up at run time, since a BLAS need not have either.
class OneBlasThread {
 public:
  OneBlasThread() {
    if (const auto get = function<int (*)()>("omp_get_max_active_levels")) openmp_levels_ = get();
    set_openmp_levels(0);
    const std::lock_guard lock(mutex());
    if (alive()++ > 0) return;
    const auto get = function<int (*)()>("openblas_get_num_threads");
    if (get) before() = get();
    set(1);
  }
  ~OneBlasThread() {
    set_openmp_levels(openmp_levels_);
    const std::lock_guard lock(mutex());
    if (--alive() == 0) set(before());
  }
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  template <class Function>
  static Function function(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
  }
  static void set(int threads) {
    if (const auto call = function<void (*)(int)>("openblas_set_num_threads")) call(threads);
  }
  static void set_openmp_levels(int levels) {
    if (const auto call = function<void (*)(int)>("omp_set_max_active_levels")) call(levels);
  }
  static std::mutex& mutex() {
    static std::mutex m;
    return m;
  }
  static int& alive() {
    static int count = 0;
    return count;
  }
  static int& before() {
    static int threads = 1;
    return threads;
  }

  int openmp_levels_ = 1;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
