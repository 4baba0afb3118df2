#include "majorant/parametrization/parametrize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "majorant/framework/error.h"
#include "majorant/parametrization/degree_solver.h"
#include "majorant/parametrization/initial_map.h"

namespace majorant {
namespace {

// The optimizer works on a surface of size about 1: a power of two, so that scaling is exact.
double normalizing_scale(const SurfaceMesh& mesh) {
  const Eigen::RowVector3d extent =
      mesh.positions().colwise().maxCoeff() - mesh.positions().colwise().minCoeff();
  return std::exp2(-std::round(std::log2(extent.maxCoeff())));
}

void require_valid(const ParametrizationOptions& o) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::Usage, what); };
  if (o.degree < 1 || o.degree > BezierTriangleSpace::kMaxDegree)
    refuse(fmt::format("degree {} is not one of 1..{}", o.degree, BezierTriangleSpace::kMaxDegree));
  if (!(o.tolerance > 0)) refuse("the tolerance must be positive");
  if (o.quadrature_points < 0) refuse("the number of quadrature points must not be negative");
  if (o.energy.empty()) refuse("no energy is given");
  for (const WeightedEnergy& e : o.energy)
    if (!(e.weight > 0) || !std::isfinite(e.weight))
      refuse("weights of energies must be positive numbers");
  if (!(o.handle_weight > 0) || !std::isfinite(o.handle_weight))
    refuse("the weight of soft handles must be a positive number");
}

void require_face_weights(const SurfaceMesh& mesh, const Vec& weights) {
  if (weights.size() == 0) return;
  if (weights.size() != mesh.face_count() || !(weights.minCoeff() > 0) || !weights.allFinite())
    throw Error(ErrorKind::Usage,
                mesh.file() + ": face weights must be one positive number for each face");
}

void require_vertex(const SurfaceMesh& mesh, const Pin& pin) {
  if (pin.vertex < 0 || pin.vertex >= mesh.vertex_count())
    throw Error(ErrorKind::Usage,
                fmt::format("{}: pinned vertex {} does not exist", mesh.file(), pin.vertex));
}

bool contains(const std::vector<FixedPoint>& points, Index node) {
  return std::any_of(points.begin(), points.end(),
                     [&](const FixedPoint& p) { return p.node == node; });
}

// Soft handles may be anywhere.
std::vector<FixedPoint> place_handles(const SurfaceMesh& mesh, const std::vector<Pin>& handles,
                                      const std::vector<FixedPoint>& pins, const Vec& start) {
  std::vector<FixedPoint> points;
  for (const Pin& handle : handles) {
    require_vertex(mesh, handle);
    if (contains(points, handle.vertex) || contains(pins, handle.vertex))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: vertex {} has two handles, or a pin and a handle; keep one",
                              mesh.file(), mesh.input_vertex(handle.vertex)));
    const Vector2 here = start.segment<2>(2 * handle.vertex);
    points.push_back({handle.vertex, handle.target.value_or(here)});
  }
  return points;
}

// Pins as fixed points: a target must be where the start has the vertex, up to rounding, because
// the solver moves along maps that satisfy the constraints.
std::vector<FixedPoint> place_pins(const SurfaceMesh& mesh, const ParametrizationOptions& options,
                                   const Vec& start) {
  const double tolerance = 1e-9 * start.cwiseAbs().maxCoeff();
  std::vector<FixedPoint> points;
  for (const Pin& pin : options.pins) {
    require_vertex(mesh, pin);
    const Vector2 here = start.segment<2>(2 * pin.vertex);
    const Vector2 target = pin.target.value_or(here);
    const double distance = (target - here).norm();
    if (distance > tolerance)
      throw Error(
          ErrorKind::Infeasible,
          fmt::format("{}: the pin of vertex {} is {:.6g} away from the initial map ({}, {}); "
                      "hold it there with \"target\": \"initial\", start from a map that "
                      "meets the pins with --init input, or use soft handles",
                      mesh.file(), mesh.input_vertex(pin.vertex), distance, here.x(), here.y()));
    if (contains(points, pin.vertex))
      throw Error(ErrorKind::Unsupported, fmt::format("{}: vertex {} is pinned twice; pin it once",
                                                      mesh.file(), mesh.input_vertex(pin.vertex)));
    // A fixed boundary already says the same, up to rounding.
    const auto& loop = mesh.boundary_loops().front();
    const bool held = options.boundary == BoundaryCondition::Fixed &&
                      std::find(loop.begin(), loop.end(), pin.vertex) != loop.end();
    points.push_back({pin.vertex, held ? here : target});
  }
  return points;
}

void require_injective(const BezierMap& map, const std::string& what) {
  const RestShapes rest = flat_triangles(map.mesh().positions(), map.mesh().faces());
  const Verdict faces =
      LocalInjectivity(map.shared_space(), 2 * rest.measure).check(map.control_points());
  if (!faces.feasible)
    throw Error(
        ErrorKind::Infeasible,
        fmt::format("{}: the {} is not injective: face {} ({} in all) is not positively "
                    "oriented; give another start with --init",
                    map.mesh().file(), what, map.mesh().input_face(faces.blocking.front()) + 1,
                    faces.blocking.size()));
  const Verdict vertices =
      AngleSums(map.shared_space(), AngleSums::Vertices::Interior).check(map.control_points());
  if (!vertices.feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}: the {} is not injective: it covers the neighbourhood of vertex {} "
                            "more than once; give another start with --init",
                            map.mesh().file(), what,
                            map.mesh().input_vertex(vertices.blocking.front()) + 1));
}

// Translations are free when nothing holds the map; then vertex 0 is held, at the origin.
bool needs_gauge(const ParametrizationOptions& options) {
  return options.boundary == BoundaryCondition::Free && options.pins.empty() &&
         options.handles.empty();
}

Vec moved(Vec x, const Vector2& by) {
  for (Index k = 0; k < x.size(); k += 2) x.segment<2>(k) += by;
  return x;
}

// One degree after the other, from 1 (or, when asked, directly at the highest).
class Run {
 public:
  Run(const BezierMap& start, const ParametrizationOptions& options, RunRecord& record)
      : options_(options),
        record_(record),
        scale_(normalizing_scale(start.mesh())),
        origin_(needs_gauge(options) ? Vector2(start.control_points().head<2>())
                                     : Vector2(Vector2::Zero())),
        map_(start.shared_mesh(), start.shared_space(),
             moved(start.control_points(), -origin_) * scale_) {
    MapSpecification& map = setup_.map;
    map.rest = flat_triangles(start.mesh().positions() * scale_, start.mesh().faces());
    map.energy = options.energy;
    map.face_weight = options.face_weight;
    map.boundary = options.boundary;
    map.boundary_angles = options.boundary_angles;
    map.pins = place_pins(start.mesh(), options, start.control_points());
    map.handles = place_handles(start.mesh(), options.handles, map.pins, start.control_points());
    for (FixedPoint& p : map.pins) p.position *= scale_;
    for (FixedPoint& p : map.handles) p.position *= scale_;
    map.handle_weight = options.handle_weight;
    setup_.options = options;
  }

  ParametrizationResult solve() {
    const double started = record_.seconds();
    Vec unused;
    result_.initial_value = mean_density(map_, setup_.map.rest, options_.energy, unused);
    if (!std::isfinite(result_.initial_value)) enter_domain();
    SolveResult solved;
    for (;;) {
      const bool last = map_.degree() == options_.degree;
      if (last || options_.elevation == Elevation::Incremental) {
        DegreeSolver solver(setup_, map_.shared_space(), map_.control_points());
        solver.soften_start(record_);
        solved =
            last ? solver.finish(record_) : solver.approach(options_.elevation_tolerance, record_);
        map_ = BezierMap(map_.shared_mesh(), map_.shared_space(), solver.x());
        account(solver);
        if (limited(solved.status)) break;
      }
      if (last) break;
      map_ = map_.elevated();
    }
    result_.optimize_seconds = record_.seconds() - started;
    return conclude(solved);
  }

 private:
  // Energies that overflow at the start (exponentials of a Tutte map) begin where the symmetric
  // Dirichlet energy, finite on every injective map, has led at degree 1.
  void enter_domain() {
    DegreeSolver::Setup gentle = setup_;
    gentle.map.energy = {{symmetric_dirichlet(), 1.0}};
    gentle.options.curvature = Curvature::Projected;
    DegreeSolver solver(gentle, map_.shared_space(), map_.control_points());
    solver.soften_start(record_);
    solver.approach(options_.elevation_tolerance, record_);
    map_ = BezierMap(map_.shared_mesh(), map_.shared_space(), solver.x());
  }

  static bool limited(Status s) { return s != Status::Converged && s != Status::Stalled; }

  void account(const DegreeSolver& solver) {
    const std::vector<long> counts = solver.injectivity_depth_counts();
    if (result_.injectivity_tests.size() < counts.size())
      result_.injectivity_tests.resize(counts.size(), 0);
    for (std::size_t k = 0; k < counts.size(); ++k) result_.injectivity_tests[k] += counts[k];
    result_.variables = solver.variables();
    result_.constraint_residual = solver.constraint_residual() / scale_;
    result_.handle_distance = 0;
    for (const FixedPoint& h : setup_.map.handles)
      result_.handle_distance =
          std::max(result_.handle_distance,
                   (solver.x().segment<2>(2 * h.node) - h.position).norm() / scale_);
  }

  // A run that a limit ended below the degree asked for is elevated all the same: valid, and of
  // the promised degree.
  ParametrizationResult conclude(const SolveResult& solved) {
    while (map_.degree() < options_.degree) map_ = map_.elevated();
    result_.status = solved.status;
    result_.message = solved.message;
    result_.value_quadrature = solved.energy;
    result_.newton_decrement = solved.newton_decrement / std::abs(solved.energy);
    result_.map = BezierMap(map_.shared_mesh(), map_.shared_space(),
                            moved(map_.control_points() / scale_, origin_));
    const double started = record_.seconds();
    result_.measures = measure(*result_.map, options_.energy);
    result_.measure_seconds = record_.seconds() - started;
    if (!result_.measures.locally_injective) result_.status = Status::Failed;
    if (solved.status == Status::Failed && result_.measures.locally_injective)
      result_.status = Status::Stalled;
    return std::move(result_);
  }

  const ParametrizationOptions& options_;
  RunRecord& record_;
  double scale_;
  Vector2 origin_;  // model units; where the held vertex of a free map is, else 0
  BezierMap map_;   // normalised: (uv - origin) * scale
  DegreeSolver::Setup setup_;
  ParametrizationResult result_;
};

}  // namespace

Vec initial_map(const SurfaceMesh& mesh, const ParametrizationOptions& options) {
  mesh.require_disk();
  if (options.initial && options.initial->size() != 2 * mesh.vertex_count())
    throw Error(ErrorKind::Usage, mesh.file() + ": the initial map needs 2 numbers per vertex");
  return options.initial ? *options.initial : tutte_map(mesh);
}

ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options, RunRecord& record) {
  require_valid(options);
  require_face_weights(*mesh, options.face_weight);
  const double started = record.seconds();
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options));
  require_injective(start, "initial map");
  const double initialize_seconds = record.seconds() - started;
  ParametrizationResult result = Run(start, options, record).solve();
  result.initialize_seconds = initialize_seconds;
  return result;
}

ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options) {
  RunRecord record;
  return parametrize(std::move(mesh), options, record);
}

}  // namespace majorant
