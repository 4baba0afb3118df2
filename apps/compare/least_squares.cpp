#include "apps/compare/least_squares.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <cmath>
#include <utility>

#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/stepper.h"

namespace majorant {
namespace {

// Entries of J and J^-1 at the quadrature points of one face; parameters: its control points.
class FaceResiduals final : public ceres::CostFunction {
 public:
  // gradients: 2 rows a quadrature point, a column for each node, in the rest frame. scale: one
  // factor for each point.
  FaceResiduals(std::vector<Eigen::MatrixX2d> gradients, Vec scale, const StopCheck& stop)
      : gradients_(std::move(gradients)), scale_(std::move(scale)), stop_(stop) {
    set_num_residuals(8 * static_cast<int>(gradients_.size()));
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(gradients_.front().rows()), 2);
  }

  // After a stop every point is unusable, until Ceres calls back.
  bool Evaluate(double const* const* points, double* residuals, double** jacobians) const override {
    if (stop_() != Directive::Continue) return false;
    for (std::size_t l = 0; l < gradients_.size(); ++l) {
      const Eigen::MatrixX2d& g = gradients_[l];
      Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
      for (Eigen::Index i = 0; i < g.rows(); ++i)
        J += Eigen::Map<const Vector2>(points[i]) * g.row(i);
      if (!(J.determinant() > 0)) return false;
      const Eigen::Matrix2d inverse = J.inverse();
      const double s = scale_[static_cast<Index>(l)];
      for (int p = 0; p < 2; ++p)
        for (int j = 0; j < 2; ++j) {
          residuals[8 * l + to_size(2 * p + j)] = s * J(p, j);
          residuals[8 * l + to_size(4 + 2 * p + j)] = s * inverse(p, j);
        }
      if (jacobians)
        for (Eigen::Index i = 0; i < g.rows(); ++i)
          if (jacobians[i]) fill(jacobians[i] + 16 * l, s, g.row(i), inverse);
    }
    return true;
  }

 private:
  // Fills 8 rows by 2 columns: dJ = dx g, d(J^-1) = -J^-1 dJ J^-1.
  static void fill(double* out, double s, const Eigen::RowVector2d& g,
                   const Eigen::Matrix2d& inverse) {
    const Eigen::RowVector2d gi = g * inverse;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        for (int p = 0; p < 2; ++p) {
          out[2 * (2 * a + b) + p] = a == p ? s * g[b] : 0.0;
          out[2 * (4 + 2 * a + b) + p] = -s * inverse(a, p) * gi[b];
        }
  }
  std::vector<Eigen::MatrixX2d> gradients_;
  Vec scale_;
  const StopCheck& stop_;
};

// Returns flags of the unknowns that the problem fixes. Parameter blocks support no other
// constraints.
std::vector<char> fixed_unknowns(const Problem& problem) {
  const Elimination& z = ProblemParts::elimination(problem);
  std::vector<char> fixed(to_size(z.full_size()), 0);
  for (Index i = 0; i < z.full_size(); ++i) {
    const Elimination::Row row = z.row(i);
    const bool is_own = row.size() == 1 && row.begin()->coefficient == 1.0 && z.offset(i) == 0.0 &&
                        z.full_index(row.begin()->reduced) == i;
    if (row.size() > 0 && !is_own)
      throw InvalidArgument("LeastSquaresMinimizer: only fixed points can be held");
    fixed[i] = row.size() == 0;
  }
  return fixed;
}

class Progress final : public ceres::IterationCallback {
 public:
  Progress(const Problem& problem, const Vec& x, const StopCheck& stop, RunObserver* observer,
           SolveResult& result)
      : problem_(problem), x_(x), stop_(stop), observer_(observer), result_(result) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    steps_ += s.iteration > 0;
    if (s.iteration == 0 || !s.step_is_successful) return ended(stop_());
    for (const auto& checker : problem_.checkers())
      if (!checker->check(x_).feasible) {
        result_.status = Status::Stalled;
        result_.message = "a step left the certified set";
        return ceres::SOLVER_ABORT;
      }
    IterationRecord record;
    record.iteration = static_cast<int>(result_.iterations.size()) + 1;
    const double before = result_.energy;
    result_.energy = 2 * s.cost;
    record.energy = result_.energy;
    record.relative_decrease = (before - result_.energy) / std::abs(before);
    record.step = 1;
    record.factorizations = std::exchange(steps_, 0);
    record.gradient_norm = 2 * s.gradient_norm;
    record.seconds.solve = s.iteration_time_in_seconds;
    result_.y = problem_.reduce(x_);
    result_.iterations.push_back(record);
    return ended(observed(observer_, record, result_.y));
  }

  ceres::CallbackReturnType ended(Directive directive) {
    if (directive == Directive::Continue) return ceres::SOLVER_CONTINUE;
    result_.status = stopped_status(directive);
    result_.message = status_name(result_.status);
    return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const Problem& problem_;
  const Vec& x_;
  const StopCheck& stop_;
  int steps_ = 0;  // Jacobians since the last accepted step; each needs a factorization
  RunObserver* observer_;
  SolveResult& result_;
};

// Adds one residual block for each face and one parameter block for each node of x. x must outlive
// the problem.
void add_residuals(const BezierTriangleSpace& space, const RestShapes& rest, const Quadrature& rule,
                   Vec& x, const StopCheck& stop, ceres::Problem& out) {
  const double area = rest.measure.sum();
  for (Index e = 0; e < space.element_count(); ++e) {
    std::vector<Eigen::MatrixX2d> gradients;
    for (Index l = 0; l < rule.size(); ++l) {
      const Barycentric xi = rule.points.row(l);
      gradients.push_back(bernstein_gradients(space.degree(), xi) * rest.inverse_of(e));
    }
    std::vector<double*> blocks;
    for (const Index node : space.cells().row(e)) blocks.push_back(x.data() + 2 * node);
    const Vec scale = (rule.weights * (rest.measure[e] / area)).cwiseSqrt();
    out.AddResidualBlock(new FaceResiduals(std::move(gradients), scale, stop), nullptr, blocks);
  }
}

void hold(const std::vector<char>& fixed, Vec& x, ceres::Problem& out) {
  for (Index i = 0; i < x.size(); i += 2) {
    const bool u = fixed[i] != 0;
    const bool v = fixed[i + 1] != 0;
    double* node = x.data() + i;
    if (u && v) out.SetParameterBlockConstant(node);
    if (u != v) out.SetManifold(node, new ceres::SubsetManifold(2, {u ? 0 : 1}));
  }
}

ceres::Solver::Options solver_options(const LeastSquaresOptions& limits) {
  ceres::Solver::Options options;
  options.max_num_iterations = limits.max_iterations;
  options.function_tolerance = limits.function_tolerance;
  options.gradient_tolerance = limits.gradient_tolerance;
  options.parameter_tolerance = limits.parameter_tolerance;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  if (ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::SUITE_SPARSE))
    options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;  // CHOLMOD
  options.logging_type = ceres::SILENT;
  options.num_threads = ThreadCount::current();
  options.update_state_every_iteration = true;
  options.max_num_consecutive_invalid_steps = 50;
  return options;
}

}  // namespace

LeastSquaresMinimizer::LeastSquaresMinimizer(std::shared_ptr<const BezierTriangleSpace> space,
                                             RestShapes rest, Quadrature rule,
                                             LeastSquaresOptions options)
    : space_(std::move(space)), rest_(std::move(rest)), rule_(std::move(rule)), options_(options) {
  if (rest_.curved()) throw InvalidArgument("LeastSquaresMinimizer: curved rest shapes");
}

SolveResult LeastSquaresMinimizer::minimize(const Problem& problem, Vec y0,
                                            RunObserver* observer) const {
  SolveResult result;
  result.y = std::move(y0);
  Evaluator evaluator(problem);
  if (!check_start(evaluator, result)) return result;
  Vec x = problem.expand(result.y);
  ceres::Problem least_squares;
  add_residuals(*space_, rest_, rule_, x, options_.stop, least_squares);
  hold(fixed_unknowns(problem), x, least_squares);
  double start_cost = 0;
  least_squares.Evaluate({}, &start_cost, nullptr, nullptr, nullptr);
  result.energy = 2 * start_cost;
  ceres::Solver::Options options = solver_options(options_);
  Progress progress(problem, x, options_.stop, observer, result);
  options.callbacks.push_back(&progress);
  result.status = Status::Converged;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &least_squares, &summary);
  if (result.status != Status::Converged) return result;
  if (progress.ended(options_.stop()) != ceres::SOLVER_CONTINUE) return result;
  result.message = summary.message;
  if (summary.termination_type == ceres::NO_CONVERGENCE) result.status = Status::MaxIterations;
  if (summary.termination_type == ceres::FAILURE) result.status = Status::Failed;
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
