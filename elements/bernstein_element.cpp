#include "majorant/elements/bernstein_element.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

// Of the degree `degree` on a simplex: (degree + corners - 1)! / (degree! (corners - 1)!).
int function_count(int corners, int degree) {
  int count = 1;
  for (int k = 1; k < corners; ++k) count = count * (degree + k) / k;
  return count;
}

bool has_degrees(const Factors& factors, const Degrees& degrees, const Exponents& e) {
  auto at = e.begin();
  for (std::size_t f = 0; f < factors.size(); at += factors[f++])
    if (std::accumulate(at, at + factors[f], 0) != degrees[f]) return false;
  return *std::min_element(e.begin(), e.end()) >= 0;
}

}  // namespace

int BernsteinElement::corner_count() const {
  int count = 1;
  for (const int corners : factors) count *= corners;
  return count;
}

int BernsteinElement::coordinate_count() const {
  return std::accumulate(factors.begin(), factors.end(), 0);
}

std::vector<Exponents> BernsteinElement::functions(const Degrees& of) const {
  std::vector<Exponents> out = lattice(of);
  std::size_t expected = 1;
  for (std::size_t f = 0; f < of.size(); ++f)
    expected *= to_size(function_count(factors[f], of[f]));
  const bool all = std::all_of(out.begin(), out.end(),
                               [&](const Exponents& e) { return has_degrees(factors, of, e); });
  if (!all || out.size() != expected || std::set(out.begin(), out.end()).size() != expected)
    throw InvalidArgument(
        fmt::format("{}: lattice({}) must be the {} functions of these degrees, each once", name,
                    fmt::join(of, ", "), expected));
  return out;
}

double BernsteinElement::measure() const {
  double measure = 1;
  for (const int corners : factors)
    for (int k = 2; k < corners; ++k) measure /= k;
  return measure;
}

int BernsteinElement::factor_of(int coordinate) const {
  int factor = 0;
  while (coordinate >= factors[factor]) coordinate -= factors[factor++];
  return factor;
}

Degrees BernsteinElement::lowered(int factor) const {
  Degrees d = degrees();
  --d[factor];
  return d;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
