// What CHOLMOD and the libraries below it do to a process, held in bounds around calls of them:
//
//   const ThreadCount alone(1);         // around anything of CHOLMOD: its own teams of four
//                                       // slow it down on the matrices here
//   require_blas();                     // before a factorization
//   const KeptSignals signals;          // around METIS
//
// Not public: for .cpp files of solvers. ThreadCount (thread_count.h) and KeptSignals leave all as
// it was; what require_blas() sets stays.
#pragma once

#include <csignal>
#include <mutex>

namespace majorant {

// The first call of a process, whichever thread makes it, prepares OpenBLAS; others wait for it.
// From then on OpenBLAS uses one thread: it has one number for all threads of the process, and more
// only cost time on the blocks of these factors. And its buffer is mapped, to be kept: OpenBLAS
// maps 128 MiB at the first use and, where the address space is limited (ulimit -v), asks for it
// again for ever. This asks first. Throws std::bad_alloc; the next call tries again. (A second
// thread that factorizes at the same time has a second buffer, for which nobody asks first.)
void require_blas();

// METIS puts its own handlers of SIGTERM and SIGABRT in place, which jump out of it, and leaves
// those it found as one-shot handlers. A SIGTERM waits while this lives, and handlers are as before
// after it. Handlers belong to the process, so one of these lives at a time: the next waits. Other
// threads must block SIGTERM to be safe from METIS's handler.
class KeptSignals {
 public:
  KeptSignals();
  ~KeptSignals();
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  std::unique_lock<std::mutex> alone_;
  struct sigaction term_, abort_;
  sigset_t mask_;
};

}  // namespace majorant
