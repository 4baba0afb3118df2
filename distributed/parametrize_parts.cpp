#include "distributed/parametrize_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "distributed/internal/angles_of_parts.h"
#include "distributed/internal/start_of_part.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/maps/measure.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"
#include "majorant/parametrization/solve/degree_schedule.h"
#include "majorant/parametrization/solve/valid_options.h"

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
        setup_{start_.specification(), options.solve, {}, {}, {}, {}} {
    record_.agree([this](int own) { return ranks().of_first(own); });
    if (keeping_.every > 0)
      setup_.watch = [this](const TraceEntry& row, const MapView& at) {
        watch(row, at.space, at.x);
        return Directive::Continue;
      };
  }

  PartResult solve(const std::optional<PartState>& from) {
    BezierMap start = BezierMap::linear(part_->mesh, start_.x());
    if (!from) require_injective(start, ErrorKind::Infeasible, "the initial map", 0);
    const double started = record_.seconds();
    result_.initial_value = from ? from->initial_value : mean(start);
    record_.begin(Activity::Solving);
    if (from) start = start.with(from->space, from->x);
    const bool enters = from ? from->entering : !std::isfinite(result_.initial_value);
    if (from && !enters)
      require_injective(start, ErrorKind::Unreadable, "the map of the checkpoint",
                        from->solver.depth);
    schedule_.emplace(setup_, domain_, std::move(start), options_.map.degree, record_);
    if (from && !enters) schedule_->resume(from->solver);
    if (enters) schedule_->enter();
    const SolveResult solved = schedule_->raise_degree(result_.initial_value);
    if (solved.status == Status::MaxIterations || was_stopped(solved.status)) keep_last();
    schedule_->elevate_to_last();
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
  void require_injective(const BezierMap& map, ErrorKind kind, const char* what, int depth) const {
    Verdict faces;
    if (part_->mesh->face_count() > 0)
      faces = LocalInjectivity(map.shared_space(), 2 * setup_.map.rest.measure,
                               std::max(depth, options_.solve.injectivity_depth))
                  .check(map.control_points());
    const double wrong = ranks().sum(static_cast<double>(faces.blocking.size()));
    if (wrong > 0)
      throw Error(kind, fmt::format("{} is not injective: {:.0f} faces are not positively oriented",
                                    what, wrong));
    const AnglesOfParts angles = angles_of_parts(*part_, map);
    if (angles.off > 0)
      throw Error(kind, fmt::format("{} is not injective: it covers the neighbourhoods of {} "
                                    "vertices more than once",
                                    what, angles.off));
  }

  // ---- Keeping it ----

  // After every row of the trace; all ranks have the same rows.
  void watch(const TraceEntry& row, const Space& space, VecIn x) {
    ++iterations_;
    if (++since_kept_ < keeping_.every) return;
    if (schedule_->entering()) {
      if (row.phase == Phase::Entry || row.phase == Phase::SoftStart) keep(space, x, {});
    } else if (const auto state = schedule_->state()) {
      keep(space, x, *state);
    }
  }

  void keep(const Space& space, VecIn x, DegreeSolver::State solver) {
    since_kept_ = 0;
    keeping_.keep(
        {space, x, schedule_->entering(), std::move(solver), result_.initial_value, iterations_});
  }

  // A limit has ended the run here.
  void keep_last() {
    const BezierMap& map = schedule_->map();
    if (keeping_.every > 0) keep(map.shared_space(), map.control_points(), *schedule_->state());
  }

  // ---- What became of it ----

  void conclude(const SolveResult& solved) {
    const BezierMap& map = schedule_->map();
    const DegreeSchedule::Counts& counts = schedule_->counts();
    result_.status = solved.status;
    result_.message = solved.message;
    result_.value_quadrature = solved.energy;
    result_.newton_decrement = relative_to(solved.energy, solved.newton_decrement);
    result_.handle_distance = ranks().max(farthest_handle(setup_.map, map)) / start_.scale();
    result_.injectivity_tests = of_all_ranks(counts.injectivity_tests);
    result_.remedies = counts.remedies;
    result_.variables = counts.variables;
    result_.map = map.with(map.shared_space(), start_.in_model_units(map.control_points()));
    record_.begin(Activity::Measuring);
    const double started = record_.seconds();
    result_.measures = measure_parts(*part_, *result_.map, options_.map.energy);
    result_.measure_seconds = record_.seconds() - started;
    judge(unproven(), result_.status, result_.message);
  }

  // Ranks may have bisected to different depths.
  std::vector<long> of_all_ranks(const std::vector<long>& counts) const {
    const double deepest = ranks().max(static_cast<double>(counts.size()));
    std::vector<double> sums(counts.begin(), counts.end());
    sums.resize(static_cast<std::size_t>(deepest), 0.0);
    ranks().sum(sums);
    return {sums.begin(), sums.end()};
  }

  // Empty: nothing is amiss.
  std::string unproven() const {
    const PartMeasures& m = result_.measures;
    if (m.locally_injective) return {};
    return fmt::format(
        "{} faces are not proven to be positively oriented, angle sums at {} vertices are not full "
        "turns",
        m.faces_not_positive, m.vertices_off);
  }

  std::shared_ptr<const MeshPart> part_;
  const ParametrizationOptions& options_;
  RunRecord& record_;
  const Keeping& keeping_;
  StartOfPart start_;
  DegreeSolver::Setup setup_;
  PlainDomain domain_;
  std::optional<DegreeSchedule> schedule_;
  PartResult result_;
  int iterations_ = 0, since_kept_ = 0;
};

}  // namespace

PartResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                             const ParametrizationOptions& options, RunRecord& record,
                             const Keeping& keeping, const std::optional<PartState>& from) {
  require_possible(options);
  require_valid(options.map, options.solve, false);
  return Run(std::move(part), uv, options, record, keeping).solve(from);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
