#include "majorant/framework/sensitivity.h"

#include <fmt/format.h>

#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseQR>
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
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
// The eigenvalue, of the mean diagonal, below which a matrix counts as singular.
constexpr double kSingular = 1e-13;
constexpr int kEigenvalueSteps = 4;  // for an eigenvalue that is right to a factor of 10
// The step of differences of gradients of four points, as a part of a parameter: their error is
// about its fourth power, the rounding 1e-16 over it.
constexpr double kDifference = 1e-3;
// Parameters that all elements see, up to which each of them is tried on all elements.
constexpr Index kFewParameters = 64;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::Unsupported, "Sensitivity: " + why);
}

double weight_of(const TermState& state, Index element) {
  return state.element_weight.size() ? state.weight * state.element_weight[element] : state.weight;
}

// Visits elements with their local systems at x: visit(e, local, p), p the place in the batch.
// wanted(e): whether an element is needed at all.
template <class Wanted, class Visit>
void visit_elements(const Problem& problem, TermId id, const Vec& x, const TermState& state,
                    bool with_hessian, const Wanted& wanted, const Visit& visit) {
  const EnergyTerm& term = problem.term(id);
  const ColoredBatches& plan = ProblemParts::plan(problem, id);
  const auto n = to_size(term.element_dofs().local_size());
  constexpr std::size_t stride = LocalSystem::stride;
  Workspace kernel, memory;
  std::vector<Index> needed;
  for (Index c = 0; c < plan.batch_count(); ++c) {
    const ElementBatch all = plan.batch(c);
    needed.clear();
    for (const Index e : all.elements)
      if (wanted(e)) needed.push_back(e);
    if (needed.empty()) continue;
    const ElementBatch batch{all.rule, needed};
    const std::size_t packed = with_hessian ? n * (n + 1) / 2 : 0;
    LocalSystem local;
    local.value = memory.reserve((1 + n + packed) * stride);
    local.gradient = local.value + stride;
    if (with_hessian) local.hessian = local.gradient + n * stride;
    term.local(x, batch, Curvature::Exact, state, kernel, local);
    for (std::size_t p = 0; p < needed.size(); ++p) visit(needed[p], local, static_cast<int>(p));
  }
}

// The values of a vector of full unknowns at an element.
void gather(const ElementDofs& dofs, Index e, const Vec& x, Vec& local) {
  local.resize(dofs.local_size());
  for (Index k = 0; k < local.size(); ++k)
    local[k] = x[dofs.block * dofs.nodes(e, k / dofs.block) + k % dofs.block];
}

// Replaces the gradient of the element at place p by its Hessian times v.
void multiply(LocalSystem& local, int p, const Vec& v) {
  const auto at = [&](Index k) { return to_size(k) * LocalSystem::stride + to_size(p); };
  for (Index i = 0; i < v.size(); ++i) {
    double sum = 0;
    for (Index j = 0; j < v.size(); ++j) {
      const Index low = std::max(i, j), high = std::min(i, j);
      sum += local.hessian[at(low * (low + 1) / 2 + high)] * v[j];
    }
    local.gradient[at(i)] = sum;
  }
}

double product(const LocalSystem& local, int p, const Vec& v) {
  double sum = 0;
  for (Index k = 0; k < v.size(); ++k)
    sum += local.gradient[to_size(k) * LocalSystem::stride + to_size(p)] * v[k];
  return sum;
}

constexpr auto kAll = [](Index) { return true; };

// The least eigenvalue of a factorized matrix, from above.
double least_eigenvalue(LinearSolver& solver, Index size) {
  Vec v = Vec::LinSpaced(size, 1, 2), next;
  for (Index k = 1; k < size; k += 2) v[k] = -v[k];
  double eigenvalue = 0;
  for (int k = 0; k < kEigenvalueSteps; ++k) {
    v.normalize();
    solver.solve(v, next);
    eigenvalue = 1 / next.norm();
    std::swap(v, next);
  }
  return eigenvalue;
}

}  // namespace

class Sensitivity::Parts {
 public:
  Parts(const Problem& problem, const SolveResult& result, SensitivityOptions options)
      : problem_(problem),
        z_(ProblemParts::elimination(problem_)),
        evaluator_(problem_),
        solver_(make_solver("SensitivityOptions", options.linear_solver)),
        y_(result.y) {
    require_usable(result);
    if (options.null_space) set_gauge(options.null_space(problem_));
    solver_->analyze(problem_.pattern());
    polish(options.polishing_steps);
    if (problem_.size() > 0 &&
        !(least_eigenvalue(*solver_, problem_.size()) > kSingular * mean_diagonal_))
      refuse(
          "the exact Hessian of the solution is singular: the energy does not see some motion of "
          "the unknowns; hold it by constraints, or name it as null_space");
    x_ = problem_.expand(y_);
  }

  Vec forward(const Change& change) {
    Vec rhs = Vec::Zero(problem_.size()), fixed;
    if (change.right_hand_sides.size() > 0) {
      fixed = of_right_hand_sides(change.right_hand_sides);
      add_hessian_times(fixed, rhs);
    }
    for (const auto& [id, change_of] : change.weights) rhs += change_of * term_gradient(id);
    for (const auto& [id, change_of] : change.element_weights)
      add_element_weights(id, change_of, rhs);
    for (const auto& [id, change_of] : change.parameters) add_parameters(id, change_of, rhs);
    const Vec dy = -solve(rhs);
    Vec dx;
    z_.expand_direction(dy, dx);
    if (fixed.size() > 0) dx += fixed;
    return dx;
  }

  Derivative adjoint(const Vec& slope) {
    require_size("Sensitivity::adjoint: the slope", slope.size(), problem_.full_size());
    require_finite("Sensitivity::adjoint: the slope", slope);
    Vec reduced, ux;
    z_.restrict_gradient(slope, reduced);
    const Vec u = solve(reduced);
    z_.expand_direction(u, ux);
    Derivative d;
    for (const TermId id : problem_.terms()) {
      const TermState& state = problem_.state(id);
      const Vec by_element = -products(id, state, ux);
      d.weights.push_back(state.element_weight.size() > 0 ? state.element_weight.dot(by_element)
                                                          : by_element.sum());
      d.element_weights.push_back(state.weight * by_element);
      d.parameters.push_back(parameters(id, ux));
    }
    d.right_hand_sides = multipliers(slope, ux);
    return d;
  }

  Index row_count() const { return static_cast<Index>(ProblemParts::rows(problem_).size()); }
  const Vec& point() const { return x_; }
  double energy() const { return energy_; }
  double error() const { return error_; }

 private:
  void require_usable(const SolveResult& result) const {
    if (partition_of(problem_).ranks().count() > 1)
      throw InvalidArgument("Sensitivity: the problem is that of several processes");
    require_size("Sensitivity: result.y", y_.size(), problem_.size());
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

  void set_gauge(const Eigen::MatrixXd& motions) {
    require_size("SensitivityOptions: null_space", static_cast<Index>(motions.rows()),
                 problem_.size());
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rows(motions.transpose());
    for (Index k = 0; k < rows.rank(); ++k) gauge_.push_back(rows.colsPermutation().indices()[k]);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> columns(motions);
    motions_ = columns.householderQ() *
               Eigen::MatrixXd::Identity(motions.rows(), static_cast<Index>(columns.rank()));
  }

  // Factorizes at y_; false where the Hessian is not definite.
  bool factorize() {
    Vec values;
    energy_ = evaluator_.linearize(y_, Curvature::Exact, gradient_, values);
    mean_diagonal_ = mean_diagonal(problem_.pattern(), values);
    for (const Index unknown : gauge_)
      values[problem_.pattern().diagonal_slot(unknown)] += mean_diagonal_;
    if (!std::isfinite(energy_) || !values.allFinite() || !gradient_.allFinite())
      refuse("the energy or its derivatives are not finite at the solution");
    return solver_->factorize(values, 0) == FactorStatus::Ok;
  }

  void polish(int steps) {
    if (problem_.size() == 0) {
      energy_ = evaluator_.value(y_);
      return;
    }
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0;; ++k) {
      if (!factorize())
        refuse(
            "the exact Hessian of the solution is indefinite: it is a saddle, no minimum, or the "
            "energy does not see some motion of the unknowns (hold it, or name it as null_space)");
      const Vec p = -solve(gradient_);
      const double length = p.norm(), size = y_.norm();
      error_ = size > 0 ? length / size : length;
      if (k == steps || error_ <= kPolished || !(length <= kContraction * last)) return;
      last = length;
      y_ += p;
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

  // Adds Z^T H v.
  void add_hessian_times(const Vec& v, Vec& sum) {
    Vec part;
    for (const TermId id : problem_.terms()) {
      const ElementDofs& dofs = problem_.term(id).element_dofs();
      const TermState& state = problem_.state(id);
      const auto moves = [&](Index e) {
        gather(dofs, e, v, part);
        return weight_of(state, e) != 0 && !part.isZero(0);
      };
      visit_elements(problem_, id, x_, state, true, moves, [&](Index e, LocalSystem& local, int p) {
        gather(dofs, e, v, part);
        multiply(local, p, part);
        ProblemParts::slots(problem_, id)
            .add_gradient(e, local, p, weight_of(state, e), sum.data());
      });
    }
  }

  // The gradient of a term with weight 1.
  Vec term_gradient(TermId id) {
    const Problem alone = problem_.with({{id, {.weight = 1}}});
    Vec gradient;
    Evaluator(alone).gradient(id, y_, gradient);
    return gradient;
  }

  void add_element_weights(TermId id, const Vec& change, Vec& sum) {
    const EnergyTerm& term = problem_.term(id);
    require_size("Sensitivity: element_weights", change.size(),
                 term.element_dofs().element_count());
    const TermState& state = problem_.state(id);
    visit_elements(
        problem_, id, x_, state, false, [&](Index e) { return change[e] != 0; },
        [&](Index e, LocalSystem& local, int p) {
          ProblemParts::slots(problem_, id)
              .add_gradient(e, local, p, state.weight * change[e], sum.data());
        });
  }

  // g_e . u_e of every element e, weights left out.
  Vec products(TermId id, const TermState& state, const Vec& ux) const {
    const EnergyTerm& term = problem_.term(id);
    const ElementDofs& dofs = term.element_dofs();
    const ColoredBatches& plan = ProblemParts::plan(problem_, id);
    constexpr std::size_t stride = LocalSystem::stride;
    const int threads = ThreadCount::current();
    std::vector<Workspace> kernels(to_size(threads)), memories(to_size(threads));
    Vec out(dofs.element_count());
    const auto visit = [&](Index c, int thread) {
      const ElementBatch batch = plan.batch(c);
      LocalSystem local;
      local.value = memories[to_size(thread)].reserve((1 + to_size(dofs.local_size())) * stride);
      local.gradient = local.value + stride;
      term.local(x_, batch, Curvature::Exact, state, kernels[to_size(thread)], local);
      Vec part;
      for (std::size_t p = 0; p < batch.elements.size(); ++p) {
        const Index e = batch.elements[p];
        gather(dofs, e, ux, part);
        out[e] = product(local, static_cast<int>(p), part);
      }
    };
    parallel_tasks(plan.batch_count(), visit, threads);
    for (Index e = 0; e < out.size(); ++e)
      if (!std::isfinite(out[e])) refuse_parameters(id, e);
    return out;
  }

  [[noreturn]] void refuse_parameters(TermId id, Index e) const {
    refuse(fmt::format("term '{}' is not finite beside the parameters of element {}",
                       problem_.term(id).name(), e));
  }

  // The parameters of a term as numbers: those of its state, or those that it was made with.
  Vec parameters_of(TermId id) const {
    const Vec& now = problem_.state(id).parameters;
    if (now.size() > 0) return now;
    return problem_.term(id).parameters();
  }

  // The points of a derivative by differences, as multiples of a step, and their coefficients.
  static constexpr std::pair<double, double> kStencil[] = {
      {1, 8.0 / 12}, {-1, -8.0 / 12}, {2, -1.0 / 12}, {-2, 1.0 / 12}};

  // The size of each parameter, for steps: its own, or the mean of all.
  static Vec sizes(const Vec& parameters) {
    const double mean = parameters.size() > 0 ? parameters.cwiseAbs().mean() : 0;
    const double least = mean > 0 ? mean : 1.0;
    return parameters.cwiseAbs().cwiseMax(least);
  }

  void add_parameters(TermId id, const Vec& change, Vec& sum) {
    require_parameters(id, change);
    const double largest = change.cwiseAbs().maxCoeff();
    if (largest == 0) return;
    const Vec base = parameters_of(id);
    // The change that is, in none of the parameters, more than the step of differences.
    const double h = kDifference / change.cwiseAbs().cwiseQuotient(sizes(base)).maxCoeff();
    TermState state = problem_.state(id);
    for (const auto& [multiple, coefficient] : kStencil) {
      state.parameters = base + multiple * h * change;
      const double part = coefficient / h;
      visit_elements(problem_, id, x_, state, false, kAll, [&](Index e, LocalSystem& local, int p) {
        if (!std::isfinite(local.value[p])) refuse_parameters(id, e);
        ProblemParts::slots(problem_, id)
            .add_gradient(e, local, p, weight_of(state, e) * part, sum.data());
      });
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
  Vec parameters(TermId id, const Vec& ux) {
    const EnergyTerm& term = problem_.term(id);
    const Index count = term.parameter_count(), own = term.parameters_per_element();
    Vec out = Vec::Zero(count);
    if (count == 0) return out;
    const Vec base = parameters_of(id), size = kDifference * sizes(base);
    // parameter(e): the one of an element's parameters that a sweep moves, or -1.
    const auto sweep = [&](const Vec& steps, const auto& parameter) {
      TermState state = problem_.state(id);
      Vec slope = Vec::Zero(term.element_dofs().element_count());
      for (const auto& [multiple, coefficient] : kStencil) {
        state.parameters = base + multiple * steps;
        slope += coefficient * products(id, state, ux);
      }
      for (Index e = 0; e < slope.size(); ++e)
        if (const Index k = parameter(e); k >= 0)
          out[k] -= weight_of(state, e) * slope[e] / size[k];
    };
    if (own > 0) {
      for (Index j = 0; j < own; ++j) {
        Vec steps = Vec::Zero(count);
        for (Index k = j; k < count; k += own) steps[k] = size[k];
        sweep(steps, [&](Index e) { return own * e + j; });
      }
    } else if (count <= kFewParameters) {
      for (Index k = 0; k < count; ++k) {
        Vec steps = Vec::Zero(count);
        steps[k] = size[k];
        sweep(steps, [&](Index) { return k; });
      }
    } else {
      auto [seen, is_new] = seen_.try_emplace(id);
      if (is_new) seen->second = parameter_of_elements(id, base, size);
      sweep(size, [&](Index e) { return seen->second[to_size(e)]; });
    }
    return out;
  }

  // The one parameter that each element depends on, -1 for none: moved are those whose numbers have
  // a bit, then those that have it not; the gradients that change spell the number.
  std::vector<Index> parameter_of_elements(TermId id, const Vec& base, const Vec& size) {
    const EnergyTerm& term = problem_.term(id);
    const Index elements = term.element_dofs().element_count(),
                n = term.element_dofs().local_size();
    const auto gradients = [&](const Vec& parameters) {
      RowMatrix all(elements, n);
      TermState state = problem_.state(id);
      state.parameters = parameters;
      visit_elements(problem_, id, x_, state, false, kAll, [&](Index e, LocalSystem& local, int p) {
        for (Index k = 0; k < n; ++k)
          all(e, k) = local.gradient[to_size(k) * LocalSystem::stride + to_size(p)];
      });
      return all;
    };
    const RowMatrix before = gradients(base);
    std::vector<Index> seen(to_size(elements), 0);
    std::vector<char> depends(to_size(elements), 0);
    const int bits = std::bit_width(static_cast<unsigned>(base.size() - 1));
    for (int bit = 0; bit < bits; ++bit) {
      Vec with = base, without = base;
      for (Index k = 0; k < base.size(); ++k) ((k >> bit & 1) ? with : without)[k] += size[k];
      const RowMatrix set = gradients(with), clear = gradients(without);
      for (Index e = 0; e < elements; ++e) {
        const bool by_set = set.row(e) != before.row(e), by_clear = clear.row(e) != before.row(e);
        if (by_set && by_clear)
          refuse(
              fmt::format("element {} of term '{}' depends on several of {} parameters that all "
                          "elements see; give each element a row of its own",
                          e, term.name(), base.size()));
        depends[to_size(e)] = depends[to_size(e)] || by_set || by_clear;
        if (by_set) seen[to_size(e)] |= Index{1} << bit;
      }
    }
    for (std::size_t e = 0; e < seen.size(); ++e)
      if (!depends[e]) seen[e] = -1;
    return seen;
  }

  // A^T lambda = dL/dx - H u, which Z^T takes to 0: the rows' multipliers are what L gains.
  Vec multipliers(const Vec& slope, const Vec& ux) {
    const ConstraintRows& rows = ProblemParts::rows(problem_);
    const Index count = row_count();
    if (count == 0) return Vec();
    if (!factors_) factorize_rows(rows);
    Vec rest = Vec::Zero(held_count_);
    for (Index i = 0; i < problem_.full_size(); ++i)
      if (held_[to_size(i)] >= 0) rest[held_[to_size(i)]] = slope[i];
    Vec part;
    for (const TermId id : problem_.terms()) {
      const ElementDofs& dofs = problem_.term(id).element_dofs();
      const TermState& state = problem_.state(id);
      const auto place = [&](Index e, Index k) {
        return held_[to_size(dofs.block * dofs.nodes(e, k / dofs.block) + k % dofs.block)];
      };
      const auto touches = [&](Index e) {
        for (Index k = 0; k < dofs.local_size(); ++k)
          if (place(e, k) >= 0) return weight_of(state, e) != 0;
        return false;
      };
      visit_elements(
          problem_, id, x_, state, true, touches, [&](Index e, LocalSystem& local, int p) {
            gather(dofs, e, ux, part);
            multiply(local, p, part);
            for (Index k = 0; k < part.size(); ++k)
              if (const Index at = place(e, k); at >= 0)
                rest[at] -= weight_of(state, e) *
                            local.gradient[to_size(k) * LocalSystem::stride + to_size(p)];
          });
    }
    return factors_->solve(rest);
  }

  void factorize_rows(const ConstraintRows& rows) {
    held_.assign(to_size(problem_.full_size()), -1);
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Index> auxiliary(to_size(rows.auxiliary_count()), -1);
    held_count_ = 0;
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (const auto* e = rows.begin(row); e != rows.end(row); ++e) {
        Index& place =
            e->unknown >= 0 ? held_[to_size(e->unknown)] : auxiliary[to_size(-1 - e->unknown)];
        if (place < 0) place = held_count_++;
        entries.emplace_back(place, static_cast<Index>(row), e->coefficient);
      }
    Eigen::SparseMatrix<double> transposed(held_count_, static_cast<Index>(rows.size()));
    transposed.setFromTriplets(entries.begin(), entries.end());
    transposed.makeCompressed();
    factors_.emplace(transposed);
    if (factors_->info() != Eigen::Success)
      refuse("the rows of the constraints could not be factorized");
  }

  Problem problem_;
  const Elimination& z_;
  Evaluator evaluator_;
  std::shared_ptr<LinearSolver> solver_;
  Vec y_, x_, gradient_;
  double energy_ = 0, error_ = 0, mean_diagonal_ = 0;
  std::vector<Index> gauge_;
  Eigen::MatrixXd motions_;                    // orthonormal columns
  std::map<TermId, std::vector<Index>> seen_;  // parameter_of_elements()
  std::vector<Index> held_;  // by full unknown: its place among those that rows have, or -1
  Index held_count_ = 0;     // with auxiliary ones
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
      !(least_eigenvalue(*solver, problem.size()) >
        kSingular * mean_diagonal(problem.pattern(), values)))
    unsupported(
        "J^T J is singular: the residuals do not determine all unknowns; hold the others by "
        "constraints");
  return solver->inverse_products(problem.size(), columns);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
