// Sparse optimization without meshes, whole: problems of small energy terms, exact elimination of
// constraints, factorizations, minimizers. For programs that put problems together; what maps
// surfaces is majorant.h.
//
//   const Problem problem = builder.build();
//   const NewtonMinimizer newton(NewtonOptions{});
//   const SolveResult result = newton.minimize(problem, y0, {});
//
// What a problem is made of:
//     types.h                     vectors, matrices, indices
//     error.h                     the exceptions: InvalidArgument, Error
//     energy_term.h               EnergyTerm: a sum over elements of functions of few unknowns
//     curvature.h                 which matrix stands for second derivatives
//     constraint.h                affine equations, eliminated exactly
//     feasibility.h               what a line search holds; bounds with barriers
//     problem.h                   ProblemBuilder, Problem: terms, constraints, checkers
//     dual2.h                     derivatives of formulas, of first and second order
//     dual2_eigen.h               the same in matrices of Eigen
//     packed_symmetric.h          small symmetric matrices, made semidefinite
//     derivative_check.h          whether the derivatives of a term are right
//
// Minimizers:
//     minimizer.h                 Minimizer, SolveResult: what all of them share
//     newton.h                    Newton's method: projected, lagged, inexact
//     lbfgs.h                     L-BFGS in a metric
//     gradient_flow.h             semi-implicit gradient flow
//     barrier_minimizer.h         interior points: barriers of falling weight
//     stepper.h                   one step at a time
//     line_search.h               the step along a direction
//     stopping.h                  when a descent ends
//     run_record.h                trace, limits and progress of a run
//     stop_check.h                interruption, time limits
//     thread_count.h              how many threads work
//
// What they stand on:
//     linear_solver.h             sparse factorizations: the own one, others to plug in
//     sparse_pattern.h            where a symmetric matrix has entries
//     evaluator.h                 energy, gradient, Hessian of a problem at a point
//
// Not here, since they need libraries that are asked for by name: ceres_minimizer.h (the solvers of
// Ceres, majorant::ceres) and cholmod_solver.h (CHOLMOD, majorant::cholmod).
#pragma once

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/derivative_check.h"
#include "majorant/framework/dual2.h"
#include "majorant/framework/dual2_eigen.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/evaluator.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/gradient_flow.h"
#include "majorant/framework/lbfgs.h"
#include "majorant/framework/line_search.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/packed_symmetric.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/sparse_pattern.h"
#include "majorant/framework/stepper.h"
#include "majorant/framework/stop_check.h"
#include "majorant/framework/stopping.h"
#include "majorant/framework/thread_count.h"
#include "majorant/framework/types.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
