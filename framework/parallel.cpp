#include "majorant/framework/parallel.h"

#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/processors.h"
#include "majorant/framework/side_task.h"

namespace majorant {

// Guarded by the pool's mutex, except for members that only the task's own thread uses while it
// runs.
struct SideTask::State {
  enum class Stage { Waiting, Running, Done };

  std::function<void()> work;
  int threads;  // that the owner may use, the calling thread included
  const void* pool = nullptr;
  Stage stage = Stage::Waiting;
  std::exception_ptr error = nullptr;
};

namespace {

thread_local int threads_of_this_thread = 0;  // 0: as many as there are processors

using Task = std::function<void(Index, int)>;

// A running parallel_tasks(), on the stack of its caller.
class Loop {
 public:
  Loop(Index count, int threads, const Task& work)
      : threads_(threads), count_(count), work_(work) {}

  // Runs the remaining tasks, one after the other.
  void run(int thread) noexcept {
    for (Index task; (task = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) {
      if (failed_.load(std::memory_order_relaxed)) return;
      try {
        work_(task, thread);
      } catch (...) {
        keep(task, std::current_exception());
      }
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }
  bool has_tasks() const { return next_.load(std::memory_order_relaxed) < count_; }
  int threads() const { return threads_; }

  // Guarded by the pool's mutex: the threads that have joined, and those of them at work.
  int joined = 1;
  std::atomic<int> at_work{1};

 private:
  void keep(Index task, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    failed_.store(true, std::memory_order_relaxed);
    if (error_ && failed_task_ < task) return;
    failed_task_ = task;
    error_ = std::move(error);
  }

  const int threads_;
  const Index count_;
  const Task& work_;
  std::atomic<Index> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  Index failed_task_ = 0;
  std::exception_ptr error_;
};

thread_local bool in_task = false;

class InTask {
 public:
  InTask() { in_task = true; }
  ~InTask() { in_task = false; }
  InTask(const InTask&) = delete;
  InTask& operator=(const InTask&) = delete;
};

// The time for which a thread looks for work before it sleeps. Loops of a solve follow each other
// within less time, and the two system calls that put it to sleep and wake it take as long.
constexpr std::chrono::microseconds kLinger{30};

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Waits for kLinger, or until is_over() returns true.
template <class IsOver>
void linger(const IsOver& is_over) {
  const auto end = std::chrono::steady_clock::now() + kLinger;
  do {
    for (int k = 0; k < 16; ++k) {
      if (is_over()) return;
      pause();
    }
  } while (std::chrono::steady_clock::now() < end);
}

// The threads end with the process, so the pool must not be destroyed before them.
class Pool {
 public:
  static Pool& get() {
    static const int once = ::pthread_atfork(before_fork, after_fork, in_child);
    (void)once;
    return *instance();
  }

  void run(Loop& loop) {
    int sleeping = 0;
    {
      const std::lock_guard lock(mutex_);
      loops_.push_back(&loop);
      ++busy_;
      start(loop.threads() - 1);
      news_.fetch_add(1, std::memory_order_release);
      sleeping = sleeping_;
    }
    for (int k = 1; k < loop.threads() && k <= sleeping; ++k) wake_.notify_one();
    loop.run(0);
    {
      const std::lock_guard lock(mutex_);
      std::erase(loops_, &loop);
      --busy_;
      --loop.at_work;
    }
    linger([&] { return loop.at_work.load(std::memory_order_acquire) == 0; });
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return loop.at_work == 0; });
  }

  using Stage = SideTask::State::Stage;

  void begin(SideTask::State& task) {
    {
      const std::lock_guard lock(mutex_);
      task.pool = this;
      sides_.push_back(&task);
      start(task.threads - 1);
      news_.fetch_add(1, std::memory_order_release);
    }
    wake_.notify_one();
  }
  // Waits for the task if it has begun, otherwise removes it. Returns whether it was done.
  bool end(SideTask::State& task) {
    if (task.pool != this) return false;  // task of the parent process
    std::unique_lock lock(mutex_);
    std::erase(sides_, &task);
    if (task.stage == Stage::Waiting) return false;
    done_.wait(lock, [&] { return task.stage == Stage::Done; });
    return true;
  }

 private:
  // Leaked on purpose: threads of the pool sleep in it until the process has gone.
  static Pool*& instance() {
    static Pool* pool = new Pool;
    return pool;
  }
  static void before_fork() { instance()->mutex_.lock(); }
  static void after_fork() { instance()->mutex_.unlock(); }
  // A forked child has none of the pool's threads, and locks that they held stay locked. It gets a
  // new pool, and the old one is left as it is.
  static void in_child() { instance() = new Pool; }

  // Starts fewer threads if the system refuses: results do not depend on their number. Other
  // threads handle signals.
  void start(int threads) {
    if (started_ >= threads) return;
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
      for (; started_ < threads; ++started_) std::thread([this] { work(); }).detach();
    } catch (const std::system_error&) {
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  // Returns a loop with tasks left and fewer threads than it may use; null: none.
  Loop* one_to_join() const {
    for (Loop* loop : loops_)
      if (loop->joined < loop->threads() && busy_ < loop->threads() && loop->has_tasks())
        return loop;
    return nullptr;
  }

  // Returns a waiting task whose owner has fewer threads at work than allowed; null: none.
  SideTask::State* one_to_begin() const {
    for (SideTask::State* side : sides_)
      if (busy_ < side->threads) return side;
    return nullptr;
  }

  void run(SideTask::State& side, std::unique_lock<std::mutex>& lock) {
    std::erase(sides_, &side);
    side.stage = Stage::Running;
    ++busy_;
    lock.unlock();
    try {
      side.work();
    } catch (...) {
      side.error = std::current_exception();
    }
    lock.lock();
    --busy_;
    side.stage = Stage::Done;
    done_.notify_all();
  }

  void work() {
    const InTask always;
    std::unique_lock lock(mutex_);
    for (;;) {
      Loop* loop = nullptr;
      SideTask::State* side = nullptr;
      const auto has_work = [&] {
        side = one_to_begin();
        loop = side ? nullptr : one_to_join();
        return side || loop;
      };
      if (!has_work()) {
        const unsigned seen = news_.load(std::memory_order_relaxed);
        lock.unlock();
        linger([&] { return news_.load(std::memory_order_acquire) != seen; });
        lock.lock();
        ++sleeping_;
        wake_.wait(lock, has_work);
        --sleeping_;
      }
      if (side) {
        run(*side, lock);
        continue;
      }
      const int thread = loop->joined++;
      ++loop->at_work;
      ++busy_;
      lock.unlock();
      loop->run(thread);
      lock.lock();
      --busy_;
      if (--loop->at_work == 0) done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::atomic<unsigned> news_{0};  // counts new loops and tasks
  std::vector<Loop*> loops_;
  std::vector<SideTask::State*> sides_;  // that have not begun
  int busy_ = 0;                         // callers in a loop, and threads of the pool at work
  int started_ = 0;                      // threads of the pool
  int sleeping_ = 0;                     // of them
};

}  // namespace

bool is_parallel_task() { return in_task; }

ThreadCount::ThreadCount(int count) : before_(threads_of_this_thread) {
  if (count < 0)
    throw InvalidArgument(fmt::format("ThreadCount: {} threads, at least 0 are needed", count));
  if (count > 0) threads_of_this_thread = count;
}

ThreadCount::~ThreadCount() { threads_of_this_thread = before_; }

int ThreadCount::current() {
  static const int processors = available_processors();
  if (is_parallel_task()) return 1;
  return threads_of_this_thread > 0 ? threads_of_this_thread : processors;
}

void parallel_tasks(Index count, const std::function<void(Index task, int thread)>& work,
                    int threads) {
  threads = in_task ? 1 : std::min<int>(threads, count);
  Loop loop(count, threads, work);
  if (threads <= 1) {
    loop.run(0);
  } else {
    const InTask now;
    Pool::get().run(loop);
  }
  loop.rethrow();
}

SideTask::SideTask(std::function<void()> work)
    : state_(std::make_unique<State>(State{std::move(work), ThreadCount::current()})) {
  if (state_->threads > 1) Pool::get().begin(*state_);
}

SideTask::~SideTask() {
  if (state_->pool) Pool::get().end(*state_);
}

bool SideTask::finish() {
  if (!state_->pool || !Pool::get().end(*state_)) return false;
  if (state_->error) std::rethrow_exception(state_->error);
  return true;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
