#include "majorant/parametrization/drive/parametrize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "majorant/framework/curvature_name.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/bijective_solver.h"
#include "majorant/parametrization/drive/degree_solver.h"
#include "majorant/parametrization/drive/normalized_start.h"
#include "majorant/parametrization/drive/solver_rules.h"
#include "majorant/parametrization/injectivity/global_injectivity.h"
#include "majorant/parametrization/starts/tutte.h"

namespace majorant {
namespace {

void require_valid(const ParametrizationOptions& o) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::Usage, what); };
  if (o.degree < 1 || o.degree > BezierTriangleSpace::kMaxDegree)
    refuse(fmt::format("degree {} is not one of 1..{}", o.degree, BezierTriangleSpace::kMaxDegree));
  if (!(o.tolerance > 0) || !std::isfinite(o.tolerance))
    refuse("the tolerance must be a positive number");
  if (o.quadrature_points < 0) refuse("the number of quadrature points must not be negative");
  if (o.injectivity == MapInjectivity::Global &&
      (o.curvature == Curvature::Reweighted || o.curvature == Curvature::PaperMajorizer))
    refuse(
        fmt::format("the scaffold's energy has no curvature model '{}'; use projected, majorizer "
                    "or exact",
                    name(o.curvature)));
  if (o.energy.empty()) refuse("no energy is given");
  for (const WeightedEnergy& e : o.energy)
    if (!is_usable_weight(e.weight))
      refuse(fmt::format("the weight {:g} of an energy is not in {:g}..{:g}", e.weight,
                         1 / kLargestFactor, kLargestFactor));
  if (!is_usable_weight(o.handle_weight))
    refuse(fmt::format("the weight {:g} of soft handles is not in {:g}..{:g}", o.handle_weight,
                       1 / kLargestFactor, kLargestFactor));
}

// One degree after the other, from 1 (or, when asked, directly at the highest).
class Run {
 public:
  Run(const BezierMap& start, const ParametrizationOptions& options, RunRecord& record)
      : options_(options),
        record_(record),
        start_(start, options),
        map_(start_.map()),
        setup_{start_.specification(), options, record.stop()} {}

  ParametrizationResult solve() {
    const double started = record_.seconds();
    result_.start_moved = start_.moved();
    Vec unused;
    result_.initial_value = mean_density(map_, setup_.map.rest, options_.energy, unused);
    if (options_.injectivity == MapInjectivity::Global) make_scaffold();
    SolveResult solved;
    solved.energy = result_.initial_value;
    try {
      climb_degrees(solved);
    } catch (const Stopped& stop) {  // between two solves
      solved = stopped(std::move(solved), stop.why());
    }
    result_.optimize_seconds = record_.seconds() - started;
    return conclude(solved);
  }

 private:
  // solved: of the last degree that was optimized.
  void climb_degrees(SolveResult& solved) {
    if (!std::isfinite(result_.initial_value)) enter_domain();
    for (;;) {
      record_.stop().poll();
      const bool last = map_.degree() == options_.degree;
      if (last || options_.elevation == Elevation::Incremental) {
        solved = options_.injectivity == MapInjectivity::Global ? optimize_bijective(last)
                                                                : optimize(last);
        if (limited(solved.status)) return;
      }
      if (last) return;
      elevate();
    }
  }

  // Energies that overflow at the start (exponentials of a Tutte map) begin where the symmetric
  // Dirichlet energy, finite on every injective map, has led at degree 1.
  void enter_domain() {
    DegreeSolver::Setup gentle = setup_;
    gentle.map.energy = {{symmetric_dirichlet(), 1.0}};
    gentle.options.curvature = Curvature::Projected;
    if (options_.injectivity == MapInjectivity::Global) {
      BijectiveSolver solver(gentle, map_.shared_space(), map_.control_points(), *scaffold_);
      solver.approach(options_.elevation_tolerance, record_);
      map_ = map_.with(map_.shared_space(), solver.x());
      scaffold_ = solver.scaffold();
      return;
    }
    DegreeSolver solver(gentle, map_.shared_space(), map_.control_points());
    solver.soften_start(record_);
    solver.approach(options_.elevation_tolerance, record_);
    map_ = map_.with(map_.shared_space(), solver.x());
  }

  SolveResult optimize(bool last) {
    DegreeSolver solver(setup_, map_.shared_space(), map_.control_points());
    solver.soften_start(record_);
    SolveResult solved =
        last ? solver.finish(record_) : solver.approach(options_.elevation_tolerance, record_);
    map_ = map_.with(map_.shared_space(), solver.x());
    account(solver);
    return solved;
  }

  void make_scaffold() {
    try {
      scaffold_.emplace(map_.shared_space(), map_.control_points());
    } catch (const Error& e) {
      throw Error(e.kind(),
                  fmt::format("{}: the start overlaps itself ({}); start from another map "
                              "(--init tutte), or leave out --bijective",
                              map_.mesh().file(), e.what()));
    }
  }

  // What was held by the scaffold, proven once more from the boundary of what is returned.
  void prove_no_overlaps() {
    const GlobalInjectivity proof = check_boundary(*result_.map);
    if (proof.result == Injectivity::Violated) result_.status = Status::Failed;
    if (proof.result != Injectivity::Undecided || result_.status != Status::Converged) return;
    result_.status = Status::Stalled;
    result_.message = "boundary curves touch to within rounding: " + proof.reason;
  }

  SolveResult optimize_bijective(bool last) {
    BijectiveSolver solver(setup_, map_.shared_space(), map_.control_points(), *scaffold_);
    SolveResult solved =
        last ? solver.finish(record_) : solver.approach(options_.elevation_tolerance, record_);
    map_ = map_.with(map_.shared_space(), solver.x());
    scaffold_ = solver.scaffold();
    result_.flips.intended += solver.flips().intended;
    result_.flips.performed += solver.flips().performed;
    account(solver);
    return solved;
  }

  void elevate() {
    map_ = map_.elevated();
    if (scaffold_) scaffold_ = scaffold_->elevated(map_.shared_space());
  }

  static bool limited(Status s) { return s != Status::Converged && s != Status::Stalled; }

  template <class Solver>
  void account(const Solver& solver) {
    result_.injectivity_tests =
        add_counts(std::move(result_.injectivity_tests), solver.injectivity_depth_counts());
    result_.variables = solver.variables();
    result_.constraint_residual = solver.constraint_residual() / start_.scale();
    result_.handle_distance = 0;
    for (const FixedPoint& h : setup_.map.handles)
      result_.handle_distance = std::max(
          result_.handle_distance,
          (map_.control_points().segment<2>(2 * h.node) - h.position).norm() / start_.scale());
  }

  // A run that a limit ended below the degree asked for is elevated all the same: valid, and of
  // the promised degree.
  ParametrizationResult conclude(const SolveResult& solved) {
    while (map_.degree() < options_.degree) elevate();
    result_.status = solved.status;
    result_.message = solved.message;
    result_.value_quadrature = solved.energy;
    result_.newton_decrement = relative_to(solved.energy, solved.newton_decrement);
    result_.map = start_.in_model_units(map_);
    if (scaffold_) result_.scaffold = start_.in_model_units(scaffold_->mesh());
    const double started = record_.seconds();
    result_.measures = measure(*result_.map, options_.energy, record_.stop());
    result_.measure_seconds = record_.seconds() - started;
    if (!result_.measures.locally_injective) result_.status = Status::Failed;
    if (solved.status == Status::Failed && result_.measures.locally_injective)
      result_.status = Status::Stalled;
    if (scaffold_ && result_.status != Status::Failed) prove_no_overlaps();
    return std::move(result_);
  }

  const ParametrizationOptions& options_;
  RunRecord& record_;
  NormalizedStart start_;
  BezierMap map_;  // normalised
  DegreeSolver::Setup setup_;
  std::optional<Scaffold> scaffold_;  // around map_, of MapInjectivity::Global
  ParametrizationResult result_;
};

}  // namespace

Vec initial_map(const SurfaceMesh& mesh, const ParametrizationOptions& options,
                const StopCheck& stop) {
  // Holes are kept open, and free of overlaps, by the scaffold inside them.
  if (options.injectivity == MapInjectivity::Global)
    mesh.require_planar();
  else
    mesh.require_disk();
  if (options.initial && options.initial->size() != 2 * mesh.vertex_count())
    throw Error(ErrorKind::Usage, mesh.file() + ": the initial map needs 2 numbers per vertex");
  return options.initial ? *options.initial : tutte_map(mesh, stop);
}

ParametrizationResult parametrize(const BezierMap& start, const ParametrizationOptions& options,
                                  RunRecord& record) {
  require_valid(options);
  if (start.degree() != 1) throw Error(ErrorKind::Usage, "a start must have degree 1");
  return Run(start, options, record).solve();
}

ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options, RunRecord& record) {
  require_valid(options);
  const double started = record.seconds();
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options, record.start_stop()));
  const double initialize_seconds = record.seconds() - started;
  ParametrizationResult result = parametrize(start, options, record);
  result.initialize_seconds = initialize_seconds;
  return result;
}

ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options) {
  RunRecord record;
  return parametrize(std::move(mesh), options, record);
}

}  // namespace majorant
