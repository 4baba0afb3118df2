// The methods that `majorant compare` knows, by name.
//
// To add one: a line in methods.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "apps/compare/contest.h"

namespace majorant::app {

struct Method {
  std::string name, summary;
  std::function<ComparisonMethod(const Contest&)> on;
  // Loads the plugin that it needs; throws Error where that cannot be had. None: it needs none.
  void (*load)() = nullptr;
  bool is_default = true;  // false: runs where it is asked for by name
};

std::span<const Method> methods();
const Method* find_method(const std::string& name);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
