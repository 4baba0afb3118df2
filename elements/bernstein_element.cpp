#include "majorant/elements/bernstein_element.h"

namespace majorant {

int BernsteinElement::corner_count() const {
  int count = 1;
  for (const int corners : factors) count *= corners;
  return count;
}

double BernsteinElement::measure() const {
  double measure = 1;
  for (const int corners : factors)
    for (int k = 2; k < corners; ++k) measure /= k;
  return measure;
}

int BernsteinElement::factor_of(int coordinate) const {
  int factor = 0;
  while (coordinate >= factors[static_cast<std::size_t>(factor)])
    coordinate -= factors[static_cast<std::size_t>(factor++)];
  return factor;
}

Degrees BernsteinElement::lowered(int factor) const {
  Degrees d = degrees();
  --d[static_cast<std::size_t>(factor)];
  return d;
}

}  // namespace majorant
