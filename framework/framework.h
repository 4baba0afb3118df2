// All of the sparse optimization without meshes: problems of small energy terms, exact elimination
// of linear constraints, checkers that every step obeys, and minimizers.
//
//   const Problem problem = builder.build();
//   const NewtonMinimizer newton(NewtonOptions{});
//   const SolveResult result = newton.minimize(problem, y0, {});
//
// The parts of a problem:
//     types.h                     vectors, matrices, indices
//     error.h                     the exceptions: InvalidArgument, Error
//     energy_term.h               EnergyTerm: a sum over elements of functions of few unknowns;
//                                 check_derivatives()
//     curvature.h                 the models of second derivatives
//     curvature_choice.h          the models by name, with the rules that choose between them
//     constraint.h                linear equations, eliminated exactly; held points and single
//                                 unknowns
//     feasibility.h               conditions of a line search; bounds with barriers; the violation
//                                 of a bound as an energy
//     problem.h                   ProblemBuilder, Problem: terms, constraints, checkers; Evaluator
//     hessian_factor.h            the factorized Hessian at a point
//     residuals.h                 residuals of sums of squares and their Jacobian
//     sensitivity.h               derivatives of a solution by the data of its problem; covariance
//     residual_term.h             terms that are sums of squares: their residuals
//     dual2.h                     derivatives of formulas, of first and second order
//
// Minimizers:
//     minimizer.h                 Minimizer, SolveResult, StoppingRules
//     newton.h                    Newton's method: projected, lagged, inexact
//     first_order.h               L-BFGS and gradient flow in a factored metric
//     levenberg_marquardt.h       damped steps for least squares
//     barrier_minimizer.h         interior points: barriers of falling weight
//     stepper.h                   single steps, for methods of your own
//     line_search.h               the line search of all minimizers
//     run_record.h                trace, limits and progress of a run
//     stop_check.h                interruption, time limits
//     parallel.h                  the number of threads, and parallel loops
//
// Linear algebra:
//     linear_solver.h             sparse patterns, factorizations, and the interface of solvers
//
// Not included, since they need optional libraries: ceres_minimizer.h (the solvers of Ceres,
// majorant::ceres) and cholmod_solver.h (CHOLMOD, majorant::cholmod). Not for maps of surfaces:
// parametrize() (majorant.h) builds their problems.
#pragma once

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/curvature_choice.h"
#include "majorant/framework/dual2.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/hessian_factor.h"
#include "majorant/framework/levenberg_marquardt.h"
#include "majorant/framework/line_search.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/residual_term.h"
#include "majorant/framework/residuals.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/stepper.h"
#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
