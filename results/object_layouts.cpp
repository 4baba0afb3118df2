#include "majorant/results/object_layouts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "majorant/results/write_map.h"

namespace majorant {

MapFile map_of_objects(std::vector<ObjectLayout> layouts) {
  std::vector<MapFile> maps;
  std::vector<int> chart;
  int charts = 0;
  for (ObjectLayout& layout : layouts) {
    MapFile& map = maps.emplace_back(std::move(layout.map));
    for (int& v : map.input_vertex)
      if (v >= 0) v = layout.object.vertices[to_size(v)];
    for (int& face : map.input_face) face = layout.object.polygons[to_size(face)];
    for (const int k : map.chart) chart.push_back(charts + k);
    if (map.chart.size() > 0) charts += map.chart.maxCoeff() + 1;
    map.distortion.resize(0);
    map.min_det.resize(0);
    map.face_distortion = FaceDistortion();
  }
  // As joined() puts the cells in order.
  std::vector<int> face;
  for (const MapFile& map : maps)
    face.insert(face.end(), map.input_face.begin(), map.input_face.end());
  std::vector<Index> order(face.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return face[a] < face[b]; });
  MapFile all = joined(maps);
  for (std::size_t c = 0; c < order.size(); ++c)
    all.chart[static_cast<Index>(c)] = chart[to_size(order[c])];
  return all;
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
