// The curvature models of a Newton step. No includes: kernels compiled for special instruction sets
// see this file.
#pragma once

namespace majorant {

// Which symmetric matrix stands for the second derivatives. Passed by argument, never stored in an
// energy. Only Exact may be indefinite.
enum class Curvature {
  Projected,       // exact Hessian per quadrature point, negative eigenvalues set to 0
  Majorizer,       // composite majorizer in the (alpha, beta) frame, method.md section 5
  PaperMajorizer,  // [MC20] Eq. 11 with its sign corrected
  Exact,
  Reweighted,  // SLIM's proxy [RPPSH17]
};
inline constexpr Curvature kCurvatures[] = {Curvature::Projected, Curvature::Majorizer,
                                            Curvature::PaperMajorizer, Curvature::Exact,
                                            Curvature::Reweighted};

}  // namespace majorant
