#include "majorant/framework/curvature_choice.h"
#include "majorant/framework/energy_term.h"

namespace majorant {

std::string_view curvature_name(Curvature curvature) {
  switch (curvature) {
    case Curvature::Projected:
      return "projected";
    case Curvature::Majorizer:
      return "majorizer";
    case Curvature::CompositeMajorizer:
      return "paper-majorizer";
    case Curvature::Exact:
      return "exact";
    case Curvature::Reweighted:
      return "reweighted";
  }
  return "unknown";
}

namespace {

constexpr std::string_view kAbsolute = "absolute", kAdaptive = "adaptive";

}  // namespace

std::vector<std::string> curvature_choices() {
  std::vector<std::string> names;
  for (const Curvature c : kCurvatures) names.emplace_back(curvature_name(c));
  names.emplace_back(kAbsolute);
  names.emplace_back(kAdaptive);
  return names;
}

std::optional<CurvatureChoice> curvature_choice(std::string_view name) {
  for (const Curvature c : kCurvatures)
    if (curvature_name(c) == name) return c;
  CurvatureChoice choice;
  if (name == kAbsolute) {
    choice.projection = 2;
  } else if (name == kAdaptive) {
    choice.adaptive.tolerance = 0.1;
  } else {
    return {};
  }
  return choice;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
