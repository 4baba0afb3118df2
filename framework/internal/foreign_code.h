// What CHOLMOD and the libraries below it do to a process, held in bounds around calls of them:
//
//   const SingleThreaded guard;         // around anything of CHOLMOD
//   require_blas_buffer();              // before the first supernodal factorization
//   const KeptSignals signals;          // around METIS
//
// Not public: for .cpp files of solvers.
#pragma once

#include <csignal>

namespace majorant {

// Debian's CHOLMOD runs its own OpenMP teams of four, which slow it down on the matrices here; BLAS
// threads likewise.
class SingleThreaded {
 public:
  SingleThreaded();
  ~SingleThreaded();
  SingleThreaded(const SingleThreaded&) = delete;
  SingleThreaded& operator=(const SingleThreaded&) = delete;

 private:
  int levels_, blas_;
};

// OpenBLAS maps a buffer of 128 MiB at the first use in a thread and, where the address space is
// limited (ulimit -v), asks for it again for ever. Asks first, then has it mapped, to be kept.
// Throws std::bad_alloc.
void require_blas_buffer();

// METIS puts its own handlers of SIGTERM and SIGABRT in place, which jump out of it, and leaves
// those it found as one-shot handlers. A SIGTERM waits while this lives, and handlers are as before
// after it. Other threads must block SIGTERM to be safe from METIS's handler.
class KeptSignals {
 public:
  KeptSignals();
  ~KeptSignals();
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  struct sigaction term_, abort_;
  sigset_t mask_;
};

}  // namespace majorant
