#include <fmt/format.h>

#include <functional>
#include <optional>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/claims.h"
#include "majorant/io/formats.h"
#include "majorant/io/io.h"
#include "majorant/io/mesh_objects.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/refusal.h"

namespace majorant {

namespace {

// Returns the map that an image shows, with the file's uv; empty if the cells differ.
std::optional<MapFile> shown_by(const MapFile& image, const MapFile& map) {
  if (image.degree != map.degree || image.cells.rows() != map.cells.rows() ||
      image.cells != map.cells || image.uv.rows() != map.uv.rows())
    return {};
  MapFile shown = image;
  shown.points = map.points;
  shown.input_vertex = map.input_vertex;
  shown.input_face = map.input_face;
  return shown;
}

// Describes a cone of a file that does not claim seams; empty if there is none. A vertex away from
// cuts must have one full turn around it.
std::string unsaid_cone(const MapFile& file, const std::string& path, ProofRequest required) {
  if (required.cuts != CutRule::Seams && required.cuts != CutRule::SeamsOrFree) return {};
  if (parse_claims(file.claims, path).seams.value_or(false)) return {};
  required = {.cuts = CutRule::Free, .stop = required.stop};
  const Finding angles = MapProof(file, path, required).angles;
  if (angles.answer == ProofStatus::Proven) return {};
  return fmt::format("{}; the format does not tell a cone from that, write a .vtu", angles.detail);
}

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw Error(
      ErrorKind::Invalid,
      fmt::format("{} is not written, since what it says would not be valid: {}", path, reason));
}

void prove(const MapFile& map, const std::string& path, const ProofRequest& request) {
  const MapProof proof(map, path, request);
  if (proof.verdict() != ProofStatus::Proven) refuse(path, proof.first_defect());
  if (!map.folded_otherwise.empty())
    refuse(path,
           fmt::format("face {} folds along its other diagonal", map.folded_otherwise.front()));
}

// Returns a verification by `judge`, for a file of that name. A file that cannot be read back is
// not valid either.
FileVerification refusing(const std::string& path, std::function<void(const std::string&)> judge) {
  return [path, judge = std::move(judge)](const std::string& temporary) {
    try {
      judge(temporary);
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::Unreadable && e.kind() != ErrorKind::Unsupported) throw;
      refuse(path, problem_of(e));
    }
  };
}

}  // namespace

FileVerification certification(std::string path, ProofRequest required, const MapFile* image_of) {
  return refusing(path, [path, required, image_of](const std::string& temporary) {
    const MapFile file = read_map(temporary);
    // A claim of cuts binds the file: other edges whose sides differ are tears.
    ProofRequest claimed = required;
    if (!claimed.cut_edges) claimed.cut_edges = parse_claims(file.claims, path).cuts;
    if (image_of != nullptr) {
      const std::optional<MapFile> shown = shown_by(file, *image_of);
      if (!shown) refuse(path, "its cells are not those of the map");
      prove(*shown, path, required);
      prove(file, path, {.stop = required.stop});
      return;
    }
    prove(file, path, claimed);
    if (const std::string cone = unsaid_cone(file, path, required); !cone.empty())
      refuse(path, cone);
  });
}

FileVerification certification_of_objects(std::string path, ProofRequest required) {
  return refusing(path, [path, required](const std::string& temporary) {
    ProofRequest layered = required;
    if (is_for(FormatUse::ReadMap, path)) {
      const MapFile file = read_map(temporary);
      layered.layers = claimed_object_of_cells(file, path).value_or(std::vector<Index>());
      if (!file.is_complete) {
        layered.coverage = ProofRequest::Coverage::Partial;
        layered.labels = ProofRequest::FaceLabels::Compared;
      }
      return prove(file, path, layered);
    }
    const PolygonMesh mesh = read_mesh(temporary, {}, Strictness::Texcoords);
    const MapFile file = to_map_file(mesh);
    layered.layers = object_of_cells(objects_of(mesh), file);
    if (!file.is_complete) layered.coverage = ProofRequest::Coverage::Partial;
    prove(file, path, layered);
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
