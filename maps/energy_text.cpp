#include "majorant/maps/energy_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "majorant/energies/energy_factory.h"

namespace majorant {
namespace {

std::string trimmed(std::string_view text) {
  const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto first = std::find_if_not(text.begin(), text.end(), space);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), space).base();
  return first < last ? std::string(first, last) : std::string();
}

EnergyWord split_weight(std::string_view summand) {
  const std::size_t star = summand.find('*');
  if (star == std::string_view::npos) return {{}, trimmed(summand)};
  return {trimmed(summand.substr(0, star)), trimmed(summand.substr(star + 1))};
}

}  // namespace

std::vector<EnergyWord> split_energy_text(std::string_view text) {
  std::vector<EnergyWord> words;
  std::size_t start = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    // The sign of an exponent, as in 1e+3, does not separate summands.
    const bool exponent = k >= 2 && (text[k - 1] == 'e' || text[k - 1] == 'E') &&
                          std::isdigit(static_cast<unsigned char>(text[k - 2])) != 0;
    if (text[k] != '+' || exponent) continue;
    words.push_back(split_weight(text.substr(start, k - start)));
    start = k + 1;
  }
  words.push_back(split_weight(text.substr(start)));
  return words;
}

std::optional<double> parse_energy_weight(std::string_view text) {
  double weight = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, weight);
  if (error != std::errc() || stop != end || !(weight > 0) || !std::isfinite(weight)) return {};
  return weight;
}

std::optional<EnergySum> find_energy_sum(std::string_view text) {
  EnergySum sum;
  for (const EnergyWord& word : split_energy_text(text)) {
    const NamedEnergy* energy = find_energy(word.name);
    const std::optional<double> weight =
        word.weight ? parse_energy_weight(*word.weight) : std::optional(1.0);
    if (!energy || !weight) return {};
    sum.push_back({energy->make, *weight});
  }
  return sum;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
