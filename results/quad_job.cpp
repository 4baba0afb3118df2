#include "majorant/results/quad_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/results/input_points.h"
#include "majorant/results/quad_report.h"

namespace majorant {
namespace {

template <class T>
void append(const T& value, std::string& text) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  text.append(bytes, sizeof(T));
}

std::string ply_of_quads(const PolygonMesh& quads) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double "
      "y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      quads.positions.size(), quads.polygons.size());
  for (const Vector3& p : quads.positions)
    for (const double x : p) append(x, text);
  for (const auto& polygon : quads.polygons) {
    append(static_cast<std::uint8_t>(polygon.size()), text);
    for (const Index v : polygon) append(std::int32_t{v}, text);
  }
  return text;
}

// The cones of a piece, of those that name vertices of the input.
std::vector<Cone> cones_on(const SurfaceMesh& piece, const std::vector<Cone>& cones,
                           const std::vector<Index>& names) {
  std::vector<Cone> found;
  for (const Cone& cone : cones)
    if (const Index v = piece.find_input_vertex(names[cone.vertex]); v >= 0)
      found.push_back({v, cone.quarter_turns});
  return found;
}

void append_mesh(const PolygonMesh& part, PolygonMesh& all) {
  const auto first = static_cast<Index>(all.positions.size());
  all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
  for (std::vector<Index> polygon : part.polygons) {
    for (Index& v : polygon) v += first;
    all.polygons.push_back(std::move(polygon));
  }
}

}  // namespace

void QuadJob::open(PolygonMesh input) {
  surface = repair(input, {.welding = Welding::EqualPlaces}, record.start_stop());
  polygons = std::move(input);
}

void QuadJob::solve(const std::string& source) {
  const double before = record.seconds();
  const SurfaceMesh& mesh = *surface.mesh;
  if (options.map.cones)
    for (const Cone& cone : *options.map.cones)
      used_vertex(source, mesh, surface.welded[cone.vertex]);
  const std::vector<SurfacePiece> pieces = mesh.split(record.start_stop());
  long least = 0;
  for (const SurfacePiece& piece : pieces) {
    QuadMeshOptions of_piece = options;
    if (options.count)
      of_piece.count = std::max(
          1L, std::lround(static_cast<double>(*options.count) * piece.mesh->area() / mesh.area()));
    if (options.map.cones)
      of_piece.map.cones = cones_on(*piece.mesh, *options.map.cones, surface.welded);
    const QuadMesh made = quad_mesh(*piece.mesh, of_piece, record);
    append_mesh(made.quads, quads);
    asked_count += made.asked;
    patches += made.patches;
    least += made.least_count.value_or(made.check.count);
    if (made.status != Status::Converged) status = made.status;
  }
  record.begin(Activity::Proving);
  check = check_quads(quads, &mesh, record.start_stop());
  if (!check.is_valid())
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}: its components do not make valid quads together: {}",
                            polygons.file, check.defects.front()));
  const auto asked = static_cast<double>(asked_count);
  if (static_cast<double>(check.count) > (1 + kCountClose) * asked) least_count = least;
  if (!options.edge_length && std::abs(check.count - asked) > kCountClose * asked)
    warnings.push_back(
        fmt::format("{}: {} quads, {} asked: no valid mesh within {:.0f} % of that was found",
                    polygons.file, check.count, asked_count, 100 * kCountClose));
  solve_seconds = record.seconds() - before;
}

Json quad_report(const QuadJob& job) {
  Json section = quads_section(job.check, QuadsComparedWith::Surface);
  section["asked"] = job.asked_count;
  section["least_count"] = job.least_count ? Json(*job.least_count) : Json();
  section["patches"] = job.patches;
  section["degree"] = 1;
  Json input = input_section(job.polygons, *job.surface.mesh);
  for (const Repair& repair : job.surface.repairs) input["repairs"].push_back(describe(repair));
  std::vector<std::string> warnings = job.polygons.warnings;
  warnings.insert(warnings.end(), job.warnings.begin(), job.warnings.end());
  Json report{
      {"schema_version", 1},
      {"version", MAJORANT_VERSION},
      {"command", "quads"},
      {"status", status_name(job.status)},
      {"message", describe(job.check, QuadsComparedWith::Surface)},
      {"warnings", warnings},
      {"input", input},
      {"options", job.asked},
      {"quads", section},
      {"seconds", {{"read", job.read_seconds}, {"solve", job.solve_seconds}, {"write", 0.0}}}};
  report["peak_memory_bytes"] = peak_memory_bytes();
  report["threads"] = ThreadCount::current();
  return report;
}

std::vector<std::string> quad_extensions() { return {".obj", ".ply"}; }

void write_quads(const std::string& path, const PolygonMesh& quads, const SurfaceMesh& surface) {
  const std::string text = format_of(path) == ".ply" ? ply_of_quads(quads) : obj_text(quads);
  write_file_atomically(path, text, [&](const std::string& temporary) {
    const QuadCheck check = check_quads(read_mesh(temporary), &surface);
    if (!check.is_valid())
      throw Error(ErrorKind::Invalid, fmt::format("{}: {}", path, fmt::join(check.defects, "; ")));
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
