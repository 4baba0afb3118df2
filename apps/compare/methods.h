// The methods of `majorant compare`, by name.
//
// To add a method, add a line to methods.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "apps/compare/benchmark_problem.h"

namespace majorant::app {

struct Method {
  std::string name, summary;
  std::function<ComparisonMethod(const BenchmarkProblem&)> on;
  // Loads the plugin that the method needs; throws Error if that fails. Null: no plugin is needed.
  void (*load)() = nullptr;
  bool is_default = true;  // false: only runs if it is named
};

std::span<const Method> methods();
const Method* find_method(const std::string& name);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
