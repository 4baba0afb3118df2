#include "apps/compare/compare_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "majorant/framework/error.h"

namespace majorant::app {
namespace {

// Throws Error(Usage) for an option that only concerns solving one problem.
void require_no_problem(const CLI::App& verb) {
  const std::set<std::string> usable{"output", "threads", "quiet",       "verbose",
                                     "strict", "force",   "color-range", "color-by",
                                     "size",   "edges",   "legend",      "transparent"};
  for (const CLI::Option* option : verb.get_options())
    if (option->count() > 0 && !option->get_positional() &&
        usable.count(option->get_single_name()) == 0)
      throw Error(ErrorKind::Usage,
                  fmt::format("--{} applies to one problem solved with many methods; leave it out "
                              "to compare two results, or leave out the second one",
                              option->get_single_name()));
}

}  // namespace

void CompareRequest::add_to(CLI::App& verb) {
  map.add_to(verb, "3");
  map.init = "tutte";  // a start far enough from the minimum to compare paths
  map.add_start_to(verb);
  add_options(verb, OptionGroup::Files,
              {{"other", &other,
                "a second result of the same surface; -o OUT.html then shows both and the "
                "difference of their densities, -o OUT.svg both layouts for a figure"}});
  formats.add_drawing_to(verb);
  add_options(
      verb, OptionGroup::Solver,
      {{"--methods",
        &methods,
        "comma-separated names of methods, listed below (default: all that fit the energy)",
        {.type = "NAMES", .comma_separated = true}},
       {"--linear-solvers",
        &linear_solvers,
        fmt::format(
            "also compare linear solvers on the first method: all, or comma-separated names ({})",
            fmt::join(linear_solver_names(), ", ")),
        {.type = "NAMES", .comma_separated = true}}});
  add_options(verb, OptionGroup::Files,
              {{"-o,--output",
                &outputs,
                "output: .csv .html .json; for two results .html .svg; repeatable",
                {.type = "FILE"}}});
  add_options(verb, OptionGroup::Solver,
              {{"--tolerance",
                &tolerance,
                fmt::format("relative decrease at which Newton stops ({})", tolerance),
                {.check = positive_number()}},
               {"--max-iterations",
                &max_iterations,
                fmt::format("limit of iterations of each method ({})", max_iterations),
                {.check = whole_number(0)}},
               {"--time-limit",
                &time_limit,
                fmt::format("time limit of each method, in seconds ({})", time_limit),
                {.check = non_negative_number()}}});
  common.add_to(verb);
}

void CompareRequest::require_fitting(const CLI::App& verb) const {
  const bool has_other = verb.get_option("other")->count() > 0;
  if (has_other) require_no_problem(verb);
  if (const std::string option = formats.first_given(); !has_other && !option.empty())
    throw Error(
        ErrorKind::Usage,
        fmt::format("{} applies to two results side by side; add the second one, or leave it out",
                    option));
}

std::vector<const Method*> CompareRequest::chosen_methods() const {
  std::vector<const Method*> chosen;
  for (std::string name : methods) {
    std::erase(name, ' ');
    const Method* m = find_method(name);
    if (!m) {
      std::vector<std::string> names;
      for (const Method& known : app::methods()) names.push_back(known.name);
      throw Error(ErrorKind::Usage, fmt::format("no method is called '{}'{}; use {}", name,
                                                did_you_mean(name, names), fmt::join(names, ", ")));
    }
    if (std::find(chosen.begin(), chosen.end(), m) == chosen.end()) chosen.push_back(m);
  }
  if (chosen.empty() && !linear_solvers.empty()) chosen.push_back(find_method("newton"));
  if (chosen.empty())
    for (const Method& m : app::methods())
      if (m.is_default) chosen.push_back(&m);
  return chosen;
}

std::vector<std::string> CompareRequest::chosen_linear_solvers() const {
  const std::vector<std::string> names = linear_solver_names();
  std::vector<std::string> chosen;
  for (std::string name : linear_solvers) {
    std::erase(name, ' ');
    if (name == "all") return names;
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(ErrorKind::Usage,
                  fmt::format("--linear-solvers: there is no {}{}; use all, or {}", name,
                              did_you_mean(name, names), fmt::join(names, ", ")));
    chosen.push_back(name);
  }
  return chosen;
}

RunReport comparison_report(const CompareRequest& request, const Comparison& comparison,
                            const std::vector<LinearSolverRun>& solvers) {
  Json options = request.map.to_json();
  options.erase("curvature");  // part of the methods' names
  options["tolerance"] = request.tolerance;
  options["max_iterations"] = request.max_iterations;
  options["time_limit"] = request.time_limit;
  options["strict"] = request.common.strict;
  const double best = comparison.best_energy(), nan = std::nan("");
  const ComparisonPoint no_point{0, 0, nan, nan, nan};
  Json runs = Json::array();
  for (const MethodRun& run : comparison.runs) {
    Json within = Json::object();
    for (const auto& [key, fraction] : {std::pair("0.01", 0.01), {"0.0001", 0.0001}})
      if (const ComparisonPoint* p = first_within(run, best, fraction))
        within[key] = {{"iterations", p->iteration}, {"seconds", p->seconds}};
      else
        within[key] = nullptr;
    const ComparisonPoint last = run.points.empty() ? no_point : run.points.back();
    runs.push_back({{"method", run.method},
                    {"status", run.status},
                    {"message", run.message},
                    {"iterations", last.iteration},
                    {"factorizations", run.factorizations},
                    {"seconds", last.seconds},
                    {"seconds_by_part",
                     {{"assemble", run.seconds.assemble},
                      {"factorize", run.seconds.factorize},
                      {"solve", run.seconds.solve},
                      {"line_search", run.seconds.line_search}}},
                    {"energy", last.energy},
                    {"gradient_norm", last.gradient_norm},
                    {"min_det", last.measure},
                    {"definite", definite_name(run.definite)},
                    {"notes", run.notes},
                    {"within", within}});
  }
  RunReport report{.status = "done",
                   .input = {{"file", request.map.input}},
                   .options = options,
                   .result = {{"title", comparison.title},
                              {"machine", comparison.machine},
                              {"best_energy", best},
                              {"methods", runs}}};
  if (!solvers.empty()) report.result["linear_solvers"] = linear_solvers_section(solvers);
  return report;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
