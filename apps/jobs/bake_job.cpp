#include "majorant/apps/jobs/bake_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/certify/cut_map.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/srgb.h"
#include "majorant/io/gltf_texture.h"
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

// Returns the map on a mesh whose faces are numbered by the file's polygons instead of its cells.
BezierMap numbered_by_polygons(const BezierMap& map, const MapFile& file) {
  const bool is_known = file.input_face.size() == map.mesh().face_count() &&
                        (file.input_face.size() == 0 || file.input_face.minCoeff() >= 0);
  if (!is_known) return map;
  SurfaceParts parts = map.mesh().parts();
  parts.input_face.assign(file.input_face.begin(), file.input_face.end());
  return BezierMap(std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts))),
                   map.shared_space(), map.control_points());
}

BakeSurface with_layout(const MapFile& file, std::string name) {
  BakeSurface surface;
  const CutMap cut(file, name);
  surface.layout = numbered_by_polygons(cut.map_cut_along(cut.cuts()), file);
  surface.mesh = surface.layout->shared_mesh();
  surface.scale = layout_scale(file);
  surface.file = std::move(name);
  return surface;
}

// Returns the corner of the polygon for each corner of a triangle: by vertex, and by texture
// coordinates if a polygon has a vertex twice.
Cells corners_of_polygons(const MapFile& file, const PolygonMesh& polygons) {
  Cells corners(file.cells.rows(), 3);
  for (Index c = 0; c < file.cells.rows(); ++c) {
    const auto p = to_size(file.input_face[c]);
    const auto& polygon = polygons.polygons[p];
    const auto& texture = polygons.polygon_texcoords[p];
    for (Index k = 0; k < 3; ++k) {
      const Index point = file.cells(c, k);
      const Vector2 uv = file.uv.row(point);
      std::size_t corner = 0;
      while (polygon[corner] != file.input_vertex[point] ||
             polygons.texcoords[to_size(texture[corner])] != uv)
        ++corner;
      corners(c, k) = static_cast<Index>(corner);
    }
  }
  return corners;
}

Points3 input_positions(const SurfaceMesh& mesh) {
  return mesh.positions().rowwise() + mesh.origin().transpose();
}

// Returns the file's normals at the corners of faces; the normals of flat faces if it has none.
CornerNormals corner_normals(const BakeSurface& surface) {
  const SurfaceMesh& mesh = *surface.mesh;
  const PolygonMesh& polygons = surface.polygons;
  CornerNormals normals(mesh.face_count(), 9);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto p = [&](Index k) -> Vector3 { return mesh.positions().row(mesh.faces()(f, k)); };
    const Vector3 flat = (p(1) - p(0)).cross(p(2) - p(0)).stableNormalized();
    const auto& of_polygon = polygons.polygon_normals[to_size(mesh.input_face(f))];
    for (Index k = 0; k < 3; ++k)
      normals.row(f).segment<3>(3 * k) =
          of_polygon.empty()
              ? flat
              : Vector3(polygons.normals[to_size(of_polygon[to_size(surface.polygon_corner(f, k))])]
                            .stableNormalized());
  }
  return normals;
}

// The numbers of polygons, vertices and polygon corners in the file, as far as its surface shows
// them. Files that hold maps have no polygon corners.
struct FileCounts {
  Index faces = 0, vertices = 0;
  std::vector<Index> first_corner;  // first corner of each polygon, then the number of all corners
};

FileCounts file_counts(const BakeSurface& surface) {
  FileCounts counts;
  if (const IndexLists& polygons = surface.polygons.polygons; !polygons.empty()) {
    counts.faces = static_cast<Index>(polygons.size());
    counts.vertices = static_cast<Index>(surface.polygons.positions.size());
    counts.first_corner = {0};
    for (std::size_t p = 0; p < polygons.size(); ++p)
      counts.first_corner.push_back(counts.first_corner.back() +
                                    static_cast<Index>(polygons[p].size()));
    return counts;
  }
  for (Index f = 0; f < surface.mesh->face_count(); ++f)
    counts.faces = std::max(counts.faces, surface.mesh->input_face(f) + 1);
  for (Index v = 0; v < surface.mesh->vertex_count(); ++v)
    counts.vertices = std::max(counts.vertices, surface.mesh->input_vertex(v) + 1);
  return counts;
}

SurfaceValues table_values(const std::string& path, const BakeSurface& carrier,
                           const StopCheck& stop) {
  const RowMatrix table = read_npy_rows(path, stop);
  const FileCounts counts = file_counts(carrier);
  const SurfaceMesh& mesh = *carrier.mesh;
  const bool is_of_faces = table.rows() == counts.faces;
  const bool is_of_vertices = table.rows() == counts.vertices;
  const bool is_of_corners =
      !counts.first_corner.empty() && table.rows() == counts.first_corner.back();
  if (is_of_faces + is_of_vertices + is_of_corners != 1)
    throw Error(
        ErrorKind::Unreadable,
        fmt::format("{}: has {} rows; {} has {} faces, {} vertices{}, one of which they must be",
                    path, table.rows(), carrier.file, counts.faces, counts.vertices,
                    counts.first_corner.empty()
                        ? ""
                        : fmt::format(" and {} corners of faces", counts.first_corner.back())));
  RowMatrix rows(is_of_vertices  ? mesh.vertex_count()
                 : is_of_corners ? 3 * mesh.face_count()
                                 : mesh.face_count(),
                 table.cols());
  for (Index i = 0; i < rows.rows(); ++i)
    rows.row(i) = table.row(is_of_vertices  ? mesh.input_vertex(i)
                            : is_of_corners ? counts.first_corner[to_size(mesh.input_face(i / 3))] +
                                                  carrier.polygon_corner(i / 3, i % 3)
                                            : mesh.input_face(i));
  if (is_of_corners) return table_of_corners(std::move(rows));
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

// Returns the values of the images: colours of several images, whether grey or with alpha; the
// channels of a single one.
SurfaceValues values_of_images(const BakeJob& job) {
  const BezierMap& layout = layout_of(job.carrier, "an image");
  std::vector<SurfaceValues> each;
  int channels = 3;
  for (std::size_t k = 0; k < job.images.size(); ++k) {
    each.push_back(texture_values(layout, job.images[k], job.image_transfer, job.filter,
                                  k < job.wraps.size() ? job.wraps[k] : Wraps{}));
    if (each.back().channels % 2 == 0) channels = 4;
  }
  if (each.size() == 1) return each.front();
  const Continuation course = each.front().course;
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

// Returns the colours of the corners of faces, 3 #F by 3, in linear light or as OBJ and PLY hold
// them. Vertices without a colour are white.
RowMatrix corner_colors_of(const BakeSurface& surface, Transfer transfer) {
  const SurfaceMesh& mesh = *surface.mesh;
  if (surface.polygons.gltf) {
    const RowMatrix of_polygons = corner_colors(surface.polygons);
    RowMatrix rows(3 * mesh.face_count(), 3);
    for (Index i = 0; i < rows.rows(); ++i)
      rows.row(i) =
          of_polygons.row(3 * mesh.input_face(i / 3) + surface.polygon_corner(i / 3, i % 3));
    return rows;
  }
  RowMatrix rows(3 * mesh.face_count(), 3);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const auto polygon = surface.polygons.polygons[to_size(mesh.input_face(f))];
      const Vector3& color =
          surface.polygons.colors[to_size(polygon[to_size(surface.polygon_corner(f, k))])];
      for (Index c = 0; c < 3; ++c) {
        const double code = std::isfinite(color[c]) ? std::clamp(color[c], 0.0, 1.0) : 1.0;
        rows(3 * f + k, c) = transfer == Transfer::Srgb ? srgb_to_linear(code) : code;
      }
    }
  return rows;
}

// Returns the requested values of the carrier and sets the names of their channels.
SurfaceValues values_of(const BakeJob& job, std::vector<std::string>& channels,
                        const StopCheck& stop) {
  const SurfaceMesh& mesh = *job.carrier.mesh;
  if (!job.images.empty()) {
    channels.clear();
    return values_of_images(job);
  }
  if (job.attribute == "color") {
    if (!has_vertex_colors(job.carrier))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: its vertices have no colours to bake", job.carrier.file));
    channels = {"r", "g", "b"};
    return color_values(corner_colors_of(job.carrier, job.image_transfer));
  }
  if (job.attribute == "position") {
    channels = {"x", "y", "z"};
    return position_values(mesh);
  }
  if (job.attribute == "normal") {
    channels = {"x", "y", "z"};
    return job.carrier.polygons.polygon_normals.empty()
               ? normal_values(mesh)
               : normal_values(corner_normals(job.carrier));
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

// Returns the least distance from the vertices of a surface to another surface.
double least_distance(const SurfaceMesh& surface, const SurfaceTree& tree) {
  double least = std::numeric_limits<double>::infinity();
  Index likely = -1;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const NearestPoint nearest = tree.nearest(surface.input_position(v), likely);
    likely = nearest.face;
    least = std::min(least, nearest.distance);
  }
  return least;
}

// Measures the time of searches for nearest points, on every kPeriod-th search.
class TimedPlaces {
 public:
  explicit TimedPlaces(Correspondence places) : places_(std::move(places)) {}

  Correspondence places() {
    return [this](const SurfacePlace& of, Index likely) {
      thread_local unsigned calls = 0;
      if (++calls % kPeriod != 0) return places_(of, likely);
      Stopwatch watch;
      std::optional<CarrierPlace> found = places_(of, likely);
      nanoseconds_.fetch_add(std::llround(1e9 * watch.restart()), std::memory_order_relaxed);
      return found;
    };
  }
  // Returns the processor seconds of all searches together.
  double seconds() const { return 1e-9 * kPeriod * static_cast<double>(nanoseconds_.load()); }

 private:
  static constexpr unsigned kPeriod = 16;

  Correspondence places_;
  std::atomic<long long> nanoseconds_{0};
};

}  // namespace

bool has_vertex_colors(const BakeSurface& surface) {
  if (surface.polygons.gltf) return corner_colors(surface.polygons).rows() > 0;
  return !surface.polygons.colors.empty();
}

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
    const MapFile file = to_map_file(polygons);
    surface = with_layout(file, polygons.file);
    surface.polygon_corner = corners_of_polygons(file, polygons);
  } else {
    RepairedSurface repaired = repair(polygons, {.numerics = Numerics::AsGiven}, stop);
    surface.mesh = std::move(repaired.mesh);
    surface.polygon_corner = std::move(repaired.polygon_corner);
    surface.file = polygons.file;
  }
  surface.warnings = polygons.warnings;
  surface.polygons = std::move(polygons);
  return surface;
}

BakeSurface read_bake_surface(const std::string& path, Texcoords texcoords, const StopCheck& stop,
                              Strictness strictness) {
  if (!is_for(FormatUse::ReadMap, path))
    return bake_surface(read_mesh(path, stop, strictness), texcoords, stop);
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
  std::optional<Correspondence> place_of;
  std::optional<SurfaceTree> tree;
  if (method != BakeMethod::Nearest) place_of = same_places(*target.mesh, *carrier.mesh);
  if (!place_of && method == BakeMethod::Same)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{} and {} do not have the same faces; use nearest points", target.file,
                            carrier.file));
  method = place_of ? BakeMethod::Same : BakeMethod::Nearest;
  Stopwatch watch;
  std::optional<TimedPlaces> timed;
  if (!place_of) {
    farthest = distance.value_or(kFarthest * diagonal(carrier.mesh->positions()));
    tree.emplace(input_positions(*carrier.mesh), carrier.mesh->faces());
    sense = sense_of(*target.mesh, *tree, farthest);
    timed.emplace(nearest_places(*target.mesh, *tree, farthest, sense));
    place_of = timed->places();
    nearest_seconds = watch.restart();
  }
  baked = bake(InverseMap(*target.layout), options, *place_of, values, stop);
  density = texel_density(*target.layout, options.width, options.height);
  bake_seconds = watch.restart();
  if (timed) {  // threads search concurrently
    const double searches = std::min(bake_seconds, timed->seconds() / ThreadCount::current());
    nearest_seconds += searches;
    bake_seconds -= searches;
  }
  if (tree && is_all_missed()) apart = least_distance(*target.mesh, *tree);
  images = {};
}

double BakeJob::opposed() const {
  const BakeCounts& counts = baked->counts;
  const long shown = counts.covered + counts.partly - counts.misses;
  return shown > 0 ? static_cast<double>(counts.opposed) / static_cast<double>(shown) : 0;
}

bool BakeJob::is_all_missed() const {
  const long covered = baked->counts.covered + baked->counts.partly;
  return covered > 0 && baked->counts.misses == covered;
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
      {"opposed", job.opposed()},
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
