#include "majorant/apps/jobs/map_job.h"

#include <optional>
#include <utility>

#include "majorant/apps/jobs/global_verdict.h"
#include "majorant/apps/jobs/input_points.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/certify/cut_map.h"
#include "majorant/framework/error.h"
#include "majorant/io/io.h"
#include "majorant/mesh/plane_side.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {
namespace {

// Adds its lifetime to the job's initialization time.
class Timed {
 public:
  explicit Timed(MapJob& job) : job_(job), before_(job.record.seconds()) {
    job.record.begin(Activity::Starting);
  }
  ~Timed() { job_.start_seconds = job_.record.seconds() - before_; }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  MapJob& job_;
  double before_;
};

Json aligned_section(const MapJob& job) {
  if (!job.placement || !job.is_aligned) return nullptr;
  const Vector2& direction = job.placement->direction;
  return {{"direction", {direction.x(), direction.y()}}};
}

Json normalized_section(const MapJob& job) {
  if (!job.placement || !job.is_normalized) return nullptr;
  const LayoutMotion& p = *job.placement;
  return {{"origin", {p.origin.x(), p.origin.y()}}, {"size", p.size}};
}

// Returns the name of the start for reports: the given start, else the one that parametrize()
// chose.
std::string_view start_taken(const MapJob& job) {
  if (job.result.start != StartMethod::Given) return start_name(job.result.start);
  // A map with seams from texture coordinates starts there without being told so.
  return job.init == start_name(StartMethod::Automatic) ? start_name(StartMethod::Given)
                                                        : std::string_view(job.init);
}

std::string claims(const MapJob& job, const MapFile& file) {
  const BezierMap& map = *job.result.map;
  Json pins = Json::array();
  for (const Pin& pin : job.options.map.pins) {
    const Vector2 uv = map.control_points().segment<2>(2 * pin.vertex);
    pins.push_back({{"vertex", map.mesh().input_vertex(pin.vertex)}, {"target", {uv.x(), uv.y()}}});
  }
  Json claims{{"version", MAJORANT_VERSION},
              {"degree", job.options.map.degree},
              {"energy", job.energy},
              {"value", job.result.measures.value},
              {"boundary", job.options.map.boundary == BoundaryCondition::Fixed ? "fixed" : "free"},
              {"init", start_taken(job)},
              {"seams", !map.seams().trivial()},
              {"bijective", job.options.map.injectivity == MapInjectivity::Global},
              {"aligned", aligned_section(job)},
              {"normalized", normalized_section(job)},
              {"layout_scale", 1 / scale_of(job)},
              {"pins", pins},
              {"other_triangles", job.result.other_triangles},
              {"cuts", unshared_edges(file, job.polygons->file)},
              {"options", job.options_json}};
  if (job.result.measures.cut_short) claims.erase("value");  // too inaccurate to be claimed
  if (job.energy.empty()) {                                  // the file cannot name the energy
    claims.erase("energy");
    claims.erase("value");
  }
  if (!map.seams().trivial()) claims["cones"] = cones_section(map);
  return json_text(without_folders(std::move(claims)));
}

Json result_section(const MapJob& job) {
  const ParametrizationResult& r = job.result;
  if (!r.map) return nullptr;
  Json result = measures_section(*r.map, r.measures, job.energy);
  if (!r.measures.cut_short)
    result["distortion"] = distortion_section({&r.measures.distortion}, scale_of(job));
  add_global_injectivity(result, *r.map, r.measures, job.boundary);
  result["layout_scale"] = 1 / scale_of(job);
  result["start"] = start_taken(job);
  result["variables"] = r.variables;
  result["initial_value"] = r.initial_value;
  result["value_quadrature"] = r.value_quadrature;
  result["newton_decrement"] = r.newton_decrement;
  result["constraint_residual"] = r.constraint_residual;
  result["handle_distance"] = r.handle_distance;
  result["factor_solve_seconds"] = r.factor_solve_seconds ? Json(*r.factor_solve_seconds) : Json();
  if (job.cuts) result.update(cuts_section(*job.cuts, job.mesh->area()));
  return result;
}

Json seam_start_section(const Start& start) {
  const Seams& seams = start.map.seams();
  return {{"residual", start.residual},    {"moved", start.moved},
          {"inverted", start.inverted},    {"untangling_steps", start.untangling_steps},
          {"chains", seams.chain_count()}, {"seam_edges", seams.edges().size()}};
}

}  // namespace

std::string_view task_name(MapTask task) {
  constexpr std::string_view kNames[] = {"parametrize", "seamless", "deform"};
  return kNames[static_cast<std::size_t>(task)];
}

SeamlessMethod method_called(std::string_view name) {
  for (const SeamlessMethod m :
       {SeamlessMethod::Field, SeamlessMethod::ScaledField, SeamlessMethod::Conformal})
    if (method_name(m) == name) return m;
  return SeamlessMethod::Automatic;
}

void MapJob::open(std::shared_ptr<const PolygonMesh> input) {
  polygons = std::move(input);
  if (task == MapTask::Deform)
    if (std::optional<PolygonMesh> turned = turned_counterclockwise(*polygons)) {
      turned->warnings.push_back(polygons->file + (polygons->file.empty() ? "" : ": ") +
                                 "all faces are clockwise in the plane; they are turned over, "
                                 "since results are counterclockwise");
      polygons = std::make_shared<const PolygonMesh>(*std::move(turned));
    }
  record.announce("building the surface");
  mesh = std::make_shared<const SurfaceMesh>(
      SurfaceMesh::from_polygons(*polygons, record.start_stop()));
}

void MapJob::start_from_texture() {
  start = seamless_from_texture(*mesh);
  init = start_name(StartMethod::Given);
}

void MapJob::start_seamless(SeamlessOptions settings, const std::string& source) {
  const Timed timed(*this);
  if (settings.cones)
    for (Cone& cone : *settings.cones) cone.vertex = used_vertex(source, *mesh, cone.vertex);
  start = make_seamless(*mesh, settings, record);
  init = method_name(start->method);
}

void MapJob::start_in_plane() {
  const Timed timed(*this);
  start = Start{planar_map(mesh)};
  init = "planar";
}

void MapJob::start_cut(const CutOptions& settings,
                       const std::function<std::string(Index pieces)>& refusal) {
  const Timed timed(*this);
  cuts = choose_cuts(*mesh, settings, record.start_stop());
  const auto opened = std::make_shared<const SurfaceMesh>(mesh->cut_along(cuts->is_cut, nullptr));
  if (const Index pieces = opened->topology().components; pieces > 1)
    throw Error(ErrorKind::Unsupported, refusal(pieces));
  MapOptions plain;
  plain.start = StartMethod::Tutte;
  start = Start{BezierMap::linear(opened, initial_map(*opened, plain, record.start_stop()))};
}

const SurfaceMesh& MapJob::mapped_mesh() const {
  if (!start) mesh->require_planar();
  return start ? start->map.mesh() : *mesh;
}

void MapJob::take_snapshots(int every) {
  film.emplace(every, options.map.degree);
  options.solve.watch = film->watcher();
}

void MapJob::solve() {
  if (!start)
    result = parametrize(mesh, options, record);
  else if (task == MapTask::Deform)
    result = deform(start->map, options, record);
  else
    result = parametrize(start->map, options, record);
  if (cuts) result.start = StartMethod::Tutte;
  result.initialize_seconds += start_seconds;
}

bool MapJob::place(Turned turn, LayoutSize size) {
  const bool into_square = size == LayoutSize::UnitSquare;
  record.begin(Activity::Measuring);
  const Vector2 along = turn == Turned::Held ? Vector2(1, 0) : layout_direction(*result.map);
  const EnergySum& measured = options.map.energy;
  auto placed = into_square ? into_unit_square(*result.map, along, measured, record.stop())
                            : turned_along(*result.map, along, measured, record.stop());
  if (!placed && into_square && turn == Turned::Free) {
    placed = into_unit_square(*result.map, {1, 0}, measured, record.stop());
    is_left_unturned = placed.has_value();
  }
  if (!placed) {
    result.status = Status::Failed;
    result.message = std::string(into_square ? "in the unit square" : "turned") +
                     " its smallest triangles are too small for doubles";
    return false;
  }
  result.map = std::move(placed->map);
  result.boundary.reset();  // belongs to the map before the motion
  result.measures = std::move(placed->measures);
  placement = placed->placement;
  is_aligned = turn == Turned::Required || placement->direction != Vector2(1, 0);
  is_normalized = into_square;
  return true;
}

void MapJob::prove() {
  if (!result.map) return;
  if (result.boundary) {
    boundary = *result.boundary;
    return;
  }
  record.begin(Activity::Proving);
  boundary = check_boundary(*result.map);
}

bool MapJob::has_result() const {
  return result.map && result.status != Status::Failed && result.status != Status::Infeasible;
}

double scale_of(const MapJob& job) { return job.placement ? job.placement->size : 1; }

ProofRequest proof_request(const MapJob& job, const std::string& path) {
  ProofRequest request;
  request.surface = job.polygons.get();
  if (!job.result.map->seams().trivial()) request.cuts = CutRule::Seams;
  if (job.cuts) request.cuts = CutRule::Free;
  if (job.options.map.injectivity == MapInjectivity::Global)
    request.overlap = ProofRequest::Overlap::Forbidden;
  request.labels = labels_in(path);
  return request;
}

MapFile map_file(const MapJob& job) {
  MapFile file = to_map_file(*job.result.map);
  // Readers can only measure an energy with a name.
  if (!job.result.measures.cut_short && !job.energy.empty())
    file.distortion = job.result.measures.face_value;
  file.min_det = job.result.measures.min_det;
  file.face_distortion = finite_or_none(job.result.measures.distortion.faces);
  file.claims = claims(job, file);
  return file;
}

RunReport map_report(const MapJob& job) {
  const ParametrizationResult& r = job.result;
  RunReport report{.command = std::string(task_name(job.task)),
                   .status = std::string(status_name(r.status)),
                   .message = r.message,
                   .input = input_section(*job.polygons, *job.mesh),
                   .options = job.options_json,
                   .result = result_section(job),
                   .warnings = job.polygons->warnings,
                   .seconds = {{"read", job.read_seconds},
                               {"initialize", r.initialize_seconds},
                               {"optimize", r.optimize_seconds},
                               {"scaffold", r.scaffold_seconds},
                               {"measure", r.measure_seconds}}};
  report.more = {{"iterations", iterations_section(job.record.trace())},
                 {"injectivity_tests", {{"depth", r.injectivity_tests}}},
                 {"remedies", remedies_section(r.remedies)},
                 {"flips", {{"intended", r.flips.intended}, {"performed", r.flips.performed}}}};
  add_solver(report, job.linear_solver, job.memory);
  if (job.start && !job.start->map.seams().trivial())
    report.more["seam_start"] = seam_start_section(*job.start);
  if (job.film)
    report.more["snapshots"] = {{"every", job.film->every()},
                                {"frames", job.film->count(last_iteration(job.record.trace()))}};
  return report;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
