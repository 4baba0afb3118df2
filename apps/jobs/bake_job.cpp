#include "majorant/apps/jobs/bake_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "majorant/certify/cut_map.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/layout_scale.h"
#include "majorant/maps/distortion.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/repair.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant {
namespace {

using CornerNormals = Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>;

bool has_texcoords(const PolygonMesh& polygons) {
  return !polygons.polygon_texcoords.indices().empty();
}

BakeSurface with_layout(const MapFile& file, std::string name) {
  BakeSurface surface;
  const CutMap cut(file, name);
  surface.layout = cut.map_cut_along(cut.cuts());
  surface.mesh = surface.layout->shared_mesh();
  surface.scale = layout_scale(file);
  surface.file = std::move(name);
  return surface;
}

bool holds_map(const std::string& path) {
  const std::string format = format_of(path);
  return format == ".vtu" || format == ".pvtu" || format == ".msh";
}

Points3 input_positions(const SurfaceMesh& mesh) {
  return mesh.positions().rowwise() + mesh.origin().transpose();
}

// The file's normals at the corners of the faces; those of flat faces where it has none.
CornerNormals corner_normals(const SurfaceMesh& mesh, const PolygonMesh& polygons) {
  CornerNormals normals(mesh.face_count(), 9);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto p = [&](Index k) -> Vector3 { return mesh.positions().row(mesh.faces()(f, k)); };
    const Vector3 flat = (p(1) - p(0)).cross(p(2) - p(0)).stableNormalized();
    const auto polygon = to_size(mesh.input_face(f));
    const auto& of_polygon = polygons.polygon_normals[polygon];
    const auto& vertices = polygons.polygons[polygon];
    for (Index k = 0; k < 3; ++k) {
      const auto corner =
          std::find(vertices.begin(), vertices.end(), mesh.input_vertex(mesh.faces()(f, k)));
      const bool is_known = corner != vertices.end() && !of_polygon.empty();
      normals.row(f).segment<3>(3 * k) =
          is_known
              ? Vector3(polygons
                            .normals[to_size(
                                of_polygon[to_size(static_cast<Index>(corner - vertices.begin()))])]
                            .stableNormalized())
              : flat;
    }
  }
  return normals;
}

// How many polygons and vertices the file has, as far as its surface tells.
std::pair<Index, Index> file_counts(const BakeSurface& surface) {
  if (!surface.polygons.polygons.empty())
    return {static_cast<Index>(surface.polygons.polygons.size()),
            static_cast<Index>(surface.polygons.positions.size())};
  Index faces = 0, vertices = 0;
  for (Index f = 0; f < surface.mesh->face_count(); ++f)
    faces = std::max(faces, surface.mesh->input_face(f) + 1);
  for (Index v = 0; v < surface.mesh->vertex_count(); ++v)
    vertices = std::max(vertices, surface.mesh->input_vertex(v) + 1);
  return {faces, vertices};
}

SurfaceValues table_values(const std::string& path, const BakeSurface& carrier,
                           const StopCheck& stop) {
  const RowMatrix table = read_npy_rows(path, stop);
  const auto [faces, vertices] = file_counts(carrier);
  const SurfaceMesh& mesh = *carrier.mesh;
  const bool is_of_faces = table.rows() == faces;
  if (is_of_faces == (table.rows() == vertices))
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: has {} rows; {} has {} faces and {} vertices, one of which they "
                            "must be",
                            path, table.rows(), carrier.file, faces, vertices));
  RowMatrix rows(is_of_faces ? mesh.face_count() : mesh.vertex_count(), table.cols());
  for (Index i = 0; i < rows.rows(); ++i)
    rows.row(i) = table.row(is_of_faces ? mesh.input_face(i) : mesh.input_vertex(i));
  return is_of_faces ? table_of_faces(std::move(rows)) : table_of_vertices(mesh, std::move(rows));
}

std::vector<std::string> numbered(int count) {
  std::vector<std::string> names;
  for (int c = 0; c < count; ++c) names.push_back(fmt::format("c{}", c));
  return names;
}

const BezierMap& layout_of(const BakeSurface& carrier, const char* what) {
  if (!carrier.layout)
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: has no texture coordinates, and {} is of its layout", carrier.file, what));
  return *carrier.layout;
}

// Of several images, grey and with alpha or not, colours; of one its own channels.
SurfaceValues values_of_images(const BakeJob& job) {
  const BezierMap& layout = layout_of(job.carrier, "an image");
  std::vector<SurfaceValues> each;
  int channels = 3;
  for (const Raster& image : job.images) {
    each.push_back(texture_values(layout, image, job.image_transfer, job.filter));
    if (each.back().channels % 2 == 0) channels = 4;
  }
  if (each.size() == 1) return each.front();
  const Course course = each.front().course;
  const Transfer seen = each.front().seen;
  const SurfaceMesh& mesh = *job.carrier.mesh;
  return {channels,
          [each = std::move(each), of = job.image_of_polygon, channels, &mesh](
              const SurfacePlace& place, float* value) {
            const SurfaceValues& own = each[to_size(of[to_size(mesh.input_face(place.face))])];
            std::array<float, 4> found{};
            own.at(place, found.data());
            const bool is_grey = own.channels < 3, has_alpha = own.channels % 2 == 0;
            for (std::size_t c = 0; c < 3; ++c) value[c] = found[is_grey ? 0 : c];
            if (channels == 4) value[3] = has_alpha ? found[to_size(own.channels - 1)] : 1.0F;
          },
          0, course, seen};
}

// What the carrier is asked for, and the names of its channels.
SurfaceValues values_of(const BakeJob& job, std::vector<std::string>& channels,
                        const StopCheck& stop) {
  const SurfaceMesh& mesh = *job.carrier.mesh;
  if (!job.images.empty()) {
    channels.clear();
    return values_of_images(job);
  }
  if (job.attribute == "position") {
    channels = {"x", "y", "z"};
    return position_values(mesh);
  }
  if (job.attribute == "normal") {
    channels = {"x", "y", "z"};
    return job.carrier.polygons.polygon_normals.empty()
               ? normal_values(mesh)
               : normal_values(corner_normals(mesh, job.carrier.polygons));
  }
  if (job.attribute == "face") {
    channels = {"face"};
    return face_values(mesh);
  }
  if (job.attribute == "distortion") {
    channels.assign(kFaceDistortionNames.begin(), kFaceDistortionNames.end());
    return table_of_faces(
        measure_distortion(layout_of(job.carrier, "distortion"), job.carrier.scale).faces);
  }
  SurfaceValues values = table_values(job.attribute, job.carrier, stop);
  channels = numbered(values.channels);
  return values;
}

// The time that searches for nearest points take, of which every kPeriod-th is measured.
class TimedPlaces {
 public:
  explicit TimedPlaces(PlaceOf places) : places_(std::move(places)) {}

  PlaceOf places() {
    return [this](const SurfacePlace& of, Index likely) {
      thread_local unsigned calls = 0;
      if (++calls % kPeriod != 0) return places_(of, likely);
      Stopwatch watch;
      std::optional<SurfacePlace> found = places_(of, likely);
      nanoseconds_.fetch_add(std::llround(1e9 * watch.restart()), std::memory_order_relaxed);
      return found;
    };
  }
  // Seconds of all searches together, of the processor.
  double seconds() const { return 1e-9 * kPeriod * static_cast<double>(nanoseconds_.load()); }

 private:
  static constexpr unsigned kPeriod = 16;

  PlaceOf places_;
  std::atomic<long long> nanoseconds_{0};
};

}  // namespace

std::string_view method_name(BakeMethod method) {
  constexpr std::array<std::string_view, 3> kNames{"auto", "same", "nearest"};
  return kNames[static_cast<std::size_t>(method)];
}

BakeSurface bake_surface(PolygonMesh polygons, Texcoords texcoords, const StopCheck& stop) {
  BakeSurface surface;
  const bool is_textured = has_texcoords(polygons);
  if (texcoords == Texcoords::Needed && !is_textured)
    throw Refusal(ErrorKind::Unsupported, polygons.file,
                  polygons.file + ": has no texture coordinates to bake into; ", Hint::Unwrap);
  if (is_textured) {
    surface = with_layout(to_map_file(polygons), polygons.file);
  } else {
    surface.mesh = repair(polygons, {.numerics = Numerics::AsGiven}, stop).mesh;
    surface.file = polygons.file;
  }
  surface.warnings = polygons.warnings;
  surface.polygons = std::move(polygons);
  return surface;
}

BakeSurface read_bake_surface(const std::string& path, Texcoords texcoords, const StopCheck& stop,
                              Strictness strictness) {
  if (!holds_map(path)) return bake_surface(read_mesh(path, stop, strictness), texcoords, stop);
  const MapFile file = read_map(path, stop, strictness);
  BakeSurface surface = with_layout(file, path);
  surface.warnings = file.warnings;
  return surface;
}

void BakeJob::run(const StopCheck& stop) {
  if (!is_in_unit_square(*target.layout))
    throw Error(ErrorKind::Unsupported, fmt::format("{}: its layout leaves [0, 1]^2, which is what "
                                                    "an image shows; move it there",
                                                    target.file));
  const SurfaceValues values = values_of(*this, channels, stop);
  background = values.background;
  std::optional<PlaceOf> place_of;
  std::optional<SurfaceTree> tree;
  if (method != BakeMethod::Nearest) place_of = same_places(*target.mesh, *carrier.mesh);
  if (!place_of && method == BakeMethod::Same)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{} and {} do not have the same faces; go by nearest points",
                            target.file, carrier.file));
  method = place_of ? BakeMethod::Same : BakeMethod::Nearest;
  Stopwatch watch;
  std::optional<TimedPlaces> timed;
  if (!place_of) {
    farthest = distance.value_or(kFarthest * diagonal(carrier.mesh->positions()));
    tree.emplace(input_positions(*carrier.mesh), carrier.mesh->faces());
    timed.emplace(nearest_places(*target.mesh, *tree, farthest));
    place_of = timed->places();
    nearest_seconds = watch.restart();
  }
  baked = bake(InverseMap(*target.layout), options, *place_of, values, stop);
  density = texel_density(*target.layout, options.width, options.height);
  bake_seconds = watch.restart();
  if (timed) {  // threads search side by side
    const double searches = std::min(bake_seconds, timed->seconds() / ThreadCount::current());
    nearest_seconds += searches;
    bake_seconds -= searches;
  }
  images = {};
}

bool BakeJob::is_proven() const {
  return baked && baked->counts.doubly_covered == 0 && baked->counts.undecided == 0;
}

namespace {

Json bake_section(const BakeJob& job) {
  const BakeCounts& counts = job.baked->counts;
  return {
      {"texels", counts.texels},
      {"covered", counts.covered},
      {"doubly_covered", counts.doubly_covered},
      {"undecided", counts.undecided},
      {"partly_covered", counts.partly},
      {"misses", counts.misses},
      {"charts", counts.charts},
      {"charts_without_texels", counts.charts_without_texels},
      {"density", {{"min", job.density.min}, {"mean", job.density.mean}, {"max", job.density.max}}},
      {"method", method_name(job.method)},
      {"distance", job.method == BakeMethod::Nearest ? Json(job.farthest) : Json()}};
}

}  // namespace

RunReport bake_report(const BakeJob& job) {
  return {.command = "bake",
          .status = "converged",
          .input = {{"file", job.target.file}},
          .result = {{"bake", bake_section(job)}},
          .warnings = job.target.warnings,
          .seconds = {{"nearest_points", job.nearest_seconds}, {"bake", job.bake_seconds}}};
}

void write_baked(const std::string& path, const BakeJob& job) {
  const Raster& raster = job.baked->image;
  const std::string bytes =
      encode_image(path, raster, {.transfer = job.options.transfer, .channels = job.channels});
  if (format_of(path) != ".npy") return write_file_atomically(path, bytes);
  const double u = 1.0 / raster.width(), v = 1.0 / raster.height();
  const Json labels{
      {"schema_version", 1},
      {"shape", {raster.height(), raster.width(), raster.channels()}},
      {"channels", job.channels},
      {"origin", {u / 2, 1 - v / 2}},
      {"step", {u, -v}},
      {"v", "down: the first row has the largest v"},
      {"nothing", std::isfinite(job.background) ? Json(job.background) : Json("nan")}};
  PendingFile array(path, bytes), beside(path + ".json", json_text(labels, 1) + "\n");
  array.take_place();
  beside.take_place();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
