// A solution as a function of the data of its problem, by the implicit function theorem: the
// derivative of x* = argmin E(x; b, w, p) by right-hand sides b of constraints, weights w of terms
// and of elements, and parameters p of terms.
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
// first by exact Newton steps; error() estimates what is left. Derivatives of gradients by data are
// made when they are first needed, and kept.
//
// Barriers of bounds and equalities are terms like others: give the problem the states that they
// had in the last phase (BarrierResult::states),
//     const BarrierResult result = minimizer.run(problem, y0);
//     const Sensitivity s(problem.with(result.states), result);
// and what comes out is the derivative of that phase's minimum, on which equalities hold exactly;
// bias() estimates how far it lies from the one without barriers. What the energy does not see
// (translations of what nothing holds) is given as null_space: the derivative is the one of least
// norm then, or the one that keeps a gauge.
//
// Rest positions of a mesh: RestSensitivity (energies/rest_sensitivity.h). Maps of parametrize()
// and deform(): MapSensitivity (parametrization/solve/map_sensitivity.h), which builds their
// problem. Not for results at a saddle, nor where a checker holds them back: neither is a function
// of the data.
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
  // A solver that has analysed the pattern of the problem, as the one that minimized it has: its
  // analysis serves. Nobody else factorizes with it as long as derivatives are asked for. Null:
  // linear_solver makes one.
  std::shared_ptr<LinearSolver> analysed_solver = {};
  // Motions that the energy does not see at y, a column each, size() rows; empty: there are none.
  std::function<Eigen::MatrixXd(const Problem&, VecIn y)> null_space = {};
  // Rows C that hold the motions, as many as there are motions, of full unknowns: C dx = 0. Empty:
  // dx has the least norm in the unknowns of the problem.
  std::function<Eigen::MatrixXd(const Problem&, VecIn y)> gauge = {};
  // Exact Newton steps at most, before the factor that serves.
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

  // A direction in the data; what is empty does not change.
  struct Change {
    Vec right_hand_sides = {};  // of all rows, in the order of ProblemBuilder::add()
    std::vector<std::pair<TermId, double>> weights = {};
    std::vector<std::pair<TermId, Vec>> element_weights = {};  // #E each
    std::vector<std::pair<TermId, Vec>> parameters = {};       // EnergyTerm::parameter_count() each
    Vec gradient = {};  // of the energy's gradient by x, full unknowns, that other data make
  };
  // dL/d(data), for a function L of x*.
  struct Derivative {
    Vec right_hand_sides;              // by all rows; where rows depend on each other, one choice
    std::vector<double> weights;       // by term, in the order of Problem::terms()
    std::vector<Vec> element_weights;  // by term: #E
    std::vector<Vec> parameters;       // by term: parameter_count()
    // H^-1 dL/dx, full unknowns: dL/dp = -adjoint_state . d(gradient)/dp of any other datum p.
    Vec adjoint_state;
  };

  Index row_count() const;  // of the constraints
  // The point that the derivatives belong to, full unknowns; its energy.
  const Vec& point() const;
  double energy() const;
  // An estimate of |x - x*| / |x| after polishing.
  double error() const;
  // Estimates |x - x0| / |x| to first order, where x0 is the minimum without these terms.
  double bias(const std::vector<TermId>& barriers) const;

  // dx* along the change, full unknowns; a column for each of several changes. Throws
  // InvalidArgument for sizes that do not fit, Error(Unsupported) where changes of rows that depend
  // on each other contradict, and for a change that moves x* along the null space.
  Vec forward(const Change& change) const;
  Eigen::MatrixXd forward(const std::vector<Change>& changes) const;
  // The derivative of L with this dL/dx at point(), full unknowns; of several, a column each.
  // Parameters by differences of exact gradients, to about 1e-10 of them. Throws InvalidArgument
  // for another number of unknowns; Error(Unsupported) for elements that depend on more than one of
  // the parameters which all of them see, where there are more than 64 of these.
  Derivative adjoint(const Vec& slope) const;
  std::vector<Derivative> adjoint(const Eigen::MatrixXd& slopes) const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;  // calls from several threads wait for each other
};

// The covariance of chosen unknowns of a least-squares solution: this block of (J^T J)^-1, J the
// derivative of all residuals, losses and weights included as Gauss-Newton has them, by the
// unknowns that constraints leave; 0 for what they fix. unknowns: full ones. All terms have to be
// sums of squares (ResidualTerm). Throws Error(Unsupported) where a term is none, and where J^T J
// is singular, InvalidArgument for unknowns out of range.
Eigen::MatrixXd covariance(const Problem& problem, const SolveResult& result,
                           const std::vector<Index>& unknowns);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
