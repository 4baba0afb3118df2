#include "majorant/results/object_layouts.h"

#include <utility>

#include "majorant/results/write_map.h"

namespace majorant {

MapFile map_of_objects(std::vector<ObjectLayout> layouts) {
  std::vector<MapFile> maps;
  for (ObjectLayout& layout : layouts) {
    MapFile& map = maps.emplace_back(std::move(layout.map));
    for (int& v : map.input_vertex)
      if (v >= 0) v = layout.object.vertices[to_size(v)];
    for (int& face : map.input_face) face = layout.object.polygons[to_size(face)];
    map.distortion.resize(0);
    map.min_det.resize(0);
    map.face_distortion = FaceDistortion();
  }
  return joined(maps);
}

FileVerification proof_of_objects(const std::string& path, const PolygonMesh& surface) {
  ProofRequest promise;
  promise.surface = &surface;
  promise.labels = labels_in(path);
  promise.cuts = CutRule::Free;
  promise.overlap = ProofRequest::Overlap::Forbidden;
  return certification_of_objects(path, promise);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
