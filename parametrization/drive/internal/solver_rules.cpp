#include "majorant/parametrization/drive/internal/solver_rules.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/curvature_name.h"

namespace majorant {

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
                             Ordering ordering) {
  NewtonOptions options;
  options.stopping = rules.stopping;
  options.line_search = rules.line_search;
  options.blend = rules.blend;
  options.kept = rules.kept;
  options.curvature = curvature;
  options.stop = stop;
  options.linear_solver = [ordering] { return make_direct_solver(ordering); };
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

Vec soft_weights(const Vec& energy, const Vec& measure, double enormous) {
  if (!(energy.sum() >= enormous * measure.sum()) || !energy.allFinite()) return {};
  return energy.cwiseQuotient(measure).cwiseSqrt().cwiseInverse();
}

}  // namespace majorant
