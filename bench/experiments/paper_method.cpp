// The method of [MC20] as published, for experiments that measure the contribution of its parts.
// It has Newton steps with the paper's majorizer, its lattices of quadrature points and its
// stopping rules, and with --exclude its remedy for stalls. It leaves out everything that
// parametrize() adds: guard points, refined rules, blended Hessians, steps longer than Newton's,
// other starts than Tutte's.
//
// Prints one JSON object. `rows` has a row for the start and for each step, with degree, energy (by
// a rule of 252 points) and CPU seconds so far without measurements. `energy` is that of the
// result, integrated adaptively. `stuck`: a step ended at the limit of injectivity far from a
// minimum. `unit_seconds`: 1 fe (unit_fe.h) of the degree-1 matrix of this mesh.
//
// Sample runs:
//   build/release/bench/majorant_paper_method examples/meshes/creature.obj --degree 3
//   build/release/bench/majorant_paper_method examples/meshes/creature.obj --degree 2 --points 55 --direct
//   build/release/bench/majorant_paper_method examples/meshes/creature.obj --degree 2 --rule gauss --points 81
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../unit_fe.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/measure.h"
#include "majorant/parametrization/initialization/start.h"

using namespace majorant;

namespace {

// [MC20] Sec. 4.3, 5.2, 8.3, 8.5; the weight and the number of rounds: method.md section 9.
constexpr double kElevate = 1e-2, kFinished = 1e-5, kSmallestStep = 1e-5, kExcluded = 1e-6;
constexpr int kPoints[] = {1, 36, 78, 105}, kRounds = 60;
// A run held at the limit of injectivity with a decrement above this fraction of the energy is not
// at a minimum, as in StoppingRules::stall_decrement.
constexpr double kMinimum = 1e-4;
constexpr int kTimes = 5;

struct Arguments {
  std::string mesh, rule = "lattice", init = "tutte";
  int degree = 3, points = 0, most_iterations = 500;
  std::vector<Index> pins;
  bool direct = false, exclude = false, fixed = false;
};

// Returns the rule of m^2 Gauss points of the square with one side collapsed into a corner, which
// is exact to degree 2m - 2.
Quadrature collapsed_gauss_rule(int m) {
  const Quadrature line = gauss_rule(m);
  Quadrature rule{{3}, RowMatrix(m * m, 3), Vec(m * m)};
  for (int i = 0, l = 0; i < m; ++i)
    for (int j = 0; j < m; ++j, ++l) {
      const double s = line.points(i, 0), t = (1 - s) * line.points(j, 0);
      rule.points.row(l) << s, t, 1 - s - t;
      rule.weights[l] = 2 * (1 - s) * line.weights[i] * line.weights[j];
    }
  rule.weights /= rule.weights.sum();
  return rule;
}

Quadrature rule_of(const Arguments& arguments, int degree) {
  const int usual = kPoints[std::min<std::size_t>(to_size(degree), std::size(kPoints)) - 1];
  const int points = arguments.points > 0 ? arguments.points : usual;
  const bool gauss = arguments.rule == "gauss";
  int m = 1;
  while ((gauss ? m * m : m * (m + 1) / 2) < points) ++m;
  return gauss ? collapsed_gauss_rule(m) : lattice_rule(m);
}

// The problem of one degree, and its descent.
class Level {
 public:
  Level(const MapSpecification& spec, const BezierMap& map, const Arguments& arguments)
      : spec_(spec),
        map_(map),
        arguments_(arguments),
        fine_(energy_terms(spec, map.shared_space(), {composite_rule(radon_rule(), 6)})),
        built_(map_problem(
            spec, map.shared_space(), map.control_points(),
            energy_terms(spec, map.shared_space(), {rule_of(arguments, map.degree())}),
            std::make_shared<const LocalInjectivity>(map.shared_space(), 2 * spec.rest->measure))),
        stepper_(built_.problem, options()),
        y_(built_.problem.reduce(map.control_points())),
        energy_(stepper_.evaluator().value(y_)) {}

  // Appends rows and adds CPU seconds. Ends at the first step with a relative decrease below
  // `decrease`, as in the paper, and detects `stuck` itself, without the StoppingTest of
  // parametrize().
  void descend(double decrease, nlohmann::json& rows, double& seconds) {
    double began = cpu_seconds();
    for (int rounds = 0; static_cast<int>(rows.size()) <= arguments_.most_iterations;) {
      const Stepper::Step step = stepper_.step(y_, energy_);
      const bool moved = step.outcome == Stepper::Outcome::Moved;
      decrement_ = step.record.newton_decrement;
      const bool held = !moved || step.record.step < kSmallestStep ||
                        (step.record.relative_decrease < decrease && step.record.step_bound < 1);
      if (arguments_.exclude && held && !step.blocking.empty() && rounds++ < kRounds) {
        step_without(step.blocking);
        continue;
      }
      if (moved) note(step.record, rows, seconds, began);
      if (!moved || step.record.relative_decrease < decrease) break;
    }
    seconds += cpu_seconds() - began;
  }

  BezierMap map() const { return map_.with(map_.shared_space(), built_.problem.expand(y_)); }
  bool stuck() const { return decrement_ > kMinimum * energy_; }
  double measured() const { return energy_of_map(spec_, fine_, {}, built_.problem.expand(y_)); }
  // Times a unit matrix with the pattern of this problem's Hessian; the values do not matter.
  double unit_seconds() const {
    const SparsePattern& pattern = built_.problem.pattern();
    Vec values = Vec::Zero(pattern.nonzeros());
    for (Index k = 0; k < pattern.size; ++k) values[pattern.diagonal_slot(k)] = 1;
    return measure_unit_fe(pattern, values, Vec::Ones(pattern.size), kTimes).seconds;
  }

 private:
  static NewtonOptions options() {
    NewtonOptions newton;
    newton.curvature = Curvature::CompositeMajorizer;
    newton.blend.below = 0;
    newton.line_search.most_improvements = 0;
    return newton;
  }

  // Makes one step with the weight kExcluded for these triangles, [MC20] Sec. 4.3.
  void step_without(const std::vector<Index>& blocking) {
    Vec weight = Vec::Ones(map_.space().element_count());
    for (const Index e : blocking) weight[e] = kExcluded;
    set_weights(weight);
    stepper_.step(y_, energy_);
    set_weights({});
  }

  void set_weights(const Vec& weight) {
    stepper_.reset(built_.problem.with(energy_states(spec_, built_.energies, {}, weight)));
    energy_ = stepper_.evaluator().value(y_);
  }

  void note(const IterationRecord& record, nlohmann::json& rows, double& seconds, double& began) {
    seconds += cpu_seconds() - began;
    rows.push_back({{"degree", map_.degree()},
                    {"iteration", rows.size()},
                    {"energy", measured()},
                    {"step", record.step},
                    {"seconds", seconds}});
    began = cpu_seconds();
  }

  const MapSpecification& spec_;
  BezierMap map_;
  const Arguments& arguments_;
  DensityTerms fine_;
  MapProblem built_;
  NewtonStepper stepper_;
  Vec y_;
  double energy_, decrement_ = 0;
};

nlohmann::json run(const Arguments& arguments) {
  const auto mesh =
      std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(arguments.mesh)));
  const Vec uv = arguments.init == "input" ? texture_map(*mesh) : tutte_map(*mesh);
  BezierMap map = BezierMap::linear(mesh, uv);
  MapSpecification spec;
  spec.rest = std::make_shared<const RestShapes>(flat_triangles(mesh->positions(), mesh->faces()));
  if (arguments.fixed) spec.boundary = BoundaryCondition::Fixed;
  for (const Index v : arguments.pins) spec.pins.push_back({v, uv.segment<2>(2 * v)});
  nlohmann::json out{{"faces", mesh->face_count()}, {"rows", nlohmann::json::array()}};
  double seconds = 0;
  {
    Level first(spec, map, arguments);
    out["unit_seconds"] = first.unit_seconds();
    out["rows"].push_back(
        {{"degree", 1}, {"iteration", 0}, {"energy", first.measured()}, {"seconds", 0.0}});
  }
  while (arguments.direct && map.degree() < arguments.degree) map = map.elevated();
  for (;; map = map.elevated()) {
    const bool last = map.degree() == arguments.degree;
    const double began = cpu_seconds();
    Level level(spec, map, arguments);
    seconds += cpu_seconds() - began;
    level.descend(last ? kFinished : kElevate, out["rows"], seconds);
    map = level.map();
    out["stuck"] = level.stuck();
    if (last) break;
  }
  Vec face_value;
  out["energy"] = mean_density(map, *spec.rest, spec.energy, face_value);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("The method of [MC20] as it is written.");
  app.add_option("mesh", arguments.mesh)->required();
  app.add_option("--degree", arguments.degree);
  app.add_option("--points", arguments.points, "of quadrature; 0: 1, 36, 78, 105 by degree");
  app.add_option("--rule", arguments.rule)->check(CLI::IsMember({"lattice", "gauss"}));
  app.add_option("--init", arguments.init)->check(CLI::IsMember({"tutte", "input"}));
  app.add_option("--pins", arguments.pins, "vertices that stay where the start has them")
      ->delimiter(',');
  app.add_option("--max-iterations", arguments.most_iterations);
  app.add_flag("--direct", arguments.direct, "the degree asked for from the start");
  app.add_flag("--exclude", arguments.exclude, "blocking triangles, for a step (Sec. 4.3)");
  app.add_flag("--fixed", arguments.fixed, "the boundary stays");
  CLI11_PARSE(app, argc, argv);
  const ThreadCount threads(1);
  try {
    fmt::print("{}\n", run(arguments).dump(1));
  } catch (const std::exception& e) {
    fmt::print(stderr, "majorant_paper_method: {}\n", e.what());
    return 1;
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
