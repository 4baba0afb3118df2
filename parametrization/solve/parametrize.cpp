#include "majorant/parametrization/solve/parametrize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/solve/degree_schedule.h"
#include "majorant/parametrization/solve/free_scale.h"
#include "majorant/parametrization/solve/internal/barrier_domain.h"
#include "majorant/parametrization/solve/internal/chosen_start.h"
#include "majorant/parametrization/solve/internal/prepared_solve.h"
#include "majorant/parametrization/solve/internal/proven_result.h"
#include "majorant/parametrization/solve/internal/several_paths.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "majorant/parametrization/solve/pin_homotopy.h"
#include "majorant/parametrization/solve/run_sharing.h"

namespace majorant {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw InvalidArgument(what); }

void require_valid(const MapOptions& options) {
  if (options.degree < 1 || options.degree > BezierTriangleSpace::kMaxDegree)
    refuse(fmt::format("degree {} is not one of 1..{}", options.degree,
                       BezierTriangleSpace::kMaxDegree));
  if (options.energy.empty()) refuse("no energy is given");
  for (const WeightedEnergy& e : options.energy)
    if (!is_usable_weight(e.weight))
      refuse(fmt::format("the weight {:g} of an energy is not in {:g}..{:g}", e.weight,
                         1 / kLargestFactor, kLargestFactor));
  if (!is_usable_weight(options.handle_weight))
    refuse(fmt::format("the weight {:g} of soft handles is not in {:g}..{:g}",
                       options.handle_weight, 1 / kLargestFactor, kLargestFactor));
  for (const auto* points : {&options.pins, &options.handles})
    for (const Pin& p : *points)
      if (p.target && !p.target->allFinite())
        refuse(fmt::format("the target of vertex {} is ({:g}, {:g}), finite numbers are needed",
                           p.vertex, p.target->x(), p.target->y()));
}

// Throws InvalidArgument for options out of range, and for those that exclude each other.
void require_valid(const ParametrizationOptions& options) {
  const MapOptions& map = options.map;
  const SolveOptions& solve = options.solve;
  require_valid(map);
  if (!(solve.tolerance > 0) || !std::isfinite(solve.tolerance))
    refuse("the tolerance must be a positive number");
  if (!(solve.elevation_tolerance >= 0)) refuse("the elevation tolerance must not be negative");
  if (solve.injectivity_depth < 0) refuse("the depth of certificates must not be negative");
  if (solve.threads < 0) refuse("the number of threads must not be negative");
  if (solve.quadrature_points < 0) refuse("the number of quadrature points must not be negative");
  if (map.injectivity == MapInjectivity::Global &&
      (solve.curvature.model == Curvature::Reweighted ||
       solve.curvature.model == Curvature::CompositeMajorizer))
    refuse(
        fmt::format("the scaffold's energy has no curvature model '{}'; use projected, majorizer "
                    "or exact",
                    curvature_name(solve.curvature.model)));
  if (solve.triangles == Triangles::Flipped &&
      (map.face_weight.size() > 0 || knows_elements(map.energy)))
    refuse("flipping edges changes the faces that weights and data refer to; leave one out");
  if (solve.triangles == Triangles::Flipped && options.extend)
    refuse("flipping edges changes the faces and nodes of the additions; leave one of the two out");
}

// A run of parametrize(): the degree schedule of a map, with additions, a scaffold, proofs and
// measures.
class Run {
 public:
  Run(const SolverRules& rules, RunSharing& sharing, const BezierMap& start,
      const ParametrizationOptions& options, RunRecord& record,
      std::shared_ptr<PreparedParts> prepared = nullptr)
      : options_(options),
        record_(record),
        sharing_(sharing),
        start_(start, options.map, options.extend ? Origin::Kept : Origin::Free, sharing.part(),
               prepared ? prepared->rest : nullptr),
        map_(start_.map()),
        setup_{start_.specification(), options.solve, sharing.stop_of(record), rules, {}, {}},
        prepared_(std::move(prepared)) {
    if (options.solve.watch || options.extend || sharing.follows() || is_kept_apart())
      setup_.watch = [this](const TraceEntry& row, const MapView& at) {
        if (!stays_apart(row, at)) return Directive::Interrupt;
        sharing_.after_row([&] { return state_at(row, at); });
        return observe(row, at);
      };
  }

  ParametrizationResult solve() {
    const RunState* const from = sharing_.from();
    const RestShapes& rest = *setup_.map.rest;
    if (from) map_ = map_.with(from->space, from->x);
    if (!from || !from->entering)
      sharing_.require_injective(map_, rest, options_.solve.injectivity_depth);
    const double started = record_.seconds();
    result_.start_moved = start_.moved();
    result_.initial_value =
        from ? from->initial_value : sharing_.mean(map_, rest, options_.map.energy);
    const bool enters = from ? from->entering : !std::isfinite(result_.initial_value);
    show_start();
    extend(map_);
    if (is_kept_apart()) begin_apart(enters);
    if (!apart_) domain_ = make_domain();
    const std::optional<DegreeSolver::State> reached =
        from && !enters ? std::optional(from->solver) : std::nullopt;
    SolveResult solved = solve_from(reached, enters, result_.initial_value);
    if (apart_ && apart_->overlaps) solved = solve_apart();
    if (solved.status == Status::Stalled && has_barrier_) solved = replace_barrier(solved.energy);
    result_.optimize_seconds = record_.seconds() - started;
    if (solved.status == Status::MaxIterations || was_stopped(solved.status))
      sharing_.at_limit([this] { return state_at_end(); });
    schedule_->elevate_to_last();
    map_ = schedule_->map();
    account(schedule_->counts());
    return conclude(solved);
  }

 private:
  // The state of a bijective run without a scaffold. No scaffold is needed as long as maps have no
  // overlaps, which is proven after every step. After the first map that overlaps, the run
  // continues from the last map without overlaps, with a scaffold. A scaffold begins around
  // straight edges, so that is a map of degree 1.
  struct Apart {
    BezierMap map;                              // proven free of overlaps
    std::optional<DegreeSolver::State> solver;  // to continue from the map
    bool entering = false;
    double energy = 0;
    std::size_t rows = 0;   // of the trace, up to the map
    bool overlaps = false;  // a later map overlaps
  };

  bool is_kept_apart() const { return options_.map.injectivity == MapInjectivity::Global; }

  static bool has_no_overlaps(const BezierMap& map) {
    return check_boundary(map).result == ProofStatus::Proven;
  }

  // Begins without a scaffold. Starts that overlap are left to the scaffold, which refuses them.
  void begin_apart(bool enters) {
    const bool is_surrounded = options_.solve.scaffold == ScaffoldUse::FromTheStart ||
                               setup_.rules.scaffold.from_the_start;
    if (is_surrounded || sharing_.part() || map_.degree() > 1 || !has_no_overlaps(map_)) return;
    apart_ = Apart{map_, std::nullopt, enters, result_.initial_value, record_.trace().size()};
    domain_ = std::make_unique<PlainDomain>(std::move(prepared_));
  }

  // Returns whether the run may continue from the map of this row.
  bool stays_apart(const TraceEntry& row, const MapView& at) {
    if (!apart_) return true;
    if (apart_->overlaps) return false;
    BezierMap map = map_.with(at.space, at.x);
    if (!has_no_overlaps(map)) {
      apart_->overlaps = true;
      return false;
    }
    if (map.degree() > 1) return true;
    if (std::optional<RunState> state = state_at(row, at))
      apart_ = Apart{std::move(map), std::move(state->solver), state->entering, row.energy,
                     record_.trace().size()};
    return true;
  }

  SolveResult solve_apart() {
    add_counts(result_.injectivity_tests, schedule_->counts().injectivity_tests);
    Apart apart = *std::exchange(apart_, std::nullopt);
    record_.take_back_to(apart.rows);
    map_ = std::move(apart.map);
    domain_ = make_domain();
    record_.announce(domain_->surroundings() ? "a scaffold prevents overlaps of the map"
                                             : "a barrier prevents overlaps of the map");
    return solve_from(apart.solver, apart.entering, apart.energy);
  }

  // Continues with a scaffold where the barrier holds the map back.
  SolveResult replace_barrier(double energy) {
    add_counts(result_.injectivity_tests, schedule_->counts().injectivity_tests);
    map_ = schedule_->map();
    domain_ = make_scaffold();
    record_.announce("a scaffold replaces the barrier");
    return solve_from({}, false, energy);
  }

  SolveResult solve_from(const std::optional<DegreeSolver::State>& reached, bool enters,
                         double energy) {
    record_.begin(Activity::Solving);
    schedule_.emplace(setup_, *domain_, map_, options_.map.degree, record_,
                      [this](const BezierMap& map) { extend(map); });
    if (enters)
      schedule_->enter();
    else if (reached)
      schedule_->resume(*reached);
    if (apart_ && apart_->overlaps) return {};
    return schedule_->raise_degree(energy);
  }

  // Returns a state from which another run can continue at a row of the trace.
  std::optional<RunState> state_at(const TraceEntry& row, const MapView& at) const {
    const bool entering = schedule_->entering();
    if (entering && row.phase != Phase::Entry && row.phase != Phase::SoftStart) return {};
    std::optional<DegreeSolver::State> solver =
        entering ? DegreeSolver::State() : schedule_->state();
    if (!solver) return {};
    return RunState{at.space, at.x, entering, *std::move(solver), result_.initial_value, 0};
  }
  std::optional<RunState> state_at_end() const {
    const BezierMap& map = schedule_->map();
    return RunState{map.shared_space(),  map.control_points(),  schedule_->entering(),
                    *schedule_->state(), result_.initial_value, 0};
  }

  // Calls options.extend for the additions of this degree.
  void extend(const BezierMap& map) {
    if (!options_.extend || (extension_ && extension_->degree() == map.degree())) return;
    auto extension =
        std::make_shared<MapExtension>(map, start_.specification().rest, start_.scale());
    options_.extend(*extension);
    extension_ = std::move(extension);
    setup_.map.added = extension_;
  }

  // Calls the observers. The first one that ends the run determines how.
  Directive observe(const TraceEntry& row, const MapView& at) {
    const MapView view{at.space, at.x,
                       [&] { return start_.in_model_units(map_.with(at.space, at.x)); }};
    const auto ask = [&](const MapObserver& observer) {
      const Directive directive = observer(row, view);
      if (observed_ == Directive::Continue) observed_ = directive;
    };
    if (options_.solve.watch) ask(options_.solve.watch);
    if (extension_)
      for (const MapObserver& observer : extension_->observers()) ask(observer);
    return observed_;
  }

  void show_start() {
    if (!setup_.watch) return;
    TraceEntry row;
    row.record.iteration = static_cast<int>(record_.trace().size());
    row.record.energy = row.energy = result_.initial_value;
    observe(row, {map_.shared_space(), map_.control_points(), {}});
  }

  // Returns whether a barrier between parts of the boundary suits the request better than a
  // scaffold. It knows neither curves nor additions, and its weight is that of energies that
  // nothing else opposes: not of springs, weighted faces, or densities that an enlarged image
  // escapes.
  bool may_use_barrier() const {
    const MapOptions& map = options_.map;
    const auto is_weighted = [](const WeightedEnergy& e) { return e.face_weight.size() > 0; };
    return map.degree == 1 && !options_.extend && !sharing_.part() && map.pins.empty() &&
           map.handles.empty() && map.face_weight.size() == 0 && !knows_elements(map.energy) &&
           std::none_of(map.energy.begin(), map.energy.end(), is_weighted) &&
           free_scale_of(map.energy) != FreeScale::Arbitrary &&
           options_.solve.scaffold != ScaffoldUse::FromTheStart &&
           options_.solve.scaffold_flips == ScaffoldFlips::Performed &&
           setup_.solve.curvature.model == Curvature::Projected;
  }

  std::unique_ptr<MapDomain> make_domain() {
    if (!is_kept_apart()) return std::make_unique<PlainDomain>(std::move(prepared_));
    if (may_use_barrier() && has_no_overlaps(map_)) {
      auto barrier = std::make_unique<BarrierDomain>(map_, start_.scale(), setup_.rules);
      has_barrier_ = !barrier->is_crowded(map_.control_points());
      if (has_barrier_) return barrier;
    }
    return make_scaffold();
  }

  std::unique_ptr<MapDomain> make_scaffold() {
    has_barrier_ = false;
    if (options_.solve.scaffold == ScaffoldUse::FromTheStart) record_.begin(Activity::Scaffold);
    try {
      return std::make_unique<ScaffoldedDomain>(map_, options_.solve.scaffold_flips, setup_.rules,
                                                setup_.stop);
    } catch (const Error& e) {
      throw Refusal(
          e.kind(), map_.mesh().file(),
          fmt::format("{}the start overlaps itself ({}); ", message_prefix(map_.mesh()), e.what()),
          options_.map.initial ? Hint::AllowOrOtherStart : Hint::AllowOverlaps);
    }
  }

  void account(const DegreeSchedule::Counts& counts) {
    add_counts(result_.injectivity_tests, counts.injectivity_tests);
    result_.remedies = counts.remedies;
    result_.variables = counts.variables;
    result_.constraint_residual = counts.constraint_residual / start_.scale();
    for (const FixedPoint& h : setup_.map.handles)
      result_.handle_distance = std::max(
          result_.handle_distance,
          (map_.control_points().segment<2>(2 * h.node) - h.position).norm() / start_.scale());
    sharing_.account(result_);
  }

  ParametrizationResult conclude(const SolveResult& solved) {
    extend(map_);
    report_additions();
    result_.status = solved.status;
    result_.message = solved.message;
    result_.value_quadrature = solved.energy;
    result_.newton_decrement = relative_to(solved.energy, solved.newton_decrement);
    result_.map = start_.in_model_units(map_);
    result_.flips = domain_->flips();
    result_.scaffold_seconds = domain_->seconds();
    const std::optional<Scaffold> scaffold = domain_->surroundings();
    if (scaffold) result_.scaffold = start_.in_model_units(scaffold->mesh());
    prove_result(result_, options_, sharing_, record_);
    take_cost();
    return std::move(result_);
  }

  void report_additions() {
    if (!extension_) return;
    const Vec& x = map_.control_points();
    for (const auto& [term, weight] : extension_->terms()) {
      const ColoredBatches plan(term->element_dofs(), {});
      result_.terms.push_back(
          {std::string(term->name()), weight, element_values(*term, {}, plan, x).sum()});
    }
    for (const auto& checker : extension_->checkers())
      result_.checks.push_back({std::string(checker->name()), checker->check(x)});
  }

  void take_cost() {
    result_.factor_solve_seconds = factor_solve_seconds(record_.trace(), map_.degree());
    if (result_.factor_solve_seconds || options_.solve.factor_cost == FactorCost::IfKnown) return;
    TraceEntry row;
    row.degree = map_.degree();
    try {
      DegreeSolver solver(setup_, *domain_, map_.shared_space(), map_.control_points());
      row.record = solver.try_step();
    } catch (const Stopped&) {
      return;
    }
    result_.factor_solve_seconds = factor_solve_seconds({row}, map_.degree());
  }

  const ParametrizationOptions& options_;
  RunRecord& record_;
  RunSharing& sharing_;
  NormalizedStart start_;
  BezierMap map_;  // normalized: the start, then the result
  DegreeSolver::Setup setup_;
  std::shared_ptr<PreparedParts> prepared_;        // until there is a domain; may be null
  std::shared_ptr<const MapExtension> extension_;  // of the degree of map_, or of one below
  Directive observed_ = Directive::Continue;
  std::optional<Apart> apart_;  // while there is no scaffold yet
  std::unique_ptr<MapDomain> domain_;
  bool has_barrier_ = false;  // the domain is a BarrierDomain
  std::optional<DegreeSchedule> schedule_;
  ParametrizationResult result_;
};

void require_degree_one(const BezierMap& start) {
  if (start.degree() != 1)
    throw InvalidArgument(
        fmt::format("a start must have degree 1, this one has {}", start.degree()));
  require_finite("the start", start.control_points());
}

// Solves from a start. prepared: for this start; may be null.
ParametrizationResult solve_from(const BezierMap& start, const ParametrizationOptions& options,
                                 const SolverRules& rules, RunRecord& record,
                                 std::shared_ptr<PreparedParts> prepared) {
  require_valid(options);
  require_degree_one(start);
  const ThreadCount threads(options.solve.threads);
  ParametrizationOptions resolved = options;
  resolved.map = with_targets(start, options.map);
  RunSharing alone;
  ParametrizationResult result;
  // Edges that stay parallel to an axis leave a start no rotation towards pins.
  if (meets_pins(start, resolved.map.pins) || !options.map.aligned.empty()) {
    result = Run(rules, alone, start, options, record, std::move(prepared)).solve();
  } else {
    require_scale(resolved.map, start);
    const PinSolver solver = pin_solver(record, rules);
    const BezierMap led = pin_homotopy(start, resolved.map, options.solve, solver, record);
    result = Run(rules, alone, led, resolved, record).solve();
  }
  result.handles = resolved.map.handles;
  return result;
}

}  // namespace

ParametrizationResult parametrize_by(const SolverRules& rules, const BezierMap& start,
                                     const ParametrizationOptions& options, RunRecord& record) {
  return solve_from(start, options, rules, record, nullptr);
}

ParametrizationResult parametrize_shared(RunSharing& sharing, const BezierMap& start,
                                         const ParametrizationOptions& options, RunRecord& record) {
  require_valid(options);
  require_degree_one(start);
  const ThreadCount threads(options.solve.threads);
  return Run(SolverRules{}, sharing, start, options, record).solve();
}

// Returns a solver whose scaffolds do not yield: the next step would otherwise begin with triangles
// squeezed between parts that have come close.
PinSolver pin_solver(RunRecord& record, const SolverRules& base_rules) {
  SolverRules rules = base_rules;
  rules.scaffold.at_rest = -std::numeric_limits<double>::infinity();
  return [&record, rules](const BezierMap& start, const MapOptions& map_options,
                          const SolveOptions& solve_options) -> std::optional<BezierMap> {
    SolveOptions seen = solve_options;
    if (solve_options.watch)
      seen.watch = [&solve_options](const TraceEntry& row, const MapView& at) {
        solve_options.watch(row, at);
        return Directive::Continue;
      };
    ParametrizationResult result = parametrize_by(rules, start, {map_options, seen, {}}, record);
    if (result.status == Status::Failed) return std::nullopt;
    return std::move(result.map);
  };
}

ParametrizationResult parametrize(const BezierMap& start, const ParametrizationOptions& options,
                                  RunRecord& record) {
  if (options.solve.effort == Effort::High)
    return parametrize_on_paths({[&](const ParametrizationOptions& of_path, RunRecord& part) {
                                  return parametrize(start, of_path, part);
                                }},
                                options, record);
  return parametrize_by(SolverRules{}, start, options, record);
}

// Returns solves from the start that the options name, and from Tutte's map beside one in many
// resolutions.
std::vector<SolveFromStart> solves_of(const std::shared_ptr<const SurfaceMesh>& mesh,
                                      const MapOptions& options) {
  std::vector<StartMethod> methods{options.start};
  if (options.start == StartMethod::Automatic && !options.initial &&
      tries_multiresolution(*mesh, options))
    methods.push_back(StartMethod::Tutte);
  std::vector<SolveFromStart> solves;
  for (const StartMethod method : methods)
    solves.push_back([mesh, method](const ParametrizationOptions& of_path, RunRecord& part) {
      ParametrizationOptions from = of_path;
      from.map.start = method;
      return parametrize(mesh, from, part);
    });
  return solves;
}

ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options, RunRecord& record) {
  require_given("parametrize: the mesh", mesh);
  require_valid(options);
  if (options.solve.effort == Effort::High)
    return parametrize_on_paths(solves_of(mesh, options.map), options, record);
  const double started = record.seconds();
  const ThreadCount threads(options.solve.threads);
  record.begin(Activity::Starting);
  MapOptions map_options = options.map;
  if (options.extend && map_options.start == StartMethod::Automatic)
    map_options.start = StartMethod::Tutte;
  mesh->require_planar();
  require_face_data(*mesh, map_options);
  SolverRules rules;
  PreparedSolve preparing(mesh, options, rules, record);
  ChosenStart chosen = choose_start(*mesh, map_options, record);
  std::shared_ptr<PreparedParts> prepared = preparing.finish();
  const BezierMap start = prepared ? BezierMap(mesh, prepared->space, std::move(chosen.uv))
                                   : BezierMap::linear(mesh, std::move(chosen.uv));
  rules.scaffold.from_the_start = chosen.free_maps_overlap;
  const double initialize_seconds = record.seconds() - started;
  ParametrizationResult result = solve_from(start, options, rules, record, std::move(prepared));
  result.start = chosen.method;
  result.initialize_seconds = initialize_seconds;
  return result;
}

ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options) {
  RunRecord record;
  return parametrize(std::move(mesh), options, record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
