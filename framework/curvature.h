// The curvature models of a Newton step, and what lies between the projected and the exact Hessian.
//
//   Vec g, h;
//   Evaluator evaluator(problem);
//   evaluator.linearize(y0, Curvature::Projected, g, h);
//   evaluator.linearize(y0, BlendedCurvature::projected(0.1), g, h);   // t = 1/10
//
// This file includes nothing and holds only aggregates and inlined functions, because kernels
// compiled for special instruction sets include it.
//
// EnergyTerm::supports() returns whether a term supports a model.
#pragma once

namespace majorant {

// The symmetric matrix that replaces the second derivatives. It is passed as an argument, never
// stored in an energy. Only Exact may be indefinite.
enum class Curvature {
  Projected,           // exact Hessian per quadrature point, negative eigenvalues set to 0
  Majorizer,           // least convex majorizer in the (alpha, beta) frame, method.md section 5
  CompositeMajorizer,  // [MC20] Eq. 11, sign corrected; named paper-majorizer
  Exact,
  Reweighted,  // SLIM's proxy [RPPSH17]
};
inline constexpr Curvature kCurvatures[] = {Curvature::Projected, Curvature::Majorizer,
                                            Curvature::CompositeMajorizer, Curvature::Exact,
                                            Curvature::Reweighted};

// A model and the weight of its projection. Where the projection removes a part -l of an eigenvalue
// l < 0 of the exact Hessian at a quadrature point, the blend removes projection_weight times that:
//     H = H_exact + projection_weight (H_projected - H_exact).
// A weight of 0 gives the exact Hessian, 1 the projected one, and 2 the absolute values of the
// eigenvalues; below 1, H may be indefinite. Other models ignore the weight. A projection that does
// not clamp eigenvalues, such as that of least squares, counts at most 1.
struct BlendedCurvature {
  Curvature model = Curvature::Projected;
  double projection_weight = 1;  // in [0, 2]; 0 for Exact, 1 for all but Projected

  // Implicit, so that a model can be passed as a blend.
  [[gnu::always_inline]] constexpr BlendedCurvature(Curvature whole)
      : model(whole), projection_weight(whole == Curvature::Exact ? 0 : 1) {}
  [[gnu::always_inline]] static constexpr BlendedCurvature projected(double projection_weight) {
    BlendedCurvature blend(projection_weight > 0 ? Curvature::Projected : Curvature::Exact);
    blend.projection_weight = projection_weight;
    return blend;
  }
  // Returns the blend's eigenvalue for an eigenvalue of the exact Hessian; for terms that know
  // theirs.
  [[gnu::always_inline]] constexpr double clamped(double eigenvalue) const {
    return eigenvalue < 0 ? (1 - projection_weight) * eigenvalue : eigenvalue;
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
