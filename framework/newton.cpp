#include "majorant/framework/newton.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/heap.h"
#include "majorant/framework/internal/lbfgs_history.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/internal/try_shifts.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

// The relative decrement below which rounding errors of the gradient matter. Its square root, 1e-5,
// is the relative distance to the minimum.
constexpr double kPolish = 1e-10;
// The shift of a polished Hessian, relative to the mean diagonal: ten times kPolish, well above the
// rounding of the Hessian.
constexpr double kPolishShift = 1e-9;
// A decrease below this part of the decrement means that the Hessian misleads: a quadratic
// decreases by half of the decrement.
constexpr double kMisleading = 0.1;
// The shift, as a multiple of a rotation's negative curvature; 1 would leave the Hessian singular.
constexpr double kRotationShift = 1.5;
// The Hessian of a minimum is definite with this shift, relative to the mean diagonal: rounding
// errors of its entries and of their factorization are far smaller.
constexpr double kSaddle = 1e-8;
// The number of steps of inverse iteration for the direction of most negative curvature. The shift
// is at most ten times the required one, so each step gains unless the next eigenvalue is close.
constexpr int kInverseIterations = 30;
// The first trial away from a saddle, as a part of |y|; the line search grows or shortens it.
constexpr double kEscape = 1e-2;
// The distances down the gradient, relative to |y|, at which curvature is measured if there is none
// at y.
constexpr double kBeside[] = {1e-3, 1e-2, 1e-1, 1};
// After a step shorter than this part of its direction, the next shift must not be smaller.
constexpr double kHalfStep = 0.5;
// The factor of the shift after a step that was much too short, and the largest shift.
constexpr double kRaisedShift = 10, kLargestShift = 10;
// BlendedCurvature::projection_weight of absolute eigenvalues.
constexpr double kAbsoluteProjection = 2;
// The values to which t of a blend rises after a failure: by a factor of about 5, so that two
// failures lead from the exact Hessian to a mostly projected one.
constexpr double kRaised[] = {0.1, 0.5, 1};

}  // namespace

// L-BFGS around the factor of the last Newton step.
class NewtonStepper::LaggedFactor {
 public:
  explicit LaggedFactor(const LaggedFactorRules& rules)
      : rules_(rules), history_(rules.history, LbfgsOptions().cautious) {}

  bool serves() const { return steps_ > 0; }
  void drop() {
    steps_ = 0;
    history_.release();
  }

  // Starts anew after a Newton step from y, with the gradient g.
  void renew(const Vec& y, const Vec& g, const Partition& partition, const IterationRecord& r,
             double relative_decrement) {
    steps_ = relative_decrement <= rules_.below && !is_short(r) ? rules_.steps : 0;
    if (steps_ > 0) history_.start(y, g, partition);
  }
  // Computes p = -B g at y, the next point.
  void direction(LinearSolver& solver, const Vec& y, const Vec& g, Vec& p) {
    history_.visit(y, g);
    history_.apply([&](const Vec& r, Vec& out) { solver.solve(r, out, kPreconditionerTolerance); },
                   -g, p);
    --steps_;
  }
  void judge(const IterationRecord& r) {
    if (is_short(r)) drop();
  }

 private:
  bool is_short(const IterationRecord& r) const { return r.step < rules_.short_step; }

  LaggedFactorRules rules_;
  History history_;
  int steps_ = 0;  // for which the factor may still be used
};

namespace {

// Returns the unknowns whose values distinguish the motions best, one for each motion.
std::vector<Index> gauge_of(const Eigen::MatrixXd& motions, Index size) {
  require_size("NewtonOptions: near_null_space", motions.rows(), size);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(motions.transpose());
  std::vector<Index> unknowns;
  for (Index k = 0; k < factors.rank(); ++k)
    unknowns.push_back(factors.colsPermutation().indices()[k]);
  return unknowns;
}

void require_rules(const BlendRules& rules) {
  require_in("NewtonOptions: blend.fall", rules.fall, 0, 1);
  require_in("NewtonOptions: blend.least", rules.least, 0, 1);
  require_at_least("NewtonOptions: blend.below", rules.below, 0);
  require_at_least("NewtonOptions: blend.hold", rules.hold, 0);
  require_at_least("NewtonOptions: blend.short_step", rules.short_step, 0);
  require_at_least("NewtonOptions: blend.whole_steps", rules.whole_steps, 0);
  require_at_least("NewtonOptions: blend.misled_steps", rules.misled_steps, 0);
}

}  // namespace

double rotation_shift(const Vec& y, const Vec& gradient, const Partition& partition) {
  const double size = partition.squared_norm(y);
  return size > 0 ? kRotationShift * std::max(0.0, -partition.dot(y, gradient)) / size : 0.0;
}

NewtonStepper::~NewtonStepper() = default;

NewtonStepper::NewtonStepper(const Problem& problem, NewtonOptions options)
    : Stepper(problem, options.line_search, options.stopping.decrement, options.stop),
      options_(std::move(options)),
      solver_(make_solver("NewtonOptions", options_.linear_solver)),
      lagged_(std::make_unique<LaggedFactor>(options_.lagged)) {
  require_curvature(problem);
  require_in("NewtonOptions: forcing.largest", options_.forcing.largest, 0, 1);
  if (!(options_.projection >= 0 && options_.projection <= 2))
    throw InvalidArgument(fmt::format("NewtonOptions: projection is {:g}, it must lie in [0, 2]",
                                      options_.projection));
  require_at_least("NewtonOptions: adaptive.tolerance", options_.adaptive.tolerance, 0);
  if ((options_.projection != 1 || options_.adaptive.tolerance > 0) &&
      options_.curvature != Curvature::Projected)
    throw InvalidArgument(
        "NewtonOptions: projection is that of Curvature::Projected, no other has one");
  require_at_least("NewtonOptions: saddles_to_leave", options_.saddles_to_leave, 0);
  if (options_.saddles_to_leave > 0 && !options_.tests_minimum)
    throw InvalidArgument("NewtonOptions: saddles_to_leave needs tests_minimum");
  if (options_.holds_null_space && !options_.near_null_space)
    throw InvalidArgument("NewtonOptions: holds_null_space needs near_null_space");
  if (options_.holds_null_space && partition_of(problem).ranks().count() > 1)
    throw InvalidArgument("NewtonOptions: holds_null_space is for problems of one process");
  require_at_least("NewtonOptions: lagged.history", options_.lagged.history, 0);
  require_at_least("NewtonOptions: lagged.steps", options_.lagged.steps, 0);
  require_rules(options_.blend);
  require_in("NewtonOptions: shifts.least", options_.shifts.least, 0, 1);
  require_in("NewtonOptions: shifts.short_step", options_.shifts.short_step, 0, 1);
  require_in("NewtonOptions: shifts.cut_step", options_.shifts.cut_step, 0, 1);
  require_in("NewtonOptions: shifts.fall", options_.shifts.fall, 0, 1);
  require_at_least("NewtonOptions: shifts.wait", options_.shifts.wait, 0);
  whole_weight_ = first_projection();
  analyze();
}

void NewtonStepper::analyze() {
  const Problem& problem = evaluator_.problem();
  gauge_.clear();
  if (options_.near_null_space) {
    Eigen::MatrixXd motions = options_.near_null_space(problem);
    if (options_.holds_null_space) gauge_ = gauge_of(motions, problem.size());
    solver_->hint_near_null_space(std::move(motions));
  }
  analyze_shared(*solver_, problem.pattern(), partition_of(problem));
}

void NewtonStepper::require_curvature(const Problem& problem) const {
  majorant::require_curvature("Newton", problem, options_.curvature);
}

void NewtonStepper::reset(const Problem& problem) {
  const bool same = problem.same_structure(evaluator_.problem());
  if (!same) require_curvature(problem);
  evaluator_.reset(problem);
  relative_decrement_ = std::numeric_limits<double>::infinity();
  last_gradient_norm_ = 0;
  shift_ = 0;
  shift_wait_ = next_wait_ = 0;
  is_raised_ = false;
  whole_weight_ = first_projection();
  misled_ = exact_wait_ = 0;
  next_exact_wait_ = 1;
  keeps_exact_ = false;
  lagged_->drop();
  if (!same) analyze();
}

void NewtonStepper::polish() {
  keeps_exact_ = true;
  projection_weight_ = 0;
  hold_ = whole_steps_ = 0;
  lagged_->drop();
}

void NewtonStepper::advance(Vec& y, double& energy, Step& step) {
  if (!lagged_->serves() || !lagged_step(y, energy, step)) newton_step(y, energy, step);
}

void NewtonStepper::newton_step(Vec& y, double& energy, Step& step) {
  IterationRecord& r = step.record;
  lagged_->drop();
  is_damped_ = false;
  if (solver_->bytes() >= kLargeFactor) release_free_memory();
  step.outcome = Outcome::Breakdown;  // whatever the outcome of a step on a kept factor
  if (!find_direction(y, r)) return;
  hessian_ = Vec();  // frees memory for steps on its factor
  const double before = energy;
  const Vec from = y;
  move_along(p_, 1.0, y, energy, step);
  learn_shift(step);
  while (is_raised_ && (step.outcome == Outcome::Blocked || step.outcome == Outcome::NoDecrease)) {
    if (!solve_whole(y, r)) break;
    hessian_ = Vec();
    move_along(p_, 1.0, y, energy, step);
    learn_shift(step);
  }
  if (no_shift_helps(step)) {
    // If all eigenvalues are negative, for example, the remaining diagonal has no scale for shifts.
    shift_ = 0;
    if (solve_absolute(y, r)) {
      hessian_ = Vec();
      move_along(p_, 1.0, y, energy, step);
    }
  }
  last_gradient_norm_ = r.gradient_norm;
  if (step.outcome == Outcome::Breakdown) return;
  relative_decrement_ = relative_decrement(before, r);
  learn_projection(step);
  if (is_exact_)
    learn_exact(step);
  else
    learn_weight(step);
  // An iterative solver has no factor to keep: its cost is that of the solves.
  if (step.outcome == Outcome::Moved && r.solver_iterations == 0)
    lagged_->renew(from, gradient_, partition_of(evaluator_.problem()), r, relative_decrement_);
}

// Returns whether the last factor gave a step; otherwise y is unchanged.
bool NewtonStepper::lagged_step(Vec& y, double& energy, Step& step) {
  IterationRecord& r = step.record;
  Stopwatch watch;
  evaluator_.gradient(y, gradient_, stop_);
  r.seconds.assemble += watch.restart();
  lagged_->direction(*solver_, y, gradient_, p_);
  r.seconds.solve += watch.restart();
  r.curvature = options_.curvature;
  const double before = energy;
  move_along(p_, 1.0, y, energy, step);
  if (step.outcome != Outcome::Moved) return false;
  relative_decrement_ = relative_decrement(before, r);
  lagged_->judge(r);
  return true;
}

bool NewtonStepper::blends() const {
  const Problem& problem = evaluator_.problem();
  return options_.curvature != Curvature::Exact && relative_decrement_ <= options_.blend.below &&
         problem.supports(Curvature::Exact) && problem.supports(Curvature::Projected);
}

// Computes gradient, factors and direction at y.
bool NewtonStepper::find_direction(const Vec& y, IterationRecord& record) {
  is_exact_ = false;
  if (tries_exact()) {
    projection_weight_ = 0;
    is_exact_ = solve_blend(y, record);
    projection_weight_ = 1;
    if (is_exact_) return true;
    keeps_exact_ = false;
    exact_wait_ = next_exact_wait_;
    next_exact_wait_ *= 2;
  }
  if (blends()) {
    if (whole_steps_ == 0) {
      for (; projection_weight_ < 1; raise_weight(projection_weight_))
        if (solve_blend(y, record)) return true;
    } else {
      --whole_steps_;
    }
  }
  if (solve_whole(y, record)) return true;
  // The projection of a Hessian whose eigenvalues are all negative is 0.
  if (options_.curvature != Curvature::Projected || whole_weight_ >= kAbsoluteProjection)
    return false;
  return solve_absolute(y, record);
}

// Solves with absolute eigenvalues, for this step alone. If all vanish, as at a point of
// inflection, the Hessian is taken at a point down the gradient.
bool NewtonStepper::solve_absolute(const Vec& y, IterationRecord& record) {
  const double weight = std::exchange(whole_weight_, kAbsoluteProjection);
  bool is_found = solve_whole(y, record);
  const Partition& partition = partition_of(evaluator_.problem());
  const double slope = partition.norm(gradient_), size = std::max(1.0, partition.norm(y));
  if (!is_found && partition.all(hessian_.isZero(0)) && slope > 0 && std::isfinite(slope)) {
    const Vec gradient = gradient_;
    for (const double distance : kBeside) {
      const Vec beside = y - distance * size / slope * gradient;
      if (!std::isfinite(evaluator_.value(beside, stop_))) break;
      evaluator_.linearize(beside, BlendedCurvature::projected(kAbsoluteProjection), gradient_,
                           hessian_, stop_);
      gradient_ = gradient;
      const ShiftedFactorization f =
          try_shifts([&](double shift) { return solve_shifted(shift, record); }, mean_diagonal(),
                     options_.shifts.least, stop_);
      record.shift = f.shift;
      record.factorizations += f.factorizations;
      record.failed_factorizations += f.failed();
      is_found = f.status == FactorStatus::Ok;
      if (is_found) break;
    }
  }
  whole_weight_ = weight;
  return is_found;
}

// Applies ForcingRules. The numbers of the last step may be those of another point, or missing.
double NewtonStepper::tolerance() const {
  const ForcingRules& rules = options_.forcing;
  if (last_gradient_norm_ == 0) return rules.largest;
  const double ratio = partition_of(evaluator_.problem()).norm(gradient_) / last_gradient_norm_;
  const double safeguard = rules.part * last_tolerance_ * last_tolerance_;
  const double eta =
      std::max(rules.part * ratio * ratio, safeguard > rules.safeguarded ? safeguard : 0.0);
  return std::min(rules.largest, eta);
}

double NewtonStepper::mean_diagonal() const {
  return majorant::mean_diagonal(evaluator_.problem().pattern(), hessian_,
                                 partition_of(evaluator_.problem()));
}

// If g is orthogonal to the motions N, and the unknowns of E distinguish the motions, then (H + m E
// E^T) p = -g has the solution of H p = -g that is 0 at the unknowns of E.
void NewtonStepper::hold_gauge() {
  if (gauge_.empty()) return;
  const double mean = mean_diagonal();
  const SparsePattern& pattern = evaluator_.problem().pattern();
  for (const Index unknown : gauge_) hessian_[pattern.diagonal_slot(unknown)] += mean;
}

// Solves with the present hessian_ and gradient_.
FactorStatus NewtonStepper::solve_shifted(double shift, IterationRecord& record) {
  Stopwatch watch;
  const FactorStatus factors = solver_->factorize_until(stop_, hessian_, shift);
  record.seconds.factorize += watch.restart();
  if (factors != FactorStatus::Ok) return factors;
  last_tolerance_ = tolerance();
  const Solution solution = solver_->solve(-gradient_, p_, last_tolerance_);
  record.seconds.solve += watch.restart();
  record.residual = solution.residual;
  record.solver_iterations += solution.iterations;
  if (solution.status == SolveStatus::Indefinite) return FactorStatus::NotPositiveDefinite;
  require_size("LinearSolver::solve: p", p_.size(), gradient_.size());
  return FactorStatus::Ok;
}

// Close to the minimum a small shift is kept. Otherwise rounding errors of the gradient would move
// y along motions that do not change the energy.
bool NewtonStepper::solve_blend(const Vec& y, IterationRecord& record) {
  Stopwatch watch;
  const BlendedCurvature blend = BlendedCurvature::projected(projection_weight_);
  evaluator_.linearize(y, blend, gradient_, hessian_, stop_);
  hold_gauge();
  record.seconds.assemble += watch.restart();
  const Partition& partition = partition_of(evaluator_.problem());
  record.shift = options_.blend.shift
                     ? (1 - projection_weight_) * options_.blend.shift(y, gradient_, partition)
                     : 0.0;
  if (projection_weight_ == 0 && relative_decrement_ <= kPolish)
    record.shift = std::max(record.shift, kPolishShift * mean_diagonal());
  stop_.poll();
  const FactorStatus status = solve_shifted(record.shift, record);
  record.curvature = blend.model;
  record.projection_weight = blend.projection_weight;
  ++record.factorizations;
  record.failed_factorizations += status != FactorStatus::Ok;
  return status == FactorStatus::Ok;
}

bool NewtonStepper::solve_whole(const Vec& y, IterationRecord& record) {
  Stopwatch watch;
  const BlendedCurvature whole = options_.curvature == Curvature::Projected
                                     ? BlendedCurvature::projected(whole_weight_)
                                     : BlendedCurvature(options_.curvature);
  evaluator_.linearize(y, whole, gradient_, hessian_, stop_);
  hold_gauge();
  record.curvature = whole.model;
  record.projection_weight = whole.projection_weight;
  record.seconds.assemble += watch.restart();
  if (!partition_of(evaluator_.problem()).all_finite(gradient_)) return false;
  const double diagonal = mean_diagonal(), first = first_shift();
  const ShiftedFactorization f =
      try_shifts([&](double shift) { return solve_shifted(shift, record); }, diagonal,
                 options_.shifts.least, stop_, first);
  is_damped_ = first > options_.shifts.least;
  fall_ = f.failed() > 0 || fall_ == 0 || fall_ == 1 ? options_.shifts.fall : fall_ * fall_;
  if (first == 0 && f.failed() > 0) {
    shift_wait_ = next_wait_ = std::max(options_.shifts.wait, 2 * next_wait_);
  } else if (first == 0) {
    next_wait_ = 0;
  }
  shift_ = diagonal > 0 ? f.shift / diagonal : 0;
  record.shift = f.shift;
  record.factorizations += f.factorizations;
  record.failed_factorizations += f.failed();
  return f.status == FactorStatus::Ok;
}

// Returns the relative shift with which a step without a blend begins.
double NewtonStepper::first_shift() {
  const ShiftRules& rules = options_.shifts;
  const bool waits = shift_wait_ > 0;
  if (waits) --shift_wait_;
  if (is_raised_) return shift_;
  if (rules.fall == 0) return 0;
  const double first = fall_ * shift_;
  if (first >= rules.least) return first;
  return waits ? rules.least : 0;
}

// Raises the shift if a direction was cut to almost nothing: its Hessian is nearly singular, or is
// a good model only very close to y. Near a minimum a cut comes from rounding instead.
void NewtonStepper::learn_shift(Step& step) {
  const ShiftRules& rules = options_.shifts;
  step.is_damped = is_damped_;
  const bool is_whole = step.record.projection_weight >= whole_weight_ || !blends();
  const bool is_energy = step.record.limit == StepLimit::Energy;
  const double least = is_energy ? std::max(rules.short_step, rules.cut_step) : rules.short_step;
  const bool is_cut = step.outcome == Outcome::Blocked || step.outcome == Outcome::NoDecrease ||
                      (step.outcome == Outcome::Moved && step.record.step < least);
  if (rules.short_step > 0 && is_whole && is_energy && step.outcome == Outcome::Moved &&
      step.record.step < kHalfStep)
    fall_ = 1;
  is_raised_ = rules.short_step > 0 && is_whole && is_cut && shift_ < kLargestShift &&
               relative_decrement(step.energy_before, step.record) >
                   std::max(LineSearch::kResolution, options_.stopping.stall_decrement);
  step.is_direction_too_long = is_raised_;
  if (!is_raised_) return;
  fall_ = rules.fall;
  const double missing = step.outcome == Outcome::Moved ? least / step.record.step : 0;
  shift_ = std::clamp(std::max(kRaisedShift, missing) * shift_, rules.least, kLargestShift);
}

bool NewtonStepper::no_shift_helps(const Step& step) const {
  return (step.outcome == Outcome::Blocked || step.outcome == Outcome::NoDecrease) &&
         shift_ >= kLargestShift && options_.curvature == Curvature::Projected &&
         whole_weight_ < kAbsoluteProjection;
}

double NewtonStepper::first_projection() const {
  return options_.adaptive.tolerance > 0 ? kAbsoluteProjection : options_.projection;
}

// For a step s p with H p = -g, the quadratic model predicts the decrease (s - s^2 / 2) (-g.p).
void NewtonStepper::learn_projection(const Step& step) {
  if (options_.adaptive.tolerance == 0) return;
  const IterationRecord& r = step.record;
  const double promised = r.step * (1 - r.step / 2) * r.newton_decrement;
  const double ratio =
      step.outcome == Outcome::Moved ? (step.energy_before - r.energy) / promised : 0;
  whole_weight_ = std::abs(ratio - 1) <= options_.adaptive.tolerance ? 1 : kAbsoluteProjection;
}

bool NewtonStepper::tries_exact() {
  const BlendRules& rules = options_.blend;
  const Problem& problem = evaluator_.problem();
  if (rules.misled_steps == 0 || options_.curvature == Curvature::Exact ||
      !problem.supports(Curvature::Exact) || !problem.supports(Curvature::Projected))
    return false;
  if (keeps_exact_) return true;
  if (misled_ < rules.misled_steps) return false;
  if (exact_wait_ > 0) --exact_wait_;
  return exact_wait_ == 0;
}

void NewtonStepper::learn_exact(const Step& step) {
  keeps_exact_ = step.outcome == Outcome::Moved && step.record.step >= options_.blend.short_step;
  if (keeps_exact_) {
    next_exact_wait_ = 1;
  } else {
    misled_ = 0;
  }
}

// Chooses the next blend.
void NewtonStepper::learn_weight(const Step& step) {
  const IterationRecord& r = step.record;
  const BlendRules& rules = options_.blend;
  const bool is_short = step.outcome != Outcome::Moved || r.step < rules.short_step;
  misled_ = is_short ? misled_ + 1 : 0;
  // The Hessian misleads if the decrease is far below the model's -g.p / 2 and well above rounding.
  const bool misled = step.outcome != Outcome::AtMinimum && r.projection_weight < 1 &&
                      relative_decrement_ > LineSearch::kResolution &&
                      r.relative_decrease < kMisleading * relative_decrement_;
  if (misled) {
    raise_weight(r.projection_weight);
  } else if (step.outcome == Outcome::Moved && r.step < rules.short_step) {
    projection_weight_ = 1;
    whole_steps_ = rules.whole_steps;
  } else if (hold_ > 0) {
    --hold_;
  } else if (blends()) {
    projection_weight_ =
        r.projection_weight * rules.fall < rules.least ? 0 : r.projection_weight * rules.fall;
  }
}

void NewtonStepper::raise_weight(double failed) {
  projection_weight_ = *std::upper_bound(std::begin(kRaised), std::end(kRaised) - 1, failed);
  hold_ = options_.blend.hold;
}

Definite NewtonStepper::definite_at(const Vec& y) {
  if (!evaluator_.problem().supports(Curvature::Exact)) return Definite::NotTested;
  try {
    evaluator_.linearize(y, Curvature::Exact, gradient_, hessian_, stop_);
    lagged_->drop();
    IterationRecord unused;
    const FactorStatus status = solve_shifted(kSaddle * mean_diagonal(), unused);
    return status == FactorStatus::Ok ? Definite::Yes : Definite::No;
  } catch (const Stopped&) {
    return Definite::NotTested;
  }
}

// Inverse iteration with H + shift, whose eigenvector of the least eigenvalue is that of H.
bool NewtonStepper::leave_saddle(Vec& y, double& energy) {
  const Problem& problem = evaluator_.problem();
  const Partition& partition = partition_of(problem);
  evaluator_.linearize(y, Curvature::Exact, gradient_, hessian_, stop_);
  lagged_->drop();
  IterationRecord unused;
  const ShiftedFactorization factors = try_shifts(
      [&](double shift) { return solve_shifted(shift, unused); }, mean_diagonal(), kSaddle, stop_);
  if (factors.status != FactorStatus::Ok || factors.shift == 0) return false;
  Vec v = Vec::LinSpaced(problem.size(), 1, 2), next;
  for (Index k = 1; k < v.size(); k += 2) v[k] = -v[k];
  double curvature = 0;
  for (int k = 0; k < kInverseIterations; ++k) {
    v /= partition.norm(v);
    solver_->solve(v, next, kPreconditionerTolerance);
    curvature = 1 / partition.dot(v, next) - factors.shift;
    std::swap(v, next);
  }
  if (!(curvature < 0)) return false;
  const double size = partition.norm(y);
  v *= (size > 0 ? kEscape * size : 1.0) / partition.norm(v);
  if (partition.dot(gradient_, v) > 0) v = -v;
  const double promised = -curvature / 2 * partition.squared_norm(v);
  LineSearch search(evaluator_, options_.line_search, y, v, energy, promised, stop_);
  if (search.find(1.0) != LineSearch::Result::Accepted || !(search.energy() < energy)) return false;
  y += search.step() * v;
  energy = search.energy();
  return true;
}

SolveResult NewtonMinimizer::minimize(const Problem& problem, Vec y0, RunObserver* observer) const {
  NewtonStepper stepper(problem, options_);
  SolveResult result = stepper.minimize(std::move(y0), options_.stopping, observer);
  const auto test = [&] {
    if (options_.tests_minimum && result.status == Status::Converged && result.y.size() > 0)
      result.definite = stepper.definite_at(result.y);
    return result.definite;
  };
  const auto leave = [&] {
    try {
      return stepper.leave_saddle(result.y, result.energy);
    } catch (const Stopped&) {
      return false;
    }
  };
  for (int left = 0; test() == Definite::No; ++left) {
    if (left == options_.saddles_to_leave || !leave()) {
      result.message += ", at a saddle: the exact Hessian is indefinite there";
      break;
    }
    StoppingRules rules = options_.stopping;
    const auto taken = static_cast<int>(result.iterations.size());
    rules.max_iterations = std::max(0, rules.max_iterations - taken);
    SolveResult rest = stepper.descend_from(std::move(result.y), result.energy, rules, observer);
    for (IterationRecord& record : rest.iterations) record.iteration += taken;
    rest.iterations.insert(rest.iterations.begin(), result.iterations.begin(),
                           result.iterations.end());
    result = std::move(rest);
  }
  if (options_.projection != 1 || options_.adaptive.tolerance > 0)
    for (const TermId id : problem.terms())
      if (!problem.term(id).supports(Curvature::Exact))
        result.message += fmt::format("; term '{}' projects its Hessian by a rule of its own",
                                      problem.term(id).name());
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
