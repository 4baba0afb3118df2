#include "majorant/parametrization/solve/map_sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/certify/global_injectivity.h"
#include "majorant/energies/rest_sensitivity.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/parametrization/solve/pins.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {
namespace {

// The largest error after polishing at which the map counts as a minimum.
constexpr double kLargestError = 1e-6;
// The angle and the factor by which a map is moved to test the invariance of its energy. Any values
// far above rounding work.
constexpr double kTestAngle = 0.5, kTestScale = 1.25;
// Changes of an element's energy below this fraction of the largest one count as 0; far above
// rounding.
constexpr double kNoChange = 1e-9;

[[noreturn]] void refuse_derivative(const std::string& why) {
  throw Error(ErrorKind::Unsupported, "MapSensitivity: " + why);
}

void require_supported(const ParametrizationResult& result, const ParametrizationOptions& options) {
  if (!result.map) refuse_derivative("there is no map: " + result.message);
  if (!result.map->seams().empty())
    refuse_derivative("the map is seamless; derivatives are those of maps without seams");
  if (!options.map.aligned.empty()) refuse_derivative("edges of the map are aligned with axes");
  if (options.extend) refuse_derivative("terms or constraints were added to the map");
  if (result.other_triangles || options.solve.triangles == Triangles::Flipped)
    refuse_derivative("edges of the map were flipped (improve_mesh)");
  if (result.map->degree() != options.map.degree)
    throw InvalidArgument(fmt::format("MapSensitivity: options of degree {}, the map has {}",
                                      options.map.degree, result.map->degree()));
  if (result.handles.size() != options.map.handles.size())
    throw InvalidArgument(fmt::format("MapSensitivity: options of {} handles, the result has {}",
                                      options.map.handles.size(), result.handles.size()));
}

// Returns the options with the actual targets of pins and handles.
MapOptions held_options(const ParametrizationResult& result,
                        const ParametrizationOptions& options) {
  MapOptions placed = options.map;
  placed.handles = result.handles;
  placed.initial.reset();
  return with_targets(*result.map, std::move(placed));
}

template <class Point>
void require_points(const char* what, const std::vector<Point>& points, std::size_t count) {
  require_size(what, static_cast<Index>(points.size()), static_cast<Index>(count));
  for (const Point& p : points)
    if (!p.allFinite()) throw InvalidArgument(fmt::format("{} are not finite", what));
}

}  // namespace

class MapSensitivity::Parts {
 public:
  Parts(const ParametrizationResult& result, const ParametrizationOptions& options,
        MapSensitivityOptions sensitivity_options)
      : map_options_((require_supported(result, options), held_options(result, options))),
        start_(*result.map, map_options_, Origin::Kept),
        sensitivity_options_(std::move(sensitivity_options)),
        problem_(build(options.solve.quadrature_points)) {
    place_pins_in_rows();
    find_motions();
    SensitivityOptions exact;
    exact.linear_solver = sensitivity_options_.linear_solver;
    if (!motions_.empty())
      exact.null_space = [this](const Problem& problem, VecIn y) { return motions_at(problem, y); };
    if (sensitivity_options_.gauge)
      exact.gauge = [this](const Problem& problem, VecIn y) { return gauge_at(problem.expand(y)); };
    SolveResult end;
    end.status = Status::Converged;
    end.y = problem_.reduce(start_.map().control_points());
    try {
      sensitivity_.emplace(problem_, end, exact);
      if (!(sensitivity_->error() <= kLargestError))
        refuse_derivative(fmt::format(
            "exact Newton steps do not converge (the last one is {:.1e} of the map): the run has "
            "stopped far from a minimum, or injectivity holds the map back",
            sensitivity_->error()));
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::Unsupported || map_options_.injectivity == MapInjectivity::Local)
        throw;
      refuse_derivative(fmt::format(
          "the scaffold or barrier against overlaps is active (bijective); without it: {}",
          e.what()));
    }
    const Vec& x = sensitivity_->point();
    const Vec away = x - start_.map().control_points();
    const auto size = Eigen::Map<const Points2>(x.data(), x.size() / 2, 2);
    moved_ = away.cwiseAbs().maxCoeff() /
             (size.colwise().maxCoeff() - size.colwise().minCoeff()).maxCoeff();
    map_.emplace(start_.in_model_units(start_.map().with(start_.map().shared_space(), x)));
    if (map_options_.injectivity == MapInjectivity::Global &&
        check_boundary(*map_).result != ProofStatus::Proven)
      refuse_derivative(
          "the scaffold or barrier against overlaps is active (bijective): without it the map "
          "overlaps itself");
  }

  Vec forward(const Change& change) {
    Sensitivity::Change in;
    const double scale = start_.scale();
    if (!change.pins.empty()) {
      require_points("MapSensitivity: pins", change.pins, map_options_.pins.size());
      in.right_hand_sides = Vec::Zero(sensitivity_->row_count());
      for (std::size_t k = 0; k < change.pins.size(); ++k)
        in.right_hand_sides.segment<2>(rows_[k]) = scale * change.pins[k];
    }
    if (!change.handles.empty()) {
      require_points("MapSensitivity: handles", change.handles, map_options_.handles.size());
      Vec targets(2 * static_cast<Index>(change.handles.size()));
      for (std::size_t k = 0; k < change.handles.size(); ++k)
        targets.segment<2>(2 * static_cast<Index>(k)) = scale * change.handles[k];
      in.parameters.emplace_back(handles_id(), std::move(targets));
    }
    if (change.weights.size() > 0) {
      require_size("MapSensitivity: weights", change.weights.size(), energy_count());
      require_finite("MapSensitivity: weights", change.weights);
      for (std::size_t k = 0; k < ids_.size(); ++k)
        in.weights.emplace_back(ids_[k], change.weights[static_cast<Index>(k)] / area());
    }
    if (change.handle_weight != 0) {
      if (!std::isfinite(change.handle_weight))
        throw InvalidArgument("MapSensitivity: handle_weight is not finite");
      if (map_options_.handles.empty())
        throw InvalidArgument("MapSensitivity: the map has no handles");
      in.weights.emplace_back(handles_id(), change.handle_weight / area());
    }
    if (change.face_weights.size() > 0) {
      require_size("MapSensitivity: face_weights", change.face_weights.size(), face_count());
      require_finite("MapSensitivity: face_weights", change.face_weights);
      for (std::size_t k = 0; k < ids_.size(); ++k)
        in.element_weights.emplace_back(ids_[k], times_own(k, change.face_weights));
    }
    if (!change.parameters.empty()) {
      require_size("MapSensitivity: parameters", static_cast<Index>(change.parameters.size()),
                   energy_count());
      for (std::size_t k = 0; k < ids_.size(); ++k)
        if (change.parameters[k].size() > 0)
          in.parameters.emplace_back(ids_[k], change.parameters[k]);
    }
    if (change.positions.rows() > 0) {
      if (map_->degree() > 1)
        refuse_derivative(
            fmt::format("the map has degree {}; positions of the surface are data at degree 1",
                        map_->degree()));
      in.gradient = rest().gradient(scale * change.positions);
    }
    return sensitivity_->forward(in) / scale;
  }

  Derivative adjoint(const Vec& slope) {
    const double scale = start_.scale();
    require_size("MapSensitivity::adjoint: the slope", slope.size(), problem_.full_size());
    const Sensitivity::Derivative d = sensitivity_->adjoint(Vec(slope / scale));
    Derivative out;
    for (const Index row : rows_) out.pins.push_back(scale * d.right_hand_sides.segment<2>(row));
    out.weights.resize(energy_count());
    out.face_weights = Vec::Zero(face_count());
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      const auto at = static_cast<std::size_t>(ids_[k]);
      out.weights[static_cast<Index>(k)] = d.weights[at] / area();
      out.face_weights += times_own(k, d.element_weights[at]);
      out.parameters.push_back(d.parameters[at]);
    }
    if (!map_options_.handles.empty()) {
      const auto at = static_cast<std::size_t>(handles_id());
      for (std::size_t k = 0; k < map_options_.handles.size(); ++k)
        out.handles.push_back(scale * d.parameters[at].segment<2>(2 * static_cast<Index>(k)));
      out.handle_weight = d.weights[at] / area();
    }
    if (map_->degree() == 1 && map_->mesh().rest_triangles().empty())
      out.positions = scale * rest().adjoint(d);
    return out;
  }

  const BezierMap& map() const { return *map_; }
  double moved() const { return moved_; }
  double error() const { return sensitivity_->error(); }
  Index motions() const { return static_cast<Index>(motions_.size()); }

 private:
  enum class Motion { AlongU, AlongV, Turn, Scale };

  const MapSpecification& spec() const { return start_.specification(); }
  double area() const { return whole_area(spec()); }
  Index energy_count() const { return static_cast<Index>(ids_.size()); }
  Index face_count() const { return start_.map().mesh().face_count(); }
  // Handles come right after the energies (add_map()).
  TermId handles_id() const { return problem_.terms()[ids_.size()]; }

  Problem build(int quadrature_points) {
    const auto& space = start_.map().shared_space();
    const QuadratureHierarchy hierarchy =
        optimizer_quadrature(space->degree(), quadrature_points, SolverRules().quadrature);
    ProblemBuilder builder = map_builder(spec(), *space);
    ids_ = add_map(builder, spec(), space, start_.map().control_points(),
                   energy_terms(spec(), space, {hierarchy.guarded.front()}),
                   std::make_shared<const LocalInjectivity>(space, 2 * spec().rest->measure))
               .energies;
    return builder.build();
  }

  // Records the rows of the pins, which come first, two each.
  void place_pins_in_rows() {
    for (const Pin& pin : map_options_.pins) {
      const auto& placed = spec().pins;
      const auto found = std::find_if(placed.begin(), placed.end(),
                                      [&](const FixedPoint& p) { return p.node == pin.vertex; });
      if (found == placed.end())
        refuse_derivative(fmt::format("the pin of vertex {} lies on the fixed boundary",
                                      user_vertex(start_.map().mesh(), pin.vertex)));
      rows_.push_back(2 * static_cast<Index>(found - placed.begin()));
    }
  }

  Vec times_own(std::size_t summand, const Vec& by_face) const {
    const Vec& own = spec().energy[summand].face_weight;
    return own.size() > 0 ? Vec(own.cwiseProduct(by_face)) : by_face;
  }

  const RestSensitivity& rest() {
    const SurfaceMesh& mesh = start_.map().mesh();
    if (!mesh.rest_triangles().empty())
      refuse_derivative(
          fmt::format("face {} has no area and is measured against another triangle, so positions "
                      "of the surface "
                      "are no data of the map",
                      user_face(mesh, mesh.rest_triangles().front().face)));
    if (!rest_)
      rest_.emplace(problem_, *sensitivity_, ids_, start_.scale() * mesh.positions(), mesh.faces());
    return *rest_;
  }

  // Finds the motions of a map held at one point or none under which its energies are invariant.
  void find_motions() {
    const auto held = spec().pins.size() + spec().handles.size();
    if (held < 2 && spec().boundary != BoundaryCondition::Fixed) {
      if (held == 1)
        centre_ = (spec().pins.empty() ? spec().handles : spec().pins).front().position;
      for (const Motion motion : {Motion::AlongU, Motion::AlongV, Motion::Turn, Motion::Scale})
        if ((held == 0 || motion == Motion::Turn || motion == Motion::Scale) && is_free(motion))
          motions_.push_back(motion);
    }
    if (!sensitivity_options_.gauge) return;
    const SurfaceMesh& mesh = start_.map().mesh();
    for (const Index vertex : *sensitivity_options_.gauge)
      if (vertex < 0 || vertex >= mesh.vertex_count())
        throw InvalidArgument(fmt::format("MapSensitivity: the gauge has vertex {}, there are {}",
                                          vertex, mesh.vertex_count()));
    if ((*sensitivity_options_.gauge)[0] == (*sensitivity_options_.gauge)[1])
      throw InvalidArgument("MapSensitivity: the gauge has the same vertex twice");
    if (held > 0 || motions_.size() < 3)
      throw InvalidArgument(
          "MapSensitivity: a gauge is for maps that nothing holds, no pin, handle or boundary");
  }

  bool is_free(Motion motion) const {
    Vec moved = start_.map().control_points();
    const double c = std::cos(kTestAngle), s = std::sin(kTestAngle);
    for (Index k = 0; k < moved.size(); k += 2) {
      const Vector2 p = moved.segment<2>(k) - centre_;
      if (motion == Motion::AlongU) moved[k] += kTestAngle;
      if (motion == Motion::AlongV) moved[k + 1] += kTestAngle;
      if (motion == Motion::Turn)
        moved.segment<2>(k) = centre_ + Vector2(c * p.x() - s * p.y(), s * p.x() + c * p.y());
      if (motion == Motion::Scale) moved.segment<2>(k) = centre_ + kTestScale * p;
    }
    return std::all_of(ids_.begin(), ids_.end(), [&](TermId id) {
      const Vec before = element_values(problem_, id, start_.map().control_points());
      const Vec after = element_values(problem_, id, moved);
      return (after - before).cwiseAbs().maxCoeff() <= kNoChange * before.cwiseAbs().maxCoeff();
    });
  }

  // Returns the motions of the map at y, a column each.
  Eigen::MatrixXd motions_at(const Problem& problem, VecIn y) const {
    const Vec x = problem.expand(y);
    Eigen::MatrixXd columns(problem.size(), motions());
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      Vec moved = x;
      for (Index k = 0; k < x.size(); k += 2) {
        const Vector2 p = x.segment<2>(k) - centre_;
        if (motions_[m] == Motion::AlongU) moved[k] += 1;
        if (motions_[m] == Motion::AlongV) moved[k + 1] += 1;
        if (motions_[m] == Motion::Turn) moved.segment<2>(k) += Vector2(-p.y(), p.x());
        if (motions_[m] == Motion::Scale) moved.segment<2>(k) += p;
      }
      columns.col(static_cast<Index>(m)) = problem.reduce(moved) - y;
    }
    return columns;
  }

  Eigen::MatrixXd gauge_at(const Vec& x) const {
    const auto [stays, follows] = *sensitivity_options_.gauge;
    const Vector2 along = (x.segment<2>(2 * follows) - x.segment<2>(2 * stays)).normalized();
    const Vector2 across(-along.y(), along.x());
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(motions(), x.size());
    rows(0, 2 * stays) = rows(1, 2 * stays + 1) = 1;
    for (Index k = 2; k < motions(); ++k) {
      const Vector2& direction = k == 2 ? across : along;
      rows.row(k).segment<2>(2 * follows) = direction.transpose();
      rows.row(k).segment<2>(2 * stays) = -direction.transpose();
    }
    return rows;
  }

  MapOptions map_options_;
  NormalizedStart start_;
  MapSensitivityOptions sensitivity_options_;
  std::vector<TermId> ids_;  // of the summands of the energy
  Problem problem_;
  std::vector<Index> rows_;  // the first of each pin
  Vector2 centre_ = Vector2::Zero();
  std::vector<Motion> motions_;
  std::optional<Sensitivity> sensitivity_;
  std::optional<RestSensitivity> rest_;
  std::optional<BezierMap> map_;
  double moved_ = 0;
};

MapSensitivity::MapSensitivity(const ParametrizationResult& result,
                               const ParametrizationOptions& options,
                               MapSensitivityOptions sensitivity_options) {
  const ThreadCount threads(options.solve.threads);
  parts_ = std::make_unique<Parts>(result, options, std::move(sensitivity_options));
}
MapSensitivity::~MapSensitivity() = default;
MapSensitivity::MapSensitivity(MapSensitivity&&) noexcept = default;
MapSensitivity& MapSensitivity::operator=(MapSensitivity&&) noexcept = default;

const BezierMap& MapSensitivity::map() const { return parts_->map(); }
double MapSensitivity::moved() const { return parts_->moved(); }
double MapSensitivity::error() const { return parts_->error(); }
Index MapSensitivity::motions() const { return parts_->motions(); }
Vec MapSensitivity::forward(const Change& change) const { return parts_->forward(change); }
MapSensitivity::Derivative MapSensitivity::adjoint(const Vec& slope) const {
  return parts_->adjoint(slope);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
