#include "majorant/elements/bernstein_basis.h"

#include <algorithm>
#include <numeric>

#include "majorant/elements/internal/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/argument_check.h"
#include "majorant/framework/internal/rounding.h"

namespace majorant {
namespace {

double exact(double integer) {
  if (!(integer < kExactIntegers))
    throw InvalidArgument("BernsteinBasis: degree too high for exact weights");
  return integer;
}

// (e_0 + e_1 + ...)! / (e_0! e_1! ...).
double multinomial(const int* e, int size) {
  double out = 1;
  for (int k = 0, total = 0; k < size; ++k)
    for (int j = 1; j <= e[k]; ++j) out = exact(out * ++total) / j;
  return out;
}

}  // namespace

BernsteinBasis::BernsteinBasis(Factors factors, std::vector<Exponents> functions)
    : factors_(std::move(factors)),
      coordinates_(std::accumulate(factors_.begin(), factors_.end(), 0)),
      functions_(std::move(functions)) {
  if (coordinates_ > static_cast<int>(Exponents{}.size()))
    throw InvalidArgument("BernsteinBasis: cell with too many coordinates");
  for (int k = 0; k < count(); ++k) {
    double weight = 1;
    const int* e = exponents(k).data();
    for (const int corners : factors_) {
      weight = exact(weight * multinomial(e, corners));
      e += corners;
    }
    weights_.push_back(weight);
    lookup_.emplace(exponents(k), k);
  }
}

int BernsteinBasis::find(const Exponents& e) const {
  const auto found = lookup_.find(e);
  return found == lookup_.end() ? -1 : found->second;
}

bool BernsteinBasis::is_corner(int k) const {
  const int* e = exponents(k).data();
  for (const int corners : factors_) {
    if (*std::max_element(e, e + corners) != std::accumulate(e, e + corners, 0)) return false;
    e += corners;
  }
  return true;
}

Vec BernsteinBasis::values(VecIn point) const {
  Index columns = 0;
  for (const int corners : factors_) columns += corners == 2 ? 1 : corners;
  require_size("BernsteinBasis::values: the point", point.size(), columns);
  std::array<double, Exponents{}.size()> x{};
  Index from = 0;
  std::size_t to = 0;
  for (const int corners : factors_)
    if (corners == 2) {  // a segment, given by one number
      x[to++] = 1 - point[from];
      x[to++] = point[from++];
    } else {
      for (int k = 0; k < corners; ++k) x[to++] = point[from++];
    }
  Vec b(count());
  for (int k = 0; k < count(); ++k) {
    b[k] = weight(k);
    for (std::size_t c = 0; c < to; ++c) b[k] *= integer_power(x[c], exponents(k)[c]);
  }
  return b;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
