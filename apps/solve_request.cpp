#include "apps/solve_request.h"

#include <vector>

#include "apps/progress.h"
#include "majorant/framework/curvature_name.h"
#include "majorant/framework/error.h"

namespace majorant::app {

void SolveRequest::add_to(CLI::App& verb, std::string& curvature) {
  std::vector<std::string> curvatures;
  for (const Curvature c : kCurvatures) curvatures.emplace_back(name(c));
  verb.add_option("--curvature", curvature, "second-order model (projected)")
      ->check(CLI::IsMember(curvatures));
  verb.add_option("--elevation", elevation, "how the degree is reached")
      ->check(CLI::IsMember({"incremental", "direct"}));
  verb.add_flag("--bijective", bijective, "keep the image free of overlaps");
  verb.add_option("--tolerance", tolerance, "relative energy decrease to stop at (1e-6)")
      ->check(CLI::PositiveNumber);
  verb.add_option("--max-iterations", max_iterations, "(1000)")->check(CLI::NonNegativeNumber);
  verb.add_option("--time-limit", time_limit, "seconds; the best valid map is written")
      ->check(CLI::NonNegativeNumber);
}

void SolveRequest::apply(ParametrizationOptions& options) const {
  if (elevation == "direct") options.elevation = Elevation::Direct;
  if (bijective) options.injectivity = MapInjectivity::Global;
  options.tolerance = tolerance;
}

Json SolveRequest::to_json() const {
  return {{"elevation", elevation},
          {"bijective", bijective},
          {"tolerance", tolerance},
          {"max_iterations", max_iterations}};
}

RunRecord SolveRequest::make_record(const CommonOptions& common) const {
  if (!(time_limit >= 0)) throw Error(ErrorKind::Usage, "--time-limit is not a number of seconds");
  return RunRecord(time_limit, max_iterations, interruption_flag(), make_progress(common));
}

}  // namespace majorant::app
