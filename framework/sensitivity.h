// The derivative of a solution by the data of its problem, by the implicit function theorem: of x*
// = argmin E(x; b, w, p) by right-hand sides b of constraints, weights w of terms and of elements,
// and parameters p of terms.
//
//   const SolveResult result = NewtonMinimizer().minimize(problem, y0, nullptr);
//   const Sensitivity s(problem, result);
//   Sensitivity::Change change;                      // a direction in the data
//   change.right_hand_sides = Vec::Ones(s.row_count());
//   const Vec dx = s.forward(change);                // how x* moves along it
//   const Vec gradient = problem.expand(y0);         // dL/dx at x* of some function L
//   const Sensitivity::Derivative d = s.adjoint(gradient);
//   const double slope = d.right_hand_sides.dot(change.right_hand_sides);   // = gradient . dx
//
// The exact Hessian at x* is factorized once. A result that stopped at a tolerance is polished
// first by exact Newton steps; error() estimates the remaining error. Derivatives of gradients by
// data are computed at first use, and kept.
//
// Barriers of bounds and equalities are terms like others: give the problem the states that they
// had in the last phase (BarrierResult::states).
//     const BarrierResult result = minimizer.run(problem, y0);
//     const Sensitivity s(problem.with(result.states), result);
// The result is the derivative of that phase's minimum, on which equalities hold exactly; bias()
// estimates the distance to the minimum without barriers. Motions that do not change the energy
// (translations, if nothing is held) are given as null_space. The derivative is then the one of
// least norm, or the one that keeps a gauge.
//
// Not for rest positions of a mesh: RestSensitivity (energies/rest_sensitivity.h). For maps of
// parametrize() and deform(), MapSensitivity (parametrization/solve/map_sensitivity.h) builds the
// problem. Not for results at a saddle or held back by a checker: neither is a function of the
// data.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/problem.h"

namespace majorant {

struct SensitivityOptions {
  SolverFactory linear_solver = [] { return make_direct_solver(); };
  // A solver that has analysed the pattern of the problem, such as that of the minimizer, to reuse
  // its analysis. Nobody else may factorize with it while the Sensitivity exists. Null:
  // linear_solver makes one.
  std::shared_ptr<LinearSolver> analysed_solver = {};
  // Motions at y that do not change the energy, one a column, size() rows; empty: none.
  std::function<Eigen::MatrixXd(const Problem&, VecIn y)> null_space = {};
  // Rows C, as many as there are motions, that hold the motions of full unknowns: C dx = 0. Empty:
  // dx has the least norm in the unknowns of the problem.
  std::function<Eigen::MatrixXd(const Problem&, VecIn y)> gauge = {};
  // The maximum number of exact Newton steps before the final factorization.
  int polishing_steps = 10;
};

class Sensitivity {
 public:
  // Throws InvalidArgument for a problem of several processes and for a result of another size.
  // Throws Error(Unsupported) with the reason if the derivative does not exist or cannot be
  // computed: the run failed; a checker holds the result, or the minimum that polishing finds; a
  // term has no exact Hessian; the exact Hessian is indefinite (a saddle) or singular.
  Sensitivity(const Problem& problem, const SolveResult& result, SensitivityOptions options = {});
  ~Sensitivity();
  Sensitivity(Sensitivity&&) noexcept;
  Sensitivity& operator=(Sensitivity&&) noexcept;

  // A direction in the data; empty members do not change.
  struct Change {
    Vec right_hand_sides = {};  // of all rows, in the order of ProblemBuilder::add()
    std::vector<std::pair<TermId, double>> weights = {};
    std::vector<std::pair<TermId, Vec>> element_weights = {};  // #E each
    std::vector<std::pair<TermId, Vec>> parameters = {};       // EnergyTerm::parameter_count() each
    Vec gradient = {};  // change of the energy's gradient by x, full unknowns, from other data
  };
  // dL/d(data) for a function L of x*.
  struct Derivative {
    Vec right_hand_sides;              // by all rows; one choice if rows depend on each other
    std::vector<double> weights;       // by term, in the order of Problem::terms()
    std::vector<Vec> element_weights;  // by term: #E
    std::vector<Vec> parameters;       // by term: parameter_count()
    // H^-1 dL/dx, full unknowns: dL/dp = -adjoint_state . d(gradient)/dp for any other datum p.
    Vec adjoint_state;
  };

  Index row_count() const;  // of the constraints
  // The point at which derivatives are taken, full unknowns, and its energy.
  const Vec& point() const;
  double energy() const;
  // Returns an estimate of |x - x*| / |x| after polishing.
  double error() const;
  // Estimates |x - x0| / |x| to first order, where x0 is the minimum without these terms.
  double bias(const std::vector<TermId>& barriers) const;

  // Returns dx* along the change, full unknowns, one column for each change. Throws InvalidArgument
  // for sizes that do not fit. Throws Error(Unsupported) if changes of dependent rows contradict
  // each other, and for a change that moves x* along the null space.
  Vec forward(const Change& change) const;
  Eigen::MatrixXd forward(const std::vector<Change>& changes) const;
  // Returns the derivative of L from its dL/dx at point(), full unknowns; for several L one column
  // each. Derivatives by parameters are differences of exact gradients, to about 1e-10 of these.
  // Throws InvalidArgument for another number of unknowns. Throws Error(Unsupported) if a term has
  // more than 64 parameters that all elements see, and an element depends on more than one of them.
  Derivative adjoint(const Vec& slope) const;
  std::vector<Derivative> adjoint(const Eigen::MatrixXd& slopes) const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;  // calls from several threads run one at a time
};

// Returns the covariance of chosen (full) unknowns of a least-squares solution: a block of (J^T
// J)^-1. J is the derivative of all residuals by the reduced unknowns, with losses and weights as
// in Gauss-Newton. Unknowns that constraints fix have covariance 0. All terms must be sums of
// squares (ResidualTerm). Throws Error(Unsupported) if a term is not, or if J^T J is singular,
// InvalidArgument for unknowns out of range.
Eigen::MatrixXd covariance(const Problem& problem, const SolveResult& result,
                           const std::vector<Index>& unknowns);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
