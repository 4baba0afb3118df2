#include "majorant/parametrization/atlas/internal/kept_islands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/map_proof.h"
#include "majorant/framework/rounding.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/texture_borders.h"

namespace majorant {
namespace {

// Returns the texture coordinates of a corner of a face.
Vector2 texcoord(const SurfaceMesh& mesh, Index f, Index k) {
  return mesh.corner_texcoords().row(f).segment<2>(2 * k);
}

int orientation_of(const SurfaceMesh& mesh, const Vec& uv, Index f) {
  const auto corner = [&](Index k) { return Vector2(uv.segment<2>(2 * mesh.faces()(f, k))); };
  return orientation(corner(0), corner(1), corner(2));
}

// Returns u, v per vertex, times the scale. The corners of a vertex agree in an island.
Vec coordinates(const SurfaceMesh& mesh, double scale) {
  Vec uv(2 * mesh.vertex_count());
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k)
      uv.segment<2>(2 * mesh.faces()(f, k)) = scale * texcoord(mesh, f, k);
  return uv;
}

[[noreturn]] void refuse(const SurfaceMesh& mesh, const std::string& what) {
  throw Refusal(ErrorKind::Unsupported, mesh.file(),
                fmt::format("{}{}, which no motion repairs; ", message_prefix(mesh), what),
                Hint::MapIslands);
}

void require_textured(const SurfaceMesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (!is_textured(mesh, f))
      refuse(mesh, fmt::format("face {} has no texture coordinates", mesh.input_face(f) + 1));
}

void require_positive(const SurfaceMesh& mesh, const Vec& uv) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const int sign = orientation_of(mesh, uv, f);
    if (sign > 0) continue;
    refuse(mesh, fmt::format("face {} {} in its texture coordinates", mesh.input_face(f) + 1,
                             sign < 0 ? "is turned over" : "has no area"));
  }
}

void require_simple(const BezierMap& map) {
  const GlobalInjectivity proof = check_boundary(map);
  if (proof.result == ProofStatus::Proven) return;
  const SurfaceMesh& mesh = map.mesh();
  refuse(mesh, fmt::format("the island of face {} overlaps itself in its texture coordinates: {}",
                           mesh.input_face(0) + 1, describe(proof, [&](Index face, Index corner) {
                             return mesh.input_vertex(mesh.faces()(face, corner));
                           })));
}

// Returns whether the properties proven of the file's coordinates also hold for this map.
bool is_kept(const BezierMap& map) {
  for (Index f = 0; f < map.mesh().face_count(); ++f)
    if (orientation_of(map.mesh(), map.control_points(), f) <= 0) return false;
  return check_boundary(map).result == ProofStatus::Proven;
}

}  // namespace

std::vector<BezierMap> kept_islands(
    const std::vector<std::shared_ptr<const SurfaceMesh>>& islands) {
  double surface = 0, image = 0;
  for (const auto& mesh : islands) {
    require_textured(*mesh);
    const Vec uv = coordinates(*mesh, 1);
    require_positive(*mesh, uv);
    require_simple(BezierMap::linear(mesh, uv));
    surface += mesh->area();
    for (Index f = 0; f < mesh->face_count(); ++f) {
      const Vector2 origin = texcoord(*mesh, f, 0);
      image +=
          cross(Vector2(texcoord(*mesh, f, 1) - origin), Vector2(texcoord(*mesh, f, 2) - origin)) /
          2;
    }
  }
  const double scale = std::sqrt(surface / image);
  for (const double by : {scale, power_of_two(scale)}) {
    std::vector<BezierMap> maps;
    for (const auto& mesh : islands)
      maps.push_back(BezierMap::linear(mesh, coordinates(*mesh, by)));
    if (std::all_of(maps.begin(), maps.end(), is_kept)) return maps;
  }
  refuse(*islands.front(), "the areas of texture coordinates leave the range of doubles");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
