#include "distributed/parametrize_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "distributed/internal/angles_of_parts.h"
#include "distributed/internal/start_of_part.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/internal/enter_domain.h"
#include "majorant/parametrization/maps/measure.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"

namespace majorant {
namespace {

void require_possible(const ParametrizationOptions& o) {
  const auto refuse = [](const char* what) {
    throw Error(ErrorKind::Usage,
                fmt::format("{} need the whole surface in one process; run `majorant`", what));
  };
  if (o.map.injectivity == MapInjectivity::Global) refuse("maps without overlaps");
  if (o.map.boundary_angles != BoundaryAngles::Free) refuse("angles at the boundary");
  if (!o.map.aligned.empty()) refuse("aligned edges");
  if (o.solve.triangles == Triangles::Flipped) refuse("flipped triangles");
  if (o.extend) refuse("terms of one's own");
}

class Run {
 public:
  Run(std::shared_ptr<const MeshPart> part, const Vec& uv, const ParametrizationOptions& options,
      RunRecord& record, const Keeping& keeping)
      : part_(std::move(part)),
        options_(options),
        record_(record),
        keeping_(keeping),
        start_(part_, uv, options.map),
        setup_{start_.specification(), options.solve, {}, {}, {}, {}, {}},
        map_(BezierMap::linear(part_->mesh, start_.x())) {
    if (keeping_.every > 0)
      setup_.watch = [this](const TraceEntry& row, const auto& space, VecIn x) {
        watch(row, space, x);
        return Directive::Continue;
      };
  }

  PartResult solve(const std::optional<PartState>& from) {
    if (!from) require_injective(ErrorKind::Infeasible, "the initial map", 0);
    const double started = record_.seconds();
    result_.initial_value = from ? from->initial_value : mean(map_);
    record_.begin(Activity::Solving);
    if (from) go_to(*from);
    if (before_)
      require_injective(ErrorKind::Unreadable, "the map of the checkpoint", before_->depth);
    if (from ? from->entering : !std::isfinite(result_.initial_value)) enter();
    const SolveResult solved = raise_degree();
    while (map_.degree() < options_.map.degree) elevate();
    result_.optimize_seconds = record_.seconds() - started;
    conclude(solved);
    return std::move(result_);
  }

 private:
  using Space = std::shared_ptr<const BezierTriangleSpace>;

  const Ranks& ranks() const { return part_->ranks(); }

  double mean(const BezierMap& map) const {
    Vec unused;
    const double area = start_.specification().rest.measure.sum();
    const double here =
        area > 0 ? area * mean_density(map, setup_.map.rest, options_.map.energy, unused) : 0;
    return ranks().sum(here) / ranks().sum(area);
  }

  // depth: of bisection, at least.
  void require_injective(ErrorKind kind, const char* what, int depth) const {
    Verdict faces;
    if (part_->mesh->face_count() > 0)
      faces = LocalInjectivity(map_.shared_space(), 2 * setup_.map.rest.measure,
                               std::max(depth, options_.solve.injectivity_depth))
                  .check(map_.control_points());
    const double wrong = ranks().sum(static_cast<double>(faces.blocking.size()));
    if (wrong > 0)
      throw Error(kind, fmt::format("{} is not injective: {:.0f} faces are not positively oriented",
                                    what, wrong));
    const AnglesOfParts angles = angles_of_parts(*part_, map_);
    if (angles.off > 0)
      throw Error(kind, fmt::format("{} is not injective: it covers the neighbourhoods of {} "
                                    "vertices more than once",
                                    what, angles.off));
  }

  void enter() {
    entering_ = true;
    map_ = enter_domain(setup_, domain_, map_, record_, result_.injectivity_tests);
    entering_ = told() != Directive::Continue;
  }

  Directive told() const { return ranks().of_first(record_.directive()); }

  void go_to(const PartState& from) {
    map_ = map_.with(from.space, from.x);
    if (!from.entering) before_ = from.solver;
  }

  // ---- Keeping it ----

  // After every row of the trace; all ranks have the same rows.
  void watch(const TraceEntry& row, const Space& space, VecIn x) {
    ++iterations_;
    if (++since_kept_ < keeping_.every) return;
    if (entering_) {
      if (row.phase == Phase::Entry || row.phase == Phase::SoftStart) keep(space, x, {});
    } else if (const auto state = solver_->state()) {
      keep(space, x, *state);
    }
  }

  void keep(const Space& space, VecIn x, DegreeSolver::State solver) {
    since_kept_ = 0;
    keeping_.keep({space, x, entering_, std::move(solver), result_.initial_value, iterations_});
  }

  // A limit has ended the run here.
  void keep_last(const DegreeSolver::State& solver) {
    if (keeping_.every > 0) keep(map_.shared_space(), map_.control_points(), solver);
  }

  // ---- Solving ----

  // solved: of the last degree that was optimized.
  SolveResult raise_degree() {
    SolveResult solved;
    solved.energy = result_.initial_value;
    for (;;) {
      if (const Directive why = told(); why != Directive::Continue) {
        keep_last(before_.value_or(DegreeSolver::State()));
        return stopped(std::move(solved), why);
      }
      const bool last = map_.degree() == options_.map.degree;
      if (last || options_.solve.elevation == Elevation::Incremental) {
        solved = optimize(last);
        if (solved.status != Status::Converged && solved.status != Status::Stalled) return solved;
      }
      if (last) return solved;
      elevate();
    }
  }

  SolveResult optimize(bool last) {
    DegreeSolver solver(setup_, domain_, map_.shared_space(), map_.control_points());
    solver_ = &solver;
    if (before_) solver.resume(*std::exchange(before_, std::nullopt));
    solver.soften_start(record_);
    SolveResult solved = last ? solver.finish(record_)
                              : solver.approach(options_.solve.elevation_tolerance, record_);
    map_ = map_.with(map_.shared_space(), solver.x());
    add_counts(result_.injectivity_tests, solver.proven());
    result_.remedies = solver.remedies();
    result_.variables = solver.variables();
    if (solved.status == Status::MaxIterations || was_stopped(solved.status))
      keep_last(solver.state().value());
    solver_ = nullptr;
    return solved;
  }

  // Ranks may round the nodes of a shared edge differently: they are the owner's.
  void elevate() {
    map_ = map_.elevated();
    Vec x = map_.control_points();
    part_->unknowns(map_.space())->copy_from_owners(x);
    map_ = map_.with(map_.shared_space(), std::move(x));
  }

  void conclude(const SolveResult& solved) {
    result_.status = solved.status;
    result_.message = solved.message;
    result_.value_quadrature = solved.energy;
    result_.newton_decrement = relative_to(solved.energy, solved.newton_decrement);
    double farthest = 0;
    for (const FixedPoint& h : setup_.map.handles)
      farthest =
          std::max(farthest, (map_.control_points().segment<2>(2 * h.node) - h.position).norm());
    result_.handle_distance = ranks().max(farthest) / start_.scale();
    std::vector<double> tests(16, 0.0);  // as many on every rank
    for (std::size_t k = 0; k < std::min(tests.size(), result_.injectivity_tests.size()); ++k)
      tests[k] = static_cast<double>(result_.injectivity_tests[k]);
    ranks().sum(tests);
    result_.injectivity_tests.assign(tests.begin(), tests.end());
    result_.map = map_.with(map_.shared_space(), start_.in_model_units(map_.control_points()));
    record_.begin(Activity::Measuring);
    const double started = record_.seconds();
    result_.measures = measure_parts(*part_, *result_.map, options_.map.energy);
    result_.measure_seconds = record_.seconds() - started;
    if (!result_.measures.locally_injective) {
      result_.message = fmt::format(
          "the result fails its own proof: {} faces are not proven to be positively oriented, "
          "angle "
          "sums at {} vertices are not full turns (the solver ended with: {})",
          result_.measures.faces_not_positive, result_.measures.vertices_off, result_.message);
      result_.status = Status::Failed;
    } else if (solved.status == Status::Failed) {
      result_.status = Status::Stalled;
    }
  }

  std::shared_ptr<const MeshPart> part_;
  const ParametrizationOptions& options_;
  RunRecord& record_;
  const Keeping& keeping_;
  StartOfPart start_;
  DegreeSolver::Setup setup_;
  BezierMap map_;  // normalised
  PlainDomain domain_;
  PartResult result_;
  const DegreeSolver* solver_ = nullptr;       // of this degree, while it solves
  std::optional<DegreeSolver::State> before_;  // of an earlier run, for the first solver
  bool entering_ = false;
  int iterations_ = 0, since_kept_ = 0;
};

}  // namespace

PartResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                             const ParametrizationOptions& options, RunRecord& record,
                             const Keeping& keeping, const std::optional<PartState>& from) {
  require_possible(options);
  return Run(std::move(part), uv, options, record, keeping).solve(from);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
