#include "majorant/parametrization/atlas/internal/chart_solver.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/certify/proven_distance.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/initialization/area_margin.h"
#include "majorant/parametrization/initialization/strip_unfolding.h"
#include "majorant/parametrization/initialization/untangle.h"
#include "majorant/parametrization/solve/parametrize_by.h"

namespace majorant {
namespace {

// An upper bound on the rounding error of a chart that is moved and written to a file, relative to
// its size, in a layout that is thousands of times as large.
constexpr double kRounding = 0x1p-40;

bool has_proven_boundary(const BezierMap& map) {
  return check_boundary(map).result == ProofStatus::Proven;
}

BezierMap rounded(const BezierMap& map) {
  const Vec& x = map.control_points();
  const double unit = kRounding * power_of_two(x.cwiseAbs().maxCoeff());
  return map.with(map.shared_space(), Vec(unit * (x / unit).array().round()));
}

// Parts of the border are neighbours if the way between them along it is less than this multiple of
// their distance. The sides of a slit, which meet at its end at angles of 1e-5 or more, are
// neighbours.
constexpr double kNeighbours = 1e5;

// Returns whether the map's boundary is proven to be simple and stays so after rounding. False for
// two sides of a cut that coincide up to rounding, as in panels that fit into the plane, and for
// panels that touch others hinged elsewhere. clearance: the smallest distance of such parts.
bool has_boundary_margin(const BezierMap& map, double clearance) {
  if (!has_proven_boundary(map) || !has_proven_boundary(rounded(map))) return false;
  return border_clearance(map, {clearance, kNeighbours}) >= clearance;
}

// Returns whether every face keeps its orientation when the map is moved and written to a file. The
// corners of a curved triangle do not decide that, so it is tested with its control points.
bool survives_rounding(const BezierMap& map) {
  if (map.degree() > 1)
    return has_positive_determinants(map) && has_positive_determinants(rounded(map));
  return faces_without_area_margin(map.mesh().faces(), map.control_points()) == 0;
}

// An attempt far from any minimum ends after this many steps, in Phase::SoftStart or at a mean
// density of kFarDensity. Starts that converge get nearer within some dozens.
constexpr int kMaxFarSteps = 100;
constexpr double kFarDensity = 1e3;

}  // namespace

// An observer that ends attempts with too many steps far from any minimum, and forwards to another
// observer, if there is one.
class SlowStartLimit final : public RunObserver {
 public:
  SlowStartLimit(RunObserver* observer, double far_energy)
      : observer_(observer), far_energy_(far_energy) {}

  void start() { steps_ = 0; }
  bool is_reached() const { return steps_ > kMaxFarSteps; }

  void begin(Activity activity) override {
    if (observer_) observer_->begin(activity);
  }
  void announce(std::string_view part) override {
    if (observer_) observer_->announce(part);
  }
  void advance(double share) override {
    if (observer_) observer_->advance(share);
  }
  void begin_pass(int pass, int most) override {
    if (observer_) observer_->begin_pass(pass, most);
  }
  void after_part(std::string_view part, const std::vector<TraceEntry>& rows) override {
    if (observer_) observer_->after_part(part, rows);
  }
  Directive after_step(const TraceEntry& row, const Vec& y) override {
    steps_ += row.level == 0 && (row.phase == Phase::SoftStart || row.energy >= far_energy_);
    const Directive answer = observer_ ? observer_->after_step(row, y) : Directive::Continue;
    return answer == Directive::Continue && is_reached() ? Directive::Interrupt : answer;
  }

 private:
  RunObserver* observer_;
  double far_energy_;
  int steps_ = 0;
};

namespace {

// Returns kFarDensity in the units of this energy.
double far_energy(const MapOptions& options) {
  double weight = 0;
  for (const WeightedEnergy& energy : options.energy)
    weight += energy.weight * (energy.face_weight.size() > 0 ? energy.face_weight.maxCoeff() : 1);
  if (options.face_weight.size() > 0) weight *= options.face_weight.maxCoeff();
  return kFarDensity * std::max(weight, 1.0);
}

// Tutte's map is compared with a projection if its mean of (Gamma^2 + gamma^2) / 2 (Stretch)
// exceeds this; below, any start converges.
constexpr double kFarFromMinimum = 100;
// Lower bound on the cosine of the angle between a face's normal and the direction of projection.
// Faces seen from the side become a thousandth as wide.
constexpr double kMinProjectedCosine = 1e-3;

double mean_stretch(const BezierMap& map) {
  const Stretch stretch = measure_stretch(map);
  return stretch.square / stretch.surface_area;
}

// Returns the normal of a face; its length is twice the face's area.
Vector3 normal_of(const SurfaceMesh& mesh, Index face) {
  const auto corner = [&](Index k) -> Vector3 {
    return mesh.positions().row(mesh.faces()(face, k)).transpose();
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

// Returns u, v per vertex of the chart projected along the mean of its normals, if every face has
// its upper side there.
std::optional<Vec> projected(const SurfaceMesh& mesh) {
  Vector3 mean = Vector3::Zero();
  for (Index f = 0; f < mesh.face_count(); ++f) mean += normal_of(mesh, f);
  const Vector3 up = mean.stableNormalized();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vector3 normal = normal_of(mesh, f);
    if (!(normal.dot(up) > kMinProjectedCosine * normal.norm())) return std::nullopt;
  }
  const Vector3 right = up.unitOrthogonal(), back = up.cross(right);
  Vec uv(2 * mesh.vertex_count());
  const Vector3 first = mesh.positions().row(0).transpose();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.positions().row(v).transpose() - first;
    uv.segment<2>(2 * v) << right.dot(p), back.dot(p);
  }
  if (faces_without_area_margin(mesh.faces(), uv) > 0) return std::nullopt;
  return uv;
}

// From this many faces on a cut chart starts from a multiresolution map instead of its parent's
// map. A slit in the parent's map is a tenth of an edge wide at first and opens by a constant
// factor a step, so large charts need many steps. If the multiresolution start, which is nearly the
// minimum, overlaps itself, so does the minimum, and the solve is skipped.
constexpr Index kAnewFaces = 50000;

bool starts_anew(const SurfaceMesh& mesh, const MapOptions& options) {
  return mesh.face_count() >= kAnewFaces && mesh.rest_triangles().empty() && options.pins.empty() &&
         options.handles.empty();
}

Status status_of(Directive why) {
  return why == Directive::Interrupt ? Status::Interrupted : Status::TimeLimit;
}

// Returns u, v per vertex, from any of its corners; these agree in a chart.
Vec vertex_coordinates(const SurfaceMesh& mesh) {
  Vec uv(2 * mesh.vertex_count());
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k)
      uv.segment<2>(2 * mesh.faces()(f, k)) = mesh.corner_texcoords().row(f).segment<2>(2 * k);
  return uv;
}

double image_area(const SurfaceMesh& mesh, const Vec& uv) {
  const auto corner = [&](Index f, Index k) {
    return Vector2(uv.segment<2>(2 * mesh.faces()(f, k)));
  };
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    sum += 0.5 * cross(Vector2(corner(f, 1) - corner(f, 0)), Vector2(corner(f, 2) - corner(f, 0)));
  return sum;
}

bool is_positive(const SurfaceMesh& mesh, const Vec& uv) {
  const auto corner = [&](Index f, Index k) {
    return Vector2(uv.segment<2>(2 * mesh.faces()(f, k)));
  };
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (orientation(corner(f, 0), corner(f, 1), corner(f, 2)) <= 0) return false;
  return true;
}

// A slit opens first by this fraction of the shortest edge at a vertex; the step is halved at most
// kMaxSlitHalvings times if faces turn over or sides meet.
constexpr double kSlitStep = 0.1;
constexpr int kMaxSlitHalvings = 6;

// Returns for each vertex of the boundary the bisector of the angle of its faces, as long as the
// shortest edge there; 0 for the others (#V). All faces are positive.
Vec inwards(const SurfaceMesh& mesh, const Vec& uv) {
  const auto along = [&](Index h) {
    return Vector2(uv.segment<2>(2 * mesh.to_vertex(h)) - uv.segment<2>(2 * mesh.from_vertex(h)));
  };
  Vec direction = Vec::Zero(uv.size());
  for (Index first = 0; first < mesh.half_edge_count(); ++first) {
    if (mesh.opposite(first) >= 0) continue;
    // The faces around the vertex are visited counterclockwise, from this half-edge to the other
    // boundary edge.
    double angle = 0, shortest = along(first).norm();
    for (Index h = first; h >= 0; h = mesh.opposite(previous(h))) {
      const Vector2 a = along(h), b = -along(previous(h));
      angle += std::atan2(cross(a, b), a.dot(b));
      shortest = std::min(shortest, b.norm());
    }
    const Vector2 a = along(first).normalized();
    const double half = 0.5 * angle;
    direction.segment<2>(2 * mesh.from_vertex(first)) =
        shortest * Vector2(std::cos(half) * a.x() - std::sin(half) * a.y(),
                           std::sin(half) * a.x() + std::cos(half) * a.y());
  }
  return direction;
}

// Returns flags of the vertices that share their place with another one (#V).
std::vector<char> shares_place(const Vec& uv) {
  std::vector<Index> order(static_cast<std::size_t>(uv.size() / 2));
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](Index v) { return std::pair(uv[2 * v], uv[2 * v + 1]); };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return place(a) < place(b); });
  std::vector<char> shares(order.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (place(order[k - 1]) == place(order[k])) shares[order[k - 1]] = shares[order[k]] = 1;
  return shares;
}

// Returns the map with open slits along the last cuts of the chart, whose two sides coincide in the
// parent's map. None if the result overlaps itself.
std::optional<Vec> with_open_slits(const std::shared_ptr<const SurfaceMesh>& mesh, const Vec& uv) {
  if (!is_positive(*mesh, uv)) return std::nullopt;
  const std::vector<char> is_moved = shares_place(uv);
  Vec step = kSlitStep * inwards(*mesh, uv);
  for (std::size_t v = 0; v < is_moved.size(); ++v)
    if (!is_moved[v]) step.segment<2>(2 * static_cast<Index>(v)).setZero();
  for (int k = 0; k <= kMaxSlitHalvings; ++k, step *= 0.5) {
    Vec open = uv + step;
    if (faces_without_area_margin(mesh->faces(), open) == 0 &&
        has_boundary_margin(BezierMap::linear(mesh, open), 0))
      return open;
  }
  return std::nullopt;
}

}  // namespace

ChartSolver::ChartSolver(std::shared_ptr<const SurfaceMesh> mesh,
                         const ParametrizationOptions& options, ChartHints hints)
    : mesh_(std::move(mesh)), options_(options), hints_(std::move(hints)) {}

Chart ChartSolver::solve(RunRecord& given) {
  SlowStartLimit limit(given.observer(), far_energy(options_.map));
  std::optional<RunRecord> limited;
  if (hints_.slow == SlowStart::LeftToCuts) {
    limit_ = &limit;
    limited = given.part(&limit, [&](double share) { given.telling_start({}).advance(share); });
  }
  RunRecord& record = limited ? *limited : given;
  try {
    return solve_within_limits(record);
  } catch (const Stopped& stop) {
    Chart chart;
    chart.status = stopped_status(stop.why());
    chart.trace = record.trace();
    return chart;
  }
}

Chart ChartSolver::solve_within_limits(RunRecord& record) {
  chart_.pins = options_.map.pins;
  if (hints_.texture == TextureStart::Tried) try_texture(record);
  const bool is_left = !is_done_ && hints_.overlaps == UnfoldedOverlaps::LeftToCuts &&
                       overlaps_unfolded() && record.directive() == Directive::Continue;
  const auto has_start = [&] { return !is_done_ && !is_left; };
  if (has_start() && hints_.shape == ChartShape::Unfolds) try_unfolded(record);
  const bool is_cut_since = hints_.parent.size() > 0;
  const bool is_slit = hints_.parent_map == ParentMap::Slit;
  if (has_start() && is_cut_since && !(is_slit && starts_anew(*mesh_, options_.map)))
    try_parent(record);
  if (has_start()) try_tutte(record);
  if (!is_done_) keep_start(record);
  if (is_left) {
    chart_.status = Status::Failed;
    chart_.message = "its unfolded faces touch or overlap";
  }
  to_area_of_surface();
  chart_.stretch = measure_stretch(*chart_.map);
  chart_.trace = record.trace();
  return std::move(chart_);
}

void ChartSolver::try_texture(RunRecord& record) {
  chart_.start = ChartStart::Anew;
  const std::optional<PreparedTexture> prepared = texture_start(mesh_, record);
  if (!prepared) return;
  if (attempt(prepared->uv, MapInjectivity::Local, record) ||
      (has_proven_boundary(BezierMap::linear(mesh_, prepared->uv)) &&
       attempt(prepared->uv, MapInjectivity::Global, record)))
    chart_.start = prepared->start;
}

// If the minimum overlaps itself, every start leads to it; the parent's map is the nearest one
// without overlaps.
void ChartSolver::try_parent(RunRecord& record) {
  is_overlapping_ = false;
  bool has_map = attempt(hints_.parent, MapInjectivity::Local, record);
  if (!has_map && is_overlapping_) {
    const std::optional<Vec> open = with_open_slits(mesh_, hints_.parent);
    has_map = open && attempt(*open, MapInjectivity::Global, record);
  }
  if (has_map) name_start(ChartStart::Parent);
}

void ChartSolver::try_tutte(RunRecord& record) {
  is_overlapping_ = false;
  if (try_many_resolutions(MapInjectivity::Local, record)) return;
  std::optional<Vec> seen;
  if (!is_overlapping_) seen = projection(record);
  if (seen && attempt(*seen, MapInjectivity::Local, record))
    return name_start(ChartStart::Projected);
  // If the minimum overlaps itself, Tutte's map leads to it too.
  if (!is_overlapping_ && attempt(tutte(record), MapInjectivity::Local, record)) return;
  if (try_unfolded(record) || try_many_resolutions(MapInjectivity::Global, record)) return;
  if (seen && has_boundary_margin(BezierMap::linear(mesh_, *seen), 0) &&
      attempt(*seen, MapInjectivity::Global, record))
    return name_start(ChartStart::Projected);
  attempt(tutte(record), MapInjectivity::Global, record);
}

// Returns the chart projected along one direction, if that is nearer to the minimum than Tutte's
// map and the latter is far from it.
std::optional<Vec> ChartSolver::projection(const RunRecord& record) {
  if (record.directive() != Directive::Continue || !mesh_->rest_triangles().empty() ||
      !options_.map.pins.empty())
    return std::nullopt;
  std::optional<Vec> seen = projected(*mesh_);
  if (!seen) return seen;
  const Vec& other = tutte(record);
  if (faces_without_area_margin(mesh_->faces(), other) > 0) return seen;
  const double mean = mean_stretch(BezierMap::linear(mesh_, other));
  const bool is_far = !(mean < kFarFromMinimum);
  if (!is_far || mean_stretch(BezierMap::linear(mesh_, *seen)) >= mean) seen.reset();
  return seen;
}

// Does nothing if the multiresolution map would be Tutte's map.
bool ChartSolver::try_many_resolutions(MapInjectivity injectivity, RunRecord& record) {
  if (record.directive() != Directive::Continue || !mesh_->rest_triangles().empty()) return false;
  MapOptions options = options_.map;
  options.injectivity = injectivity;
  options.initial.reset();
  StartMethod taken = StartMethod::Tutte;
  try {
    const Vec start = initial_map(*mesh_, options, record, &taken);
    if (taken != StartMethod::Multiresolution) {
      tutte_ = start;
      return false;
    }
    if (injectivity == MapInjectivity::Local && starts_anew(*mesh_, options_.map) &&
        !has_proven_boundary(BezierMap::linear(mesh_, start))) {
      is_overlapping_ = true;
      return false;
    }
    if (!attempt(start, injectivity, record)) return false;
  } catch (const Stopped&) {
    return false;
  }
  name_start(ChartStart::Multiresolution);
  return true;
}

bool ChartSolver::overlaps_unfolded() const {
  const Vec start = unfolded(*mesh_);
  return faces_without_area_margin(mesh_->faces(), start) == 0 &&
         !has_boundary_margin(BezierMap::linear(mesh_, start), hints_.clearance);
}

// Starts from the unfolded faces. Tutte's map of a strip that is much longer than wide is so far
// from its minimum that it winds over itself on the way, while an unfolded strip is nearly optimal.
bool ChartSolver::try_unfolded(RunRecord& record) {
  const Vec start = unfolded(*mesh_);
  if (faces_without_area_margin(mesh_->faces(), start) > 0 ||
      !has_boundary_margin(BezierMap::linear(mesh_, start), hints_.clearance))
    return false;
  if (!attempt(start, MapInjectivity::Local, record) &&
      !attempt(start, MapInjectivity::Global, record))
    return false;
  name_start(ChartStart::Unfolded);
  return true;
}

// Computes the map even after the time limit, for as long as starts may take. The map of a single
// face without an area is the triangle that stands for it. Throws Stopped.
const Vec& ChartSolver::tutte(const RunRecord& record) {
  const auto& rest = mesh_->rest_triangles();
  if (!tutte_ && mesh_->face_count() == 1 && !rest.empty()) {
    tutte_.emplace(6);
    for (Index k = 0; k < 3; ++k)
      tutte_->segment<2>(2 * mesh_->faces()(0, k)) = rest.front().corners[k];
  }
  MapOptions options;
  options.start = StartMethod::Tutte;
  if (!tutte_) tutte_ = initial_map(*mesh_, options, record.start_stop());
  return *tutte_;
}

// Returns whether the attempt ends with an injective map, which then is the chart's.
bool ChartSolver::attempt(const Vec& start, MapInjectivity injectivity, RunRecord& record) {
  if (record.directive() != Directive::Continue) return false;
  // The observer shows the steps of each attempt apart from those before.
  if (record.observer() && !record.trace().empty()) record.observer()->begin(Activity::Solving);
  ParametrizationOptions options = options_;
  options.map.injectivity = injectivity;
  options.map.initial.reset();
  ParametrizationResult result;
  if (limit_) limit_->start();
  try {
    SolverRules rules;
    rules.scaffold.from_the_start = true;  // a free map has overlapped
    result = parametrize_by(rules, BezierMap::linear(mesh_, start), options, record);
  } catch (const Stopped&) {
    return false;
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::Infeasible || !chart_.pins.empty()) throw;
    chart_.message = problem_of(e);
    return false;
  }
  const bool has_map = result.map && result.status != Status::Failed;
  const double clearance = injectivity == MapInjectivity::Local ? hints_.clearance : 0;
  const bool is_apart = has_map && has_boundary_margin(*result.map, clearance);
  is_overlapping_ = result.status == Status::Converged && !is_apart;
  if (!is_apart || !survives_rounding(*result.map)) {
    chart_.message = result.message;
    return false;
  }
  chart_.map = std::move(result.map);
  chart_.status = result.status;
  chart_.message = result.message;
  if (limit_ && limit_->is_reached() && record.directive() == Directive::Continue) {
    chart_.status = Status::Stalled;
    chart_.message = "the solve makes no progress from its start";
  }
  chart_.measures = std::move(result.measures);
  return is_done_ = true;
}

void ChartSolver::keep_start(const RunRecord& record) {
  if (!chart_.pins.empty()) record.start_stop().poll();  // starts that were not tried may meet them
  if (!chart_.pins.empty())
    throw Error(ErrorKind::Infeasible,
                message_prefix(*mesh_) + "no map without overlaps that meets the pins was found");
  BezierMap map = BezierMap::linear(mesh_, tutte(record));
  while (map.degree() < options_.map.degree) map = map.elevated();
  chart_.measures = measure_map(map, options_.map.energy, record.stop());
  const Directive why = record.directive();
  chart_.status = why == Directive::Continue ? Status::Stalled : status_of(why);
  if (!chart_.measures.locally_injective || !has_proven_boundary(map)) {
    chart_.status = Status::Failed;
    chart_.message = "no injective map of the chart was found";
  }
  chart_.map = std::move(map);
}

// Names the start. A chart that was to start from the file's coordinates stays Anew.
void ChartSolver::name_start(ChartStart start) {
  if (chart_.start == ChartStart::Tutte) chart_.start = start;
}

// Scales the chart to the area of the surface where the energy does not determine its size.
void ChartSolver::to_area_of_surface() {
  if (free_scale_of(options_.map.energy) != FreeScale::Arbitrary || !chart_.pins.empty()) return;
  const Stretch stretch = measure_stretch(*chart_.map);
  const double scale = std::sqrt(stretch.surface_area / stretch.image_area);
  BezierMap scaled =
      chart_.map->with(chart_.map->shared_space(), Vec(scale * chart_.map->control_points()));
  MapMeasures measures = measure_map(scaled, options_.map.energy);
  if (!measures.locally_injective || !has_proven_boundary(scaled)) return;
  chart_.map = std::move(scaled);
  chart_.measures = std::move(measures);
}

std::optional<PreparedTexture> texture_start(const std::shared_ptr<const SurfaceMesh>& mesh,
                                             const RunRecord& record) {
  if (untextured_polygons(*mesh) > 0) return std::nullopt;
  Vec uv = vertex_coordinates(*mesh);
  const double area = image_area(*mesh, uv);
  if (area < 0)
    for (Index v = 0; v < mesh->vertex_count(); ++v) uv[2 * v] = -uv[2 * v];
  const double scale = std::sqrt(mesh->area() / std::abs(area));
  if (!std::isfinite(scale) || !(scale > 0)) return std::nullopt;
  uv *= scale;
  if (!uv.allFinite()) return std::nullopt;
  if (is_positive(*mesh, uv)) return PreparedTexture{std::move(uv), ChartStart::Texture};
  const BezierMap map = BezierMap::linear(mesh, uv);
  MapSpecification spec;
  spec.rest = std::make_shared<const RestShapes>(rest_shapes(*mesh));
  UntangleResult untangled = untangle(spec, map.shared_space(), uv, record);
  if (!untangled.inverted.empty() || !is_positive(*mesh, untangled.x)) return std::nullopt;
  return PreparedTexture{std::move(untangled.x), ChartStart::Untangled};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
