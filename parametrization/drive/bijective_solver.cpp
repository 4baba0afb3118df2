#include "majorant/parametrization/drive/bijective_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/evaluator.h"
#include "majorant/parametrization/drive/solver_rules.h"

namespace majorant {
namespace {

// lambda E_conf / E. [MC20] Sec. 6 has 1e-4: too weak a barrier where curves touch (scorpion_500 at
// degree 3 stalls at 5.386 with 1e-4 and converges to 4.996 with 1e-3, own energies); elsewhere the
// energy is 3e-5 to 2e-4 higher (docs/bijective.md).
constexpr double kScaffoldShare = 1e-3;
// A change of lambda below this part does not count: the stepper keeps what it has learned.
constexpr double kSameLambda = 0.02;
constexpr double kLeastEnergy = 1e-3;  // mean density: where the map's vanishes, the scaffold stays
constexpr double kStillMoving = 1e-3;  // relative decrease above which the scaffold is relaxed
constexpr int kRelaxSteps = 5;
constexpr int kHelpRounds = 30;
constexpr int kRoundsWithoutStep = 3;  // in which only the scaffold changes

}  // namespace

BijectiveSolver::BijectiveSolver(const DegreeSolver::Setup& setup,
                                 std::shared_ptr<const BezierTriangleSpace> space, Vec x,
                                 Scaffold scaffold)
    : setup_(setup),
      space_(std::move(space)),
      x_(scaffold.joined(x)),
      start_(std::move(x)),
      scaffold_(std::move(scaffold)),
      levels_(optimizer_ladder(space_->degree(), setup.options.quadrature_points),
              space_->element_count()),
      terms_(energy_terms(setup.map, space_, levels_.rules())),
      depth_(setup.options.injectivity_depth) {
  require_curvature(terms_, setup.options.curvature);
  rebuild();
}

// The problem of the scaffold as it is now.
void BijectiveSolver::rebuild() {
  if (injectivity_) depth_counts_ = injectivity_depth_counts();
  injectivity_ = std::make_shared<const LocalInjectivity>(space_, 2 * setup_.map.rest.measure,
                                                          depth_, setup_.stop);
  ProblemBuilder builder(2 * scaffold_.joint_node_count());
  add_map(builder, setup_.map, space_, scaffold_.joined(start_), terms_);
  TermState around;
  around.element_rule = scaffold_.levels();
  builder.add(scaffold_.energy_term(), around);
  builder.add(std::make_shared<const ScaffoldInjectivity>(
      injectivity_, space_->element_count(),
      std::make_shared<const LocalInjectivity>(scaffold_.space(), Vec::Ones(scaffold_.face_count()),
                                               depth_, setup_.stop)));
  builder.add(FixedPoints::at(scaffold_.frame_nodes(), x_));
  problem_ = builder.build();
  lambda_.reset();
  set_states();
}

// Weights of this iteration: lambda, and those of a soft start.
void BijectiveSolver::set_states() {
  const Vec& measure = setup_.map.rest.measure;
  const Vec energy_of = energy_by_face(setup_.map, terms_, levels_.of_faces(), x_, setup_.stop);
  const Vec weight = soft_weights(energy_of, measure);
  const double mean = (weight.size() ? weight.dot(energy_of) : energy_of.sum()) / measure.sum();
  const std::size_t last = problem_.term_count() - 1;
  const double lambda = kScaffoldShare * std::max(mean, kLeastEnergy) / scaffold_energy();
  if (weight.size() == 0 && lambda_ && std::abs(lambda - *lambda_) <= kSameLambda * lambda) return;
  lambda_ = lambda;
  std::vector<TermState> states = energy_states(setup_.map, problem_, levels_.of_faces(), weight);
  states[last].weight = lambda;
  states[last].element_rule = scaffold_.levels();
  problem_ = problem_.with(std::move(states));
  if (stepper_)
    stepper_->reset(problem_);
  else
    stepper_ = std::make_unique<NewtonStepper>(
        problem_, newton_options(setup_.options.curvature, setup_.stop));
}

double BijectiveSolver::scaffold_energy() const {
  const std::size_t last = problem_.term_count() - 1;
  return element_values(problem_.term(last), problem_.state(last), problem_.plan(last), x_).sum();
}

Stepper::Step BijectiveSolver::iterate(SolveResult& result) {
  set_states();
  Vec y = problem_.reduce(x_);
  double energy = stepper_->evaluator().value(y);
  Stepper::Step step = stepper_->step(y, energy);
  x_ = problem_.expand(y);
  result.energy = energy - *lambda_ * scaffold_energy();
  result.newton_decrement = step.record.newton_decrement;
  return step;
}

FlipCounts BijectiveSolver::flip() {
  return setup_.options.scaffold_flips == ScaffoldFlips::Performed ? scaffold_.flip()
                                                                   : FlipCounts{};
}

// Enlarges, flips and relaxes the scaffold after a step; whether its triangulation changed. Near
// the end of a run that nothing hinders the scaffold is left alone.
bool BijectiveSolver::maintain(const IterationRecord& step, const std::vector<Index>& blocking) {
  scaffold_.take(x_);
  refine_scaffold(blocking);
  const bool grown = scaffold_.grow();
  FlipCounts counts = flip();
  if (grown || counts.performed > 0 || step.relative_decrease > kStillMoving ||
      step.step_bound < 1) {
    scaffold_.relax(kRelaxSteps, depth_, setup_.stop);
    const FlipCounts more = flip();
    counts.intended += more.intended;
    counts.performed += more.performed;
  }
  flips_.intended += counts.intended;
  flips_.performed += counts.performed;
  x_ = scaffold_.joined(x_);
  const bool changed = grown || counts.performed > 0;
  if (changed) rebuild();
  return changed;
}

// Scaffold faces that block a step get a finer quadrature rule: theirs does not see the barrier.
void BijectiveSolver::refine_scaffold(const std::vector<Index>& blocking) {
  std::vector<Index> faces;
  for (const Index e : blocking)
    if (e >= space_->element_count()) faces.push_back(e - space_->element_count());
  if (faces.empty()) return;
  scaffold_.refine(faces);
  lambda_.reset();
}

// For a step that was blocked: certificates that look deeper, then finer quadrature on the faces
// that block. Whether anything was left to do.
bool BijectiveSolver::help(const std::vector<Index>& blocking) {
  if (depth_ < kDeepestBisection) {
    depth_ = std::min(depth_ + kBisectionsDeeper, kDeepestBisection);
    rebuild();
    return true;
  }
  std::vector<Index> faces;
  for (const Index e : blocking)
    if (e < space_->element_count()) faces.push_back(e);
  if (!levels_.climb(faces)) return false;
  rebuild();
  return true;
}

SolveResult BijectiveSolver::run(const StoppingRules& rules, RunRecord& record) {
  SolveResult result;
  try {
    iterate_until(rules, record, result);
  } catch (const Stopped& stop) {
    return stopped(std::move(result), stop.why());
  }
  return result;
}

void BijectiveSolver::iterate_until(const StoppingRules& rules, RunRecord& record,
                                    SolveResult& result) {
  const Observer observe = record.observer(space_->degree());
  const auto finish = [&](Status status, const char* message) {
    result.status = status;
    result.message = message;
  };
  set_states();
  result.energy = stepper_->evaluator().value(problem_.reduce(x_)) - *lambda_ * scaffold_energy();
  int idle = 0, without_step = 0;
  while (record.iterations_left() > 0) {
    Stepper::Step step = iterate(result);
    if (step.outcome == Stepper::Outcome::Stopped) throw Stopped(step.why);
    result.blocking = std::move(step.blocking);
    const double scale = std::abs(result.energy);
    const bool near = result.newton_decrement <= rules.stall_decrement * scale;
    if (step.outcome == Stepper::Outcome::Breakdown) return finish(Status::Failed, "no direction");
    if (step.outcome == Stepper::Outcome::AtMinimum) return finish(Status::Converged, "decrement");
    if (step.outcome != Stepper::Outcome::Moved) {
      if (without_step++ < kRoundsWithoutStep && record.directive() == Directive::Continue &&
          maintain(step.record, result.blocking))
        continue;
      return finish(near ? Status::Converged : Status::Stalled, "no further decrease");
    }
    without_step = 0;
    step.record.energy = result.energy;
    if (const Directive why = observe(step.record, x_); why != Directive::Continue) {
      scaffold_.take(x_);
      throw Stopped(why);
    }
    const double decrease = step.record.relative_decrease;
    const bool small = decrease <= rules.relative_decrease;
    const bool changed = maintain(step.record, result.blocking);
    if (small && !changed &&
        result.newton_decrement <= rules.tail_factor * rules.relative_decrease * scale)
      return finish(Status::Converged, "relative decrease");
    idle = small ? idle + 1 : 0;
    if (idle >= rules.stall_iterations)
      return finish(near ? Status::Converged : Status::Stalled,
                    "held at the limit of the feasible set");
  }
  return finish(Status::MaxIterations, "iteration limit");
}

SolveResult BijectiveSolver::approach(double tolerance, RunRecord& record) {
  StoppingRules rules;
  rules.relative_decrease = tolerance;
  rules.stall_decrement = std::numeric_limits<double>::infinity();
  return run(rules, record);
}

SolveResult BijectiveSolver::finish(RunRecord& record) {
  StoppingRules rules;
  rules.relative_decrease = setup_.options.tolerance;
  SolveResult result = run(rules, record);
  try {
    for (int helped = 0, refined = 0;; result = run(rules, record)) {
      if (result.status == Status::Stalled && helped++ < kHelpRounds && help(result.blocking))
        continue;
      if (result.status == Status::Converged && setup_.options.quadrature_points == 0 &&
          refined++ < kAccuracyRounds &&
          levels_.climb_inaccurate(setup_.map, terms_, x_, setup_.stop)) {
        rebuild();
        continue;
      }
      return result;
    }
  } catch (const Stopped& stop) {
    return stopped(std::move(result), stop.why());
  }
}

double BijectiveSolver::constraint_residual() const {
  double residual = 0;
  problem_.reduce(x_, &residual);
  return residual;
}

std::vector<long> BijectiveSolver::injectivity_depth_counts() const {
  return add_counts(injectivity_->depth_counts(), depth_counts_);
}

}  // namespace majorant
