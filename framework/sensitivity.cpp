#include "majorant/framework/sensitivity.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseQR>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <random>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/element_visits.h"
#include "majorant/framework/internal/equality_rows.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/residual_term.h"

namespace majorant {
namespace {

// An exact Newton step that is shorter, as a part of |y|, changes derivatives by less than what
// their solves leave.
constexpr double kPolished = 1e-9;
// The part of the last one's length that a polishing step has at most: quadratic convergence has
// less.
constexpr double kContraction = 0.5;
// Steps with one factor before the next one is made: two take an error e to e^4.
constexpr int kStepsOfAFactor = 3;
// The eigenvalue, where the diagonal is scaled to 1, below which a matrix counts as singular.
constexpr double kSingular = 1e-13;
// The step of differences of gradients of four points, as a part of a parameter: their error is
// about its fourth power, the rounding 1e-16 over it.
constexpr double kDifference = 1e-3;
// The points, as multiples of the step, and their coefficients.
constexpr std::pair<double, double> kStencil[] = {
    {1, 8.0 / 12}, {-1, -8.0 / 12}, {2, -1.0 / 12}, {-2, 1.0 / 12}};
// Parameters that all elements see, up to which each of them is tried on all elements.
constexpr Index kFewParameters = 64;
// Elements are moved by this part of the unknowns' mean size to see on which parameters they
// depend: at a minimum their energies may be 0 whatever the parameters are.
constexpr double kDisplacement = 1e-3;
// The part of a change's gradient along the null space that is no rounding error.
constexpr double kAlongNullSpace = 1e-6;
// The rounding error of a sum of elements' gradients, relative to them.
constexpr double kRounding = 1e-10;
// The largest accepted relative residual of the equations of equalities.
constexpr double kSaddleResidual = 1e-9;
// Elements that a task treats: some 0.1 ms.
constexpr Index kElementsOfATask = 4096;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::Unsupported, "Sensitivity: " + why);
}

double weight_of(const TermState& state, Index element) {
  return state.element_weight.size() ? state.weight * state.element_weight[element] : state.weight;
}

// Batches of these elements, by rule.
class Batches {
 public:
  Batches(const TermState& state, std::vector<Index> elements) : elements_(std::move(elements)) {
    const auto rule = [&](Index e) {
      return state.element_rule.empty() ? 0 : state.element_rule[to_size(e)];
    };
    std::stable_sort(elements_.begin(), elements_.end(),
                     [&](Index a, Index b) { return rule(a) < rule(b); });
    for (std::size_t first = 0, last; first < elements_.size(); first = last) {
      last = first + 1;
      while (last < elements_.size() && last - first < ElementBatch::kMaxSize &&
             rule(elements_[last]) == rule(elements_[first]))
        ++last;
      batches_.push_back(
          {rule(elements_[first]), std::span<const Index>(elements_.data() + first, last - first)});
    }
  }
  Index batch_count() const { return static_cast<Index>(batches_.size()); }
  const ElementBatch& batch(Index c) const { return batches_[to_size(c)]; }

 private:
  std::vector<Index> elements_;
  std::vector<ElementBatch> batches_;
};

// Returns whether a factorized matrix has an eigenvalue below kSingular where its diagonal is
// scaled to 1: barriers beside their limits are many times as stiff as the rest. A vector of random
// numbers of variance 1 has about 1 of every eigenvector, so that H^-1 makes 1 / eigenvalue of it,
// and up to sqrt(size) of that where there are many small ones; a second step tells these apart.
bool is_singular(LinearSolver& solver, const SparsePattern& pattern, const Vec& values) {
  std::minstd_rand random(1);
  Vec v(pattern.size), roots(pattern.size), next;
  for (double& entry : v)
    entry = std::sqrt(12.0) * (static_cast<double>(random()) / std::minstd_rand::max() - 0.5);
  for (Index i = 0; i < pattern.size; ++i)
    roots[i] = std::sqrt(std::abs(values[pattern.diagonal_slot(i)]));
  const auto size_of_solution = [&] {
    solver.solve(roots.cwiseProduct(v), next);
    next = next.cwiseProduct(roots);
    return next.norm();
  };
  if (size_of_solution() * kSingular < 1) return false;
  v = next.normalized();
  return !(size_of_solution() * kSingular < 1);
}

}  // namespace

class Sensitivity::Parts {
 public:
  Parts(const Problem& problem, const SolveResult& result, SensitivityOptions options)
      : problem_(problem),
        z_(ProblemParts::elimination(problem_)),
        evaluator_(problem_),
        solver_(options.analysed_solver ? options.analysed_solver
                                        : make_solver("SensitivityOptions", options.linear_solver)),
        options_(std::move(options)),
        y_(result.y),
        motions_(problem_.size(), 0),
        terms_(problem_.terms().size()),
        equalities_(equality_terms(problem_)) {
    require_usable(result);
    if (!equalities_.empty()) estimate_multipliers();
    if (!options_.analysed_solver) solver_->analyze(problem_.pattern());
    polish();
    if (is_singular_)
      refuse(
          "the exact Hessian of the solution is singular: the energy does not see some motion of "
          "the unknowns; hold it by constraints, or name it as null_space");
    x_ = problem_.expand(y_);
    set_gauge();
    if (const auto violation = evaluator_.violation(x_))
      refuse(fmt::format(
          "the minimum without '{}' violates it: what this checker holds back is no function of "
          "the data",
          violation->checker->name()));
  }

  Vec forward(const Change& change) {
    const std::lock_guard lock(mutex_);
    Vec full = Vec::Zero(problem_.full_size()), rhs = Vec::Zero(problem_.size()), fixed;
    double rounding = 0;  // of what cancels: a single term's gradient is 0 at the minimum
    if (change.right_hand_sides.size() > 0) {
      fixed = of_right_hand_sides(change.right_hand_sides);
      const auto& seen = coupling();
      full += seen.transpose() * held_of(fixed);
    }
    if (change.gradient.size() > 0) {
      require_size("Sensitivity: gradient", change.gradient.size(), problem_.full_size());
      require_finite("Sensitivity: gradient", change.gradient);
      full += change.gradient;
    }
    for (const auto& [id, change_of] : change.weights) {
      require_finite("Sensitivity: weights", Vec::Constant(1, change_of));
      full += change_of * of(id).gradient;
      rounding += kRounding * std::abs(change_of) * of(id).gradients.norm();
    }
    for (const auto& [id, change_of] : change.element_weights)
      add_element_weights(id, change_of, full);
    for (const auto& [id, change_of] : change.parameters) add_parameters(id, change_of, full, rhs);
    Vec reduced;
    z_.restrict_gradient(full, reduced);
    rhs += reduced;
    Vec moved;  // of the equalities, by what the right-hand sides fix
    if (!equalities_.empty() && fixed.size() > 0) moved = -rows_->times(fixed);
    if (const double along = (motions_.transpose() * rhs).norm();
        along > kAlongNullSpace * rhs.norm() + rounding)
      refuse("the change moves the solution along the null space, where it has no minimum");
    const Vec dy = solve_held(-rhs, moved).p;
    Vec dx;
    z_.expand_direction(dy, dx);
    if (fixed.size() > 0) dx += fixed;
    if (gauge_.size() > 0) dx -= full_motions_ * gauge_of_motions_.solve(gauge_ * dx);
    return dx;
  }

  Derivative adjoint(Vec slope) {
    const std::lock_guard lock(mutex_);
    require_size("Sensitivity::adjoint: the slope", slope.size(), problem_.full_size());
    require_finite("Sensitivity::adjoint: the slope", slope);
    if (gauge_.size() > 0)
      slope -= gauge_.transpose() * transposed_gauge_.solve(full_motions_.transpose() * slope);
    Vec reduced;
    z_.restrict_gradient(slope, reduced);
    const auto [u, q, _] = solve_held(reduced, Vec());
    if (!equalities_.empty()) slope -= rows_->transposed_times(q);
    Derivative d;
    z_.expand_direction(u, d.adjoint_state);
    const Vec& ux = d.adjoint_state;
    for (const TermId id : problem_.terms()) {
      const TermState& state = problem_.state(id);
      const OfTerm& parts = of(id);
      d.weights.push_back(-parts.gradient.dot(ux));
      d.element_weights.push_back(-state.weight * products(id, parts.gradients, 1, ux));
      d.parameters.push_back(parameters(id, u, ux));
    }
    d.right_hand_sides = multipliers(slope, ux);
    return d;
  }

  double bias(const std::vector<TermId>& barriers) {
    Change away;
    for (const TermId id : barriers) away.weights.emplace_back(id, -problem_.state(id).weight);
    const double distance = forward(away).norm(), size = x_.norm();
    return size > 0 ? distance / size : distance;
  }

  Index row_count() const { return static_cast<Index>(ProblemParts::rows(problem_).size()); }
  const Vec& point() const { return x_; }
  double energy() const { return energy_; }
  double error() const { return error_; }

 private:
  // The derivatives of a term at x_, made when they are first needed.
  struct OfTerm {
    RowMatrix gradients;           // #E by local_size(), without weights
    Vec gradient;                  // their sum with the weights of the elements, full unknowns
    RowMatrix by_parameters;       // #E by local_size() K: of the gradients, by each element's K
    std::vector<Index> parameter;  // where all see all: the one of each element, -1: none
    Eigen::MatrixXd by_shared;     // or, size() by count: of the sum, by each of few
  };

  void require_usable(const SolveResult& result) const {
    if (partition_of(problem_).ranks().count() > 1)
      throw InvalidArgument("Sensitivity: the problem is that of several processes");
    require_size("Sensitivity: result.y", y_.size(), problem_.size());
    require_finite("Sensitivity: result.y", y_);
    if (options_.polishing_steps < 0)
      throw InvalidArgument("SensitivityOptions: polishing_steps is negative");
    if (result.status == Status::Failed || result.status == Status::Infeasible)
      refuse("there is no solution: " + result.message);
    if (!result.blocking.empty())
      refuse(fmt::format(
          "a checker holds the result back (at element {}): it is no function of the data there",
          result.blocking.front()));
    for (const TermId id : problem_.terms())
      if (!problem_.term(id).supports(Curvature::Exact))
        refuse(fmt::format("term '{}' has no exact Hessian", problem_.term(id).name()));
  }

  // The motions at y_, orthonormal, and as many unknowns that hold them.
  void find_motions() {
    if (!options_.null_space) return;
    const Eigen::MatrixXd motions = options_.null_space(problem_, y_);
    require_size("SensitivityOptions: null_space", static_cast<Index>(motions.rows()),
                 problem_.size());
    if (!motions.allFinite()) throw InvalidArgument("SensitivityOptions: null_space is not finite");
    motions_.resize(motions.rows(), 0);
    stopped_.clear();
    if (motions.size() == 0) return;
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rows(motions.transpose());
    for (Index k = 0; k < rows.rank(); ++k) stopped_.push_back(rows.colsPermutation().indices()[k]);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> columns(motions);
    motions_ = columns.householderQ() *
               Eigen::MatrixXd::Identity(motions.rows(), static_cast<Index>(columns.rank()));
  }

  void set_gauge() {
    if (!options_.gauge) return;
    gauge_ = options_.gauge(problem_, y_);
    const auto count = static_cast<Index>(motions_.cols());
    if (gauge_.rows() != count || gauge_.cols() != problem_.full_size() || !gauge_.allFinite())
      throw InvalidArgument(fmt::format(
          "SensitivityOptions: the gauge has {} rows of {} numbers, {} of {} finite ones hold the "
          "null space",
          gauge_.rows(), gauge_.cols(), count, problem_.full_size()));
    if (count == 0) return;
    full_motions_.resize(problem_.full_size(), count);
    Vec moved;
    for (Index k = 0; k < count; ++k) {
      z_.expand_direction(motions_.col(k), moved);
      full_motions_.col(k) = moved;
    }
    gauge_of_motions_.compute(gauge_ * full_motions_);
    transposed_gauge_.compute((gauge_ * full_motions_).transpose());
    if (!gauge_of_motions_.isInvertible())
      throw InvalidArgument("SensitivityOptions: the gauge leaves a motion of the null space free");
  }

  enum class Factor { Definite, Indefinite, NotFinite };

  Factor factorize() {
    find_motions();
    if (!equalities_.empty()) {
      // The state with which the augmented Lagrangian has the gradient and, beside A^T R A, the
      // curvature of E + multipliers g.
      rows_.emplace(problem_, equalities_, problem_.expand(y_));
      const Vec beside = multipliers_ - penalties_.cwiseProduct(rows_->values());
      problem_ = problem_.with(equality_changes(problem_, equalities_, {beside, penalties_}));
      evaluator_.reset(problem_);
    }
    Vec values;
    energy_ = evaluator_.linearize(y_, Curvature::Exact, gradient_, values);
    if (!std::isfinite(energy_) || !values.allFinite() || !gradient_.allFinite())
      return Factor::NotFinite;
    mean_diagonal_ = mean_diagonal(problem_.pattern(), values);
    for (const Index unknown : stopped_)
      values[problem_.pattern().diagonal_slot(unknown)] += mean_diagonal_;
    if (solver_->factorize(values, 0) != FactorStatus::Ok) return Factor::Indefinite;
    is_singular_ = is_singular(*solver_, problem_.pattern(), values);
    return Factor::Definite;
  }

  static void require_definite(Factor factor) {
    if (factor == Factor::NotFinite)
      refuse("the energy or its derivatives are not finite at the solution");
    if (factor == Factor::Indefinite)
      refuse(
          "the exact Hessian of the solution is indefinite: it is a saddle, no minimum, or the "
          "energy does not see some motion of the unknowns (hold it, or name it as null_space)");
  }

  // Exact Newton steps until the factor at hand is that of the minimum.
  void polish() {
    if (problem_.size() == 0) {
      energy_ = evaluator_.value(y_);
      return;
    }
    require_definite(factorize());
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0;; ++k) {
      const auto [step, more, _] =
          solve_held(-gradient_, equalities_.empty() ? Vec() : Vec(-rows_->values()));
      const double length = step.norm(), size = y_.norm();
      error_ = size > 0 ? length / size : length;
      if (k == options_.polishing_steps || error_ <= kPolished || !(length <= kContraction * last))
        return;
      last = length;
      const Vec before = y_, multipliers_before = multipliers_;
      const double error_before = error_;
      if (equalities_.empty()) {
        descend(step);
      } else {
        y_ += step;
        multipliers_ += more;
      }
      const Factor found = factorize();
      if (found == Factor::NotFinite) {  // too far: what is known is the estimate
        y_ = before;
        multipliers_ = multipliers_before;
        require_definite(factorize());
        error_ = error_before;
        return;
      }
      require_definite(found);
    }
  }

  // Steps with the factor at hand, the first of which is given, as long as they contract.
  void descend(const Vec& first) {
    y_ += first;
    double last = first.norm();
    for (int k = 1; k < kStepsOfAFactor && last > kPolished * y_.norm(); ++k) {
      Vec gradient;
      if (!std::isfinite(evaluator_.gradient(y_, gradient)) || !gradient.allFinite()) return;
      const Vec step = -solve(gradient);
      if (!(step.norm() <= kContraction * last)) return;
      last = step.norm();
      y_ += step;
    }
  }

  Vec solve(Vec r) {
    if (problem_.size() == 0) return Vec();
    Vec p;
    if (motions_.cols() > 0) r -= motions_ * (motions_.transpose() * r).eval();
    solver_->solve(r, p);
    if (motions_.cols() > 0) p -= motions_ * (motions_.transpose() * p).eval();
    return p;
  }

  // p with H p + A^T q = r and A p = s, A the derivative of the equalities, none of which: H p = r;
  // s empty: 0.
  SaddlePoint solve_held(const Vec& r, const Vec& s) {
    if (equalities_.empty()) return {solve(r), Vec(), 0};
    SaddlePoint at =
        solve_with_equalities([this](const Vec& b) { return solve(b); }, z_, *rows_, penalties_, r,
                              s.size() > 0 ? s : Vec(Vec::Zero(rows_->count())));
    if (!(at.residual <= kSaddleResidual))
      refuse(
          fmt::format("the equalities, such as {}, contradict the change, or depend on each "
                      "other but for rounding",
                      rows_->name(0)));
    return at;
  }

  void estimate_multipliers() {
    const EqualityState state = equality_state(problem_, equalities_);
    penalties_ = state.penalties;
    multipliers_ =
        state.multipliers +
        penalties_.cwiseProduct(EqualityRows(problem_, equalities_, problem_.expand(y_)).values());
  }

  // The place of a term; throws InvalidArgument for one that is not there.
  std::size_t place_of(TermId id) const {
    problem_.term(id);
    return static_cast<std::size_t>(id);
  }

  const OfTerm& of(TermId id) {
    OfTerm& parts = terms_[place_of(id)];
    if (parts.gradient.size() > 0) return parts;
    const TermState& state = problem_.state(id);
    parts.gradients = element_gradients(problem_, id, x_, state);
    parts.gradient = Vec::Zero(problem_.full_size());
    add(id, parts.gradients, 1,
        state.element_weight.size() > 0 ? state.element_weight : Vec::Ones(parts.gradients.rows()),
        parts.gradient);
    return parts;
  }

  // Adds the local gradients by K numbers of each element (rows of #E by local_size() K) times
  // these numbers, K of each element.
  void add(TermId id, const RowMatrix& gradients, Index count, const Vec& numbers,
           Vec& full) const {
    const ElementDofs& dofs = problem_.term(id).element_dofs();
    const Index n = dofs.local_size();
    for (Index e = 0; e < gradients.rows(); ++e)
      for (Index j = 0; j < count; ++j) {
        const double number = numbers[count * e + j];
        if (number == 0) continue;
        for (Index k = 0; k < n; ++k)
          full[unknown_of(dofs, e, k)] += number * gradients(e, n * j + k);
      }
  }

  // The transpose of it: K numbers of each element.
  Vec products(TermId id, const RowMatrix& gradients, Index count, const Vec& ux) const {
    const ElementDofs& dofs = problem_.term(id).element_dofs();
    const Index n = dofs.local_size();
    Vec out(count * gradients.rows());
    parallel_for(static_cast<Index>(gradients.rows()), kElementsOfATask, [&](Index e) {
      for (Index j = 0; j < count; ++j) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += gradients(e, n * j + k) * ux[unknown_of(dofs, e, k)];
        out[count * e + j] = sum;
      }
    });
    return out;
  }

  // x - Z y of these right-hand sides: the same elimination of other numbers, which enter linearly.
  Vec of_right_hand_sides(const Vec& change) const {
    const ConstraintRows& rows = ProblemParts::rows(problem_);
    require_size("Sensitivity: right_hand_sides", change.size(), row_count());
    require_finite("Sensitivity: right_hand_sides", change);
    ConstraintRows changed;
    for (Index k = 0; k < rows.auxiliary_count(); ++k) changed.add_auxiliary();
    for (std::size_t row = 0; row < rows.size(); ++row) {
      changed.begin_row(rows.label(row));
      for (const auto* e = rows.begin(row); e != rows.end(row); ++e)
        changed.add(e->unknown, e->coefficient);
      changed.end_row(change[static_cast<Index>(row)]);
    }
    const Elimination z(problem_.full_size(), changed);
    Vec x;
    z.expand(Vec::Zero(z.reduced_size()), x);
    return x;
  }

  void add_element_weights(TermId id, const Vec& change, Vec& full) {
    const OfTerm& parts = of(id);
    require_size("Sensitivity: element_weights", change.size(), parts.gradients.rows());
    require_finite("Sensitivity: element_weights", change);
    add(id, parts.gradients, 1, problem_.state(id).weight * change, full);
  }

  [[noreturn]] void refuse_parameters(TermId id) const {
    refuse(fmt::format("term '{}' is not finite beside its parameters", problem_.term(id).name()));
  }

  // The parameters of a term as numbers: those of its state, or those that it was made with.
  Vec parameters_of(TermId id) const {
    const Vec& now = problem_.state(id).parameters;
    if (now.size() > 0) return now;
    return problem_.term(id).parameters();
  }

  // The size of each parameter, for steps: its own, or the mean of all.
  static Vec sizes(const Vec& parameters) {
    const double mean = parameters.size() > 0 ? parameters.cwiseAbs().mean() : 0;
    const double least = mean > 0 ? mean : 1.0;
    return parameters.cwiseAbs().cwiseMax(least);
  }

  // The derivative of the reduced gradient along a change of parameters, by differences.
  Vec along_parameters(TermId id, const Vec& base, const Vec& change) {
    const double h = kDifference / change.cwiseAbs().cwiseQuotient(sizes(base)).maxCoeff();
    Vec sum = Vec::Zero(problem_.size()), gradient;
    Evaluator evaluator(problem_);
    for (const auto& [multiple, coefficient] : kStencil) {
      evaluator.reset(problem_.with({{id, {.parameters = base + multiple * h * change}}}));
      const double energy = evaluator.gradient(id, y_, gradient);
      if (!std::isfinite(energy) || !gradient.allFinite()) refuse_parameters(id);
      sum += coefficient / h * gradient;
    }
    return sum;
  }

  void add_parameters(TermId id, const Vec& change, Vec& full, Vec& rhs) {
    require_parameters(id, change);
    if (change.isZero(0)) return;
    const OfTerm& parts = terms_[place_of(id)];
    const TermState& state = problem_.state(id);
    if (parts.by_shared.size() > 0) {
      rhs += parts.by_shared * change;
    } else if (parts.by_parameters.size() > 0) {
      const Index own = std::max(problem_.term(id).parameters_per_element(), 1);
      const auto elements = static_cast<Index>(parts.by_parameters.rows());
      Vec numbers(own * elements);
      for (Index e = 0; e < elements; ++e)
        for (Index j = 0; j < own; ++j) {
          const Index k = parts.parameter.empty() ? own * e + j : parts.parameter[to_size(e)];
          numbers[own * e + j] = k < 0 ? 0 : weight_of(state, e) * change[k];
        }
      add(id, parts.by_parameters, own, numbers, full);
    } else {
      rhs += along_parameters(id, parameters_of(id), change);
    }
  }

  void require_parameters(TermId id, const Vec& change) const {
    const EnergyTerm& term = problem_.term(id);
    if (term.parameter_count() == 0 || change.size() != term.parameter_count())
      throw InvalidArgument(fmt::format("Sensitivity: term '{}' takes {} parameters, not {}",
                                        term.name(), term.parameter_count(), change.size()));
    require_finite("Sensitivity: parameters", change);
  }

  // dL/dp of all parameters of a term.
  Vec parameters(TermId id, const Vec& u, const Vec& ux) {
    const EnergyTerm& term = problem_.term(id);
    const Index count = term.parameter_count();
    if (count == 0) return Vec();
    OfTerm& parts = terms_[place_of(id)];
    if (parts.by_parameters.size() == 0 && parts.by_shared.size() == 0)
      differentiate_by_parameters(id, parts);
    if (parts.by_shared.size() > 0) return -(parts.by_shared.transpose() * u);
    const Index own = std::max(term.parameters_per_element(), 1);
    const Vec slopes = products(id, parts.by_parameters, own, ux);
    Vec out = Vec::Zero(count);
    const TermState& state = problem_.state(id);
    for (Index e = 0; e < parts.by_parameters.rows(); ++e)
      for (Index j = 0; j < own; ++j) {
        const Index k = parts.parameter.empty() ? own * e + j : parts.parameter[to_size(e)];
        if (k >= 0) out[k] -= weight_of(state, e) * slopes[own * e + j];
      }
    return out;
  }

  void differentiate_by_parameters(TermId id, OfTerm& parts) {
    const EnergyTerm& term = problem_.term(id);
    const Index count = term.parameter_count(), own = term.parameters_per_element();
    const Vec base = parameters_of(id);
    if (own == 0 && count <= kFewParameters) {
      parts.by_shared.resize(problem_.size(), count);
      for (Index k = 0; k < count; ++k)
        parts.by_shared.col(k) = along_parameters(id, base, Vec::Unit(count, k));
      return;
    }
    const Vec size = kDifference * sizes(base);
    if (own == 0) parts.parameter = parameter_of_elements(id, base, size);
    const Index n = term.element_dofs().local_size(), steps = std::max(own, 1);
    parts.by_parameters.resize(term.element_dofs().element_count(), n * steps);
    TermState state = problem_.state(id);
    for (Index j = 0; j < steps; ++j) {
      Vec step = own == 0 ? size : Vec(Vec::Zero(count));
      for (Index k = j; own > 0 && k < count; k += own) step[k] = size[k];
      auto slopes = parts.by_parameters.middleCols(n * j, n);
      slopes.setZero();
      for (const auto& [multiple, coefficient] : kStencil) {
        state.parameters = base + multiple * step;
        slopes += coefficient * element_gradients(problem_, id, x_, state);
      }
      for (Index e = 0; e < slopes.rows(); ++e) {
        const Index k = own > 0 ? own * e + j : parts.parameter[to_size(e)];
        slopes.row(e) *= k < 0 ? 0 : 1 / size[k];
      }
    }
    if (!parts.by_parameters.allFinite()) {
      parts.by_parameters.resize(0, 0);
      refuse_parameters(id);
    }
  }

  // The one parameter that each element depends on, -1 for none: moved are those whose numbers have
  // a bit, then those that have it not; the energies that change spell the number.
  std::vector<Index> parameter_of_elements(TermId id, const Vec& base, const Vec& size) {
    const Index elements = problem_.term(id).element_dofs().element_count();
    Vec at;
    const auto energies = [&](const Vec& parameters) {
      TermState state = problem_.state(id);
      state.parameters = parameters;
      return element_values(problem_.with({{id, state}}), id, at);
    };
    const Vec before = displaced(id, at);
    std::vector<Index> seen(to_size(elements), 0);
    std::vector<char> depends(to_size(elements), 0);
    const int bits = std::bit_width(static_cast<unsigned>(base.size() - 1));
    for (int bit = 0; bit < bits; ++bit) {
      Vec with = base, without = base;
      for (Index k = 0; k < base.size(); ++k) ((k >> bit & 1) ? with : without)[k] += size[k];
      const Vec set = energies(with), clear = energies(without);
      for (Index e = 0; e < elements; ++e) {
        const bool by_set = set[e] != before[e], by_clear = clear[e] != before[e];
        if (by_set && by_clear)
          refuse(
              fmt::format("element {} of term '{}' depends on several of {} parameters that all "
                          "elements see; give each element a row of its own",
                          e, problem_.term(id).name(), base.size()));
        depends[to_size(e)] = depends[to_size(e)] || by_set || by_clear;
        if (by_set) seen[to_size(e)] |= Index{1} << bit;
      }
    }
    for (std::size_t e = 0; e < seen.size(); ++e)
      if (!depends[e]) seen[e] = -1;
    return seen;
  }

  // The energies of the elements at a point beside x_, which is in the domain, too.
  Vec displaced(TermId id, Vec& at) const {
    std::minstd_rand random(1);
    Vec by(x_.size());
    for (double& entry : by) entry = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
    const double size = x_.norm() / std::sqrt(static_cast<double>(x_.size()));
    for (double step = kDisplacement * (size > 0 ? size : 1.0);; step /= 4) {
      at = x_ + step * by;
      Vec values = element_values(problem_, id, at);
      if (values.allFinite()) return values;
      if (!(step > 0)) refuse_parameters(id);
    }
  }

  // A^T lambda = dL/dx - H u, which Z^T takes to 0: the rows' multipliers are what L gains.
  Vec multipliers(const Vec& slope, const Vec& ux) {
    if (row_count() == 0) return Vec();
    const auto& k = coupling();
    if (!factors_) factorize_rows();
    Vec rest = Vec::Zero(held_count_);
    rest.head(k.rows()) = held_of(slope) - k * ux;
    return factors_->solve(rest);
  }

  // The unknowns that rows have, of a vector of full ones.
  Vec held_of(const Vec& x) const {
    Vec out(static_cast<Index>(held_unknowns_.size()));
    for (std::size_t k = 0; k < held_unknowns_.size(); ++k)
      out[static_cast<Index>(k)] = x[held_unknowns_[k]];
    return out;
  }

  // The rows of the Hessian by full unknowns that belong to unknowns which constraints have: what
  // these see of the energy beside what they hold.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& coupling() {
    if (coupling_) return *coupling_;
    number_held();
    using Entries = std::vector<Eigen::Triplet<double>>;
    Entries all;
    for (const TermId id : problem_.terms()) {
      const EnergyTerm& term = problem_.term(id);
      const ElementDofs& dofs = term.element_dofs();
      const TermState& state = problem_.state(id);
      const Index n = dofs.local_size();
      std::vector<Index> touching;
      for (Index e = 0; e < dofs.element_count(); ++e) {
        bool touches = false;
        for (Index k = 0; k < n && !touches; ++k) touches = held_[unknown_of(dofs, e, k)] >= 0;
        if (touches && weight_of(state, e) != 0) touching.push_back(e);
      }
      const Batches batches(state, std::move(touching));
      std::vector<Entries> parts(to_size(batches.batch_count()));
      visit_elements(
          term, batches, x_, state, true, [&](Index c, Index e, const LocalSystem& local, int p) {
            for (Index i = 0; i < n; ++i) {
              const Index row = held_[unknown_of(dofs, e, i)];
              if (row < 0) continue;
              for (Index j = 0; j < n; ++j) {
                const Index low = std::max(i, j), high = std::min(i, j);
                const auto at = to_size(low * (low + 1) / 2 + high) * LocalSystem::stride;
                parts[to_size(c)].emplace_back(
                    row, unknown_of(dofs, e, j),
                    weight_of(state, e) * local.hessian[at + to_size(p)]);
              }
            }
          });
      for (const Entries& part : parts) all.insert(all.end(), part.begin(), part.end());
    }
    coupling_.emplace(static_cast<Index>(held_unknowns_.size()), problem_.full_size());
    coupling_->setFromTriplets(all.begin(), all.end());
    return *coupling_;
  }

  void number_held() {
    const ConstraintRows& rows = ProblemParts::rows(problem_);
    held_.assign(to_size(problem_.full_size()), -1);
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (const auto* e = rows.begin(row); e != rows.end(row); ++e)
        if (e->unknown >= 0 && held_[to_size(e->unknown)] < 0) {
          held_[to_size(e->unknown)] = static_cast<Index>(held_unknowns_.size());
          held_unknowns_.push_back(e->unknown);
        }
  }

  void factorize_rows() {
    const ConstraintRows& rows = ProblemParts::rows(problem_);
    std::vector<Eigen::Triplet<double>> entries;
    const auto first = static_cast<Index>(held_unknowns_.size());
    held_count_ = first + rows.auxiliary_count();
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (const auto* e = rows.begin(row); e != rows.end(row); ++e)
        entries.emplace_back(
            e->unknown >= 0 ? held_[to_size(e->unknown)] : first + (-1 - e->unknown),
            static_cast<Index>(row), e->coefficient);
    Eigen::SparseMatrix<double> transposed(held_count_, static_cast<Index>(rows.size()));
    transposed.setFromTriplets(entries.begin(), entries.end());
    transposed.makeCompressed();
    factors_.emplace(transposed);
    if (factors_->info() != Eigen::Success)
      refuse("the rows of the constraints could not be factorized");
  }

  std::mutex mutex_;
  Problem problem_;
  const Elimination& z_;
  Evaluator evaluator_;
  std::shared_ptr<LinearSolver> solver_;
  SensitivityOptions options_;
  Vec y_, x_, gradient_;
  double energy_ = 0, error_ = 0, mean_diagonal_ = 0;
  bool is_singular_ = false;    // the factorized matrix
  std::vector<Index> stopped_;  // unknowns that stop the motions for the factor
  Eigen::MatrixXd motions_;     // orthonormal columns, by size()
  Eigen::MatrixXd gauge_, full_motions_;
  Eigen::FullPivLU<Eigen::MatrixXd> gauge_of_motions_, transposed_gauge_;
  std::vector<OfTerm> terms_;
  std::vector<TermId> equalities_;
  Vec multipliers_, penalties_;       // of all equalities
  std::optional<EqualityRows> rows_;  // of the factor
  std::vector<Index> held_;  // by full unknown: its place among those that rows have, or -1
  std::vector<Index> held_unknowns_;  // these
  Index held_count_ = 0;              // with auxiliary ones
  std::optional<Eigen::SparseMatrix<double, Eigen::RowMajor>> coupling_;
  std::optional<Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>>> factors_;
};

Sensitivity::Sensitivity(const Problem& problem, const SolveResult& result,
                         SensitivityOptions options)
    : parts_(std::make_unique<Parts>(problem, result, std::move(options))) {}
Sensitivity::~Sensitivity() = default;
Sensitivity::Sensitivity(Sensitivity&&) noexcept = default;
Sensitivity& Sensitivity::operator=(Sensitivity&&) noexcept = default;

Index Sensitivity::row_count() const { return parts_->row_count(); }
const Vec& Sensitivity::point() const { return parts_->point(); }
double Sensitivity::energy() const { return parts_->energy(); }
double Sensitivity::error() const { return parts_->error(); }
double Sensitivity::bias(const std::vector<TermId>& barriers) const {
  return parts_->bias(barriers);
}

Vec Sensitivity::forward(const Change& change) const { return parts_->forward(change); }

Eigen::MatrixXd Sensitivity::forward(const std::vector<Change>& changes) const {
  Eigen::MatrixXd all(point().size(), static_cast<Index>(changes.size()));
  for (Index k = 0; k < all.cols(); ++k) all.col(k) = forward(changes[to_size(k)]);
  return all;
}

Sensitivity::Derivative Sensitivity::adjoint(const Vec& slope) const {
  return parts_->adjoint(slope);
}

std::vector<Sensitivity::Derivative> Sensitivity::adjoint(const Eigen::MatrixXd& slopes) const {
  std::vector<Derivative> all;
  for (Index k = 0; k < slopes.cols(); ++k) all.push_back(adjoint(Vec(slopes.col(k))));
  return all;
}

Eigen::MatrixXd covariance(const Problem& problem, const SolveResult& result,
                           const std::vector<Index>& unknowns) {
  const auto unsupported = [](const std::string& why) {
    throw Error(ErrorKind::Unsupported, "covariance: " + why);
  };
  if (partition_of(problem).ranks().count() > 1)
    throw InvalidArgument("covariance: the problem is that of several processes");
  require_size("covariance: result.y", result.y.size(), problem.size());
  for (const TermId id : problem.terms())
    if (!dynamic_cast<const ResidualTerm*>(&problem.term(id)))
      unsupported(fmt::format("term '{}' is no sum of squares", problem.term(id).name()));
  std::vector<DirectSolver::SparseColumn> columns;
  for (const Index i : unknowns) {
    if (i < 0 || i >= problem.full_size())
      throw InvalidArgument(fmt::format("covariance: unknown {} of {}", i, problem.full_size()));
    DirectSolver::SparseColumn& column = columns.emplace_back();
    for (const auto& e : ProblemParts::elimination(problem).row(i))
      column.emplace_back(e.reduced, e.coefficient);
    std::sort(column.begin(), column.end());
  }
  Vec gradient, values;
  Evaluator(problem).linearize(result.y, Curvature::Projected, gradient, values);
  const std::unique_ptr<DirectSolver> solver = make_direct_solver();
  solver->analyze(problem.pattern());
  if (!values.allFinite() || solver->factorize(values, 0) != FactorStatus::Ok ||
      is_singular(*solver, problem.pattern(), values))
    unsupported(
        "J^T J is singular: the residuals do not determine all unknowns; hold the others by "
        "constraints");
  return solver->inverse_products(problem.size(), columns);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
