// The methods that `majorant compare` knows, by name.
//
// To add one: a line in methods.cpp.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "majorant/framework/minimizer.h"
#include "majorant/maps/map_problem.h"

namespace majorant::app {

// One problem, as every method gets it.
struct Contest {
  MapSpecification specification;
  std::string energy;  // as asked
  std::shared_ptr<const BezierTriangleSpace> space;
  Quadrature rule;
  std::shared_ptr<const FeasibilityChecker> injectivity;
  Vec start;  // full unknowns
  Problem problem;
  double tolerance = 1e-9;  // relative decrease; see StoppingRules
  int max_iterations = StoppingRules().max_iterations;
  StopCheck stop;  // ends a method in the middle of an iteration
};

struct Method {
  std::string name, summary;
  // Why the contest is not for this method; empty when it is. None: every contest is.
  std::function<std::string(const Contest&)> obstacle;
  std::function<std::unique_ptr<Minimizer>(const Contest&)> make;
  // Loads the plugin that it needs; throws Error where that cannot be had. None: it needs none.
  void (*load)() = nullptr;
};

std::span<const Method> methods();
const Method* find_method(const std::string& name);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
