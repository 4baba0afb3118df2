// Optimization problems made in Python.
#include "majorant/framework/problem.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <string>

#include "arrays.h"
#include "comparison.h"
#include "element_functions.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/rest_sensitivity.h"
#include "majorant/framework/barrier_minimizer.h"
#if MAJORANT_GPL
#include "majorant/framework/ceres_minimizer.h"
#endif
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/hessian_factor.h"
#include "majorant/framework/levenberg_marquardt.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/residuals.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/manifold_problem.h"
#include "majorant/framework/terms/manifold_sensitivity.h"
#include "module.h"
#include "options.h"
#include "run.h"
#include "space.h"
#include "terms.h"

namespace majorant::python {
namespace {

// Rows of A x = b. call: number of the call of constrain() that added them, from 1.
class Rows final : public Constraint {
 public:
  Rows(int call, const Integers& starts, const Integers& columns, const Doubles& values,
       const Doubles& targets)
      : of_call_(call > 1 ? " of constrain() number " + std::to_string(call) : ""),
        starts_(starts.data(), starts.data() + starts.size()),
        columns_(columns.data(), columns.data() + columns.size()),
        values_(values.data(), values.data() + values.size()),
        targets_(matrix<Vec>(targets)) {}

  void append_rows(ConstraintRows& rows) const override {
    for (Index r = 0; r < size(); ++r) {
      rows.begin_row("A[" + std::to_string(r) + "]" + of_call_);
      for (Index k = starts_[to_size(r)]; k < starts_[to_size(r) + 1]; ++k)
        rows.add(columns_[to_size(k)], values_[to_size(k)]);
      rows.end_row(targets_[r]);
    }
  }
  Index size() const { return static_cast<Index>(targets_.size()); }
  void set_targets(VecIn targets) { targets_ = targets; }

 private:
  std::string of_call_;
  std::vector<Index> starts_, columns_;
  std::vector<double> values_;
  Vec targets_;
};

// A problem whose terms and constraints are added one by one. Elimination and ordering take place
// when the problem is first used.
class PythonProblem {
 public:
  explicit PythonProblem(Index size) : size_(size) {}

  // Returns the index of the term.
  std::size_t add(const Term& term, double weight) {
    ProblemBuilder(size_).add(term.term, weight);  // throws before the problem changes
    terms_.push_back({term.term, TermState{.weight = weight}});
    problem_.reset();
    return terms_.size() - 1;
  }
  // Changes the weight or the data of a term; the analysis is kept.
  void update(std::size_t index, std::optional<double> weight,
              const std::optional<Doubles>& parameters) {
    TermState state = terms_.at(index).state;
    if (weight) state.weight = *weight;
    if (parameters) state.parameters = matrix<Vec>(*parameters);
    if (problem_)
      problem_ = problem_->with({{problem_->terms()[index], state}});
    else
      ProblemBuilder(size_).add(terms_[index].term, state);
    terms_[index].state = std::move(state);
  }
  void constrain(const Integers& starts, const Integers& columns, const Doubles& values,
                 const Doubles& targets) {
    Rows rows(static_cast<int>(constraints_.size()) + 1, starts, columns, values, targets);
    ProblemBuilder(size_).add(rows);  // throws before the problem changes
    constraints_.push_back(std::move(rows));
    problem_.reset();
  }
  // targets: of all rows, in their order.
  void set_right_hand_sides(const Doubles& targets) {
    const Vec all = matrix<Vec>(targets);
    Index first = 0;
    for (Rows& rows : constraints_) {
      rows.set_targets(all.segment(first, rows.size()));
      first += rows.size();
    }
    problem_.reset();
  }
  void keep_injective(const Space& s) {
    const Vec determinants = s.rest.measure / s.space->reference_measure();
    checkers_.push_back(std::make_shared<const LocalInjectivity>(s.space, determinants));
    problem_.reset();
  }
  void hold(std::shared_ptr<const BarrierChecker> bound) { bounds_.push_back(std::move(bound)); }
  void hold(std::shared_ptr<const EnergyTerm> equality) {
    equalities_.push_back(std::move(equality));
  }

  // Returns the problem without bounds and equalities.
  const Problem& built() {
    if (!problem_) problem_ = with_terms(ProblemBuilder(size_)).build();
    return *problem_;
  }
  Index full_size() const { return size_; }
  Index row_count() const {
    Index count = 0;
    for (const Rows& rows : constraints_) count += rows.size();
    return count;
  }

  // With the equalities, the bounds, and the barriers of these among its terms.
  template <class Kind>
  struct Held {
    Kind problem;
    std::vector<HeldBound> bounds;
  };
  Held<Problem> held() const { return held_by<Problem>(with_terms(ProblemBuilder(size_))); }
  Held<ManifoldProblem> on_manifolds() const {
    return held_by<ManifoldProblem>(with_terms(builder_on(manifolds_)));
  }
  bool holds() const { return !bounds_.empty() || !equalities_.empty(); }

  void put_on(std::shared_ptr<const Manifold> manifold, Cells unknowns) {
    auto more = manifolds_;
    more.push_back({std::move(manifold), std::move(unknowns)});
    builder_on(more).build();  // throws before anything is kept
    manifolds_ = std::move(more);
  }
  bool has_manifolds() const { return !manifolds_.empty(); }

 private:
  struct Part {
    std::shared_ptr<const EnergyTerm> term;
    TermState state;
  };
  struct Place {
    std::shared_ptr<const Manifold> manifold;
    Cells unknowns;
  };
  ManifoldProblemBuilder builder_on(const std::vector<Place>& manifolds) const {
    ManifoldProblemBuilder builder(size_);
    for (const Place& place : manifolds) builder.on(place.manifold, place.unknowns);
    return builder;
  }
  template <class Builder>
  Builder with_terms(Builder builder) const {
    for (const Part& part : terms_) builder.add(part.term, part.state);
    for (const Rows& rows : constraints_) builder.add(rows);
    for (const auto& checker : checkers_) builder.add(checker);
    return builder;
  }
  template <class Kind, class Builder>
  Held<Kind> held_by(Builder builder) const {
    for (const auto& equality : equalities_) builder.add(equality, 1.0);
    std::vector<HeldBound> held;
    for (const auto& bound : bounds_) {
      held.push_back({builder.add(bound->barrier(), 1.0), bound});
      builder.add(bound);
    }
    return {builder.build(), std::move(held)};
  }

  Index size_;
  std::vector<Part> terms_;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers_;
  std::vector<Rows> constraints_;
  std::optional<Problem> problem_;
  std::vector<std::shared_ptr<const BarrierChecker>> bounds_;
  std::vector<std::shared_ptr<const EnergyTerm>> equalities_;
  std::vector<Place> manifolds_;
};

std::function<std::unique_ptr<LinearSolver>()> solver_named(const std::string& name) {
  if (name == "eigen") return [] { return make_eigen_ldlt_solver(); };
  return [] { return make_direct_solver(); };
}

void set_newton(NewtonOptions& options, const CurvatureChoice& choice, const py::dict& keywords) {
  options.set_curvature(choice);
  options.saddles_to_leave = keyword<int>(keywords, "saddles_to_leave");
}

template <class Options>
Options filled(Options options, const py::dict& keywords, const StopCheck& stop) {
  const auto tolerance = keyword<std::optional<double>>(keywords, "tolerance");
  const CurvatureChoice choice = *curvature_choice(keyword<std::string>(keywords, "curvature"));
  if constexpr (std::is_same_v<Options, NewtonOptions>)
    set_newton(options, choice, keywords);
  else
    options.curvature = choice.model;
  options.stopping.max_iterations = keyword<int>(keywords, "max_iterations");
  if (tolerance) options.stopping.relative_decrease = *tolerance;
  options.linear_solver = solver_named(keyword<std::string>(keywords, "linear_solver"));
  options.stop = stop;
  return options;
}

std::unique_ptr<Minimizer> minimizer_named(const std::string& name, const py::dict& keywords,
                                           const StopCheck& stop) {
  if (name == "newton")
    return std::make_unique<NewtonMinimizer>(filled(NewtonOptions(), keywords, stop));
  if (name == "levenberg-marquardt")
    return std::make_unique<LevenbergMarquardtMinimizer>(
        filled(LevenbergMarquardtOptions(), keywords, stop));
  if (name == "lbfgs")
    return std::make_unique<LbfgsMinimizer>(filled(LbfgsOptions(), keywords, stop));
  if (name == "gradient-flow")
    return std::make_unique<GradientFlowMinimizer>(filled(GradientFlowOptions(), keywords, stop));
#if MAJORANT_GPL
  CeresOptions options;
  if (name == "ceres-nlcg") options.method = CeresOptions::Method::NonlinearConjugateGradient;
  if (name == "ceres-lm") options.method = CeresOptions::Method::LevenbergMarquardt;
  if (name == "ceres-dogleg") options.method = CeresOptions::Method::Dogleg;
  options.max_iterations = keyword<int>(keywords, "max_iterations");
  options.function_tolerance =
      keyword<std::optional<double>>(keywords, "tolerance").value_or(options.function_tolerance);
  options.stop = stop;
  return std::make_unique<CeresMinimizer>(options);
#else
  throw Error(ErrorKind::Unsupported,
              fmt::format("the method '{}' is not in this package, which was built without "
                          "MAJORANT_GPL; use another one",
                          name));
#endif
}

BarrierMinimizer barrier_minimizer(std::vector<HeldBound> bounds, const py::dict& keywords,
                                   const StopCheck& stop) {
  BarrierOptions options;
  options.newton = filled(NewtonOptions(), keywords, stop);
  options.tolerance = keyword<std::optional<double>>(keywords, "gap").value_or(options.tolerance);
  return BarrierMinimizer::of_bounds(std::move(bounds), {}, options);
}

py::dict as_dict(const IterationRecord& r) {
  using namespace py::literals;
  return py::dict(
      "iteration"_a = r.iteration, "energy"_a = r.energy,
      "relative_decrease"_a = r.relative_decrease, "step"_a = r.step, "step_bound"_a = r.step_bound,
      "gradient_norm"_a = r.gradient_norm, "newton_decrement"_a = r.newton_decrement,
      "shift"_a = r.shift, "curvature"_a = curvature_name(r.curvature),
      "projection_weight"_a = r.projection_weight, "limit"_a = limit_name(r.limit),
      "trials"_a = r.trials, "factorizations"_a = r.factorizations, "seconds"_a = r.seconds.sum());
}

py::dict as_dict(const BarrierPhase& phase) {
  using namespace py::literals;
  return py::dict("mu"_a = phase.mu, "gap"_a = phase.gap, "energy"_a = phase.energy,
                  "violation"_a = phase.violation, "iterations"_a = phase.iterations,
                  "status"_a = status_name(phase.status));
}

// The problem of a solution, with the barriers and equalities of the last phase.
struct Solved {
  Problem problem;
  SolveResult result;
  Index row_count;               // number of constraint rows
  std::vector<TermId> barriers;  // of bounds
  // Of unknowns on manifolds, where `problem` is the chart around the result; null: there are none.
  std::shared_ptr<const ManifoldProblem> manifolds = {};
  ManifoldBarrierResult on_manifolds = {};
};

TermChanges last_states(const BarrierResult& result, std::span<const HeldBound> bounds) {
  TermChanges states = result.states;
  if (states.empty())  // the run ended before its first phase
    for (const HeldBound& bound : bounds)
      states.emplace_back(bound.barrier, TermChange{.weight = 0});
  return states;
}

Solved solved(const Problem& problem, const BarrierResult& result,
              std::span<const HeldBound> bounds, Index row_count) {
  Solved kept{problem.with(last_states(result, bounds)), result, row_count, {}};
  for (const HeldBound& bound : bounds) kept.barriers.push_back(bound.barrier);
  if (!bounds.empty()) kept.result.blocking.clear();  // barriers enforce the bounds, not a checker
  return kept;
}

// Returns (x, energy, status, message, [record, ...], [phase, ...], definite, multipliers of all
// equality rows, Solved).
py::tuple as_tuple(Vec x, const BarrierResult& result, Solved solved) {
  py::list records, phases;
  for (const IterationRecord& record : result.iterations) records.append(as_dict(record));
  for (const BarrierPhase& phase : result.phases) phases.append(as_dict(phase));
  std::vector<double> multipliers;
  for (const Vec& part : result.multipliers)
    multipliers.insert(multipliers.end(), part.begin(), part.end());
  return py::make_tuple(moved(std::move(x)), result.energy, status_name(result.status),
                        result.message, records, phases, definite_name(result.definite),
                        Doubles(static_cast<py::ssize_t>(multipliers.size()), multipliers.data()),
                        std::make_shared<Solved>(std::move(solved)));
}

// keywords: options of minimize() in Python. callback(record, x): see Run.
py::tuple minimize(PythonProblem& p, const Doubles& x0, const py::dict& keywords,
                   const py::object& callback) {
  Run run(keyword<double>(keywords, "time_limit"), std::numeric_limits<int>::max(), py::none());
  const Vec start = matrix<Vec>(x0);
  const int threads = keyword<int>(keywords, "threads");
  // Makes an observer that passes expand(y) to the callback.
  const auto watch_by = [&](auto expand) {
    return StepObserver([&run, &callback, expand](const TraceEntry& row, const Vec& y) {
      bool ends = false;
      if (!callback.is_none() && !run.raised().guard([&] {
            ends = static_cast<bool>(py::bool_(callback(as_dict(row.record), moved(expand(y)))));
          }))
        ends = true;
      return ends ? Directive::Interrupt : run.record().directive();
    });
  };
  BarrierResult result;
  if (p.has_manifolds()) {
    const auto held = p.on_manifolds();
    auto watch = watch_by([](const Vec& x) { return x; });
    ManifoldBarrierResult found;
    if (p.holds()) {
      const BarrierMinimizer minimizer =
          barrier_minimizer(held.bounds, keywords, run.record().stop());
      found = run([&] {
        const ThreadCount count(threads);
        return held.problem.minimize(start, minimizer, &watch);
      });
    } else {
      const NewtonOptions options = filled(NewtonOptions(), keywords, run.record().stop());
      ManifoldResult free = run([&] {
        const ThreadCount count(threads);
        return held.problem.minimize(start, options, &watch);
      });
      found.x = std::move(free.x);
      static_cast<SolveResult&>(found) = std::move(free);
    }
    Solved kept = solved(held.problem.around(found.x), found, held.bounds, p.row_count());
    kept.manifolds = std::make_shared<const ManifoldProblem>(held.problem);
    kept.on_manifolds = found;
    kept.on_manifolds.states = last_states(found, held.bounds);
    if (!held.bounds.empty()) kept.on_manifolds.blocking.clear();
    return as_tuple(std::move(found.x), found, std::move(kept));
  }
  auto held = p.holds() ? p.held() : PythonProblem::Held<Problem>{p.built(), {}};
  const Problem& problem = held.problem;
  auto watch = watch_by([&problem](const Vec& y) { return problem.expand(y); });
  if (p.holds()) {
    const BarrierMinimizer minimizer =
        barrier_minimizer(held.bounds, keywords, run.record().stop());
    result = run([&] {
      const ThreadCount count(threads);
      return minimizer.run(problem, problem.reduce(start), &watch);
    });
  } else {
    const auto minimizer =
        minimizer_named(keyword<std::string>(keywords, "method"), keywords, run.record().stop());
    static_cast<SolveResult&>(result) = run([&] {
      const ThreadCount count(threads);
      return minimizer->minimize(problem, problem.reduce(start), &watch);
    });
  }
  return as_tuple(problem.expand(result.y), result,
                  solved(problem, result, held.bounds, p.row_count()));
}

ComparisonInput compared_from(PythonProblem& p, const Doubles& x0) {
  const Vec start = matrix<Vec>(x0);
  if (p.has_manifolds())
    return {p.on_manifolds().problem, {}, {}, start};  // compare() refuses bounds
  auto held = p.holds() ? p.held() : PythonProblem::Held<Problem>{p.built(), {}};
  Vec y0 = held.problem.reduce(start);
  return {{}, std::move(held.problem), std::move(held.bounds), std::move(y0)};
}

// The derivatives of a solution, by one factorization.
class PythonSensitivity {
 public:
  explicit PythonSensitivity(std::shared_ptr<Solved> solved) : solved_(std::move(solved)) {
    Run run;
    run([&] {
      if (solved_->manifolds)
        on_manifolds_.emplace(*solved_->manifolds, solved_->on_manifolds);
      else
        sensitivity_.emplace(solved_->problem, solved_->result);
      return 0;
    });
  }

  // gradient: a result of rest_gradient().
  py::array forward(const std::optional<Doubles>& right_hand_sides,
                    const std::vector<std::pair<std::size_t, double>>& weights,
                    const std::vector<std::pair<std::size_t, Doubles>>& parameters,
                    const std::optional<Doubles>& gradient) const {
    Sensitivity::Change change;
    if (gradient) change.gradient = matrix<Vec>(*gradient);
    if (right_hand_sides) change.right_hand_sides = matrix<Vec>(*right_hand_sides);
    for (const auto& [index, weight] : weights) change.weights.emplace_back(id(index), weight);
    for (const auto& [index, numbers] : parameters)
      change.parameters.emplace_back(id(index), matrix<Vec>(numbers));
    Run run;
    return moved(run([&] {
      return on_manifolds_ ? on_manifolds_->forward(change) : sensitivity_->forward(change);
    }));
  }

  // Returns derivatives by right-hand sides, by weights and by the parameters of each term (a
  // list), and the adjoint state.
  py::tuple adjoint(const Doubles& slope) const {
    const Vec at = matrix<Vec>(slope);
    Run run;
    Sensitivity::Derivative d =
        run([&] { return on_manifolds_ ? on_manifolds_->adjoint(at) : sensitivity_->adjoint(at); });
    py::list parameters;
    for (Vec& part : d.parameters) parameters.append(moved(std::move(part)));
    return py::make_tuple(moved(std::move(d.right_hand_sides)), d.weights, parameters,
                          moved(std::move(d.adjoint_state)));
  }
  double error() const { return on_manifolds_ ? on_manifolds_->error() : sensitivity_->error(); }
  double bias() const {
    Run run;
    return run([&] {
      return on_manifolds_ ? on_manifolds_->bias(solved_->barriers)
                           : sensitivity_->bias(solved_->barriers);
    });
  }

  // Returns the change of the gradient of these terms along a change of the rest vertices of their
  // space.
  py::array rest_gradient(const Space& space, const std::vector<std::size_t>& terms,
                          const Doubles& change) {
    const RowMatrix moved_by = matrix<RowMatrix>(change);
    Run run;
    return moved(run([&] { return rest(space, terms).gradient(moved_by); }));
  }
  // Returns the derivative of L by the rest vertices.
  py::array rest_slopes(const Space& space, const std::vector<std::size_t>& terms,
                        const Doubles& adjoint_state) {
    Sensitivity::Derivative d;
    d.adjoint_state = matrix<Vec>(adjoint_state);
    Run run;
    return moved(run([&] { return rest(space, terms).adjoint(d); }));
  }

 private:
  TermId id(std::size_t index) const { return solved_->problem.terms()[index]; }

  const RestSensitivity& rest(const Space& space, const std::vector<std::size_t>& terms) {
    if (on_manifolds_)
      throw Error(ErrorKind::Unsupported,
                  "solutions on manifolds have no derivatives by the vertices of a space here");
    if (space.rest.curved() || space.space->degree() > 1)
      throw Error(ErrorKind::Unsupported,
                  "derivatives by the vertices of a space are those of triangles and tetrahedra of "
                  "degree 1, not of " +
                      std::string(space.rest.curved() ? "quads" : "degree ") +
                      (space.rest.curved() ? "" : std::to_string(space.space->degree())));
    const auto found = rest_.find(&space);
    if (found != rest_.end()) return found->second;
    std::vector<TermId> ids;
    for (const std::size_t index : terms) ids.push_back(id(index));
    const RowMatrix positions =
        space.mesh ? RowMatrix(space.mesh->positions()) : RowMatrix(space.vertices);
    return rest_
        .try_emplace(&space, solved_->problem, *sensitivity_, ids, positions, space.space->cells())
        .first->second;
  }

  std::shared_ptr<Solved> solved_;
  std::optional<Sensitivity> sensitivity_;
  std::optional<ManifoldSensitivity> on_manifolds_;  // in its place
  std::map<const Space*, RestSensitivity> rest_;
};

py::array covariance_of(const Solved& solved, const std::vector<Index>& unknowns) {
  if (solved.manifolds)
    throw Error(
        ErrorKind::Unsupported,
        "solutions on manifolds have no covariance here; hold |x|^2 = 1, say, as an Equality "
        "instead");
  Run run;
  return moved(run([&] { return RowMatrix(covariance(solved.problem, solved.result, unknowns)); }));
}

double value(PythonProblem& p, const Doubles& y) {
  const Problem& problem = p.built();
  const Vec at = matrix<Vec>(y);
  Run run;
  return run([&] { return Evaluator(problem).value(at, run.stop()); });
}

struct Linearized {
  double energy;
  Vec gradient, hessian;
};

// Returns (energy, gradient, starts, rows, values), the last three for the lower triangle of the
// Hessian in compressed columns.
py::tuple linearize(PythonProblem& p, const Doubles& y, const std::string& curvature) {
  const Problem& problem = p.built();
  const Vec at = matrix<Vec>(y);
  const CurvatureChoice choice = *curvature_choice(curvature);
  Run run;
  Linearized out = run([&] {
    Linearized l;
    l.energy = Evaluator(problem).linearize(at, choice.blend(), l.gradient, l.hessian, run.stop());
    return l;
  });
  const SparsePattern& pattern = problem.pattern();
  return py::make_tuple(
      out.energy, moved(std::move(out.gradient)),
      Integers(static_cast<py::ssize_t>(pattern.column_starts.size()),
               pattern.column_starts.data()),
      Integers(static_cast<py::ssize_t>(pattern.rows.size()), pattern.rows.data()),
      moved(std::move(out.hessian)));
}

py::array gradient_of(PythonProblem& p, std::size_t index, const Doubles& y) {
  const Problem& problem = p.built();
  const Vec at = matrix<Vec>(y);
  Run run;
  return moved(run([&] {
    Vec gradient;
    Evaluator(problem).gradient(problem.terms()[index], at, gradient, run.stop());
    return gradient;
  }));
}

// Returns (r, starts, columns, values), the last three for J in compressed rows.
py::tuple residuals(PythonProblem& p, std::size_t index, const Doubles& y) {
  const Problem& problem = p.built();
  const Vec at = matrix<Vec>(y);
  Run run;
  Residuals found = run([&] { return residuals_at(problem, problem.terms()[index], at); });
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = found.jacobian;
  return py::make_tuple(
      moved(std::move(found.values)),
      Integers(static_cast<py::ssize_t>(rows.outerSize() + 1), rows.outerIndexPtr()),
      Integers(static_cast<py::ssize_t>(rows.nonZeros()), rows.innerIndexPtr()),
      Doubles(static_cast<py::ssize_t>(rows.nonZeros()), rows.valuePtr()));
}

std::shared_ptr<HessianFactor> factor(PythonProblem& p, const Doubles& y,
                                      const std::string& curvature) {
  const Problem& problem = p.built();
  const Vec at = matrix<Vec>(y);
  const CurvatureChoice choice = *curvature_choice(curvature);
  Run run;
  return run([&] { return std::make_shared<HessianFactor>(problem, at, choice.blend()); });
}

}  // namespace

void bind_problems(py::module_& module) {
  py::class_<Solved, std::shared_ptr<Solved>>(module, "SolvedProblem")
      .def("covariance", &covariance_of, py::arg("unknowns"))
      .def_property_readonly("row_count", [](const Solved& s) { return s.row_count; });
  py::class_<PythonSensitivity>(module, "Sensitivity")
      .def(py::init<std::shared_ptr<Solved>>(), py::arg("solved"))
      .def("forward", &PythonSensitivity::forward, py::arg("right_hand_sides"), py::arg("weights"),
           py::arg("parameters"), py::arg("gradient"))
      .def("adjoint", &PythonSensitivity::adjoint, py::arg("slope"))
      .def("rest_gradient", &PythonSensitivity::rest_gradient, py::arg("space"), py::arg("terms"),
           py::arg("change"), py::keep_alive<1, 2>())
      .def("rest_slopes", &PythonSensitivity::rest_slopes, py::arg("space"), py::arg("terms"),
           py::arg("adjoint_state"), py::keep_alive<1, 2>())
      .def("bias", &PythonSensitivity::bias)
      .def_property_readonly("error", &PythonSensitivity::error);
  py::class_<HessianFactor, std::shared_ptr<HessianFactor>>(module, "Factor")
      .def(
          "solve",
          [](const HessianFactor& f, const Doubles& b) {
            const Eigen::MatrixXd columns = matrix<RowMatrix>(b);
            Run run;
            RowMatrix x = run([&] { return RowMatrix(f.solve(columns)); });
            return moved(std::move(x));
          },
          py::arg("b"));
  py::class_<PythonProblem>(module, "Problem")
      .def(py::init<Index>(), py::arg("size"))
      .def_property_readonly("full_size", &PythonProblem::full_size)
      .def_property_readonly("size", [](PythonProblem& p) { return p.built().size(); })
      .def("add", &PythonProblem::add, py::arg("term"), py::arg("weight"))
      .def_property_readonly("row_count", &PythonProblem::row_count)
      .def("set_right_hand_sides", &PythonProblem::set_right_hand_sides, py::arg("targets"))
      .def("update", &PythonProblem::update, py::arg("index"), py::arg("weight"),
           py::arg("parameters"))
      .def("factor", &factor, py::arg("y"), py::arg("curvature"))
      .def("gradient_of", &gradient_of, py::arg("index"), py::arg("y"))
      .def("residuals", &residuals, py::arg("index"), py::arg("y"))
      .def("constrain", &PythonProblem::constrain, py::arg("starts"), py::arg("columns"),
           py::arg("values"), py::arg("targets"))
      .def("keep_injective", &PythonProblem::keep_injective, py::arg("space"))
      .def(
          "hold",
          [](PythonProblem& p, const std::string& name, const Integers& nodes,
             const Integers& counts, int block, const py::object& function) {
            p.hold(python_inequality(name, elements_of(nodes, counts, block), function));
          },
          py::arg("name"), py::arg("nodes"), py::arg("counts"), py::arg("block"),
          py::arg("function"))
      .def(
          "on_manifold",
          [](PythonProblem& p, const std::string& kind, const Integers& unknowns) {
            const Cells rows = matrix<Cells>(unknowns);
            const bool is_matrix = kind == "rotation" && rows.cols() == 9;
            p.put_on(is_matrix ? rotation_matrices() : unit_sphere(static_cast<int>(rows.cols())),
                     rows);
          },
          py::arg("kind"), py::arg("unknowns"))
      .def(
          "hold_equality",
          [](PythonProblem& p, const std::string& name, const Integers& nodes,
             const Integers& counts, int block, const py::object& function) {
            p.hold(python_equality(name, elements_of(nodes, counts, block), function));
          },
          py::arg("name"), py::arg("nodes"), py::arg("counts"), py::arg("block"),
          py::arg("function"))
      .def(
          "bound",
          [](PythonProblem& p, const Doubles& lower, const Doubles& upper) {
            p.hold(Bounds(matrix<Vec>(lower), matrix<Vec>(upper)).checker());
          },
          py::arg("lower"), py::arg("upper"))
      .def(
          "expand",
          [](PythonProblem& p, const Doubles& y) {
            return moved(p.built().expand(matrix<Vec>(y)));
          },
          py::arg("y"))
      .def(
          "reduce",
          [](PythonProblem& p, const Doubles& x) {
            return moved(p.built().reduce(matrix<Vec>(x)));
          },
          py::arg("x"))
      .def("value", &value, py::arg("y"))
      .def("linearize", &linearize, py::arg("y"), py::arg("curvature"))
      .def("compared_from", &compared_from, py::arg("x0"))
      .def("minimize", &minimize, py::arg("x0"), py::arg("keywords"), py::arg("callback"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
