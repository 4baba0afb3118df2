#include "apps/process.h"

#include <dlfcn.h>
#include <malloc.h>
#include <poll.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <optional>

#include "apps/streams.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/files/reading_limit.h"
#include "majorant/io/temporary_file.h"

namespace majorant::app {
namespace {

constexpr int kEndingSignals[] = {SIGINT, SIGTERM, SIGHUP};

// Signals within this time after the first one count as the same request. `timeout` signals the
// child and then its group; a lost terminal signals the group, and the shell then each job.
constexpr std::int64_t kOneWish = 500'000'000;  // nanoseconds

std::atomic<bool> interrupted{false}, stops_runs{false}, answers{false};
std::atomic<std::int64_t> first_signal{0};
pthread_t main_thread;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
}

sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : kEndingSignals) sigaddset(&set, number);
  return set;
}

void end_by(int number) {
  remove_temporary_files();
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  sigaction(number, &standard, nullptr);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, number);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  raise(number);
}

// Writes a line on stderr unless that would block. Safe in signal handlers.
void answer_signal() {
  constexpr char kLine[] = "\r\x1b[Kmajorant: stopping; a second signal ends at once\n";
  constexpr std::size_t kClearing = 4;  // bytes that clear the live line of a terminal
  pollfd stream{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&stream, 1, 0) != 1 || (stream.revents & POLLOUT) == 0) return;
  const std::size_t from = ::isatty(STDERR_FILENO) == 1 ? 0 : kClearing;
  [[maybe_unused]] const ssize_t written =
      ::write(STDERR_FILENO, kLine + from, sizeof kLine - 1 - from);
}

// Runs on the main thread, which creates all temporary files, so that none appears while they are
// removed.
extern "C" void handle_ending_signal(int number) {
  const int saved = errno;
  if (!pthread_equal(pthread_self(), main_thread)) {
    pthread_kill(main_thread, number);
  } else if (!stops_runs.load()) {
    end_by(number);
  } else if (!interrupted.load()) {
    first_signal.store(now());
    interrupted.store(true);
    if (answers.load()) answer_signal();
  } else if (now() - first_signal.load() > kOneWish) {
    end_by(number);
  }
  errno = saved;
}

void handle_signals() {
  main_thread = pthread_self();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = handle_ending_signal;
  action.sa_mask = ending_signals();
  action.sa_flags = SA_RESTART;
  for (const int number : kEndingSignals) {
    struct sigaction before {};
    // A signal that is ignored at the start stays ignored: nohup, background jobs of scripts.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
}

// OpenBLAS reads the variable when it is loaded. majorant-mpi links it, so it is loaded before
// main().
void require_one_blas_thread() {
  ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
  const auto set =
      reinterpret_cast<void (*)(int)>(::dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (set) set(1);
}

// Returns whether this much address space is left.
bool can_map(std::size_t bytes) {
  void* place = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) return false;
  ::munmap(place, bytes);
  return true;
}

std::size_t stack_bytes() {
  pthread_attr_t attributes;
  std::size_t size = 0;
  if (pthread_getattr_default_np(&attributes) != 0) return size;
  pthread_attr_getstacksize(&attributes, &size);
  pthread_attr_destroy(&attributes);
  return size;
}

}  // namespace

// Address space reserved for the heap, which uses no memory until it is touched. The reservation is
// at most a fixed part of the free memory, since ScopedMemoryLimit counts it.
constexpr std::size_t kReservedHeap = std::size_t{1} << 30;  // bytes
constexpr std::size_t kReservedPart = 4;
// Larger blocks are mapped one by one and returned to the system when freed. This is glibc's
// largest threshold.
constexpr int kLargestInHeap = 32 << 20;  // bytes

// Keeps freed memory for the next step. Otherwise the system would unmap, clear and map it again,
// which costs more than most steps. The heap also asks for large pages, which reduce page faults.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, kLargestInHeap);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  rlimit space{}, data{};
  ::getrlimit(RLIMIT_AS, &space);
  ::getrlimit(RLIMIT_DATA, &data);
  if (space.rlim_cur != RLIM_INFINITY || data.rlim_cur != RLIM_INFINITY) return;
  const std::size_t free = reading_memory().value_or(kReservedPart * kReservedHeap);
  const std::size_t reserved = std::min(kReservedHeap, free / kReservedPart);
  if (reserved < 2 * kLargestInHeap) return;
  constexpr std::uintptr_t kLargePage = 1 << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(::sbrk(0)) / kLargePage * kLargePage;
  mallopt(M_TOP_PAD, static_cast<int>(reserved));
  void* volatile first = std::malloc(kLargestInHeap / 2);  // volatile, or compilers remove the call
  std::free(first);
  mallopt(M_TOP_PAD, kLargestInHeap);
#ifdef MADV_HUGEPAGE
  // From the first whole page on: small runs stay within the first megabytes.
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0)) / kLargePage * kLargePage;
  if (begin + kLargePage < end)
    ::madvise(reinterpret_cast<void*>(begin + kLargePage), end - begin - kLargePage, MADV_HUGEPAGE);
#endif
}

void prepare_process() {
  keep_memory();
  open_standard_streams();
  require_one_blas_thread();
  handle_signals();
}

const std::atomic<bool>* interruption_flag() {
  stops_runs.store(true);
  return &interrupted;
}

void acknowledge_signals(bool answered) { answers.store(answered); }

// RLIMIT_DATA counts writable mappings, touched or not.
ScopedMemoryLimit::ScopedMemoryLimit() {
  ::getrlimit(RLIMIT_DATA, &before_);
  std::size_t total = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;  // pages
  std::ifstream("/proc/self/statm") >> total >> resident >> shared >> text >> library >> data;
  const std::optional<std::size_t> free = reading_memory();
  if (!free || data == 0) return;
  rlimit limit = before_;
  // Mapped bytes at the top of the heap that are not in use.
  const std::size_t unused = ::mallinfo2().keepcost;
  const rlim_t least =
      data * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + *free - std::min(*free, unused);
  limit.rlim_cur = std::min(before_.rlim_cur, least);
  ::setrlimit(RLIMIT_DATA, &limit);
}

ScopedMemoryLimit::~ScopedMemoryLimit() { ::setrlimit(RLIMIT_DATA, &before_); }

int usable_threads(int requested) {
  // glibc gives each allocating thread an arena of 64 MiB, aligned to its size.
  constexpr std::size_t kArena = std::size_t{128} << 20;
  // Address space left to the run itself.
  constexpr std::size_t kRun = std::size_t{256} << 20;
  const std::size_t per_thread = stack_bytes() + kArena;
  int count = requested > 0 ? requested : ThreadCount::current();
  while (count > 1 && !can_map(kRun + static_cast<std::size_t>(count - 1) * per_thread)) --count;
  return count;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
