#include "majorant/parametrization/drive/deform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/internal/free_scale.h"

namespace majorant {
namespace {

// Of the mesh's size: deviation from a plane.
constexpr double kFlat = kTenDigits;
// Towards the targets. Origin: chosen so that a right angle is turned by 9 degrees at a time.
constexpr int kSteps = 10;
// Relative decrease that ends one. Origin: a thousand times the final one: they only lead there.
constexpr double kStepTolerance = 1e-3;
// Stiffness of the springs that pull pins. Origin: from a hundred times the default of soft handles
// to where the energy has three digits left beside them.
constexpr double kFirstStiffness = 1e5, kStiffer = 100, kStiffest = 1e13;
// Of the size: how close pins must come to be held. Origin: a jump of this length folds no triangle
// larger than that.
constexpr double kReached = 1e-6;

Vector2 start_of(const BezierMap& map, Index vertex) {
  return map.control_points().segment<2>(2 * vertex);
}

double size_of(const BezierMap& map) {
  const Eigen::Map<const Points2> points(map.control_points().data(),
                                         map.control_points().size() / 2, 2);
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

class Deformation {
 public:
  Deformation(const BezierMap& start, const ParametrizationOptions& options, RunRecord& record)
      : start_(start), options_(options), record_(record), map_(start) {}

  ParametrizationResult solve() {
    if (options_.map.handles.empty() && options_.map.pins.empty())
      return parametrize(start_, options_, record_);
    for (int k = 1; k <= kSteps && going_on(); ++k)
      pull(static_cast<double>(k) / kSteps, options_.map.handle_weight);
    if (!options_.map.pins.empty()) reach_pins();
    return parametrize(map_, options_, record_);
  }

 private:
  bool going_on() const {
    return record_.iterations_left() > 0 && record_.directive() == Directive::Continue;
  }

  // One solve at degree 1 with all targets soft, at the part t of their way.
  double pull(double t, double weight) {
    ParametrizationOptions o = options_;
    o.map.degree = 1;
    o.map.handle_weight = weight;
    o.map.handles.clear();
    o.map.pins.clear();
    o.solve.tolerance = kStepTolerance;
    o.solve.triangles = Triangles::Kept;
    for (const auto* points : {&options_.map.handles, &options_.map.pins})
      for (const Pin& p : *points) {
        const Vector2 from = start_of(start_, p.vertex);
        o.map.handles.push_back({p.vertex, Vector2(from + t * (p.target.value_or(from) - from))});
      }
    const ParametrizationResult r = parametrize(map_, o, record_);
    if (r.map) map_ = *r.map;
    return r.handle_distance;
  }

  void reach_pins() {
    const double enough = kReached * size_of(start_);
    for (double w = kFirstStiffness; w <= kStiffest && going_on() && pin_distance().second > enough;
         w *= kStiffer)
      pull(1.0, w);
    const auto [vertex, distance] = pin_distance();
    const auto refuse = [&](const std::string& why) {
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}: no valid way to the pins' targets found: {}; use soft handles, "
                              "or targets nearer to the start",
                              start_.mesh().file(), why));
    };
    if (distance > enough && !going_on())
      throw Error(ErrorKind::Infeasible,
                  start_.mesh().file() +
                      ": stopped by a limit or Ctrl-C before the pins' targets were "
                      "reached; raise --max-iterations or --time-limit");
    const Index name = start_.mesh().input_vertex(vertex);
    if (distance > enough) refuse(fmt::format("vertex {} stays {:.3g} away", name, distance));
    Vec x = map_.control_points();
    for (const Pin& p : options_.map.pins)
      x.segment<2>(2 * p.vertex) = p.target.value_or(start_of(start_, p.vertex));
    map_ = map_.with(map_.shared_space(), std::move(x));
  }

  // The pin that is farthest from its target.
  std::pair<Index, double> pin_distance() const {
    std::pair<Index, double> worst{-1, -1.0};
    for (const Pin& p : options_.map.pins) {
      const Vector2 target = p.target.value_or(start_of(start_, p.vertex));
      const double d = (start_of(map_, p.vertex) - target).norm();
      if (d > worst.second) worst = {p.vertex, d};
    }
    return worst;
  }

  const BezierMap& start_;
  const ParametrizationOptions& options_;
  RunRecord& record_;
  BezierMap map_;
};

}  // namespace

BezierMap planar_map(std::shared_ptr<const SurfaceMesh> mesh) {
  const Points3& p = mesh->positions();
  const double size = (p.colwise().maxCoeff() - p.colwise().minCoeff()).maxCoeff();
  for (Index v = 0; v < mesh->vertex_count(); ++v)
    if (!(std::abs(p(v, 2) - p(0, 2)) <= kFlat * size))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: vertex {} is off the plane z = {:g}; deform needs a planar mesh",
                              mesh->file(), mesh->input_vertex(v) + 1, p(0, 2)));
  Vec twice_area(mesh->face_count());
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const Eigen::RowVector2d a = p.row(mesh->faces()(f, 0)).head<2>();
    const Eigen::RowVector2d b = p.row(mesh->faces()(f, 1)).head<2>() - a;
    const Eigen::RowVector2d c = p.row(mesh->faces()(f, 2)).head<2>() - a;
    twice_area[f] = cross(b, c);
  }
  const double side = twice_area.sum() < 0 ? -1 : 1;
  for (Index f = 0; f < mesh->face_count(); ++f)
    if (!(side * twice_area[f] > 0))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: face {} is turned over in the plane; repair the mesh",
                              mesh->file(), mesh->input_face(f) + 1));
  Vec uv(2 * mesh->vertex_count());
  for (Index v = 0; v < mesh->vertex_count(); ++v) uv.segment<2>(2 * v) << side * p(v, 0), p(v, 1);
  return BezierMap::linear(std::move(mesh), std::move(uv));
}

ParametrizationResult deform(const BezierMap& start, const ParametrizationOptions& options,
                             RunRecord& record) {
  for (const auto* points : {&options.map.pins, &options.map.handles})
    for (const Pin& p : *points)
      if (p.vertex < 0 || p.vertex >= start.mesh().vertex_count())
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: vertex {} does not exist", start.mesh().file(), p.vertex));
  require_scale(options.map, start);
  return Deformation(start, options, record).solve();
}

}  // namespace majorant
