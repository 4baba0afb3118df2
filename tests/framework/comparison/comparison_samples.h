// Comparisons for writers: a typical one, and special cases.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "majorant/framework/comparison/comparison.h"

namespace majorant {

// Returns a run with energies 4.1 (1 + start e^(-rate k)) for iterations 0..count.
inline MethodRun decaying_run(const std::string& method, int count, double start, double rate,
                              double seconds_each) {
  MethodRun run{method, "converged", "", {}};
  for (int k = 0; k <= count; ++k) {
    const double excess = start * std::exp(-rate * k);
    run.points.push_back({k, seconds_each * k, 4.1 * (1.0 + excess), 10.0 * std::sqrt(excess),
                          k == 0 ? std::nan("") : 1.0 / (1.0 + k % 4), 0.2 / (1.0 + excess)});
  }
  return run;
}

inline Comparison usual_comparison() {
  Comparison all{
      "creature.obj, degree 3, symmetric-dirichlet", "2 threads of a test", {}, {}, "min det",
  };
  all.runs.push_back(decaying_run("projected-newton", 24, 20.0, 1.25, 0.11));
  all.runs.push_back(decaying_run("majorizer", 30, 20.0, 0.8, 0.105));
  all.runs.push_back(decaying_run("reweighted (slim)", 120, 20.0, 0.12, 0.09));
  all.runs.push_back(decaying_run("akvf", 200, 20.0, 0.05, 0.08));
  all.runs.push_back(decaying_run("lbfgs", 900, 20.0, 0.011, 0.004));
  all.runs[4].status = "max_iterations";
  all.runs.push_back(decaying_run("gradient-descent", 60, 20.0, 0.02, 0.003));
  all.runs[5].status = "stalled";
  all.runs[5].message = "held at the injectivity limit: 3 triangles allow no step above 1e-9";
  all.runs.push_back({"exact-newton",
                      "failed",
                      "the matrix of the start is not positive definite and no shift helped",
                      {{0, 0.0, 4.1 * 21.0, 44.7, std::nan(""), 0.01}}});
  return all;
}

inline MethodRun run_of_energies(const std::string& method, const std::vector<double>& energies) {
  MethodRun run{method, "converged", "", {}};
  for (std::size_t k = 0; k < energies.size(); ++k) {
    run.points.push_back(
        {static_cast<int>(k), 0.5 * static_cast<double>(k), energies[k], 1.0, 1.0, 0.5});
  }
  return run;
}

// Returns special cases by name, each of which a page must draw without an error.
inline std::vector<std::pair<std::string, Comparison>> odd_comparisons() {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  const std::string hostile = "</script><b id=\"hostile\">\"'&\n<!-- {{data}} \xc3\xa9\xe2\x88\x9e";
  const auto with = [](std::vector<MethodRun> runs) {
    return Comparison{"odd", "a machine", std::move(runs), {}, "min det"};
  };
  std::vector<std::pair<std::string, Comparison>> all = {
      {"nothing", with({})},
      {"no_points", with({{"a", "failed", "no start", {}}, {"b", "failed", "", {}}})},
      {"one_point", with({run_of_energies("a", {4.0})})},
      {"equal", with({run_of_energies("a", {4.0, 4.0, 4.0}), run_of_energies("b", {4.0, 4.0})})},
      {"zero", with({run_of_energies("a", {5.0, 1e-3, 0.0}), run_of_energies("b", {5.0, 1e-9})})},
      {"negative", with({run_of_energies("a", {5.0, -1.0, -2.0}), run_of_energies("b", {-1.99})})},
      {"not_finite", with({run_of_energies("a", {kInf, nan, 7.0, -kInf, 6.0, kInf}),
                           run_of_energies("b", {nan, kInf})})},
      {"never_finite", with({run_of_energies("a", {kInf, nan})})},
      {"extreme",
       with({run_of_energies("a", {1e308, -1e308}), run_of_energies("b", {1e-310, 5e-324})})},
      {"hostile", with({{hostile, hostile, hostile, {}}})},
  };
  Comparison& last = all.back().second;
  last.title = last.measure = hostile;
  last.machine = hostile + "\xff\xfe";
  last.runs[0].notes = last.notes = {hostile};
  last.runs[0].points = run_of_energies("", {5.0, 4.0}).points;
  Comparison many = with({});
  for (int i = 0; i < 16; ++i) {
    many.runs.push_back(decaying_run("method " + std::to_string(i), 20, 3.0, 0.1 + 0.05 * i, 0.2));
  }
  all.emplace_back("many", many);
  all.emplace_back("big", with({decaying_run("a", 10000, 3.0, 1e-3, 1e-3),
                                decaying_run("b", 10000, 3.0, 2e-3, 1.7e-3)}));
  return all;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
