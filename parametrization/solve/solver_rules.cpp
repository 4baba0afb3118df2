#include "majorant/parametrization/solve/solver_rules.h"

#include <fmt/format.h>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

// Returns the translations of the plane, under which energies of maps are invariant unless points
// are held.
Eigen::MatrixXd translations(const Problem& problem) {
  Eigen::MatrixXd vectors(problem.size(), 2);
  for (const Index c : {0, 1}) {
    Vec x = Vec::Zero(problem.full_size());
    x(Eigen::seq(c, Eigen::last, 2)).setOnes();
    vectors.col(c) = problem.reduce(x);
  }
  return vectors;
}

}  // namespace

void require_curvature(const DensityTerms& terms, Curvature model) {
  for (const auto& term : terms) {
    if (term->supports(model)) continue;
    std::vector<std::string_view> known;
    for (const Curvature c : kCurvatures)
      if (term->supports(c)) known.push_back(curvature_name(c));
    throw InvalidArgument(fmt::format("energy '{}' has no curvature model '{}'; use one of {}",
                                      term->name(), curvature_name(model), fmt::join(known, " ")));
  }
}

NewtonOptions newton_options(const CurvatureChoice& curvature, const SolverRules& rules,
                             const StopCheck& stop, const DirectSolverOptions& direct,
                             const SolverFactory& linear_solver) {
  NewtonOptions options = newton_of_maps();
  options.stopping = rules.stopping;
  options.line_search = rules.line_search;
  options.blend = rules.blend;
  options.lagged = rules.lagged;
  options.set_curvature(curvature);
  options.stop = stop;
  options.linear_solver = [=] { return make_direct_solver(direct); };
  if (linear_solver) {
    options.linear_solver = linear_solver;
    options.near_null_space = translations;
  }
  return options;
}

bool was_stopped(Status status) {
  return status == Status::TimeLimit || status == Status::Interrupted;
}

SolveResult stopped(SolveResult result, Directive why) {
  result.status = stopped_status(why);
  result.message = Stopped(why).what();
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
