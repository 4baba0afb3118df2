// Compiled for the machine that it runs on, so nothing here may be inline in other files.
#include "condensation_kernels.h"

namespace majorant::condensation {
namespace {

typedef double Lanes __attribute__((vector_size(8 * kLanes), aligned(8)));

Lanes load(const double* p) { return *reinterpret_cast<const Lanes*>(p); }
void store(double* p, Lanes v) { *reinterpret_cast<Lanes*>(p) = v; }

}  // namespace

bool eliminate(int inner, int outer, int count, double* panel, const int* slots, double* values) {
  const int rows = inner + outer;
  const auto at = [&](int r, int c) { return panel + kLanes * (c * rows + r); };
  for (int c = 0; c < inner; ++c) {
    for (int k = 0; k < c; ++k) {
      const Lanes factor = load(at(c, k));
      for (int r = c; r < rows; ++r) store(at(r, c), load(at(r, c)) - load(at(r, k)) * factor);
    }
    const Lanes pivot = load(at(c, c));
    Lanes root;
    for (int l = 0; l < kLanes; ++l) {
      if (l < count && !(pivot[l] > 0)) return false;
      root[l] = __builtin_sqrt(pivot[l]);
    }
    const Lanes inverse = 1.0 / root;
    store(at(c, c), root);
    for (int r = c + 1; r < rows; ++r) store(at(r, c), load(at(r, c)) * inverse);
  }
  for (int c = inner; c < rows; ++c)
    for (int r = c; r < rows; ++r, slots += kLanes) {
      Lanes sum{};
      for (int k = 0; k < inner; ++k) sum += load(at(r, k)) * load(at(c, k));
      for (int l = 0; l < count; ++l) values[slots[l]] -= sum[l];
    }
  return true;
}

void forward(int inner, int outer, const double* panel, double* x, double* y) {
  const int rows = inner + outer;
  for (int r = 0; r < outer; ++r) store(y + kLanes * r, Lanes{});
  for (int c = 0; c < inner; ++c) {
    const double* column = panel + kLanes * c * rows;
    const Lanes value = load(x + kLanes * c) / load(column + kLanes * c);
    store(x + kLanes * c, value);
    for (int r = c + 1; r < inner; ++r)
      store(x + kLanes * r, load(x + kLanes * r) - load(column + kLanes * r) * value);
    for (int r = 0; r < outer; ++r)
      store(y + kLanes * r, load(y + kLanes * r) + load(column + kLanes * (inner + r)) * value);
  }
}

void backward(int inner, int outer, const double* panel, double* x, const double* y) {
  const int rows = inner + outer;
  for (int c = inner; c-- > 0;) {
    const double* column = panel + kLanes * c * rows;
    Lanes sum = load(x + kLanes * c);
    for (int r = c + 1; r < inner; ++r) sum -= load(column + kLanes * r) * load(x + kLanes * r);
    for (int r = 0; r < outer; ++r)
      sum -= load(column + kLanes * (inner + r)) * load(y + kLanes * r);
    store(x + kLanes * c, sum / load(column + kLanes * c));
  }
}

}  // namespace majorant::condensation

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
