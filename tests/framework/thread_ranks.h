// Ranks as threads of one process, to test Partition and parallel solvers without MPI.
//
//     test::run_ranks(3, [](const std::shared_ptr<const Ranks>& ranks) { ... });   // on 3 threads
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

#include "majorant/framework/partition.h"

namespace majorant::test {

class ThreadRanks final : public Ranks {
 public:
  struct Group {
    explicit Group(int count)
        : size(static_cast<std::size_t>(count)),
          meeting(count),
          notified(size),
          messages(size, std::vector<std::vector<double>>(size)) {}
    std::size_t size;
    std::barrier<> meeting;
    std::vector<std::vector<double>> notified;
    std::vector<std::vector<std::vector<double>>> messages;  // from, to
    std::vector<std::byte> bytes;
  };
  ThreadRanks(Group& group, int rank) : group_(group), rank_(static_cast<std::size_t>(rank)) {}

  int rank() const override { return static_cast<int>(rank_); }
  int count() const override { return static_cast<int>(group_.size); }
  void sum(std::span<double> values) const override {
    reduce(values, [](double a, double b) { return a + b; });
  }
  void min(std::span<double> values) const override {
    reduce(values, [](double a, double b) { return std::min(a, b); });
  }
  void broadcast(std::span<std::byte> bytes) const override {
    if (rank_ == 0) group_.bytes.assign(bytes.begin(), bytes.end());
    group_.meeting.arrive_and_wait();
    std::copy(group_.bytes.begin(), group_.bytes.end(), bytes.begin());
    group_.meeting.arrive_and_wait();
  }
  void exchange(std::span<const Message> sent, std::span<const Message> received) const override {
    for (const Message& p : sent)
      group_.messages[rank_][static_cast<std::size_t>(p.rank)].assign(p.values.begin(),
                                                                      p.values.end());
    group_.meeting.arrive_and_wait();
    for (const Message& p : received) {
      const auto& values = group_.messages[static_cast<std::size_t>(p.rank)][rank_];
      EXPECT_EQ(values.size(), p.values.size());
      std::copy(values.begin(), values.end(), p.values.begin());
    }
    group_.meeting.arrive_and_wait();
  }

 private:
  template <class Operation>
  void reduce(std::span<double> values, const Operation& operation) const {
    group_.notified[rank_].assign(values.begin(), values.end());
    group_.meeting.arrive_and_wait();
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = group_.notified[0][k];
      for (std::size_t r = 1; r < group_.size; ++r)
        values[k] = operation(values[k], group_.notified[r][k]);
    }
    group_.meeting.arrive_and_wait();
  }

  Group& group_;
  std::size_t rank_;
};

// Runs the function on all ranks. If one throws, all must; the first exception is thrown again.
inline void run_ranks(int count,
                      const std::function<void(const std::shared_ptr<const Ranks>&)>& body) {
  ThreadRanks::Group group(count);
  std::vector<std::exception_ptr> errors(group.size);
  std::vector<std::thread> threads;
  for (int r = 0; r < count; ++r)
    threads.emplace_back([&, r] {
      try {
        body(std::make_shared<const ThreadRanks>(group, r));
      } catch (...) {
        errors[static_cast<std::size_t>(r)] = std::current_exception();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
