#include <fmt/format.h>

#include <optional>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/claims.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/refusal.h"

namespace majorant {

namespace {

// The map that an image shows, with uv as the file has them. Empty if the cells are others.
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

// Files that do not say that their cuts are seams are asked as others are: a vertex away from the
// cuts has one whole turn around it.
std::string unsaid_cone(const MapFile& file, const std::string& path, ProofRequest wanted) {
  if (wanted.cuts != CutRule::Seams && wanted.cuts != CutRule::SeamsOrFree) return {};
  if (parse_claims(file.claims, path).seams.value_or(false)) return {};
  wanted = {.cuts = CutRule::Free, .stop = wanted.stop};
  const Finding angles = MapProof(file, path, wanted).angles;
  if (angles.answer == ProofStatus::Proven) return {};
  return fmt::format("{}; the format does not tell a cone from that, write a .vtu", angles.detail);
}

}  // namespace

FileVerification certification(std::string path, ProofRequest wanted, const MapFile* image_of) {
  return [path = std::move(path), wanted, image_of](const std::string& temporary) {
    const auto refuse = [&](const std::string& reason) {
      throw Error(ErrorKind::Invalid,
                  fmt::format("{} is not written, since what it says would not be valid: {}", path,
                              reason));
    };
    const auto prove = [&](const MapFile& map, const ProofRequest& request) {
      const MapProof proof(map, path, request);
      if (proof.verdict() != ProofStatus::Proven) refuse(proof.first_defect());
    };
    try {
      const MapFile file = read_map(temporary);
      // A claim of cuts binds the file: other edges whose sides differ are tears.
      ProofRequest claimed = wanted;
      if (!claimed.cut_edges) claimed.cut_edges = parse_claims(file.claims, path).cuts;
      if (image_of != nullptr) {
        const std::optional<MapFile> shown = shown_by(file, *image_of);
        if (!shown) refuse("its cells are not those of the map");
        prove(*shown, wanted);
        prove(file, {.stop = wanted.stop});
        return;
      }
      prove(file, claimed);
      if (const std::string cone = unsaid_cone(file, path, wanted); !cone.empty()) refuse(cone);
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::Unreadable && e.kind() != ErrorKind::Unsupported) throw;
      refuse(problem_of(e));
    }
  };
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
