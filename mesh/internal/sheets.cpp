#include "majorant/mesh/internal/sheets.h"

#include <algorithm>
#include <array>
#include <utility>

#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/internal/agreeing_faces.h"
#include "majorant/mesh/internal/crowded_edges.h"
#include "majorant/mesh/internal/equal_lists.h"
#include "majorant/mesh/internal/joined_places.h"

namespace majorant {
namespace {

// The layer of every face. Faces of one layer are glued to each other: the second faces of
// duplicates form the second layer. Faces of layer -1 are glued to nothing.
struct FaceLayers {
  std::vector<Index> layer;
  std::vector<Index> repeated, duplicates;  // faces
};

FaceLayers layers_of(const GivenTriangles& triangles) {
  FaceLayers result;
  result.layer.assign(to_size(triangles.face_count()), 0);
  IndexLists corners;
  for (const auto& t : triangles.faces.rowwise()) corners.push_back({t[0], t[1], t[2]});
  const std::vector<Index> of_triangle = ranks_of_lists(std::move(corners));
  const std::vector<Index> of_polygon = ranks_of_lists(triangles.polygons);
  for (Index f = 0; f < triangles.face_count(); ++f) {
    const auto t = triangles.faces.row(f);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      result.layer[f] = -1;
      result.repeated.push_back(f);
      continue;
    }
    result.layer[f] = std::max(of_triangle[f], of_polygon[triangles.polygon[f]]);
    if (result.layer[f] > 0) result.duplicates.push_back(f);
  }
  return result;
}

// Returns pairs of sides. An edge with more than two sides in one layer has no pair. If sides of
// such an edge are connected around both of its ends, they are the two ends of a fan. So there are
// two of them, in opposite directions, with the same copies of the ends, and SurfaceMesh joins
// them.
PairedSides pairs_within_layers(const GivenTriangles& triangles, const std::vector<Index>& layer) {
  return pair_sides(
      static_cast<Index>(triangles.positions.size()), triangles.half_edge_count(),
      [&](Index h) {
        return std::pair(layer[face_of(h)] < 0 ? Index{-1} : triangles.from(h), triangles.to(h));
      },
      [&](Index h) { return layer[face_of(h)]; });
}

std::vector<Index> fans_of_corners(const GivenTriangles& triangles, const GluedSides& glued) {
  return corner_fans<3>(glued.opposite,
                        [&](Index h) { return triangles.agree(h, glued.opposite[h]); });
}

// Opens joined edges at the ends of edges that would have more than two sides by the fans of their
// ends. Returns whether there were any.
bool open_crowded(const GivenTriangles& triangles, const std::vector<Index>& layer,
                  const std::vector<Index>& fan, GluedSides& glued) {
  if (glued.joined.empty()) return false;
  std::vector<std::array<Index, 2>> ends;
  for (Index h = 0; h < triangles.half_edge_count(); ++h)
    if (layer[face_of(h)] >= 0)
      ends.push_back({std::min(fan[h], fan[next(h)]), std::max(fan[h], fan[next(h)])});
  std::sort(ends.begin(), ends.end());
  std::vector<char> is_crowded(glued.opposite.size(), 0);  // by fan
  for (std::size_t k = 2; k < ends.size(); ++k)
    if (ends[k] == ends[k - 2]) is_crowded[ends[k][0]] = is_crowded[ends[k][1]] = 1;
  return std::erase_if(glued.joined, [&](Index h) {
           if (!is_crowded[fan[h]] && !is_crowded[fan[next(h)]]) return false;
           glued.open(h);
           return true;
         }) > 0;
}

// Returns one side of each edge with more than two faces, whatever their layers.
std::vector<Index> one_side_each(const GivenTriangles& triangles, const IndexLists& crowded) {
  std::vector<std::array<Index, 3>> edges;
  for (const Index h : crowded.indices()) {
    const Index a = triangles.from(h), b = triangles.to(h);
    edges.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Index> sides;
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (k == 0 || edges[k][0] != edges[k - 1][0] || edges[k][1] != edges[k - 1][1])
      sides.push_back(edges[k][2]);
  return sides;
}

// Returns by given vertex whether its copies are due to a listed edge or face.
std::vector<char> explained_vertices(const GivenTriangles& triangles, const Sheets& sheets,
                                     Index vertices) {
  std::vector<char> is_explained(to_size(vertices), 0);
  for (const auto* edges : {&sheets.split_edges, &sheets.cut_edges})
    for (const Index h : *edges)
      is_explained[triangles.from(h)] = is_explained[triangles.to(h)] = 1;
  for (const auto* faces : {&sheets.repeated, &sheets.duplicates})
    for (const Index f : *faces)
      for (const Index v : triangles.faces.row(f)) is_explained[v] = 1;
  return is_explained;
}

// Gives a vertex to every fan: the first fan of a given vertex keeps it, others get copies.
void number_vertices(const GivenTriangles& triangles, const std::vector<Index>& fan,
                     Sheets& sheets) {
  Index given = 0;
  for (const Index v : triangles.faces.reshaped()) given = std::max(given, v + 1);
  std::vector<Index> first(to_size(given), -1), number(fan.size(), -1);
  for (Index h = 0; h < triangles.half_edge_count(); ++h)
    if (first[triangles.from(h)] < 0) first[triangles.from(h)] = fan[h];
  for (Index v = 0; v < given; ++v) {
    if (first[v] < 0 || number[first[v]] >= 0) continue;
    number[first[v]] = static_cast<Index>(sheets.vertex.size());
    sheets.vertex.push_back(v);
  }
  const std::vector<char> is_explained = explained_vertices(triangles, sheets, given);
  for (Index h = 0; h < triangles.half_edge_count(); ++h) {
    if (number[fan[h]] >= 0) continue;
    number[fan[h]] = static_cast<Index>(sheets.vertex.size());
    sheets.vertex.push_back(triangles.from(h));
    if (!is_explained[triangles.from(h)]) sheets.split_vertices.push_back(triangles.from(h));
  }
  auto& split = sheets.split_vertices;
  std::sort(split.begin(), split.end());
  split.erase(std::unique(split.begin(), split.end()), split.end());
  sheets.faces.resize(triangles.face_count(), 3);
  for (Index f = 0; f < triangles.face_count(); ++f)
    for (Index k = 0; k < 3; ++k)
      sheets.faces(f, sheets.is_turned[f] ? (3 - k) % 3 : k) = number[fan[3 * f + k]];
}

}  // namespace

Sheets make_sheets(const GivenTriangles& triangles, Orientation orientation,
                   CrowdedEdges crowded_edges, const StopCheck& stop) {
  FaceLayers layers = layers_of(triangles);
  stop.poll();
  PairedSides sides = pairs_within_layers(triangles, layers.layer);
  GluedSides glued{std::move(sides.opposite), {}};
  Sheets sheets;
  sheets.pieces_given = component_count(face_components(glued.opposite));
  join_places(triangles, layers.layer, sides.crowded, glued, stop);
  if (crowded_edges == CrowdedEdges::Paired)
    pair_crowded_sides(triangles, sides.crowded, glued, stop);
  stop.poll();
  AgreeingFaces agreeing = orientation == Orientation::MadeConsistent
                               ? turn_to_agree(triangles, glued, stop)
                               : open_disagreeing(triangles, glued);
  stop.poll();
  std::vector<Index> fan = fans_of_corners(triangles, glued);
  while (open_crowded(triangles, layers.layer, fan, glued)) fan = fans_of_corners(triangles, glued);
  sheets.repeated = std::move(layers.repeated);
  sheets.duplicates = std::move(layers.duplicates);
  sheets.split_edges = one_side_each(triangles, sides.crowded);
  sheets.cut_edges = std::move(agreeing.cut_edges);
  sheets.one_sided = agreeing.one_sided;
  sheets.is_turned = std::move(agreeing.is_turned);
  for (Index f = 0; f < triangles.face_count(); ++f)
    if (sheets.is_turned[f]) sheets.turned.push_back(f);
  number_vertices(triangles, fan, sheets);
  return sheets;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
