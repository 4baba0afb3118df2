#include "apps/energy_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "apps/arguments/suggestion.h"
#include "majorant/framework/error.h"
#include "majorant/maps/energy_text.h"
#include "majorant/maps/map_problem.h"

namespace majorant::app {
namespace {

[[noreturn]] void refuse(const std::string& expression, const std::string& problem) {
  throw Error(ErrorKind::Usage, fmt::format("--energy '{}': {}", expression, problem));
}

double usable_weight(const EnergyWord& word, const std::string& expression) {
  if (!word.weight) return 1.0;
  const std::optional<double> weight = parse_energy_weight(*word.weight);
  if (!weight || !is_usable_weight(*weight))
    refuse(expression, fmt::format("'{}' is not a positive number in {:g}..{:g}", *word.weight,
                                   1 / kLargestFactor, kLargestFactor));
  return *weight;
}

const char* in_words(Barrier barrier) {
  if (barrier == Barrier::None) return "no barrier";
  return barrier == Barrier::Weak ? "barrier" : "strong barrier";
}

}  // namespace

EnergySum parse_energy(const std::string& expression, std::span<const NamedEnergy> energies) {
  EnergySum sum;
  for (const EnergyWord& word : split_energy_text(expression)) {
    const double weight = usable_weight(word, expression);
    const auto energy = std::find_if(energies.begin(), energies.end(),
                                     [&](const NamedEnergy& e) { return e.name == word.name; });
    if (energy == energies.end()) {
      std::vector<std::string> names;
      for (const NamedEnergy& e : energies) names.push_back(e.name);
      refuse(expression, fmt::format("no energy is called '{}'{}; use {}, or a sum like "
                                     "'symmetric-dirichlet + 0.1*{}'",
                                     word.name, did_you_mean(word.name, names),
                                     fmt::join(names, ", "), names[1]));
    }
    sum.push_back({energy->make, weight});
  }
  return sum;
}

std::string energy_help(std::span<const NamedEnergy> energies) {
  std::string text = fmt::format("Energies (sums such as 'symmetric-dirichlet + 0.1*{}' too):\n",
                                 energies[1].name);
  for (const NamedEnergy& e : energies)
    text += fmt::format("  {:<20} {}; {}\n", e.name, e.summary, in_words(e.make.traits().barrier));
  return text;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
