// Cheapest paths across a chart, from one vertex of its outline to another.
//
//   const std::vector<Index>& outline = longest_loop(*mesh);
//   const ChartPaths paths(*mesh, cut_costs(*mesh, {}), outline);
//   double least = 1e9;
//   paths.find_between_ends({}, [&](const PathSearch& search, Index end) {
//     least = std::min(least, search.distance[end]);
//   });
//
// Paths touch the outline only at their ends. Along holes they cost nothing.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the boundary loop with most vertices.
const std::vector<Index>& longest_loop(const SurfaceMesh& mesh);

// The cheapest paths from some vertices to others.
struct PathSearch {
  std::vector<double> distance;  // #V, +inf where no path leads
  std::vector<std::pair<Index, Index>>
      entered;  // #V: previous vertex and half-edge, -1 at a source
};

class ChartPaths {
 public:
  using IsEnd = std::function<bool(Index)>;
  using Found = std::function<void(const PathSearch&, Index end)>;
  // The number of windows of the outline between which paths are searched, so that a part has at
  // least an eighth of the outline.
  static constexpr Index kWindows = 8;

  // cost: 3 #F, positive; outline: one of the boundary loops. The mesh outlives this.
  ChartPaths(const SurfaceMesh& mesh, const Vec& cost, std::vector<Index> outline);

  const std::vector<Index>& outline() const { return outline_; }
  // Returns the number of steps along the outline from one of its vertices to another.
  Index steps(Index from, Index to) const;
  // Returns paths to all vertices.
  PathSearch all_from(Index source) const;
  // Finds the cheapest path to a vertex of the outline that is an end, if there is one.
  void find(const std::vector<Index>& sources, const IsEnd& is_end, const Found& found) const;
  // Finds one path a window, between the two sides of the chart at the same distance from one of
  // its ends. The ends are as far apart along edges as possible. Stopped.
  void find_between_ends(const StopCheck& stop, const Found& found) const;
  // Finds one path from this vertex of the outline to each window of it. Stopped.
  void find_around(Index source, const StopCheck& stop, const Found& found) const;
  // Returns the vertex of the outline with the largest angle, if that is a full turn or more, else
  // -1.
  Index overlapping_corner() const;

 private:
  struct Way {
    Index to, half_edge;
    double cost;
  };

  PathSearch search(const std::vector<Index>& sources, const IsEnd& is_end, Index* end) const;
  Vec edge_distances(Index source) const;
  Index farthest(const Vec& distance) const;

  const SurfaceMesh& mesh_;
  std::vector<std::vector<Way>> leaving_;  // #V
  std::vector<Index> outline_;
  std::vector<Index> place_;  // #V: place in the outline, -1 elsewhere
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
