#include "distributed/parametrize_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "distributed/internal/angles_of_parts.h"
#include "distributed/internal/start_of_part.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/internal/degree_solver.h"
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
      RunRecord& record)
      : part_(std::move(part)),
        options_(options),
        record_(record),
        start_(part_, uv, options.map),
        setup_{start_.specification(), options.solve, {}, {}, {}, {}, {}},
        map_(BezierMap::linear(part_->mesh, start_.x())) {}

  PartResult solve() {
    require_injective();
    const double started = record_.seconds();
    result_.initial_value = mean(map_);
    record_.begin(Activity::Solving);
    if (!std::isfinite(result_.initial_value)) enter_domain();
    const SolveResult solved = raise_degree();
    while (map_.degree() < options_.map.degree) elevate();
    result_.optimize_seconds = record_.seconds() - started;
    conclude(solved);
    return std::move(result_);
  }

 private:
  const Ranks& ranks() const { return part_->ranks(); }

  double mean(const BezierMap& map) const {
    Vec unused;
    const double area = start_.specification().rest.measure.sum();
    const double here =
        area > 0 ? area * mean_density(map, setup_.map.rest, options_.map.energy, unused) : 0;
    return ranks().sum(here) / ranks().sum(area);
  }

  void require_injective() const {
    Verdict faces;
    if (part_->mesh->face_count() > 0)
      faces = LocalInjectivity(map_.shared_space(), 2 * setup_.map.rest.measure)
                  .check(map_.control_points());
    const double wrong = ranks().sum(static_cast<double>(faces.blocking.size()));
    if (wrong > 0)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("the initial map is not injective: {:.0f} faces are not positively "
                              "oriented",
                              wrong));
    const AnglesOfParts angles = angles_of_parts(*part_, map_);
    if (angles.off > 0)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("the initial map is not injective: it covers the neighbourhoods of "
                              "{} vertices more than once",
                              angles.off));
  }

  // As parametrize() does for energies that overflow at the start.
  void enter_domain() {
    DegreeSolver::Setup gentle = setup_;
    gentle.map.energy = {{symmetric_dirichlet(), 1.0}};
    gentle.solve.curvature = Curvature::Projected;
    const QuadratureLevels levels(
        optimizer_ladder(1, setup_.solve.quadrature_points, setup_.rules.quadrature),
        map_.space().element_count());
    const DensityTerms terms = energy_terms(setup_.map, map_.shared_space(), levels.rules());
    gentle.asked_energy = [&](VecIn x) {
      return energy_of_map(setup_.map, terms, levels.of_faces(), x);
    };
    DegreeSolver solver(gentle, domain_, map_.shared_space(), map_.control_points());
    solver.soften_start(record_);
    solver.approach(options_.solve.elevation_tolerance, record_, Phase::Entry);
    map_ = map_.with(map_.shared_space(), solver.x());
    add_counts(result_.injectivity_tests, solver.proven());
  }

  // solved: of the last degree that was optimized.
  SolveResult raise_degree() {
    SolveResult solved;
    solved.energy = result_.initial_value;
    for (;;) {
      const Directive told = ranks().of_first(record_.directive());
      if (told != Directive::Continue) return stopped(std::move(solved), told);
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
    solver.soften_start(record_);
    SolveResult solved = last ? solver.finish(record_)
                              : solver.approach(options_.solve.elevation_tolerance, record_);
    map_ = map_.with(map_.shared_space(), solver.x());
    add_counts(result_.injectivity_tests, solver.proven());
    result_.remedies = solver.remedies();
    result_.variables = solver.variables();
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
  StartOfPart start_;
  DegreeSolver::Setup setup_;
  BezierMap map_;  // normalised
  PlainDomain domain_;
  PartResult result_;
};

}  // namespace

PartResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                             const ParametrizationOptions& options, RunRecord& record) {
  require_possible(options);
  return Run(std::move(part), uv, options, record).solve();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
