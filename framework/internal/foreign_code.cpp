#include "majorant/framework/internal/foreign_code.h"

#include <pthread.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

extern "C" void openblas_set_num_threads(int);
extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace majorant {
namespace {

// BUFFER_SIZE of OpenBLAS for x86-64, the largest of its targets that are in use.
constexpr std::size_t kBlasBuffer = std::size_t{128} << 20;

std::mutex metis;

bool prepare_blas() {
  void* place =
      ::mmap(nullptr, kBlasBuffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  ::munmap(place, kBlasBuffer);
  openblas_set_num_threads(1);
  const int size = 1;
  int info = 0;
  double matrix = 1;
  dpotrf_("L", &size, &matrix, &size, &info);
  return info == 0;
}

}  // namespace

// A static of a function: once, and under a lock.
void require_blas() { [[maybe_unused]] static const bool ready = prepare_blas(); }

MetisScope::MetisScope() : alone_(metis) {
  sigaction(SIGTERM, nullptr, &term_);
  sigaction(SIGABRT, nullptr, &abort_);
  sigset_t term;
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &term, &mask_);
  program_random_ = ::initstate(1, random_.data(), random_.size());
}

MetisScope::~MetisScope() {
  ::setstate(program_random_);
  sigaction(SIGTERM, &term_, nullptr);
  sigaction(SIGABRT, &abort_, nullptr);
  pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
}

}  // namespace majorant
