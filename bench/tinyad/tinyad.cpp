// The problems of TinyAD's examples (rows.h), on one thread.
//
// Prints a line of CSV for each row: problem, row, unknowns, status, energy, violation of exact
// conditions, steps, factorizations, and CPU seconds from arrays in memory to the end. The last two
// columns are the steps and seconds until the energy was at most --target; "-" means never.
//
// Without --data, meshes are generated, smaller than those of the examples. --write
// writes the arrays of the problems for other programs, one folder per problem.
//
// Sample runs:
//   build/release/bench/tinyad
//   build/release/bench/tinyad --data TinyAD-Examples/data --only parametrization --target 52.0945
//   build/release/bench/tinyad --data TinyAD-Examples/data --write /tmp/arrays
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "rows.h"

using namespace majorant;
using namespace majorant::tinyad;

namespace {

std::vector<TinyadProblem> all_problems() {
  std::vector<TinyadProblem> all;
  for (const auto& family : {parametrization(), deformation(), sphere_embedding(), polycurl(),
                             planar_quads(), polygon(), derivatives()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

struct Options {
  std::string data, folder, row;
  std::vector<std::string> only;
  double target = -std::numeric_limits<double>::infinity();
  bool to_rounding = false;
};

void print(const std::string& problem, const Row& row, const Input& input, const Options& options) {
  Watch watch(options.target, options.to_rounding);
  const End end = row.solve(input, watch);
  const double seconds = watch.seconds();
  const bool reached = watch.steps_to_target >= 0;
  fmt::print("{},{},{},{},{:.15g},{:.3g},{},{},{:.6f},{},{}\n", problem, row.name,
             end.result.y.size(), status_name(end.result.status), end.energy, end.violation,
             watch.steps, watch.factorizations, seconds,
             reached ? fmt::format("{}", watch.steps_to_target) : "-",
             reached ? fmt::format("{:.6f}", watch.seconds_to_target) : "-");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app("The problems of TinyAD's examples");
  app.add_option("--data", options.data, "folder of the examples' meshes; none: generated ones");
  app.add_option("--only", options.only, "names of problems, or their first words")->delimiter(',');
  app.add_option("--row", options.row, "one row of each");
  app.add_option("--target", options.target, "energy at which a row may end");
  app.add_flag("--rounding", options.to_rounding, "goes on until doubles resolve no decrease");
  app.add_option("--write", options.folder, "writes the arrays there, and solves nothing");
  CLI11_PARSE(app, argc, argv);
  const ThreadCount one(1);
  if (options.folder.empty())
    fmt::print(
        "problem,row,unknowns,status,energy,violation,steps,factorizations,seconds,"
        "steps_to_target,seconds_to_target\n");
  for (const TinyadProblem& problem : all_problems()) {
    const std::string family = problem.name.substr(0, problem.name.find(' '));
    const auto is_selected = [&](const std::string& name) {
      return name == problem.name || name == family;
    };
    if (!options.only.empty() &&
        std::none_of(options.only.begin(), options.only.end(), is_selected))
      continue;
    const Input input = problem.input(options.data);
    if (!options.folder.empty()) input.write(options.folder + "/" + family);
    if (options.folder.empty())
      for (const Row& row : problem.rows)
        if (options.row.empty() || options.row == row.name)
          print(problem.name, row, input, options);
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << "tinyad: " << error.what() << "\n";
  return 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
