#include "majorant/parametrization/drive/internal/solver_rules.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/assembly.h"
#include "majorant/framework/internal/curvature_name.h"

namespace majorant {
namespace {

// Of a factor and its making, for every entry of the Hessians of faces, from degree 2 on: at most.
// Origin: nefertiti_10000 takes 35 at degree 3 and 38 at degree 2, and 10 and 12 more for every
// fourfold number of faces: 87 and 110 where patterns end.
constexpr std::size_t kFactorBytes = 120;

// Of the plane: what energies of maps do not see, but for points that are held.
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

void require_curvature(const DensityTerms& terms, Curvature asked) {
  for (const auto& term : terms) {
    if (term->supports(asked)) continue;
    std::vector<std::string_view> known;
    for (const Curvature c : kCurvatures)
      if (term->supports(c)) known.push_back(curvature_name(c));
    throw InvalidArgument(fmt::format("energy '{}' has no curvature model '{}'; use one of {}",
                                      term->name(), curvature_name(asked), fmt::join(known, " ")));
  }
}

NewtonOptions newton_options(Curvature curvature, const SolverRules& rules, const StopCheck& stop,
                             Ordering ordering, const SolverFactory& linear_solver,
                             const InsteadOfFactor& instead) {
  NewtonOptions options;
  options.stopping = rules.stopping;
  options.line_search = rules.line_search;
  options.blend = rules.blend;
  options.kept = rules.kept;
  options.curvature = curvature;
  options.stop = stop;
  options.linear_solver = [=] { return make_direct_solver(ordering, instead); };
  if (linear_solver) {
    options.linear_solver = linear_solver;
    options.near_null_space = translations;
  }
  return options;
}

LastDegree last_degree(int degree, const std::shared_ptr<const BezierTriangleSpace>& space,
                       Ordering ordering) {
  const auto local = static_cast<std::size_t>((degree + 1) * (degree + 2));
  const std::size_t entries = at(space->element_count()) * (local * (local + 1) / 2);
  return {degree, {kFactorBytes * entries, entries}, [=] {
            const BezierTriangleSpace higher(space->faces(), space->vertex_count(), degree);
            const Stencils stencils{higher.cells(), 2};
            const Elimination all(2 * higher.node_count(), ConstraintRows{});
            return factor_size(reduced_pattern({&stencils}, all), ordering);
          }};
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
