#include "apps/energy_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include "apps/arguments/suggestion.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/maps/map_problem.h"

namespace majorant::app {
namespace {

[[noreturn]] void refuse(const std::string& expression, const std::string& problem) {
  throw Error(ErrorKind::Usage, fmt::format("--energy '{}': {}", expression, problem));
}

std::string trimmed(const std::string& text) {
  const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto first = std::find_if_not(text.begin(), text.end(), space);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), space).base();
  return first < last ? std::string(first, last) : std::string();
}

// A leading "number *" is taken off `text`; 1 when there is none.
double take_weight(std::string& text, const std::string& expression) {
  const std::size_t star = text.find('*');
  if (star == std::string::npos) return 1.0;
  const std::string number = trimmed(text.substr(0, star));
  double weight = 0;
  const char* end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, weight);
  if (error != std::errc() || stop != end || !is_usable_weight(weight))
    refuse(expression, fmt::format("'{}' is not a positive number in {:g}..{:g}", number,
                                   1 / kLargestFactor, kLargestFactor));
  text = trimmed(text.substr(star + 1));
  return weight;
}

std::vector<std::string> summands(const std::string& text) {
  std::vector<std::string> out(1);
  for (std::size_t k = 0; k < text.size(); ++k) {
    // The sign of an exponent, 1e+3, is not a sum.
    const bool exponent = k >= 2 && (text[k - 1] == 'e' || text[k - 1] == 'E') &&
                          std::isdigit(static_cast<unsigned char>(text[k - 2]));
    if (text[k] == '+' && !exponent)
      out.emplace_back();
    else
      out.back() += text[k];
  }
  for (std::string& summand : out) summand = trimmed(summand);
  return out;
}

const char* in_words(Barrier barrier) {
  if (barrier == Barrier::None) return "no barrier";
  return barrier == Barrier::Weak ? "barrier" : "strong barrier";
}

}  // namespace

EnergySum parse_energy(const std::string& expression) {
  EnergySum sum;
  for (std::string text : summands(expression)) {
    const double weight = take_weight(text, expression);
    const NamedEnergy* energy = find_energy(text);
    if (!energy) {
      std::vector<std::string> names;
      for (const NamedEnergy& e : named_energies()) names.push_back(e.name);
      refuse(expression, fmt::format("no energy is called '{}'{}; use {}, or a sum like "
                                     "'symmetric-dirichlet + 0.1*asap'",
                                     text, did_you_mean(text, names), fmt::join(names, ", ")));
    }
    sum.push_back({energy->make, weight});
  }
  return sum;
}

std::string energy_help() {
  std::string text = "Energies (sums such as 'symmetric-dirichlet + 0.1*asap' too):\n";
  for (const NamedEnergy& e : named_energies())
    text += fmt::format("  {:<20} {}; {}\n", e.name, e.summary, in_words(e.make.traits().barrier));
  return text;
}

}  // namespace majorant::app
