// The curvature models of a Newton step, and what lies between the projected and the exact Hessian.
//
//   Vec g, h;
//   Evaluator evaluator(problem);
//   evaluator.linearize(y0, Curvature::Projected, g, h);
//   evaluator.linearize(y0, BlendedCurvature::projected(0.1), g, h);   // t = 1/10
//
// No includes, nothing but aggregates and inlined functions: kernels compiled for special
// instruction sets see this file.
//
// Not for asking what a term can do: it says that itself (EnergyTerm::supports()).
#pragma once

namespace majorant {

// The symmetric matrix that stands for the second derivatives. It is passed by argument, never
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

// A model and how much of it: where the projection takes away a part -l of an eigenvalue l < 0 of
// the exact Hessian at a quadrature point, this takes away projection_weight times that, so that
//     H = H_exact + projection_weight (H_projected - H_exact).
// A projection_weight of 0 is the exact Hessian, 1 the projected one, 2 that of the absolute values
// of the eigenvalues; below 1 H may be indefinite. Other models have no such part: they are what
// they are. A projection that is no clamping of eigenvalues, as that of least squares, ends at 1.
struct BlendedCurvature {
  Curvature model = Curvature::Projected;
  double projection_weight = 1;  // in [0, 2]; 0 for Exact, 1 for all but Projected

  // Implicit: wherever a blend is asked for, a model will do.
  [[gnu::always_inline]] constexpr BlendedCurvature(Curvature whole)
      : model(whole), projection_weight(whole == Curvature::Exact ? 0 : 1) {}
  [[gnu::always_inline]] static constexpr BlendedCurvature projected(double projection_weight) {
    BlendedCurvature blend(projection_weight > 0 ? Curvature::Projected : Curvature::Exact);
    blend.projection_weight = projection_weight;
    return blend;
  }
  // The eigenvalue of the blend for one of the exact Hessian; for terms that know theirs.
  [[gnu::always_inline]] constexpr double clamped(double eigenvalue) const {
    return eigenvalue < 0 ? (1 - projection_weight) * eigenvalue : eigenvalue;
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
