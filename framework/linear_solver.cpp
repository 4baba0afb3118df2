#include "majorant/framework/linear_solver.h"

#include <cmath>

namespace majorant {

ShiftedFactorization factorize_shifted(LinearSolver& solver, const SparsePattern& pattern,
                                       const Vec& values, double smallest_shift) {
  ShiftedFactorization result;
  double diagonal = 0;
  for (Index c = 0; c < pattern.size; ++c)
    diagonal += std::abs(values[pattern.column_starts[static_cast<std::size_t>(c)]]);
  diagonal /= pattern.size;
  if (pattern.size > 0 && !std::isfinite(diagonal)) return result;
  double shift = 0;
  for (int attempt = 0; attempt < 24; ++attempt) {
    result.status = solver.factorize(values, shift);
    result.shift = shift;
    if (result.status != FactorStatus::NotPositiveDefinite) break;
    shift = shift == 0 ? smallest_shift * diagonal : 10 * shift;
  }
  return result;
}

}  // namespace majorant
