#include "majorant/parametrization/fields/conformal_metric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/backtracking.h"
#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/edge_laplacian.h"
#include "majorant/parametrization/fields/internal/conformal_energy.h"

namespace majorant {
namespace {

// Below this error of the angle sums (radians), a thousand roundings of 2 pi, only full steps are
// taken that reduce the error by kPolishedPart. They polish the result down to rounding.
constexpr double kPolishedAngle = 1e-12;
// The fraction of the error that a polishing step may leave. Newton's steps leave far less until
// only rounding is left.
constexpr double kPolishedPart = 0.5;
// Upper bound on the Newton steps of a minimization, three times the largest number on the public
// meshes.
constexpr int kMaxNewtonSteps = 100;
// Upper bound on the halvings of a step: 2^-60 of a step is below its rounding.
constexpr int kMaxStepHalvings = 60;
// The first multiple of the mean diagonal that is added where the Hessian is singular, as it is
// around broken triangles. It stays so for several steps, so a smaller first shift would only be
// increased.
constexpr double kSingularShift = 1e-10;
// Lower bound on the fraction of a step that one secant leaves: the safeguard of interpolation of
// [NW06] Sec. 3.5.
constexpr double kShortest = 0.1;
// The largest change of a log factor in one step; lengths then change by e^10. Beyond it the
// quadratic model is useless. Chosen, not tuned.
constexpr double kLargestChange = 10;
// A minimization that ends with a larger error of the angle sums (radians) is no start for the next
// one. Chosen, not tuned.
constexpr double kLostAngle = 1e-3;
// Edge vectors of a face close up if their sum is less than this fraction of the longest: above the
// error of angles good to 1e-12, below that of a wrong edge.
constexpr double kClosingTolerance = 1e-6;

void require_angle_sums(const SurfaceMesh& mesh, const std::vector<int>& quarter_turns) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::Usage, fmt::format("{}{}", message_prefix(mesh), what));
  };
  if (quarter_turns.size() != to_size(mesh.vertex_count()))
    refuse(fmt::format("{} quarter turns for {} vertices; give one number per vertex",
                       quarter_turns.size(), mesh.vertex_count()));
  const std::vector<char> is_boundary = mesh.boundary_flags();
  long long missing = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (is_boundary[v]) continue;
    if (quarter_turns[v] < 1)
      refuse(fmt::format("vertex {}: {} quarter turns; an angle sum must be positive",
                         user_vertex(mesh, v), quarter_turns[v]));
    missing += 4 - quarter_turns[v];
  }
  const long long expected = 4LL * mesh.topology().euler_characteristic();
  if (mesh.boundary_loops().empty() && missing != expected)
    refuse(fmt::format(
        "the sum of 4 - quarter turns over all cones is {}, but must be {}, 4 times the "
        "Euler characteristic (Gauss-Bonnet); add or remove cones",
        missing, expected));
}

Vec target_angles(const std::vector<int>& quarter_turns) {
  Vec angles(static_cast<Index>(quarter_turns.size()));
  for (std::size_t v = 0; v < quarter_turns.size(); ++v)
    angles[static_cast<Index>(v)] = 0.5 * std::numbers::pi * quarter_turns[v];
  return angles;
}

enum class Edges { Fixed, Delaunay };

// A damped Newton iteration. E is convex, so phi(t) = E(u + t p) has a monotone derivative, and the
// step rule needs no values of E, whose rounding hides its decrease near the minimum.
//
// A step is accepted if phi'(t) <= 0, that is, if E falls all along it, or if it halves the
// smallest gradient so far. The latter happens finitely often above any tolerance, and E decreases
// in between. Near the minimum it accepts full steps whatever the sign of phi'(1). All this also
// holds if every u has its own Delaunay triangulation, since E is then twice differentiable
// [GSC21].
class ConformalNewton {
 public:
  ConformalNewton(const SurfaceMesh& mesh, Vec angles, const StopCheck& stop)
      : energy_(mesh, std::move(angles)), row_of_(unknowns(energy_)), stop_(stop) {
    start_at(Vec::Zero(mesh.vertex_count()));
  }

  // Solves with the surface's own edges and, if that breaks triangles, again with Delaunay edges.
  void run() {
    minimize();
    if (!triangulation().has_broken_triangles(u_)) return;
    edges_ = Edges::Delaunay;
    if (angle_error() > kLostAngle) u_.setZero();
    flips_ = energy_.make_delaunay(u_);
    start_at(u_);
    minimize();
  }
  const IntrinsicTriangulation& triangulation() const { return energy_.triangulation(); }
  const Vec& log_factor() const { return u_; }
  double angle_error() const { return here_.gradient.cwiseAbs().maxCoeff(); }
  Index steps() const { return steps_; }
  Index flips() const { return flips_; }

 private:
  // Returns the unknowns of the interior vertices. A constant changes no angle, so the first vertex
  // of a closed surface has no unknown; its angle sum follows from Gauss-Bonnet.
  static std::vector<Index> unknowns(const ConformalEnergy& energy) {
    const std::vector<char>& is_interior = energy.is_interior();
    const bool closed = std::find(is_interior.begin(), is_interior.end(), 0) == is_interior.end();
    std::vector<Index> row_of(is_interior.size(), -1);
    Index rows = 0;
    for (std::size_t v = closed ? 1 : 0; v < is_interior.size(); ++v)
      if (is_interior[v]) row_of[v] = rows++;
    return row_of;
  }

  void start_at(const Vec& u) {
    u_ = u;
    here_ = energy_.derivatives(u_);
    least_gradient_ = here_.gradient.norm();
    analyze();
  }

  void analyze() {
    laplacian_.emplace(triangulation().faces(), row_of_);
    solver_ = make_direct_solver();
    if (laplacian_->pattern().size > 0) solver_->analyze(laplacian_->pattern());
  }

  void minimize() {
    if (laplacian_->pattern().size == 0) return;
    for (int k = 0; k < kMaxNewtonSteps && step(); ++k) {
      stop_.poll();
      ++steps_;
    }
  }

  // Returns the direction of the Newton step (#V), or of steepest descent if no matrix can be
  // factorized.
  Vec direction() {
    Vec r(laplacian_->pattern().size);
    for (std::size_t v = 0; v < row_of_.size(); ++v)
      if (row_of_[v] >= 0) r[row_of_[v]] = -here_.gradient[static_cast<Index>(v)];
    Vec p = r;
    const auto factorization = factorize_shifted(
        *solver_, laplacian_->pattern(), laplacian_->values(here_.hessian_weights), kSingularShift);
    if (factorization.status == FactorStatus::Ok) solver_->solve(r, p);
    if (!p.allFinite() || p.dot(r) <= 0) p = r;
    Vec out = Vec::Zero(u_.size());
    for (std::size_t v = 0; v < row_of_.size(); ++v)
      if (row_of_[v] >= 0) out[static_cast<Index>(v)] = p[row_of_[v]];
    return out;
  }

  // Moves to u + t p if that is acceptable; else returns phi'(t).
  std::optional<double> refusal(const Vec& p, double t) {
    const Vec u = u_ + t * p;
    ConformalEnergy energy = energy_;
    const Index flips = edges_ == Edges::Delaunay ? energy.make_delaunay(u) : 0;
    ConformalDerivatives there = energy.derivatives(u);
    const double slope = there.gradient.dot(p), norm = there.gradient.norm();
    const bool descends = slope <= 0 && angle_error() > kPolishedAngle;
    if (!descends && norm > kPolishedPart * least_gradient_) return slope;
    u_ = u;
    here_ = std::move(there);
    least_gradient_ = std::min(least_gradient_, norm);
    if (flips > 0) {
      flips_ += flips;
      energy_ = std::move(energy);
      analyze();
    }
    return std::nullopt;
  }

  bool step() {
    if (angle_error() == 0) return false;
    const Vec p = direction();
    const double descent = -here_.gradient.dot(p);
    const auto attempt = [&](double t) {
      const std::optional<double> slope = refusal(p, t);
      if (!slope) return kTake;
      if (angle_error() <= kPolishedAngle) return kGiveUp;
      // Steps towards the zero of phi' by the secant, staying before it.
      return std::clamp(kPartOfLimit * descent / (descent + *slope), kShortest, kPartOfLimit);
    };
    const double first = std::min(1.0, kLargestChange / p.cwiseAbs().maxCoeff());
    return backtrack(first, {.most_trials = kMaxStepHalvings}, attempt).has_value();
  }

  ConformalEnergy energy_;
  Edges edges_ = Edges::Fixed;
  std::vector<Index> row_of_;  // #V: unknown, or -1
  std::optional<EdgeLaplacian> laplacian_;
  std::unique_ptr<LinearSolver> solver_;
  const StopCheck& stop_;
  Vec u_;
  ConformalDerivatives here_;
  double least_gradient_ = 0;
  Index steps_ = 0, flips_ = 0;
};

// Shifts u so that the triangles that are not broken have the surface's area.
void scale_to_area(const SurfaceMesh& mesh, const IntrinsicTriangulation& triangulation, Vec& u) {
  const Vec log_lengths = triangulation.log_lengths(u);
  std::vector<double> log_areas;
  for (Index f = 0; f < triangulation.face_count(); ++f) {
    const TriangleShape shape = IntrinsicTriangulation::shape(log_lengths, f);
    if (!shape.broken) log_areas.push_back(shape.log_area);
  }
  if (log_areas.empty()) return;
  const double largest = *std::max_element(log_areas.begin(), log_areas.end());
  double sum = 0;
  for (const double a : log_areas) sum += std::exp(a - largest);
  u.array() += 0.5 * (std::log(mesh.area()) - largest - std::log(sum));
}

void count_broken(ConformalMetric& metric) {
  const Points2& vectors = metric.edge_vectors;
  for (Index h = 0; h < vectors.rows(); h += 3) {
    if (cross(vectors.row(h), vectors.row(h + 1)) > 0) continue;
    ++metric.broken_faces;
    const double longest = vectors.middleRows(h, 3).rowwise().norm().maxCoeff();
    if (vectors.middleRows(h, 3).colwise().sum().norm() > kClosingTolerance * longest)
      ++metric.open_faces;
  }
}

SurfaceMesh disk_of(const SurfaceMesh& mesh, const ConformalMetric& metric,
                    const std::vector<char>& is_cut) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::Usage, fmt::format("{}{}", message_prefix(mesh), what));
  };
  if (is_cut.size() != to_size(mesh.half_edge_count()))
    refuse(fmt::format("{} cut flags for {} half-edges; give 3 per face", is_cut.size(),
                       mesh.half_edge_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0 && !is_cut[h] != !is_cut[mesh.opposite(h)])
      refuse(fmt::format("edge ({}, {}) is cut on one side only; flag both half-edges",
                         user_vertex(mesh, mesh.from_vertex(h)),
                         user_vertex(mesh, mesh.to_vertex(h))));
  if (metric.edge_vectors.rows() != mesh.half_edge_count())
    refuse("the conformal metric belongs to another surface");
  SurfaceMesh disk = mesh.cut_along(is_cut, nullptr);
  const Topology& topology = disk.topology();
  if (topology.components != 1 || topology.boundary_loops != 1 ||
      topology.euler_characteristic() != 1)
    refuse(
        fmt::format("the cut surface is not a disk ({} components, {} boundary loops, Euler "
                    "characteristic {}); cut it along a graph whose complement is a disk",
                    topology.components, topology.boundary_loops, topology.euler_characteristic()));
  return disk;
}

// The faces of the disk in breadth-first order from a face in its middle, the last one that a sweep
// from the boundary reaches, so that few steps lead to each. `crossed`: per face the half-edge
// through which it is entered, -1 for the first.
struct FaceOrder {
  std::vector<Index> faces, crossed;

  explicit FaceOrder(const SurfaceMesh& disk) {
    for (Index h = 0; h < disk.half_edge_count(); ++h)
      if (disk.opposite(h) < 0) faces.push_back(face_of(h));
    sweep(disk);
    faces = {faces.back()};
    sweep(disk);
  }

 private:
  void sweep(const SurfaceMesh& disk) {
    crossed.assign(to_size(disk.face_count()), -1);
    std::vector<char> seen(crossed.size(), 0);
    for (const Index f : faces) seen[f] = 1;
    for (std::size_t done = 0; done < faces.size(); ++done)
      for (Index k = 0; k < 3; ++k) {
        const Index h = disk.opposite(3 * faces[done] + k);
        if (h < 0 || seen[face_of(h)]) continue;
        seen[face_of(h)] = 1;
        crossed[face_of(h)] = h;
        faces.push_back(face_of(h));
      }
  }
};

// Returns the metric's edge vectors (3 #F by 2) with all faces in the frame of the first, scaled so
// that the longest is 1.
Points2 aligned_vectors(const SurfaceMesh& disk, const FaceOrder& order,
                        const ConformalMetric& metric) {
  const double longest = metric.edge_vectors.rowwise().norm().maxCoeff();
  Points2 vectors = metric.edge_vectors / (longest > 0 ? longest : 1);
  for (const Index f : order.faces) {
    const Index here = order.crossed[f];
    if (here < 0) continue;
    // This rotation makes the edge the opposite of its vector in the previous face.
    const Eigen::RowVector2d a = vectors.row(here), b = -vectors.row(disk.opposite(here));
    const double norms = a.norm() * b.norm();
    if (!(norms > 0)) continue;
    const double c = a.dot(b) / norms, s = cross(a, b) / norms;
    Eigen::Matrix2d rotation;  // of rows
    rotation << c, s, -s, c;
    vectors.middleRows(3 * f, 3) *= rotation;
  }
  return vectors;
}

// Returns positions of the vertices of the disk by walking along its half-edges, face by face.
Points2 walk(const SurfaceMesh& disk, const FaceOrder& order, const Points2& vectors) {
  Points2 positions = Points2::Zero(disk.vertex_count(), 2);
  std::vector<char> placed(to_size(disk.vertex_count()), 0);
  placed[disk.faces()(order.faces.front(), 0)] = 1;
  for (const Index f : order.faces) {
    const Index entered = order.crossed[f];
    Index h = entered < 0 ? 3 * f : entered;
    for (int side = 0; side < 2; ++side, h = next(h)) {
      const Index b = disk.to_vertex(h);
      if (placed[b]) continue;
      positions.row(b) = positions.row(disk.from_vertex(h)) + vectors.row(h);
      placed[b] = 1;
    }
  }
  return positions;
}

// Minimizes the sum of |x_b - x_a - vector|^2 / |vector|^2 over all half-edges, starting from
// `positions`. If they already fit, only rounding is added. Leaves them unchanged if the system
// cannot be solved.
void improve(const SurfaceMesh& disk, const Points2& vectors, Points2& positions) {
  std::vector<Index> row_of;
  for (Index v = 0; v < disk.vertex_count(); ++v) row_of.push_back(v - 1);  // vertex 0 stays
  const EdgeLaplacian laplacian(disk.faces(), row_of);
  const Vec weights = vectors.rowwise().squaredNorm().cwiseInverse();
  if (!weights.allFinite()) return;
  const auto solver = make_direct_solver();
  solver->analyze(laplacian.pattern());
  if (factorize_shifted(*solver, laplacian.pattern(), laplacian.values(weights)).status !=
      FactorStatus::Ok)
    return;
  Points2 residual = Points2::Zero(disk.vertex_count(), 2);
  for (Index h = 0; h < disk.half_edge_count(); ++h) {
    const Index a = disk.from_vertex(h), b = disk.to_vertex(h);
    const Eigen::RowVector2d gap =
        weights[h] * (vectors.row(h) - (positions.row(b) - positions.row(a)));
    residual.row(b) += gap;
    residual.row(a) -= gap;
  }
  for (Index c = 0; c < 2; ++c) {
    Vec correction;
    solver->solve(residual.col(c).tail(laplacian.pattern().size), correction);
    if (correction.allFinite()) positions.col(c).tail(correction.size()) += correction;
  }
}

double area_of(const SurfaceMesh& disk, const Points2& positions) {
  double area = 0;
  for (Index f = 0; f < disk.face_count(); ++f) {
    const auto side = [&](Index k) -> Vector2 {
      return (positions.row(disk.faces()(f, k)) - positions.row(disk.faces()(f, 0))).transpose();
    };
    area += 0.5 * std::abs(cross(side(1), side(2)));
  }
  return area;
}

}  // namespace

ConformalMetric conformal_metric(const SurfaceMesh& mesh, const std::vector<int>& quarter_turns,
                                 const StopCheck& stop) {
  require_angle_sums(mesh, quarter_turns);
  ConformalNewton newton(mesh, target_angles(quarter_turns), stop);
  newton.run();
  ConformalMetric metric;
  metric.log_factor = newton.log_factor();
  metric.angle_error = newton.angle_error();
  metric.newton_steps = newton.steps();
  metric.flips = newton.flips();
  scale_to_area(mesh, newton.triangulation(), metric.log_factor);
  metric.edge_vectors = newton.triangulation().surface_vectors(metric.log_factor);
  count_broken(metric);
  return metric;
}

// Rotates all faces into one frame, walks along half-edges for positions, then corrects these once
// by least squares.
CornerPoints lay_out(const SurfaceMesh& mesh, const ConformalMetric& metric,
                     const std::vector<char>& is_cut) {
  const SurfaceMesh disk = disk_of(mesh, metric, is_cut);
  const FaceOrder order(disk);
  // The disk has the faces, corners and half-edges of the mesh.
  const Points2 vectors = aligned_vectors(disk, order, metric);
  Points2 positions = walk(disk, order, vectors);
  improve(disk, vectors, positions);
  const double area = area_of(disk, positions);
  if (area > 0) positions *= std::sqrt(mesh.area() / area);
  CornerPoints corners(mesh.face_count(), 6);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k)
      corners.row(f).segment<2>(2 * k) = positions.row(disk.faces()(f, k));
  return corners;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
