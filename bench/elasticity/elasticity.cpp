// Solves the problems of the public elasticity suite (README.md) with every curvature filter.
// Prints Markdown tables of iterations, factorizations and solves, counted as in the suite, CPU
// seconds, and the published figures of the suite.
//
// Sample runs:
//   bench/elasticity.py                                          # makes the starts, runs all
//   build/release/bench/elasticity --only boxes --boxes 12
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/constraints/untangling_descent.h"
#include "majorant/framework/parallel.h"
#include "methods.h"
#include "ring.h"

using namespace majorant;
using namespace majorant::elasticity;

namespace {

constexpr double kTolerance = 1e-6;  // bound on the largest entry of the gradient
constexpr int kMaxIterations = 400;
constexpr int kMaxFirstOrder = 1000;

int limit_of(Method method) { return method == Method::Lbfgs ? kMaxFirstOrder : kMaxIterations; }

bool begins_with(const std::string& text, const std::string& part) {
  return text.compare(0, part.size(), part) == 0;
}

// Returns the square that the start belongs to.
Square square_of(const NamedStart& start) {
  int n = 1;
  while ((n + 1) * (n + 1) < start.positions.rows()) ++n;
  return Square(n, 1);
}

// Counts of a method over several problems.
struct Sums {
  int runs = 0, reached = 0, iterations = 0, least = kMaxFirstOrder, most = 0, factorizations = 0,
      solves = 0;
  double cpu_seconds = 0;
  void add(const Counts& counts) {
    ++runs;
    reached += counts.is_reached;
    iterations += counts.iterations;
    least = std::min(least, counts.iterations);
    most = std::max(most, counts.iterations);
    factorizations += counts.factorizations;
    solves += counts.solves;
    cpu_seconds += counts.cpu_seconds;
  }
  double mean(int sum) const { return runs == 0 ? 0 : static_cast<double>(sum) / runs; }
};

constexpr const char* kSumsHeading =
    "iterations, mean [least-most] | factorizations | solves | reached | CPU ms | suite |\n"
    "|---|---|---|---|---|---|---|\n";

void print_sums(const std::string& name, const Sums& sums, const std::string& published) {
  fmt::print("| {} | {:.1f} [{}-{}] | {:.1f} | {:.1f} | {} of {} | {:.1f} | {} |\n", name,
             sums.mean(sums.iterations), sums.least, sums.most, sums.mean(sums.factorizations),
             sums.mean(sums.solves), sums.reached, sums.runs,
             1000 * sums.cpu_seconds / std::max(1, sums.runs), published);
}

void print_disks(const std::vector<NamedStart>& starts) {
  fmt::print("\nSymmetric Dirichlet on squared disks, the boundary fixed\n\n| method | {}",
             kSumsHeading);
  const auto published = [](Method method) {
    if (method == Method::Clamp) return "8.8 [7-11]";
    if (method == Method::PaperMajorizer) return "9.0 [7-11]";
    if (method == Method::Absolute) return "9.0";
    return method == Method::Reweighted ? "5, to an energy tolerance" : "-";
  };
  for (const Method method : kMethods) {
    Sums sums;
    for (const NamedStart& start : starts)
      if (begins_with(start.name, "disk"))
        sums.add(
            run(disk(square_of(start), start.positions), method, kTolerance, limit_of(method)));
    print_sums(method_name(method), sums, published(method));
  }
}

// Prints the two sets of problems of the suite that unfiltered Newton does not solve.
void print_sets(const std::vector<NamedStart>& starts) {
  const auto solved = [](Method method, const char* unfiltered, const char* all) {
    if (method == Method::Blend) return std::string("-");
    return method == Method::Shifted ? fmt::format("unfiltered {}, with shift {}", unfiltered, all)
                                     : std::string(all);
  };
  const Method methods[] = {Method::Clamp, Method::Absolute, Method::Shifted, Method::Blend};
  fmt::print("\n40 disks of 6 to 12 squares a side, symmetric Dirichlet\n\n| method | {}",
             kSumsHeading);
  for (const Method method : methods) {
    Sums sums;
    for (const NamedStart& start : starts)
      if (begins_with(start.name, "set"))
        sums.add(run(disk(square_of(start), start.positions), method, kTolerance, kMaxIterations));
    print_sums(method_name(method), sums, solved(method, "30 of 40", "40 of 40"));
  }
  fmt::print("\n12 squares with one side pulled, neo-Hookean, nu 0.3 to 0.49\n\n| method | {}",
             kSumsHeading);
  for (const Method method : methods) {
    Sums sums;
    for (const int n : {6, 8})
      for (const double nu : {0.3, 0.45, 0.49})
        for (const double stretch : {1.6, 2.2})
          sums.add(run(stretched(Square(n, 1), Material::NeoHookean, nu, Volume::Pointwise, stretch,
                                 Start::MovedEnd),
                       method, kTolerance, kMaxIterations));
    print_sums(method_name(method), sums, solved(method, "5 of 12", "12 of 12"));
  }
}

void print_folds(const std::vector<NamedStart>& starts) {
  fmt::print(
      "\nFolded starts, 12 by 12 squares\n\n"
      "| start | folds | untangling: folds left, steps | stable neo-Hookean, nu 0.45: folds "
      "left, iterations |\n|---|---|---|---|\n");
  int runs = 0, untangled = 0, elastic = 0;
  for (const NamedStart& start : starts) {
    if (!begins_with(start.name, "fold")) continue;
    const Square square(12, 1);
    const Case map = folded_map(square, start.positions);
    const LocalInjectivity injectivity(square.space, 2 * square.rest.measure);
    const UntangledPoint point = descend_untangling(map.problem, {map.problem.terms().front()},
                                                    [&](VecIn x) { return injectivity.check(x); },
                                                    map.start, {.first_eps = kFirstEpsHeld}, {});
    const Case solid = folded_solid(square, start.positions, 0.45);
    const Counts counts = run(solid, Method::Blend, kTolerance, kMaxIterations);
    const int left = folds(square, solid.problem.expand(counts.y));
    ++runs;
    untangled += point.verdict.feasible;
    elastic += left == 0 && counts.is_reached;
    fmt::print("| {} | {} | {}, {} | {}, {} |\n", start.name,
               folds(square, map.problem.expand(map.start)), folds(square, point.x),
               point.iterations, left, counts.iterations);
  }
  fmt::print(
      "| all | | **{} of {}** (suite: TLC 6 of 8, its limit without lifting 1 of 8) "
      "| {} of {} |\n",
      untangled, runs, elastic, runs);
}

struct Published {
  double nu;
  const char* clamp;
  const char* absolute;
};

std::string cell(const Counts& counts) {
  if (counts.is_reached) return fmt::format("{}", counts.iterations);
  if (counts.status == "max_iterations") return fmt::format("more than {}", counts.iterations);
  return fmt::format("{} ({})", counts.iterations, counts.status);
}

template <class MakeCase>
void print_sweep(const std::string& title, const std::vector<Published>& rows,
                 const std::vector<Method>& methods, const MakeCase& make, bool has_projected) {
  fmt::print("\n{}\n\n| nu | suite: clamp | suite: absolute |", title);
  for (const Method method : methods) fmt::print(" {} |", method_name(method));
  fmt::print(" Gauss-Newton of the volume | its factorizations, solves |{}\n",
             has_projected ? " mean dilatation |" : "");
  fmt::print("|---|---|---|");
  for (std::size_t k = 0; k < methods.size(); ++k) fmt::print("---|");
  fmt::print("---|---|{}\n", has_projected ? "---|" : "");
  for (const Published& row : rows) {
    fmt::print("| {} | {} | {} |", row.nu, row.clamp, row.absolute);
    const Case pointwise = make(row.nu, Volume::Pointwise);
    for (const Method method : methods)
      fmt::print(" {} |", cell(run(pointwise, method, kTolerance, limit_of(method))));
    const Counts volume =
        run(make(row.nu, Volume::GaussNewton), Method::Blend, kTolerance, kMaxIterations);
    fmt::print(" {} | {}, {} |", cell(volume), volume.factorizations, volume.solves);
    if (has_projected)
      fmt::print(" {} |", cell(run(make(row.nu, Volume::Projected), Method::Blend, kTolerance,
                                   kMaxIterations)));
    fmt::print("\n");
    std::fflush(stdout);
  }
}

void print_plane() {
  const std::vector<Method> methods{Method::Clamp, Method::Absolute, Method::Adaptive,
                                    Method::Lbfgs, Method::Shifted,  Method::Blend};
  const auto block = [](int degree, Material material) {
    return [square = Square(8, degree), material](double nu, Volume volume) {
      return stretched(square, material, nu, volume, 2.0, Start::Affine);
    };
  };
  print_sweep("Poisson's ratio in the plane, degree 1 (locks), neo-Hookean, 8 by 8, stretch 2",
              {{0.3, "4", "4"},
               {0.45, "9", "9"},
               {0.49, "44", "79"},
               {0.499, "139", "314"},
               {0.4999, "242", "more than 400"}},
              methods, block(1, Material::NeoHookean), false);
  print_sweep("The same, degree 2 (suite's trust region: 4, 8, 11, 23, 39)",
              {{0.3, "4", "4"},
               {0.45, "9", "8"},
               {0.49, "15", "15"},
               {0.499, "23", "23"},
               {0.4999, "53", "41"}},
              methods, block(2, Material::NeoHookean), true);
  print_sweep("The same, degree 2, stable neo-Hookean",
              {{0.3, "5", "5"},
               {0.45, "9", "9"},
               {0.49, "15", "13"},
               {0.499, "24", "23"},
               {0.4999, "48", "38"},
               {0.49999, "-", "-"}},
              methods, block(2, Material::StableNeoHookean), true);
}

void print_space(int n) {
  const std::vector<Method> methods{Method::Clamp, Method::Absolute, Method::Adaptive,
                                    Method::Blend};
  const auto block = [](int cubes, int degree) {
    return [cube = Cube(cubes, degree)](double nu, Volume volume) {
      return stretched(cube, Material::NeoHookean, nu, volume, 1.3, Start::MovedEnd);
    };
  };
  print_sweep(
      "Poisson's ratio in space, 4 by 4 by 4 cubes, 384 tetrahedra, degree 1 (locks), "
      "stretch 1.3",
      {{0.3, "4", "4"}, {0.45, "7", "7"}, {0.49, "18", "27"}, {0.499, "267", "300"}}, methods,
      block(4, 1), false);
  print_sweep("The same, degree 2",
              {{0.3, "5", "5"},
               {0.45, "7", "7"},
               {0.49, "11", "9"},
               {0.499, "19", "17"},
               {0.4999, "-", "-"}},
              methods, block(4, 2), true);
  if (n >= 12)
    print_sweep("Poisson's ratio in space, 10,368 tetrahedra, degree 1 (locks), stretch 1.3",
                {{0.3, "5", "5"}, {0.45, "8", "7"}, {0.49, "14", "17"}, {0.499, "93", "172"}},
                {Method::Clamp, Method::Blend}, block(12, 1), false);
}

void print_boxes(int largest) {
  fmt::print(
      "\nNeo-Hookean boxes of straight tetrahedra, lambda = mu = 1, stretch 1.4\n\n"
      "| tetrahedra | unknowns | method | iterations | factorizations | solves | CPU s "
      "| suite: iterations, wall s |\n|---|---|---|---|---|---|---|---|\n");
  const struct {
    int n;
    const char* published;
  } boxes[] = {{8, "4, 0.6"},   {12, "4, 2.8"},   {16, "4, 10.8"},
               {20, "4, 36.3"}, {24, "4, 110.0"}, {28, "5, 834.2"}};
  for (const auto& box : boxes) {
    if (box.n > largest) break;
    const Cube cube(box.n, 1);
    const Case c =
        stretched(cube, Material::NeoHookean, 0.25, Volume::Pointwise, 1.4, Start::MovedEnd);
    for (const Method method : {Method::Clamp, Method::Blend}) {
      const Counts counts = run(c, method, kTolerance, kMaxIterations);
      fmt::print("| {} | {} | {} | {} | {} | {} | {:.1f} | {} |\n", cube.cells.rows(),
                 c.problem.size(), method_name(method), cell(counts), counts.factorizations,
                 counts.solves, counts.cpu_seconds, box.published);
      std::fflush(stdout);
    }
  }
}

void print_ring(int largest) {
  fmt::print(
      "\nA thick ring pushed from inside, stable neo-Hookean with a projected dilatation, Newton's "
      "method with default options; error and largest jump of the pressure at nu 0.49999, in parts "
      "of its range\n\n"
      "| element, degree of the pressure | elements | unknowns | iterations at nu 0.3 "
      "| at 0.49999 | error % | jump % |\n|---|---|---|---|---|---|---|\n");
  for (const RingElement& element : ring_elements())
    for (int n = 4; n <= std::min(largest, element.is_solid ? 16 : 32); n *= 2) {
      const RingResult soft = solve_ring(element, n, 0.3), stiff = solve_ring(element, n, 0.49999);
      const auto steps = [](const RingResult& r) {
        return fmt::format("{}{}", r.iterations, r.has_converged ? "" : " (not converged)");
      };
      fmt::print("| {}, {} | {} | {} | {} | {} | {:.2f} | {:.2f} |\n", element.name,
                 element.pressure_degree, stiff.elements, stiff.unknowns, steps(soft), steps(stiff),
                 100 * stiff.error, 100 * stiff.jump);
      std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> only;
  std::string starts_path;
  int largest = 28;
  CLI::App app("The public elasticity suite by every filter of curvature");
  app.add_option("--only", only, "of disks, sets, folds, ring, plane, space, boxes")
      ->delimiter(',');
  app.add_option("--starts", starts_path, "disks and folded starts, by bench/elasticity.py");
  app.add_option("--boxes", largest, "cubes a side of the largest box, elements across the ring");
  CLI11_PARSE(app, argc, argv);
  const ThreadCount one(1);
  const auto is_selected = [&only](const char* part) {
    return only.empty() || std::find(only.begin(), only.end(), part) != only.end();
  };
  try {
    std::vector<NamedStart> starts;
    if (!starts_path.empty()) starts = read_starts(starts_path);
    if (is_selected("disks")) print_disks(starts);
    if (is_selected("sets")) print_sets(starts);
    if (is_selected("folds")) print_folds(starts);
    if (is_selected("ring")) print_ring(largest);
    if (is_selected("plane")) print_plane();
    if (is_selected("space")) print_space(largest);
    if (is_selected("boxes")) print_boxes(largest);
  } catch (const std::exception& e) {
    fmt::print(stderr, "elasticity: {}\n", e.what());
    return 1;
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
