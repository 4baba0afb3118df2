#include "majorant/framework/linear_solver.h"

#include <cmath>

namespace majorant {

double mean_diagonal(const SparsePattern& pattern, const Vec& values) {
  double sum = 0;
  for (Index c = 0; c < pattern.size; ++c) sum += std::abs(values[pattern.column_starts[at(c)]]);
  return sum / pattern.size;
}

ShiftedFactorization factorize_shifted(LinearSolver& solver, const SparsePattern& pattern,
                                       const Vec& values, double smallest_shift,
                                       const StopCheck& stop) {
  ShiftedFactorization result;
  const double diagonal = mean_diagonal(pattern, values);
  if (pattern.size > 0 && !std::isfinite(diagonal)) return result;
  double shift = 0;
  for (int attempt = 0; attempt < 24; ++attempt) {
    stop.poll();
    result.status = solver.factorize(values, shift);
    result.shift = shift;
    if (result.status != FactorStatus::NotPositiveDefinite) break;
    shift = shift == 0 ? smallest_shift * diagonal : 10 * shift;
  }
  return result;
}

}  // namespace majorant
