// Rows of the trace: numbers, times, remedies; counts and measures from them.
#include "majorant/framework/run_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "framework/thread_ranks.h"

namespace majorant {
namespace {

std::optional<Remedy> noted(RunRecord& record) {
  record.note({});
  return record.trace().back().remedy;
}

TEST(RunRecord, NotesARemedyOnce) {
  RunRecord record;
  EXPECT_EQ(noted(record), std::nullopt);
  record.mark(Remedy::Exclude);
  EXPECT_EQ(noted(record), Remedy::Exclude);
  EXPECT_EQ(noted(record), std::nullopt);
}

// Starts may take a little more than the limit, and Ctrl-C ends them at once.
TEST(RunRecord, StartsEndSoonAfterTheLimit) {
  EXPECT_LE(RunRecord::kGrace, 1);
  const RunRecord late(-RunRecord::kGrace);
  EXPECT_EQ(late.start_stop()(), Directive::TimeLimit);
  const RunRecord just(0);
  EXPECT_EQ(just.stop()(), Directive::TimeLimit);
  EXPECT_EQ(just.start_stop()(), Directive::Continue);
  const std::atomic<bool> interrupt = true;
  const RunRecord interrupted(1e3, 10, &interrupt);
  EXPECT_EQ(interrupted.start_stop()(), Directive::Interrupt);
}

TEST(RunRecord, ForgetsARemedyThatNoIterationFollowed) {
  RunRecord record;
  record.mark(Remedy::Deepen);
  record.forget_mark();
  EXPECT_EQ(noted(record), std::nullopt);
}

TraceEntry row_of(int level, StepResult::Outcome outcome = StepResult::Outcome::Moved) {
  TraceEntry row;
  row.level = level;
  row.outcome = outcome;
  return row;
}

TEST(RunRecord, RowsAddUpToTheTime) {
  RunRecord record;
  for (int k = 0; k < 4; ++k) {
    TraceEntry row = row_of(0);
    if (k == 2) row.record.seconds.factorize = 1e3;  // longer than the elapsed time
    row.record.seconds.solve += 1e-9;
    record.note(row);
  }
  const auto& trace = record.trace();
  double spent = 0;
  for (std::size_t k = 0; k < trace.size(); ++k) {
    EXPECT_EQ(trace[k].record.iteration, static_cast<int>(k) + 1);
    EXPECT_GE(trace[k].other_seconds, 0);
    EXPECT_GE(trace[k].elapsed, k > 0 ? trace[k - 1].elapsed : 0);
    spent += trace[k].other_seconds + trace[k].record.seconds.sum();
    if (k < 2) {
      EXPECT_NEAR(trace[k].elapsed, spent, 1e-9);
    }
  }
  EXPECT_EQ(trace[2].other_seconds, 0);
}

TEST(RunRecord, CoarserMeshesDoNotUseUpIterations) {
  RunRecord record(1e9, 3);
  TraceEntry coarse;
  coarse.level = 2;
  record.note(coarse);
  EXPECT_EQ(record.trace().back().level, 2);
  EXPECT_EQ(record.iterations_left(), 3);
  record.note(row_of(0, StepResult::Outcome::Blocked));
  EXPECT_EQ(record.iterations_left(), 2);
  record.note(row_of(0));
  EXPECT_EQ(steps_taken(record.trace()), 1);
}

TEST(RunRecord, RanksStopTogether) {
  test::run_ranks(3, [](const auto& ranks) {
    const bool stops = ranks->rank() == 0;
    RunRecord record(INFINITY, stops ? 2 : 9);
    record.agree([&](int own) { return ranks->of_first(own); });
    EXPECT_EQ(record.iterations_left(), 2);
    EXPECT_EQ(record.directive(), Directive::Continue);
    std::atomic<bool> interrupt = stops;
    RunRecord late(INFINITY, 9, &interrupt);
    late.agree([&](int own) { return ranks->of_first(own); });
    EXPECT_EQ(late.note(row_of(0)), Directive::Interrupt);
  });
}

// An observer that records its calls as words.
class Listener final : public RunObserver {
 public:
  std::vector<std::string> notified;

  void begin(Activity activity) override { notified.emplace_back(activity_name(activity)); }
  void advance(double share) override {
    notified.push_back(std::to_string(std::lround(100 * share)));
  }
  void begin_pass(int pass, int most) override {
    notified.push_back("pass " + std::to_string(pass) + " of " + std::to_string(most));
  }
  Directive after_step(const TraceEntry& row, const Vec&) override {
    notified.push_back("step " + std::to_string(row.record.iteration));
    return Directive::Continue;
  }
};

TEST(RunRecord, ReportsSharesAndPasses) {
  Listener listener;
  RunRecord record(INFINITY, 9, nullptr, &listener);
  record.begin(Activity::Cutting);
  record.telling(record.stop()).between(0.5, 1).advance(0.5);
  record.advance(1);
  record.begin_pass();
  record.begin_pass(4);
  EXPECT_EQ(listener.notified,
            (std::vector<std::string>{"cutting", "75", "100", "pass 2 of 0", "pass 3 of 7"}));
}

TEST(RunRecord, PartsReportOnlyTheSharesOfTheirStart) {
  Listener listener;
  const RunRecord record(INFINITY, 9, nullptr, &listener);
  double start = 0;
  RunRecord part = record.part(&listener, [&](double share) { start = share; });
  part.begin(Activity::Starting);
  part.advance(0.5);
  part.telling(part.stop()).advance(0.6);
  part.begin_pass();
  part.telling_start(part.stop()).advance(0.7);
  record.part().telling_start({}).advance(0.8);
  EXPECT_EQ(start, 0.7);
  EXPECT_TRUE(listener.notified.empty());
}

TEST(RunRecord, ReportsTheLastStepOfEachPart) {
  Listener listener;
  RunObserver& observer = listener;
  std::vector<TraceEntry> rows(3);
  rows[2].record.iteration = 3;
  observer.after_part("chart 1 of 2", rows);
  observer.after_part("chart 2 of 2", {});
  EXPECT_EQ(listener.notified, std::vector<std::string>{"step 3"});
}

TEST(Trace, FactorizationTimeIsTheMedianAtOneDegree) {
  std::vector<TraceEntry> trace;
  const auto add = [&](int degree, int level, int tried, int failed, double seconds) {
    TraceEntry row = row_of(level);
    row.degree = degree;
    row.record.factorizations = tried;
    row.record.failed_factorizations = failed;
    row.record.seconds.factorize = seconds;
    row.record.seconds.solve = 0.5;
    trace.push_back(row);
  };
  add(2, 0, 0, 0, 0);      // a kept factor
  add(2, 0, 2, 2, 100);    // no solver
  add(1, 0, 1, 0, 1000);   // another degree
  add(2, 1, 1, 0, 10000);  // another mesh
  EXPECT_EQ(factor_solve_seconds(trace, 2), std::nullopt);
  add(2, 0, 1, 0, 1);
  add(2, 0, 2, 1, 6);
  add(2, 0, 1, 0, 9);
  EXPECT_EQ(factor_solve_seconds(trace, 2), 3.5);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
