#include "majorant/quads/internal/quad_surface.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>

#include "majorant/mesh/connectivity.h"

namespace majorant {
namespace {

std::vector<Index> other_polygons(const PolygonMesh& quads) {
  std::vector<Index> others;
  for (std::size_t q = 0; q < quads.polygons.size(); ++q) {
    std::vector<Index> corners(quads.polygons[q].begin(), quads.polygons[q].end());
    std::sort(corners.begin(), corners.end());
    const bool repeats = std::adjacent_find(corners.begin(), corners.end()) != corners.end();
    if (corners.size() != 4 || repeats) others.push_back(static_cast<Index>(q));
  }
  return others;
}

// Adds "2 edges with more than two quads (vertices (1, 2), (3, 4))"; nothing if there are none.
void add_edges(const QuadSurface& quads, std::string_view what, const std::vector<Index>& sides,
               std::vector<std::string>& defects) {
  if (sides.empty()) return;
  std::vector<std::string> shown;
  for (const Index h : sides) {
    if (shown.size() == kNamedInDefects) break;
    const auto [a, b] = std::minmax({quads.from(h), quads.to(h)});
    shown.push_back(fmt::format("({}, {})", a + 1, b + 1));
  }
  defects.push_back(fmt::format("{} {} (vertices {}{})", sides.size(), what, fmt::join(shown, ", "),
                                sides.size() > kNamedInDefects ? ", ..." : ""));
}

}  // namespace

std::array<Vector3, 4> QuadSurface::corners_of(Index quad) const {
  const std::span<const Index> v = mesh.polygons[quad];
  return {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
}

std::optional<QuadSurface> quad_surface(const PolygonMesh& mesh,
                                        std::vector<std::string>& defects) {
  const std::size_t before = defects.size();
  if (mesh.polygons.empty()) defects.push_back("there are no faces");
  if (const std::vector<Index> others = other_polygons(mesh); !others.empty())
    defects.push_back(
        listed("face is no quad of four vertices", "faces are no quads of four vertices", others));
  if (defects.size() > before) return {};
  QuadSurface quads{mesh, {}, {}, {}, {}};
  PairedSides sides = pair_sides(static_cast<Index>(mesh.positions.size()), quads.half_edge_count(),
                                 [&](Index h) { return std::pair(quads.from(h), quads.to(h)); });
  std::vector<Index> crowded;
  for (const auto edge : std::as_const(sides.crowded)) crowded.push_back(edge[0]);
  add_edges(quads, "edges with more than two quads", crowded, defects);
  add_edges(quads, "edges along which both quads run the same way", sides.same_way, defects);
  if (defects.size() > before) return {};
  quads.opposite = std::move(sides.opposite);
  if (const std::vector<Index> touching =
          touching_vertices<4>(quads.opposite, [&](Index h) { return quads.from(h); });
      !touching.empty()) {
    defects.push_back(listed("vertex in which quads merely touch",
                             "vertices in which quads merely touch", touching));
    return {};
  }
  quads.valence.assign(mesh.positions.size(), 0);
  quads.is_border.assign(mesh.positions.size(), 0);
  for (Index h = 0; h < quads.half_edge_count(); ++h) {
    ++quads.valence[quads.from(h)];
    if (quads.opposite[h] < 0) quads.is_border[quads.from(h)] = quads.is_border[quads.to(h)] = 1;
  }
  quads.loops = border_loops<4>(quads.opposite);
  return quads;
}

std::string listed(std::string_view one, std::string_view several,
                   const std::vector<Index>& from_0) {
  std::vector<Index> shown;
  for (const Index i : from_0) {
    if (shown.size() == kNamedInDefects) break;
    shown.push_back(i + 1);
  }
  return fmt::format("{} {} ({}{})", from_0.size(), from_0.size() == 1 ? one : several,
                     fmt::join(shown, ", "), from_0.size() > kNamedInDefects ? ", ..." : "");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
