// What CHOLMOD and the libraries below it do to a process, held in bounds around calls of them:
//
//   const ThreadCount alone(1);         // around anything of CHOLMOD: its own teams of four
//                                       // slow it down on the matrices here
//   require_blas();                     // before a factorization
//   const MetisScope metis;             // around METIS
//
// Not public: for .cpp files of solvers. ThreadCount (thread_count.h) and MetisScope leave all as
// it was; what require_blas() sets stays.
#pragma once

#include <array>
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

// METIS puts its own handlers of SIGTERM and SIGABRT in place, which jump out of it, leaves those
// it found as one-shot handlers, and seeds rand(). A SIGTERM waits while this lives; handlers and
// the sequence of rand() are as before after it. All of that belongs to the process, so one of
// these lives at a time, the next waits: METIS would draw the other's numbers, and order
// differently. Other threads must block SIGTERM to be safe from METIS's handler, and leave rand()
// alone for orderings, and so the bits of results, to be the same every time.
class MetisScope {
 public:
  MetisScope();
  ~MetisScope();
  MetisScope(const MetisScope&) = delete;
  MetisScope& operator=(const MetisScope&) = delete;

 private:
  std::unique_lock<std::mutex> alone_;
  struct sigaction term_, abort_;
  sigset_t mask_;
  std::array<char, 128> random_;  // as large as the C library's own: the same numbers for a seed
  char* program_random_;
};

}  // namespace majorant
