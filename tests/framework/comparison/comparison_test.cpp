#include "majorant/framework/comparison/comparison.h"

#include <algorithm>
#include <sstream>

#include "framework/comparison/comparison_samples.h"
#include "majorant/framework/comparison/comparison_table.h"

namespace majorant {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Comparison, TheBestEnergyIsTheSmallestFiniteOne) {
  Comparison all;
  EXPECT_EQ(all.best_energy(), kInf);
  all.runs = {run_of_energies("a", {kInf, std::nan(""), -kInf})};
  EXPECT_EQ(all.best_energy(), kInf);
  all.runs.push_back(run_of_energies("b", {5.0, 3.0, 4.0}));  // the best energy is not the last
  EXPECT_EQ(all.best_energy(), 3.0);
  all.runs.push_back(run_of_energies("c", {-2.0}));
  EXPECT_EQ(all.best_energy(), -2.0);
}

TEST(Comparison, FirstPointWithinAFraction) {
  const MethodRun run = run_of_energies("a", {kInf, std::nan(""), 5.0, 4.04, 4.0399, 4.0});
  EXPECT_EQ(first_within(run, 4.0, 0.01), &run.points[3]);
  EXPECT_EQ(first_within(run, 4.0, 1e-4), &run.points[5]);
  EXPECT_EQ(first_within(run, 4.0, 0.0), &run.points[5]);
  EXPECT_EQ(first_within(run, 3.0, 0.01), nullptr);
  EXPECT_EQ(first_within(run, kInf, 0.01), nullptr);
  EXPECT_EQ(first_within(run, std::nan(""), 0.01), nullptr);
  EXPECT_EQ(first_within(MethodRun{}, 4.0, 0.01), nullptr);
  // For a negative best energy the limit is above it. -inf does not count as an energy.
  const MethodRun negative = run_of_energies("b", {-kInf, 1.0, -1.99, -2.0});
  EXPECT_EQ(first_within(negative, -2.0, 0.01), &negative.points[2]);
  const MethodRun zero = run_of_energies("c", {1.0, 1e-12, 0.0});
  EXPECT_EQ(first_within(zero, 0.0, 0.01), &zero.points[2]);
}

TEST(Comparison, Excess) {
  EXPECT_DOUBLE_EQ(excess_energy(5.0, 4.0), 0.25);
  EXPECT_DOUBLE_EQ(excess_energy(-1.0, -4.0), 0.75);
  EXPECT_EQ(excess_energy(5.0, 0.0), 5.0);
  EXPECT_TRUE(std::isnan(excess_energy(kInf, 4.0)));
  EXPECT_TRUE(std::isnan(excess_energy(4.0, kInf)));
}

TEST(ComparisonTable, HasTheTimeAtWhichEachMethodCameNear) {
  Comparison all{"t",
                 "m",
                 {run_of_energies("first", {9.0, 4.03, 4.0003, 4.0}),
                  run_of_energies("second", {9.0, 4.5, 4.02}),
                  {"third", "failed", "no descent", {}}},
                 {},
                 "min det"};
  const auto lines = lines_of(comparison_table(all));
  const std::vector<std::string> expected = {
      "                                                         seconds    by part     "
      "                                                   to within      1 %   to withi"
      "n   0.01 %",
      "method  status     iterations  factorizations  seconds  assemble  factorize  sol"
      "ve  line search  final energy  gradient  min det  iterations  seconds  iteration"
      "s  seconds",
      "first   converged           3               0     1.50      0.00       0.00   0."
      "00         0.00     4.0000000   1.0e+00    0.500           1    0.500           "
      "2     1.00",
      "second  converged           2               0     1.00      0.00       0.00   0."
      "00         0.00     4.0200000   1.0e+00    0.500           2     1.00           "
      "-        -",
      "third   failed              -               -        -         -          -     "
      " -            -             -         -        -           -        -           "
      "-        -",
      "third: no descent"};
  ASSERT_EQ(lines.size(), expected.size());
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i], expected[i]);
}

TEST(ComparisonTable, NamesAStatusOnce) {
  const Comparison all{"t", "m", {{"slow", "time_limit", "time_limit", {}}}};
  EXPECT_EQ(comparison_rows(all).front().message, "");
  const std::string text = comparison_table(all);
  EXPECT_EQ(text.find("time_limit"), text.rfind("time_limit"));
}

TEST(ComparisonTable, IsAsciiWithALinePerMethod) {
  auto all = odd_comparisons();
  all.emplace_back("usual", usual_comparison());
  for (const auto& [name, comparison] : all) {
    SCOPED_TRACE(name);
    const std::string text = comparison_table(comparison);
    EXPECT_TRUE(std::all_of(text.begin(), text.end(),
                            [](char c) { return c == '\n' || (c >= ' ' && c < 0x7f); }));
    std::size_t noted = comparison.notes.size();
    for (const MethodRun& run : comparison.runs) noted += run.notes.size();
    const auto messages = std::count_if(
        comparison.runs.begin(), comparison.runs.end(),
        [](const MethodRun& run) { return !run.message.empty() && run.message != run.status; });
    EXPECT_EQ(lines_of(text).size(),
              2 + comparison.runs.size() + static_cast<std::size_t>(messages) + noted);
  }
}

TEST(ComparisonTable, ExcessOfEachRow) {
  const auto excess = [](std::vector<double> energies, double best) {
    return comparison_rows({"", "", {run_of_energies("a", energies), run_of_energies("b", {best})}})
        .front()
        .excess;
  };
  EXPECT_EQ(excess({4.0}, 4.0), "0.00 %");
  EXPECT_EQ(excess({4.05}, 4.0), "1.25 %");
  EXPECT_EQ(excess({84.0}, 4.0), "2000 %");
  EXPECT_EQ(excess({-3.0}, -4.0), "25.0 %");
  EXPECT_EQ(excess({0.125}, 0.0), "0.125");  // relative to 0 there is no percentage
  EXPECT_EQ(excess({kInf}, 4.0), "-");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
