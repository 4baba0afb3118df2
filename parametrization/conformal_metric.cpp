#include "majorant/parametrization/conformal_metric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/parametrization/conformal_energy.h"
#include "majorant/parametrization/edge_laplacian.h"

namespace majorant {
namespace {

// Below this error of the angle sums (radians) only full steps that still halve it are taken: a
// few steps of polishing down to rounding.
constexpr double kAngleTolerance = 1e-12;
constexpr Index kMostSteps = 300;
// Halvings of a step before it counts as none.
constexpr int kMostTrials = 60;
// First multiple of the mean diagonal that is added where the Hessian is singular, as it is around
// broken triangles.
constexpr double kSmallestShift = 1e-10;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void require_angle_sums(const SurfaceMesh& mesh, const std::vector<int>& quarter_turns) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::Usage, fmt::format("{}: {}", mesh.file(), what));
  };
  if (quarter_turns.size() != at(mesh.vertex_count()))
    refuse(fmt::format("{} quarter turns for {} vertices; give one number per vertex",
                       quarter_turns.size(), mesh.vertex_count()));
  std::vector<char> is_boundary(quarter_turns.size(), 0);
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) is_boundary[at(v)] = 1;
  long long missing = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (is_boundary[at(v)]) continue;
    if (quarter_turns[at(v)] < 1)
      refuse(fmt::format("vertex {}: {} quarter turns; an angle sum must be positive",
                         mesh.input_vertex(v) + 1, quarter_turns[at(v)]));
    missing += 4 - quarter_turns[at(v)];
  }
  const long long wanted = 4LL * mesh.topology().euler_characteristic();
  if (mesh.boundary_loops().empty() && missing != wanted)
    refuse(
        fmt::format("the cones' (4 - quarter turns) add up to {}, which must be {}, 4 times the "
                    "Euler characteristic (Gauss-Bonnet); add or remove cones",
                    missing, wanted));
}

Vec wanted_angles(const std::vector<int>& quarter_turns) {
  Vec angles(static_cast<Index>(quarter_turns.size()));
  for (std::size_t v = 0; v < quarter_turns.size(); ++v)
    angles[static_cast<Index>(v)] = 0.5 * std::numbers::pi * quarter_turns[v];
  return angles;
}

// Damped Newton iteration. E is convex, so phi(t) = E(u + t p) has a monotone derivative, and the
// step rule needs no values of E, which would lose the digits that matter near the minimum: a step
// is accepted when phi'(t) <= 0 (E fell all the way along it) or when it halves the smallest
// gradient so far. The latter happens finitely often above any tolerance, between them E decreases;
// near the minimum it lets full steps pass whatever the sign of phi'(1).
class ConformalNewton {
 public:
  ConformalNewton(const SurfaceMesh& mesh, Vec angles)
      : energy_(mesh, std::move(angles)),
        row_of_(unknowns(energy_)),
        laplacian_(mesh.faces(), row_of_),
        solver_(make_cholmod_solver()),
        u_(Vec::Zero(mesh.vertex_count())),
        here_(energy_.derivatives(u_)),
        least_gradient_(here_.gradient.norm()) {
    if (laplacian_.pattern().size > 0) solver_->analyze(laplacian_.pattern());
  }

  // Returns the number of steps.
  Index run() {
    Index steps = 0;
    if (laplacian_.pattern().size == 0) return steps;
    while (steps < kMostSteps && step()) ++steps;
    return steps;
  }
  const Vec& log_factor() const { return u_; }
  double angle_error() const { return here_.gradient.cwiseAbs().maxCoeff(); }

 private:
  // Interior vertices. A constant changes no angle, so the first vertex of a closed surface is
  // left out; Gauss-Bonnet sees to its angle sum.
  static std::vector<Index> unknowns(const ConformalEnergy& energy) {
    const std::vector<char>& is_interior = energy.is_interior();
    const bool closed = std::find(is_interior.begin(), is_interior.end(), 0) == is_interior.end();
    std::vector<Index> row_of(is_interior.size(), -1);
    Index rows = 0;
    for (std::size_t v = closed ? 1 : 0; v < is_interior.size(); ++v)
      if (is_interior[v]) row_of[v] = rows++;
    return row_of;
  }

  Vec direction() {
    Vec r(laplacian_.pattern().size), p;
    for (std::size_t v = 0; v < row_of_.size(); ++v)
      if (row_of_[v] >= 0) r[row_of_[v]] = -here_.gradient[static_cast<Index>(v)];
    const auto factorization = factorize_shifted(
        *solver_, laplacian_.pattern(), laplacian_.values(here_.hessian_weights), kSmallestShift);
    p = r;  // steepest descent when nothing can be factorized
    if (factorization.status == FactorStatus::Ok) solver_->solve(r, p);
    if (!p.allFinite() || p.dot(r) <= 0) p = r;
    Vec out = Vec::Zero(u_.size());
    for (std::size_t v = 0; v < row_of_.size(); ++v)
      if (row_of_[v] >= 0) out[static_cast<Index>(v)] = p[row_of_[v]];
    return out;
  }

  // Goes to u + t p if that is acceptable; else returns phi'(t).
  std::optional<double> refusal(const Vec& p, double t) {
    constexpr double refused = std::numeric_limits<double>::infinity();
    const Vec u = u_ + t * p;
    if (!u.allFinite()) return refused;
    ConformalDerivatives there = energy_.derivatives(u);
    const double slope = there.gradient.dot(p), norm = there.gradient.norm();
    const bool halves = norm <= 0.5 * least_gradient_;
    const bool polishing = angle_error() <= kAngleTolerance;
    if (!halves && (polishing || slope > 0)) return polishing ? refused : slope;
    u_ = u;
    here_ = std::move(there);
    least_gradient_ = std::min(least_gradient_, norm);
    return std::nullopt;
  }

  bool step() {
    if (angle_error() == 0) return false;
    const Vec p = direction();
    const double descent = -here_.gradient.dot(p);
    double t = 1;
    for (int trial = 0; trial < kMostTrials; ++trial) {
      const std::optional<double> slope = refusal(p, t);
      if (!slope) return true;
      if (angle_error() <= kAngleTolerance) return false;
      // Towards the zero of phi' by the secant, from the safe side.
      t *= std::clamp(0.9 * descent / (descent + *slope), 0.1, 0.9);
    }
    return false;
  }

  ConformalEnergy energy_;
  std::vector<Index> row_of_;  // #V: unknown, or -1
  EdgeLaplacian laplacian_;
  std::unique_ptr<LinearSolver> solver_;
  Vec u_;
  ConformalDerivatives here_;
  double least_gradient_;
};

// Shifts u so that the faces that are not broken have the surface's area; counts the others.
void finish(const SurfaceMesh& mesh, ConformalMetric& metric) {
  const Vec log_lengths = log_edge_lengths(mesh, metric.log_factor);
  std::vector<double> log_areas;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const TriangleShape shape = face_shape(log_lengths, f);
    if (shape.broken)
      ++metric.broken_faces;
    else
      log_areas.push_back(shape.log_area);
  }
  if (log_areas.empty()) return;
  const double largest = *std::max_element(log_areas.begin(), log_areas.end());
  double sum = 0;
  for (const double a : log_areas) sum += std::exp(a - largest);
  metric.log_factor.array() += 0.5 * (std::log(mesh.area()) - largest - std::log(sum));
}

}  // namespace

ConformalMetric conformal_metric(const SurfaceMesh& mesh, const std::vector<int>& quarter_turns) {
  require_angle_sums(mesh, quarter_turns);
  ConformalNewton newton(mesh, wanted_angles(quarter_turns));
  ConformalMetric metric;
  metric.newton_steps = newton.run();
  metric.log_factor = newton.log_factor();
  metric.angle_error = newton.angle_error();
  finish(mesh, metric);
  return metric;
}

}  // namespace majorant
