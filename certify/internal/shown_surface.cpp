#include "majorant/certify/internal/shown_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "majorant/certify/internal/surface_match.h"
#include "majorant/mesh/plane_side.h"

namespace majorant {
namespace {

// Returns the polygon of each cell if the file holds polygons. Labels of a .vtu name faces of the
// surface instead, and are compared. Empty if all polygons are triangles.
std::vector<Index> polygons_of_file(const MapFile& file, const ProofRequest& request) {
  if (request.labels == ProofRequest::FaceLabels::Compared) return {};
  std::vector<Index> polygon(file.input_face.begin(), file.input_face.end());
  std::vector<Index> sorted = polygon;
  if (!std::is_sorted(sorted.begin(), sorted.end())) std::sort(sorted.begin(), sorted.end());
  const bool repeats = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  return repeats ? polygon : std::vector<Index>();
}

template <class Polygon>
std::vector<Index> from_smallest(const Polygon& polygon) {
  std::vector<Index> vertices(polygon.begin(), polygon.end());
  std::rotate(vertices.begin(), std::min_element(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

// Returns flags of the polygons of the surface without cells; empty if all should have cells.
std::vector<char> unmapped_polygons(const MapFile& file, const ProofRequest& request) {
  if (request.coverage == ProofRequest::Coverage::Whole) return {};
  const IndexLists& polygons = request.surface->polygons;
  std::vector<char> flags(polygons.size(), 0);
  if (request.labels == ProofRequest::FaceLabels::Compared) {
    std::fill(flags.begin(), flags.end(), 1);
    for (const Index face : file.input_face)
      if (to_size(face) < flags.size()) flags[face] = 0;
    return flags;
  }
  std::map<std::vector<Index>, Index> left;  // polygons by sorted vertices
  for (const auto& polygon : file.unmapped) ++left[from_smallest(polygon)];
  for (std::size_t p = 0; p < flags.size() && !left.empty(); ++p)
    if (const auto entry = left.find(from_smallest(polygons[p])); entry != left.end()) {
      flags[p] = 1;
      if (--entry->second == 0) left.erase(entry);
    }
  return flags;
}

Finding refused(std::string defect) { return {ProofStatus::Violated, std::move(defect)}; }

}  // namespace

ShownSurface shown_surface(const MapFile& file, const SurfaceMesh& cells,
                           const ProofRequest& request) {
  const bool has_numbers = request.labels == ProofRequest::FaceLabels::Compared;
  for (Index v = 0; v < cells.vertex_count() && has_numbers; ++v)
    if (to_size(cells.input_vertex(v)) >= request.surface->positions.size())
      return {refused(fmt::format("the surface has no vertex {}", cells.input_vertex(v)))};
  std::vector<Index> labels;
  if (has_numbers && file.input_face.size() > 0)
    labels.assign(file.input_face.begin(), file.input_face.end());
  const std::vector<char> unmapped = unmapped_polygons(file, request);
  const auto left = static_cast<Index>(std::count(unmapped.begin(), unmapped.end(), 1));
  if (request.unmapped && left != *request.unmapped)
    return {refused(fmt::format("{} without cells instead of {}", count_text(left, "face"),
                                *request.unmapped))};
  const std::vector<Index> polygons = polygons_of_file(file, request);
  const ShownCells shown{cells, labels, polygons, unmapped, file.points_rounding};
  SurfaceMatch match = match_surface(shown, *request.surface, request.orientation);
  // A planar mesh that is clockwise everywhere may be shown from the other side.
  if (!match.defect.empty())
    if (const auto turned = turned_counterclockwise(*request.surface))
      if (SurfaceMatch other = match_surface(shown, *turned, request.orientation);
          other.defect.empty())
        match = std::move(other);
  if (!match.defect.empty()) return {refused(match.defect)};
  ShownSurface result{
      {ProofStatus::Proven, count_text(match.same + match.changed, "face")}, match.changed, left};
  if (match.changed > 0)
    result.finding.detail += fmt::format(", {} of them in other triangles", match.changed);
  if (left > 0) result.finding.detail += fmt::format(", {} more are not mapped", left);
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
