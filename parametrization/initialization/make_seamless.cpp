#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/cut_surface.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/mesh/cut_graph.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/fields/conformal_metric.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/initialization/untangle.h"

namespace majorant {
namespace {

// Computes a seamless map that follows a combed cross field; it may have inverted triangles.

// The term area / scale^2 * (|grad u - X|^2 + |grad v - Y|^2) of every face, with X and Y of length
// scale.
class FieldTerm final : public EnergyTerm {
 public:
  FieldTerm(const SurfaceMesh& surface, const CrossField& field, const Vec& scale)
      : element_dofs_{surface.faces(), 2},
        gradients_(surface.face_count(), 6),
        targets_(surface.face_count(), 4),
        weight_(surface.face_count()) {
    for (Index f = 0; f < surface.face_count(); ++f)
      tabulate(surface, field, scale.size() > 0 ? scale[f] : 1.0, f);
  }

  std::string_view name() const override { return "field"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      f[p] = weight_[e] * difference(x, e).squaredNorm();
    }
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const Eigen::Matrix2d d = difference(x, e);
      for (int i = 0, k = 0; i < 6; ++i) {
        out.gradient[i * LocalSystem::stride + static_cast<int>(p)] =
            2 * weight_[e] * gradient(e, i / 2).dot(d.row(i % 2));
        if (!out.hessian) continue;
        for (int j = 0; j <= i; ++j, ++k)
          out.hessian[k * LocalSystem::stride + static_cast<int>(p)] =
              i % 2 == j % 2 ? 2 * weight_[e] * gradient(e, i / 2).dot(gradient(e, j / 2)) : 0.0;
      }
    }
  }

 private:
  // Tabulates face f in its own frame: first axis along the edge corner 0 -> corner 1, as
  // CrossField has it.
  void tabulate(const SurfaceMesh& surface, const CrossField& field, double scale, Index f) {
    const auto p = [&](int k) { return Vector3(surface.positions().row(surface.faces()(f, k))); };
    const Vector3 a = p(1) - p(0), b = p(2) - p(0);
    const double length = a.norm();
    const Vector2 q1(length, 0), q2(a.dot(b) / length, length_of(a.cross(b)) / length);
    const double twice_area = q1.x() * q2.y();
    const std::array<Vector2, 3> corner{Vector2(0, 0), q1, q2};
    for (int k = 0; k < 3; ++k) {
      const Vector2 e = corner[previous(k)] - corner[next(k)];  // opposite edge
      gradients_.row(f).segment<2>(2 * k) << -e.y() / twice_area, e.x() / twice_area;
    }
    const Vector2 x = scale * Vector2(std::cos(field.angle[f]), std::sin(field.angle[f]));
    targets_.row(f) << x.x(), x.y(), -x.y(), x.x();
    weight_[f] = 0.5 * twice_area / (scale * scale);
  }
  Eigen::RowVector2d gradient(Index e, int corner) const {
    return gradients_.row(e).segment<2>(2 * corner);
  }
  // Returns grad u - X, grad v - Y as rows.
  Eigen::Matrix2d difference(VecIn x, Index e) const {
    Eigen::Matrix2d d;
    d << -targets_(e, 0), -targets_(e, 1), -targets_(e, 2), -targets_(e, 3);
    for (int k = 0; k < 3; ++k) d += x.segment<2>(2 * element_dofs_.nodes(e, k)) * gradient(e, k);
    return d;
  }

  ElementDofs element_dofs_;
  RowMatrix gradients_;  // #F by 6: of the three hat functions
  RowMatrix targets_;    // #F by 4: X, Y
  Vec weight_;
};

// A surface cut through its cones, and the field with these cones.
struct CutField {
  CrossField field;
  std::vector<char> is_cut;
  std::vector<AlignedEdge> aligned;  // that the field follows
};

// Returns the piecewise linear map of least int (|grad u - X|^2 + |grad v - Y|^2) / scale^2 whose
// seams have the transitions of `field`. X, Y are branches 0 and 1 of every face, of length
// `scale`. A sparse linear solve; seams hold exactly, and aligned edges lie along the axes.
//
// along: its field is combed along is_cut (3 #F), with turns 0 elsewhere. scale: #F, positive;
// empty: 1. The field of prescribed cones and the scale of the conformal metric with these cones
// are compatible except around handles and holes, where the metric may turn by other angles. The
// result may have inverted triangles (untangle.h). Throws Error(Infeasible) if the linear system is
// singular.
BezierMap integrate_field(const SurfaceMesh& mesh, const CutField& along, const Vec& scale) {
  const CrossField& field = along.field;
  const CutSurface cut = cut_open(mesh, along.is_cut, field.turns, field.quarter_turns);
  BezierMap map = BezierMap::linear(cut.mesh, Vec::Zero(2 * cut.mesh->vertex_count()), cut.seams);
  MapSpecification spec;
  spec.seams = cut.seams;
  ProblemBuilder builder(map.control_points().size());
  builder.add(std::make_shared<const FieldTerm>(*cut.mesh, field, scale), 1.0 / mesh.area());
  builder.add(SeamlessConstraint(map.shared_space(), cut.seams));
  if (!along.aligned.empty()) builder.add(AxisAlignment(map.shared_space(), along.aligned));
  builder.add(FixedPoints::at(gauge_vertices(spec, map.space()), map.control_points()));
  const Problem problem = builder.build();
  // The energy is quadratic: one Newton step solves it, and a second one removes rounding.
  NewtonOptions options = newton_of_maps();
  options.curvature = Curvature::Exact;
  NewtonStepper stepper(problem, options);
  const SolveResult solved = stepper.minimize(Vec::Zero(problem.size()), brief_rules(2, 0));
  if (solved.status == Status::Failed || solved.status == Status::Infeasible)
    throw Error(
        ErrorKind::Infeasible,
        message_prefix(mesh) + "the field's linear system is singular; check the mesh for defects");
  return map.with(map.shared_space(), problem.expand(solved.y));
}

constexpr std::size_t kMaxNamedCones = 5;  // in messages
// The first eps for scaled fields, a tenth of kFirstEps, since they leave few inverted triangles,
// and the others have nearly the right sizes.
constexpr double kScaledFirstEps = 0.01;

// Returns the coordinate that is constant along each edge that the combed field follows: that of
// the branch across.
std::vector<AlignedEdge> aligned_edges(const SurfaceMesh& mesh, const CrossField& field,
                                       const std::vector<char>& is_aligned) {
  std::vector<AlignedEdge> aligned;
  for (Index h = 0; h < static_cast<Index>(is_aligned.size()); ++h) {
    if (!is_aligned[h]) continue;
    double direction = 0;  // from corner 0 -> corner 1 of the face, counterclockwise
    const Index first = 3 * face_of(h);
    if (h == first + 1) direction = std::numbers::pi - corner_angle(mesh, h).radians();
    if (h == first + 2) direction = std::numbers::pi + corner_angle(mesh, first).radians();
    const double off = direction - field.angle[face_of(h)];
    aligned.push_back({h, std::abs(std::cos(off)) > std::abs(std::sin(off)) ? 1 : 0});
  }
  return aligned;
}

CutField cut_field(const SurfaceMesh& mesh, const SeamlessOptions& options, const StopCheck& stop) {
  CrossFieldOptions field = options.field;
  field.stop = stop;
  CutField out{options.cones ? cross_field_with_cones(mesh, *options.cones)
                             : smoothest_cross_field(mesh, field),
               {},
               {}};
  out.is_cut = cut_graph(mesh, cone_vertices(out.field), stop);
  comb(mesh, out.is_cut, out.field);
  out.aligned = aligned_edges(mesh, out.field, field.aligned);
  return out;
}

// Returns the ratio of lengths in a conformal metric to those on the surface, per face (geometric
// mean of corners).
Vec face_scale(const SurfaceMesh& mesh, const ConformalMetric& metric) {
  Vec scale(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += metric.log_factor[mesh.faces()(f, k)];
    scale[f] = std::exp(sum / 3);
  }
  return scale;
}

bool is_sphere_or_disk(const SurfaceMesh& mesh) {
  const Topology& t = mesh.topology();
  return t.boundary_loops <= 1 && t.euler_characteristic() == 2 - t.boundary_loops;
}

BezierMap conformal_start(const SurfaceMesh& mesh, const CutField& cut,
                          const ConformalMetric& metric) {
  return seamless_from_layout(mesh, cut.is_cut, lay_out(mesh, metric, cut.is_cut),
                              cut.field.quarter_turns)
      .map;
}

// The defects of a map: faces without a proof of det > 0, vertices covered several times.
struct Defects {
  std::vector<Index> faces, vertices;
  bool none() const { return faces.empty() && vertices.empty(); }
};

Defects defects(const BezierMap& map, const MapSpecification& spec) {
  Defects d;
  d.faces = LocalInjectivity(map.shared_space(), 2 * spec.rest->measure)
                .check(map.control_points())
                .blocking;
  if (d.faces.empty())
    d.vertices = AngleSums(map.shared_space(), AngleSums::Vertices::Interior, map.shared_seams())
                     .check(map.control_points())
                     .blocking;
  return d;
}

// Tries one start after the other and keeps the defects of the first.
class Maker {
 public:
  Maker(const SurfaceMesh& mesh, const SeamlessOptions& options, const RunRecord& record)
      : mesh_(mesh), record_(record), cut_(cut_field(mesh, options, record.start_stop())) {}

  std::optional<Start> attempt(SeamlessMethod method) {
    const Vec scale = method == SeamlessMethod::ScaledField ? face_scale(mesh_, metric()) : Vec();
    Start out{method == SeamlessMethod::Conformal ? conformal_start(mesh_, cut_, metric())
                                                  : integrate_field(mesh_, cut_, scale)};
    out.method = method;
    MapSpecification spec;
    spec.seams = out.map.shared_seams();
    spec.aligned = cut_.aligned;
    spec.rest = std::make_shared<const RestShapes>(rest_shapes(out.map.mesh()));
    record_.start_stop().poll();
    Defects found = defects(out.map, spec);
    out.inverted = static_cast<Index>(found.faces.size());
    if (!found.faces.empty()) {
      // The rest shapes have the sizes that a scaled field gives the triangles.
      RestShapes rest = *spec.rest;
      for (Index f = 0; f < scale.size(); ++f) rest.inverse.row(f) /= scale[f];
      spec.rest = std::make_shared<const RestShapes>(std::move(rest));
      const UntangleResult r = untangle(spec, out.map.shared_space(), out.map.control_points(),
                                        record_, scale.size() > 0 ? kScaledFirstEps : kFirstEps);
      out.untangling_steps = r.iterations;
      out.map = out.map.with(out.map.shared_space(), r.x);
      found = defects(out.map, spec);
    }
    if (found.none()) return out;
    if (defects_.none()) defects_ = found;
    return std::nullopt;
  }

  [[noreturn]] void give_up() const {
    record_.start_stop().poll();
    const std::string what =
        defects_.faces.empty()
            ? fmt::format("{} vertices are covered several times", defects_.vertices.size())
            : fmt::format("{} triangles stay inverted", defects_.faces.size());
    throw Refusal(ErrorKind::Invalid, mesh_.file(),
                  fmt::format("{}no injective seamless map found: {} {}; ", message_prefix(mesh_),
                              what, place()),
                  Hint::OtherCones, ", or refine the mesh there");
  }

 private:
  const ConformalMetric& metric() {
    if (!metric_) metric_ = conformal_metric(mesh_, cut_.field.quarter_turns, record_.start_stop());
    return *metric_;
  }

  // Names the cones nearest to the defects, along edges. Vertices count from 0, as in files of
  // cones.
  std::string place() const {
    std::vector<Index> seeds = defects_.vertices;
    for (const Index f : defects_.faces) seeds.push_back(mesh_.faces()(f, 0));
    const std::vector<Index> cones = cone_vertices(cut_.field);
    if (cones.empty()) return fmt::format("near vertex {}", mesh_.input_vertex(seeds[0]));
    const std::vector<Index> nearest = nearest_of(cones);
    std::vector<Index> near;
    for (const Index v : seeds) near.push_back(nearest[v]);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::string list;
    for (std::size_t k = 0; k < std::min(near.size(), kMaxNamedCones); ++k)
      list += fmt::format("{}{} ({} degrees)", k ? ", " : "", mesh_.input_vertex(near[k]),
                          90 * cut_.field.quarter_turns[near[k]]);
    if (near.size() > kMaxNamedCones)
      list += fmt::format(" and {} more", near.size() - kMaxNamedCones);
    return fmt::format("near the cone{} at vert{} {}", near.size() > 1 ? "s" : "",
                       near.size() > 1 ? "ices" : "ex", list);
  }

  // Returns for each vertex the source that a breadth-first search reaches first.
  std::vector<Index> nearest_of(const std::vector<Index>& sources) const {
    std::vector<std::vector<Index>> neighbours(to_size(mesh_.vertex_count()));
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      neighbours[mesh_.from_vertex(h)].push_back(mesh_.to_vertex(h));
      neighbours[mesh_.to_vertex(h)].push_back(mesh_.from_vertex(h));
    }
    std::vector<Index> nearest(neighbours.size(), -1);
    std::deque<Index> queue(sources.begin(), sources.end());
    for (const Index v : sources) nearest[v] = v;
    for (; !queue.empty(); queue.pop_front())
      for (const Index v : neighbours[queue.front()])
        if (nearest[v] < 0) {
          nearest[v] = nearest[queue.front()];
          queue.push_back(v);
        }
    return nearest;
  }

  const SurfaceMesh& mesh_;
  const RunRecord& record_;
  CutField cut_;
  std::optional<ConformalMetric> metric_;
  Defects defects_;
};

}  // namespace

std::string_view method_name(SeamlessMethod method) {
  switch (method) {
    case SeamlessMethod::Field:
      return "field";
    case SeamlessMethod::ScaledField:
      return "scaled-field";
    case SeamlessMethod::Conformal:
      return "conformal";
    default:
      return "automatic";
  }
}

Start make_seamless(const SurfaceMesh& mesh, const SeamlessOptions& options,
                    const RunRecord& record) {
  if (options.cones && !options.field.aligned.empty())
    throw InvalidArgument("make_seamless: given cones and edges to follow exclude each other");
  const bool is_aligned = !options.field.aligned.empty();
  const bool conformal_exists = is_sphere_or_disk(mesh) && !is_aligned;
  if (options.method == SeamlessMethod::Conformal && !conformal_exists)
    throw Refusal(ErrorKind::Usage, mesh.file(),
                  message_prefix(mesh) +
                      "a conformal start needs a sphere or a disk, where cones alone determine the "
                      "transitions, and no edges to follow; use ",
                  Hint::ScaledField);
  if (options.threads < 0) throw InvalidArgument("the number of threads must not be negative");
  const ThreadCount threads(options.threads);
  Maker maker(mesh, options, record);
  for (const SeamlessMethod method :
       {SeamlessMethod::Field, SeamlessMethod::ScaledField, SeamlessMethod::Conformal}) {
    const bool is_first = method == SeamlessMethod::Field;
    const bool is_possible = method != SeamlessMethod::Conformal || conformal_exists;
    const bool is_next = options.method == SeamlessMethod::Automatic && is_possible &&
                         (is_first || record.start_stop()() == Directive::Continue);
    if (options.method != method && !is_next) continue;
    try {
      if (auto found = maker.attempt(method)) return *std::move(found);
    } catch (const Error& e) {
      // If this start fails, the error of an earlier method says more.
      const bool no_start = e.kind() == ErrorKind::Unsupported || e.kind() == ErrorKind::Infeasible;
      if (options.method == method || is_first || !no_start) throw;
    }
  }
  maker.give_up();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
