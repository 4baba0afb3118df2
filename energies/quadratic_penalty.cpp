#include "majorant/energies/quadratic_penalty.h"

#include <algorithm>
#include <stdexcept>

namespace majorant {

QuadraticPenalty::QuadraticPenalty(const Constraint& constraint) {
  ConstraintRows rows;
  constraint.append_rows(rows);
  const auto count = static_cast<Index>(rows.size());
  Index longest = 1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows.begin(r) == rows.end(r))
      throw std::invalid_argument("QuadraticPenalty: a row without unknowns: " + rows.label(r));
    longest = std::max(longest, static_cast<Index>(rows.end(r) - rows.begin(r)));
  }
  stencils_.nodes.resize(count, longest);
  coefficients_.setZero(count, longest);
  rhs_.resize(count);
  for (Index r = 0; r < count; ++r) {
    const auto row = static_cast<std::size_t>(r);
    stencils_.nodes.row(r).setConstant(rows.begin(row)->unknown);
    Index k = 0;
    for (const auto* e = rows.begin(row); e != rows.end(row); ++e, ++k) {
      stencils_.nodes(r, k) = e->unknown;
      coefficients_(r, k) = static_cast<double>(e->coefficient);
    }
    rhs_[r] = rows.rhs(row);
  }
}

double QuadraticPenalty::residual(VecIn x, Index row) const {
  double sum = -rhs_[row];
  for (Index k = 0; k < coefficients_.cols(); ++k)
    sum += coefficients_(row, k) * x[stencils_.nodes(row, k)];
  return sum;
}

void QuadraticPenalty::values(VecIn x, const Chunk& chunk, const TermState&, Workspace&,
                              std::span<double> f) const {
  for (std::size_t p = 0; p < chunk.elements.size(); ++p) {
    const double r = residual(x, chunk.elements[p]);
    f[p] = r * r;
  }
}

void QuadraticPenalty::local(VecIn x, const Chunk& chunk, Curvature, const TermState&, Workspace&,
                             LocalSystem& out) const {
  constexpr int stride = LocalSystem::stride;
  const auto columns = static_cast<int>(coefficients_.cols());
  for (std::size_t p = 0; p < chunk.elements.size(); ++p) {
    const Index row = chunk.elements[p];
    const double r = residual(x, row);
    out.value[p] = r * r;
    for (int i = 0, k = 0; i < columns; ++i) {
      out.gradient[static_cast<std::size_t>(i * stride) + p] = 2 * r * coefficients_(row, i);
      if (!out.hessian) continue;
      for (int j = 0; j <= i; ++j, ++k)
        out.hessian[static_cast<std::size_t>(k * stride) + p] =
            2 * coefficients_(row, i) * coefficients_(row, j);
    }
  }
}

}  // namespace majorant
