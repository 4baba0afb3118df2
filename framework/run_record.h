// The records of a run: the record of a step (IterationRecord, StepResult), the trace (a row for
// each attempted step), the stages of a run (Activity) and its observer (RunObserver). A RunRecord
// owns the trace of all degrees and rebuilt problems, the time limit and the interruption.
//
//   class Printer final : public RunObserver {
//     void begin(Activity activity) override { std::cerr << activity_name(activity) << "\n"; }
//     Directive after_step(const TraceEntry& row, const Vec&) override {
//       return row.energy < 4.1 ? Directive::Interrupt : Directive::Continue;
//     }
//   };
//   Printer printer;
//   RunRecord record(60, 1000, nullptr, &printer);
//   double in_vain = 0;  // seconds of steps that were not taken
//   for (const TraceEntry& row : record.trace())
//     if (row.outcome != StepResult::Outcome::Moved) in_vain += row.record.seconds.sum();
//
// Solvers, starts and measurements announce their activities and note their steps; progress lines,
// reports and CSV files show them. Not for ending a descent, which StoppingTest does (minimizer.h),
// nor for watching the map itself, which SolveOptions::watch does (maps/map_options.h).
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/framework/curvature.h"
#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

enum class Status {
  Converged,  // a stopping formula holds
  MaxIterations,
  TimeLimit,    // an observer returned it
  Interrupted,  // an observer returned it
  Stalled,      // no step decreases the energy, or only tiny ones, far from a minimum
  Infeasible,   // the start violates a checker or lies outside an energy's domain
  Failed,       // numerical breakdown: no factorization, no finite energy
};
// Returns "converged", "max_iterations", ..., as in reports.
std::string_view status_name(Status status);
Status stopped_status(Directive why);  // of a run that was stopped

// The reason why the line search refused the last trial that was too long. If there are several
// reasons, it is the last in this order.
enum class StepLimit {
  None,     // nothing: the first trial was good
  Energy,   // the energy falls less than its derivatives promise, or not at all
  Domain,   // the energy is not finite
  Checker,  // a FeasibilityChecker refuses it
};
std::string_view limit_name(StepLimit limit);  // "none", "energy", "domain", "checker"

struct IterationRecord {
  int iteration = 0;                           // 1-based
  double energy = 0;                           // after the step
  double relative_decrease = 0;                // (E_before - E_after) / |E_before|
  double step = 0;                             // accepted multiple of the Newton direction
  double step_bound = 0;                       // largest certified multiple
  double gradient_norm = 0;                    // before the step, reduced unknowns, Euclidean
  double newton_decrement = 0;                 // -g . p, an energy; before the step
  double direction_norm = 0;                   // |p|, Euclidean
  double distance = 0;                         // from the start of the descent; before the step
  double shift = 0;                            // added to the Hessian's diagonal
  Curvature curvature = Curvature::Projected;  // of the direction
  double projection_weight = 1;                // BlendedCurvature::projection_weight of the
                                               // direction
  StepLimit limit = StepLimit::None;           // the reason why the step is not longer
  int trials = 0;                              // energy evaluations of the line search
  double residual = 0;                         // Solution::residual, 0 with a direct solver
  int solver_iterations = 0;                   // Solution::iterations, of all solves
  int factorizations = 0;                      // of a matrix of this size, failed ones included
  int failed_factorizations = 0;               // of these: the matrix was not positive definite
  struct Seconds {
    double assemble = 0, factorize = 0, solve = 0, line_search = 0;
    double sum() const { return assemble + factorize + solve + line_search; }
  } seconds;
};

// Returns value / |energy|, with 0 / 0 = 0, since energies may be 0 at their minimum.
double relative_to(double energy, double value);

struct StepResult {
  enum class Outcome {
    Moved,
    AtMinimum,   // decrement rule, or no unknowns: y unchanged
    Blocked,     // the largest certified step is below smallest_step: y unchanged
    NoDecrease,  // no decrease down to smallest_step: y unchanged
    Breakdown,   // no factorization or no finite direction: y unchanged
    Stopped,     // `why` has the reason: y unchanged
  };
  Outcome outcome = Outcome::Breakdown;
  double energy_before = 0;
  IterationRecord record;              // record.energy is the energy after the step
  std::vector<Index> blocking;         // StepBound::blocking of the line search
  bool is_direction_too_long = false;  // the next one will be shorter; limits of this step mean
                                       // nothing
  bool is_damped = false;  // by a shift that shortens the direction: -g.p underestimates the
                           // decrease
  Directive why = Directive::Continue;
  std::string why_none;  // of a Breakdown, if it was diagnosed: a sentence
};

// The energy that an iteration minimizes. Energies of different phases are not comparable.
enum class Phase {
  Newton,     // the requested energy
  Entry,      // an energy that is finite at the start, if the requested one is not
  SoftStart,  // sum A sqrt(density), from a start of enormous energy
  Excluded,   // without blocking elements
  Barrier,    // the energy plus a part of one with a strong barrier
};
// Returns "newton", "entry", "soft-start", ..., as in reports.
std::string_view phase_name(Phase phase);

// The remedies for a run that is held at the limit of the feasible set, tried in this order.
enum class Remedy {
  Deepen,         // certificates that bisect deeper
  Refine,         // finer quadrature on blocking elements
  Exclude,        // a few steps without blocking elements
  FollowBarrier,  // steps with a strong barrier of falling weight
};
inline constexpr std::array<Remedy, 4> kRemedies{Remedy::Deepen, Remedy::Refine, Remedy::Exclude,
                                                 Remedy::FollowBarrier};
std::string_view remedy_name(Remedy remedy);  // "deepen", ..., "follow-barrier"

// The number of times that a remedy ran, and the total decrease of the energy from each stall to
// the end of the run after it; a run without a decrease counts 0.
struct RemedyUse {
  int runs = 0;
  double gained = 0;
};
using RemedyUses = std::array<RemedyUse, kRemedies.size()>;  // in the order of kRemedies

// Returns "moved", "at-minimum", "blocked", ..., as in reports.
std::string_view outcome_name(StepResult::Outcome outcome);

struct TraceEntry {
  int degree = 1;
  // record.iteration counts through the whole run. record.energy is the minimized energy, without
  // the part of the surroundings of the map.
  IterationRecord record;
  Phase phase = Phase::Newton;
  StepResult::Outcome outcome = StepResult::Outcome::Moved;
  int level = 0;      // of the mesh: 0 is the requested one, 1 and more are coarser levels of a
                      // start
  double energy = 0;  // the requested energy after the step: record.energy in Phase::Newton
  std::optional<Remedy> remedy;  // ran just before this iteration
  double elapsed = 0;            // seconds from the start of the run to the end of the step
  // The part of `elapsed` since the row before (since the start of the run in the first row) that
  // is not in record.seconds: the start, building and analysing problems, remedies, scaffolds.
  double other_seconds = 0;
};

// Returns the number of steps that moved the map on the requested mesh, without coarser levels.
int steps_taken(const std::vector<TraceEntry>& trace);
// Returns the seconds of one factorization and one solve at that degree on the requested mesh, the
// median over the rows; nothing if there was no factorization.
std::optional<double> factor_solve_seconds(const std::vector<TraceEntry>& trace, int degree);

// Solvers, starts and measurements announce activities through their RunRecord. An activity lasts
// until the next one is announced, and may occur more than once. All steps happen while Solving.
enum class Activity {
  Reading,
  Cutting,   // of a surface into charts
  Starting,  // the first map, on coarser meshes as well
  Scaffold,  // the first triangulation of the space around an image
  Solving,
  Measuring,
  Packing,
  Proving,  // that nothing overlaps; for a file: all requested proofs
  Writing,  // each file is proven before it gets its name
};

constexpr std::string_view activity_name(Activity activity) {
  constexpr std::array<std::string_view, 9> kNames{"reading",  "cutting", "start",
                                                   "scaffold", "solving", "measuring",
                                                   "packing",  "proving", "writing"};
  return kNames[static_cast<std::size_t>(activity)];
}

// Watches a run. It must outlive the run. The thread of the run calls it; other threads call only
// advance().
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  // The run begins another activity.
  virtual void begin(Activity /*activity*/) {}
  // A part of the activity begins, and lasts until the next step: "raising the degree to 2".
  virtual void announce(std::string_view /*part*/) {}
  // The share of the activity that is done, from 0 to 1, of its faces, charts, texels or other
  // pieces. Called for activities whose end can be foreseen, by any thread, several at a time. The
  // share starts from 0 after begin() of another activity and after begin_pass().
  virtual void advance(double /*share*/) {}
  // Activities that have already run begin again on the remaining work. The run so far was the
  // first pass. most: the maximum number of passes if it is known, else 0.
  virtual void begin_pass(int /*pass*/, int /*most*/) {}
  // A step was tried. A minimizer alone reports accepted steps only, before the next one. y: the
  // point reached; empty for rows of a RunRecord. Any result other than Continue ends the solve
  // with that status.
  virtual Directive after_step(const TraceEntry& /*row*/, const Vec& /*y*/) {
    return Directive::Continue;
  }
  // One of several parts solved in parallel is over: "chart 3 of 17", with the rows of its trace.
  // Calls come one after the other. The default reports the last step of each part as if it was the
  // only part.
  virtual void after_part(std::string_view /*part*/, const std::vector<TraceEntry>& rows) {
    if (!rows.empty()) after_step(rows.back(), {});
  }
};

// An observer made of a lambda:
//
//   StepObserver print([](const TraceEntry& row, const Vec& y) {
//     std::cerr << row.energy << " at " << y[0] << "\n";
//     return Directive::Continue;
//   });
//   SolveResult result = NewtonMinimizer().minimize(problem, y0, &print);
template <class F>
class StepObserver final : public RunObserver {
 public:
  explicit StepObserver(F f) : f_(std::move(f)) {}
  Directive after_step(const TraceEntry& row, const Vec& y) override { return f_(row, y); }

 private:
  F f_;
};

// Returns the directive of an observer, which may be null, after a step of a minimizer.
Directive observed(RunObserver* observer, const IterationRecord& record, const Vec& y);

class RunRecord {
 public:
  // Seconds beyond the time limit that reading and computing the start may take: a run that stops
  // before it has a map has no result. 50,000 faces take half a second for both, and the run still
  // ends within two seconds of the limit. Ctrl-C has no such grace.
  static constexpr double kGrace = 1;

  // interrupt: set by others, such as a signal handler, and read between pieces of work. interrupt
  // and observer may be null; the observer must outlive the record. Throws InvalidArgument for a
  // time limit that is NaN and for a negative number of iterations.
  explicit RunRecord(double time_limit_seconds = std::numeric_limits<double>::infinity(),
                     int max_iterations = std::numeric_limits<int>::max(),
                     const std::atomic<bool>* interrupt = nullptr, RunObserver* observer = nullptr)
      : max_iterations_(max_iterations),
        stop_(limits(start_, time_limit_seconds, interrupt)),
        start_stop_(limits(start_, time_limit_seconds + kGrace, interrupt)),
        observer_(observer) {
    if (std::isnan(time_limit_seconds))
      throw InvalidArgument("RunRecord: the time limit is nan; infinity is no limit");
    if (max_iterations < 0) throw InvalidArgument("RunRecord: the iteration limit is negative");
  }
  // A record that `stop` alone ends, without grace.
  explicit RunRecord(const StopCheck& stop) : stop_(stop), start_stop_(stop) {}
  // Makes loops that run in step end together: from here on directive(), note() and
  // iterations_left() return `agreed` of their own result, which is the same in all loops.
  void agree(std::function<int(int own)> agreed) { agreed_ = std::move(agreed); }
  // Returns a record for one part of the run that is solved by itself, perhaps on another thread.
  // It has the same limits (iterations count from 0) and a trace of its own. The observer gets its
  // steps, but not its activities, shares and passes. starting: receives the share of a start that
  // telling_start() reports in the part.
  RunRecord part(RunObserver* observer = nullptr, StopCheck::Tell starting = {}) const {
    RunRecord part;
    part.starting_ = std::move(starting);
    part.max_iterations_ = max_iterations_;
    part.observer_ = observer;
    part.is_part_ = true;
    part.stop_ = stop_;
    part.start_stop_ = start_stop_;
    return part;
  }

  // Adds a row to the trace, right after its step. Fills in its number, its times and the marked
  // remedy.
  Directive note(TraceEntry row) {
    const double before = trace_.empty() ? 0.0 : trace_.back().elapsed;
    row.record.iteration = static_cast<int>(trace_.size()) + 1;
    row.remedy = std::exchange(remedy_, std::nullopt);
    row.elapsed = seconds();
    row.other_seconds = std::max(0.0, row.elapsed - before - row.record.seconds.sum());
    trace_.push_back(std::move(row));
    const Directive directive =
        observer_ ? observer_->after_step(trace_.back(), {}) : Directive::Continue;
    const Directive limit = stop_();
    return agreed(limit == Directive::Continue ? directive : limit);
  }
  void begin(Activity activity) const {
    if (observer_ && !is_part_) observer_->begin(activity);
  }
  void announce(std::string_view part) const {
    if (observer_ && !is_part_) observer_->announce(part);
  }
  // Forward to the RunObserver.
  void advance(double share) const {
    if (observer_ && !is_part_) observer_->advance(share);
  }
  // Begins the next pass. left: the maximum number of passes after it, if known.
  void begin_pass(std::optional<int> left = {}) {
    ++pass_;
    if (observer_ && !is_part_) observer_->begin_pass(pass_, left ? pass_ + *left : 0);
  }
  // Returns a check that asks `stop` and reports shares of the current activity, for work that is
  // all of the activity. May outlive the record, not the observer.
  StopCheck telling(const StopCheck& stop) const {
    if (!observer_ || is_part_) return stop.silent();
    return stop.telling([to = observer_](double share) { to->advance(share); });
  }
  // Does the same for a start, which is an activity of the run or one piece of a part's work.
  StopCheck telling_start(const StopCheck& stop) const {
    return is_part_ ? stop.telling(starting_) : telling(stop);
  }
  // Notes that the next iteration is the first one after this remedy.
  void mark(Remedy remedy) { remedy_ = remedy; }
  // Ends a solve: the first iteration of the next one follows no remedy.
  void forget_mark() { remedy_.reset(); }
  // start_stop() is for work before there is a map, stop() for all later work. Both checks may
  // outlive the record.
  const StopCheck& stop() const { return stop_; }
  const StopCheck& start_stop() const { return start_stop_; }
  // Replaces start_stop() and returns the former check. For work that runs beside a start.
  StopCheck replace_start_stop(StopCheck check) {
    return std::exchange(start_stop_, std::move(check));
  }
  Directive directive() const { return agreed(stop_()); }
  // Returns the remaining iterations; those on coarser meshes do not count.
  int iterations_left() const {
    const auto used = std::count_if(trace_.begin(), trace_.end(),
                                    [](const TraceEntry& row) { return row.level == 0; });
    return agreed(max_iterations_ - static_cast<int>(used));
  }
  double seconds() const { return seconds_since(start_); }
  const std::vector<TraceEntry>& trace() const { return trace_; }
  // Takes steps back: keeps `rows` rows of the trace; the next row follows them.
  void take_back_to(std::size_t rows) { trace_.resize(std::min(rows, trace_.size())); }
  RunObserver* observer() const { return observer_; }  // may be null

 private:
  using Clock = std::chrono::steady_clock;

  template <class T>
  T agreed(T own) const {
    return agreed_ ? static_cast<T>(agreed_(static_cast<int>(own))) : own;
  }
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }
  static StopCheck limits(Clock::time_point start, double limit,
                          const std::atomic<bool>* interrupt) {
    return StopCheck([=] {
      if (interrupt && interrupt->load(std::memory_order_relaxed)) return Directive::Interrupt;
      const bool late =
          limit < std::numeric_limits<double>::infinity() && seconds_since(start) > limit;
      return late ? Directive::TimeLimit : Directive::Continue;
    });
  }

  Clock::time_point start_ = Clock::now();
  int max_iterations_ = std::numeric_limits<int>::max();
  StopCheck stop_, start_stop_;
  RunObserver* observer_ = nullptr;
  bool is_part_ = false;
  int pass_ = 1;
  StopCheck::Tell starting_;
  std::vector<TraceEntry> trace_;
  std::optional<Remedy> remedy_;
  std::function<int(int)> agreed_;  // empty: own results
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
