#include "majorant/parametrization/seams/internal/sharp_charts.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "majorant/mesh/union_find.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"

namespace majorant {
namespace {

// A component of n faces has at most kMinChartLimit + n / kFacesPerChart charts, a number that a
// texture artist can handle; a box has six.
constexpr Index kMinChartLimit = 2, kFacesPerChart = 200;

class SharpCharts {
 public:
  SharpCharts(const SurfaceMesh& mesh, double radians)
      : mesh_(mesh),
        charts_(mesh.face_count()),
        component_(face_components(mesh.opposites())),
        size_(to_size(mesh.face_count()), 0),
        borders_(to_size(mesh.face_count())) {
    const Vec angle = dihedral_angles(mesh);
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (const Index o = mesh.opposite(h); o > h && angle[h] <= radians)
        charts_.join(face_of(h), face_of(o));
    for (Index f = 0; f < mesh.face_count(); ++f) ++size_[charts_.find(f)];
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      if (mesh.opposite(h) < 0) continue;
      const Index a = charts_.find(face_of(h)), b = charts_.find(face_of(mesh.opposite(h)));
      if (a != b) borders_[a][b] += mesh.edge_length(h);
    }
  }

  void join_small() {
    const Index components =
        component_.empty() ? 0 : *std::max_element(component_.begin(), component_.end()) + 1;
    std::vector<Index> faces(to_size(components), 0), charts(to_size(components), 0);
    std::set<std::pair<Index, Index>> by_size;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      ++faces[component_[f]];
      if (charts_.find(f) != f) continue;
      ++charts[component_[f]];
      by_size.emplace(size_[f], f);
    }
    while (!by_size.empty()) {
      const auto [size, chart] = *by_size.begin();
      by_size.erase(by_size.begin());
      const std::size_t c = to_size(component_[chart]);
      const bool few = charts[c] <= kMinChartLimit + faces[c] / kFacesPerChart;
      if (borders_[chart].empty() || (few && size > 1)) continue;
      Index best = -1;
      double longest = -1;
      for (const auto& [other, length] : borders_[chart])
        if (length > longest) longest = length, best = other;
      by_size.erase({size_[best], best});
      by_size.emplace(size + size_[best], join(chart, best));
      --charts[c];
    }
  }

  std::vector<char> borders() {
    std::vector<char> is_cut(to_size(mesh_.half_edge_count()), 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (const Index o = mesh_.opposite(h); o >= 0)
        is_cut[h] = charts_.find(face_of(h)) != charts_.find(face_of(o));
    return is_cut;
  }

 private:
  // Joins two charts and returns the number of the result.
  Index join(Index a, Index b) {
    charts_.join(a, b);
    const Index joint = charts_.find(a), gone = joint == a ? b : a;
    borders_[joint].erase(gone);
    borders_[gone].erase(joint);
    for (const auto& [other, length] : borders_[gone]) {
      borders_[joint][other] += length;
      borders_[other].erase(gone);
      borders_[other][joint] += length;
    }
    borders_[gone].clear();
    size_[joint] += size_[gone];
    return joint;
  }

  const SurfaceMesh& mesh_;
  UnionFind charts_;
  const std::vector<Index> component_;            // #F
  std::vector<Index> size_;                       // faces, by number of the chart
  std::vector<std::map<Index, double>> borders_;  // by number of the chart: length with each other
};

}  // namespace

std::vector<char> sharp_charts(const SurfaceMesh& mesh, double angle) {
  SharpCharts charts(mesh, angle * std::numbers::pi / 180);
  charts.join_small();
  return charts.borders();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
