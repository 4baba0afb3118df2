// Solves one map with changed solver rules, to measure the effect of a rule.
//
// Prints one line of JSON: the energy by measure(), status, iterations, remedies that ran, seconds
// of the optimization. bench/tune.py runs tables of variations.
//
// Sample runs:
//   build/release/bench/majorant_tune --list
//   build/release/bench/majorant_tune --degree 2 ../shared/data/public/disks/spot_500.obj
//   build/release/bench/majorant_tune --bijective --set scaffold.share=1e-4 examples/meshes/creature.obj
//   build/release/bench/majorant_tune --bounded 1.2 --set bounds.weights.fall=0.3 examples/meshes/cap.obj
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "../examples/stretch_bound.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/solve/parametrize_by.h"

using namespace majorant;

namespace {

struct Settings {
  SolverRules rules;
  ParametrizationOptions options;
  // Ratio of the largest stretch of the free map to that of a second map, whose line is printed; 0:
  // the line of the free map is printed.
  double tighter = 0;
};

struct Rule {
  const char* name;
  std::function<std::variant<double*, int*>(Settings&)> value;
};

const std::vector<Rule>& all_rules() {
  static const std::vector<Rule> rules = {
      {"accuracy_rounds", [](Settings& s) { return &s.rules.accuracy_rounds; }},
      {"blend.below", [](Settings& s) { return &s.rules.blend.below; }},
      {"blend.fall", [](Settings& s) { return &s.rules.blend.fall; }},
      {"blend.hold", [](Settings& s) { return &s.rules.blend.hold; }},
      {"blend.least", [](Settings& s) { return &s.rules.blend.least; }},
      {"blend.short_step", [](Settings& s) { return &s.rules.blend.short_step; }},
      {"blend.whole_steps", [](Settings& s) { return &s.rules.blend.whole_steps; }},
      {"bounds.entry.tolerance", [](Settings& s) { return &s.rules.bounds.entry.tolerance; }},
      {"bounds.weights.fall", [](Settings& s) { return &s.rules.bounds.weights.fall; }},
      {"bounds.first_share", [](Settings& s) { return &s.rules.bounds.first_share; }},
      {"bounds.entry.harder", [](Settings& s) { return &s.rules.bounds.entry.harder; }},
      {"bounds.centred", [](Settings& s) { return &s.rules.bounds.centred; }},
      {"bounds.least_barrier", [](Settings& s) { return &s.rules.bounds.least_barrier; }},
      {"bounds.least_energy", [](Settings& s) { return &s.rules.bounds.least_energy; }},
      {"bounds.entry.least_progress",
       [](Settings& s) { return &s.rules.bounds.entry.least_progress; }},
      {"bounds.weights.most_phases",
       [](Settings& s) { return &s.rules.bounds.weights.most_phases; }},
      {"depth", [](Settings& s) { return &s.options.solve.injectivity_depth; }},
      {"elevation_tolerance", [](Settings& s) { return &s.options.solve.elevation_tolerance; }},
      {"lagged.below", [](Settings& s) { return &s.rules.lagged.below; }},
      {"lagged.history", [](Settings& s) { return &s.rules.lagged.history; }},
      {"lagged.short_step", [](Settings& s) { return &s.rules.lagged.short_step; }},
      {"lagged.steps", [](Settings& s) { return &s.rules.lagged.steps; }},
      {"line_search.armijo", [](Settings& s) { return &s.rules.line_search.armijo; }},
      {"line_search.barrier_decrement",
       [](Settings& s) { return &s.rules.line_search.barrier_decrement; }},
      {"line_search.barrier_gain", [](Settings& s) { return &s.rules.line_search.barrier_gain; }},
      {"line_search.boundary_fraction",
       [](Settings& s) { return &s.rules.line_search.boundary_fraction; }},
      {"line_search.largest_growth",
       [](Settings& s) { return &s.rules.line_search.largest_growth; }},
      {"line_search.most_improvements",
       [](Settings& s) { return &s.rules.line_search.most_improvements; }},
      {"quadrature.boundary_guard", [](Settings& s) { return &s.rules.quadrature.boundary_guard; }},
      {"quadrature.refinements", [](Settings& s) { return &s.rules.quadrature.refinements; }},
      {"quadrature.corner_guard", [](Settings& s) { return &s.rules.quadrature.corner_guard; }},
      {"quadrature.error", [](Settings& s) { return &s.rules.quadrature.error; }},
      {"remedies.barrier_rounds", [](Settings& s) { return &s.rules.remedies.barrier_rounds; }},
      {"remedies.barrier_tolerance",
       [](Settings& s) { return &s.rules.remedies.barrier_tolerance; }},
      {"remedies.bisections_deeper",
       [](Settings& s) { return &s.rules.remedies.bisections_deeper; }},
      {"deepest_bisection", [](Settings& s) { return &s.rules.remedies.deepest_bisection; }},
      {"remedies.excluded_iterations",
       [](Settings& s) { return &s.rules.remedies.excluded_iterations; }},
      {"remedies.excluded_tolerance",
       [](Settings& s) { return &s.rules.remedies.excluded_tolerance; }},
      {"remedies.excluded_weight", [](Settings& s) { return &s.rules.remedies.excluded_weight; }},
      {"remedies.stall_rounds", [](Settings& s) { return &s.rules.remedies.stall_rounds; }},
      {"scaffold.at_rest", [](Settings& s) { return &s.rules.scaffold.at_rest; }},
      {"scaffold.depth", [](Settings& s) { return &s.rules.scaffold.depth; }},
      {"scaffold.least_energy", [](Settings& s) { return &s.rules.scaffold.least_energy; }},
      {"scaffold.part_of_tolerance",
       [](Settings& s) { return &s.rules.scaffold.part_of_tolerance; }},
      {"scaffold.relax_steps", [](Settings& s) { return &s.rules.scaffold.relax_steps; }},
      {"scaffold.same_lambda", [](Settings& s) { return &s.rules.scaffold.same_lambda; }},
      {"scaffold.share", [](Settings& s) { return &s.rules.scaffold.share; }},
      {"scaffold.share_at_rest", [](Settings& s) { return &s.rules.scaffold.share_at_rest; }},
      {"scaffold.short_bound", [](Settings& s) { return &s.rules.scaffold.short_bound; }},
      {"scaffold.still_moving", [](Settings& s) { return &s.rules.scaffold.still_moving; }},
      {"scaffold.tail_steps", [](Settings& s) { return &s.rules.scaffold.tail_steps; }},
      {"soft_start", [](Settings& s) { return &s.rules.soft_start; }},
      {"stopping.fallback_step", [](Settings& s) { return &s.rules.stopping.fallback_step; }},
      {"stopping.decrement", [](Settings& s) { return &s.rules.stopping.decrement; }},
      {"stopping.last_factor", [](Settings& s) { return &s.rules.stopping.last_factor; }},
      {"stopping.plateau_factor", [](Settings& s) { return &s.rules.stopping.plateau_factor; }},
      {"stopping.plateau_steps", [](Settings& s) { return &s.rules.stopping.plateau_steps; }},
      {"stopping.plateau_window", [](Settings& s) { return &s.rules.stopping.plateau_window; }},
      {"stopping.relative_decrease", [](Settings& s) { return &s.options.solve.tolerance; }},
      {"stopping.saddle_part", [](Settings& s) { return &s.rules.stopping.saddle_part; }},
      {"stopping.stall_decrement", [](Settings& s) { return &s.rules.stopping.stall_decrement; }},
      {"stopping.stall_iterations", [](Settings& s) { return &s.rules.stopping.stall_iterations; }},
      {"stopping.stall_step", [](Settings& s) { return &s.rules.stopping.stall_step; }},
      {"stopping.tail_factor", [](Settings& s) { return &s.rules.stopping.tail_factor; }},
      {"stopping.tail_steps", [](Settings& s) { return &s.rules.stopping.tail_steps; }},
  };
  return rules;
}

// assignment: name=value. Throws std::invalid_argument for other texts.
void set(const std::string& assignment, Settings& settings) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) throw std::invalid_argument(assignment + ": not NAME=VALUE");
  for (const Rule& rule : all_rules()) {
    if (assignment.substr(0, equals) != rule.name) continue;
    const double value = std::stod(assignment.substr(equals + 1));
    std::visit([value](auto* to) { *to = static_cast<std::decay_t<decltype(*to)>>(value); },
               rule.value(settings));
    return;
  }
  throw std::invalid_argument(assignment + ": no such rule, see --list");
}

void list(Settings& settings) {
  for (const Rule& rule : all_rules())
    std::visit([&](const auto* value) { fmt::print("{} {}\n", rule.name, *value); },
               rule.value(settings));
}

// Uses the rules of parametrize(), so that the bound does not depend on the changed rule.
double free_stretch(const BezierMap& start, const ParametrizationOptions& options) {
  RunRecord record;
  const ParametrizationResult free = parametrize_by({}, start, options, record);
  const RestShapes rest = flat_triangles(start.mesh().positions(), start.mesh().faces());
  return largest_stretch(jacobian_net(free.map->space(), rest), free.map->control_points())
      .maxCoeff();
}

void solve(const std::string& path, const Settings& settings) {
  const auto mesh =
      std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, settings.options.map));
  ParametrizationOptions options = settings.options;
  if (settings.tighter > 0) {
    const double bound = free_stretch(start, options) / settings.tighter;
    options.extend = [bound](MapExtension& map) {
      map.add(std::make_shared<const StretchBound>(jacobian_net(map.space(), map.rest()), bound));
    };
  }
  RunRecord record;
  const ParametrizationResult r = parametrize_by(settings.rules, start, options, record);
  int remedies = 0;
  for (const RemedyUse& use : r.remedies) remedies += use.runs;
  fmt::print(
      "{{\"energy\": {:.12g}, \"status\": \"{}\", \"iterations\": {}, \"remedies\": {}, "
      "\"seconds\": {:.3g}}}\n",
      r.measures.value, status_name(r.status), steps_taken(record.trace()), remedies,
      r.optimize_seconds);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  std::vector<std::string> changes;
  std::string path, energy = "symmetric-dirichlet";
  bool bijective = false, fixed = false, list_only = false;
  int threads = 1;
  CLI::App app("One map with other solver rules.");
  app.add_option("mesh", path);
  app.add_option("--degree", settings.options.map.degree);
  app.add_option("--set", changes, "NAME=VALUE, repeatedly")->allow_extra_args(false);
  app.add_option("--threads", threads);
  app.add_option("--energy", energy, "a name, such as arap");
  app.add_flag("--bijective", bijective);
  app.add_option("--bounded", settings.tighter,
                 "X: with a bound of the largest stretch, X times below that of the free map");
  app.add_flag("--fixed", fixed, "the boundary stays where the start has it");
  app.add_flag("--list", list_only, "names and values of the rules");
  CLI11_PARSE(app, argc, argv);
  if (bijective) settings.options.map.injectivity = MapInjectivity::Global;
  if (fixed) settings.options.map.boundary = BoundaryCondition::Fixed;
  try {
    const NamedEnergy* found = find_energy(energy);
    if (!found) throw std::invalid_argument(energy + ": no such energy");
    settings.options.map.energy = {{found->make, 1.0}};
    for (const std::string& change : changes) set(change, settings);
    if (list_only) {
      list(settings);
    } else {
      settings.options.solve.threads = threads;
      solve(path, settings);
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "majorant_tune: {}\n", e.what());
    return 1;
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
