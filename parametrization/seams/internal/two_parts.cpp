#include "majorant/parametrization/seams/internal/two_parts.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <set>
#include <tuple>

#include "majorant/mesh/geometry.h"
#include "majorant/mesh/union_find.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"

namespace majorant {
namespace {

// Rounds of growth [CSAD04]; two planes converge in three or four.
constexpr int kPlaneRounds = 6;
// A face may go to the other part for the sake of a shorter border if the cosine of its angle to
// that part's plane exceeds this.
constexpr double kMinPlaneCosine = 0.7;
// Relative differences of costs below this are rounding.
constexpr double kCostRounding = 1e-9;

// Two connected parts of a chart that grow around planes, which then move to the means of their
// parts [CSAD04]. Tiles are polygons of the file, or faces if there is one polygon only.
class TwoParts {
 public:
  TwoParts(const SurfaceMesh& mesh, const Vec& cost)
      : mesh_(mesh), cost_(cost), tiles_(mesh.face_count()) {
    join_polygons();
    normal_.assign(to_size(mesh.face_count()), Vector3::Zero());
    for (Index f = 0; f < mesh.face_count(); ++f) normal_[tiles_.find(f)] += area_vector(mesh, f);
  }

  std::vector<char> cut(PartsAround centres, const StopCheck& stop) {
    if (centres == PartsAround::Ends) {
      stop.poll();
      grow_evenly(ends());
    } else {
      grow_around_planes(stop);
      smooth();
    }
    std::vector<char> is_cut(to_size(mesh_.half_edge_count()), 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (const Index o = mesh_.opposite(h); o >= 0)
        is_cut[h] = part(face_of(h)) != part(face_of(o));
    return is_cut;
  }

 private:
  void grow_around_planes(const StopCheck& stop) {
    std::array<Index, 2> seeds = first_seeds();
    for (int k = 0; k < kPlaneRounds; ++k) {
      stop.poll();
      const std::array<Vector3, 2> planes = k == 0 ? planes_at(seeds) : planes_of_parts();
      if (k > 0) seeds = nearest_to(planes);
      grow(seeds, planes);
    }
  }

  int part(Index face) { return part_[tiles_.find(face)]; }
  Vector3 unit(Index tile) const { return normal_[tile].stableNormalized(); }

  void join_polygons() {
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (mesh_.opposite(h) > h && is_inner(mesh_, h))
        tiles_.join(face_of(h), face_of(mesh_.opposite(h)));
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (tiles_.find(f) != tiles_.find(0)) return;
    tiles_ = UnionFind(mesh_.face_count());
  }

  // Returns two tiles whose normals differ most or, if these do not differ, that are farthest apart
  // across faces.
  std::array<Index, 2> first_seeds() {
    Vector3 mean = Vector3::Zero();
    for (const Vector3& n : normal_) mean += n;
    const Index one = farthest_from(mean.stableNormalized(), 0);
    const Index other = farthest_from(unit(one), one);
    if (one != other && unit(one).dot(unit(other)) < 1 - kCurved) return {one, other};
    return ends();
  }

  // Returns two tiles that are farthest apart across faces.
  std::array<Index, 2> ends() {
    const Index end = last_reached(tiles_.find(0));
    return {end, last_reached(end)};
  }

  Index farthest_from(const Vector3& normal, Index otherwise) {
    Index farthest = tiles_.find(otherwise);
    double least = 1;
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (tiles_.find(f) == f && unit(f).dot(normal) < least) {
        least = unit(f).dot(normal);
        farthest = f;
      }
    return farthest;
  }

  Index last_reached(Index start) {
    std::vector<char> seen(to_size(mesh_.face_count()), 0);
    std::vector<Index> queue{start};
    const std::vector<std::vector<Index>> sides = sides_of_tiles();
    seen[start] = 1;
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const Index h : sides[queue[k]])
        if (const Index t = tiles_.find(face_of(mesh_.opposite(h))); !seen[t]) {
          seen[t] = 1;
          queue.push_back(t);
        }
    return queue.back();
  }

  // Returns the half-edges from each tile to others.
  std::vector<std::vector<Index>> sides_of_tiles() {
    std::vector<std::vector<Index>> sides(to_size(mesh_.face_count()));
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      if (mesh_.opposite(h) < 0) continue;
      const Index t = tiles_.find(face_of(h));
      if (t != tiles_.find(face_of(mesh_.opposite(h)))) sides[t].push_back(h);
    }
    return sides;
  }

  std::array<Vector3, 2> planes_at(const std::array<Index, 2>& seeds) const {
    return {unit(seeds[0]), unit(seeds[1])};
  }

  std::array<Vector3, 2> planes_of_parts() {
    std::array<Vector3, 2> planes = {Vector3::Zero(), Vector3::Zero()};
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (tiles_.find(f) == f) planes[static_cast<std::size_t>(part_[f])] += normal_[f];
    for (Vector3& plane : planes) plane = plane.stableNormalized();
    return planes;
  }

  std::array<Index, 2> nearest_to(const std::array<Vector3, 2>& planes) {
    std::array<Index, 2> seeds = {-1, -1};
    std::array<double, 2> most = {-2, -2};
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (tiles_.find(f) != f) continue;
      const auto p = static_cast<std::size_t>(part_[f]);
      const double cosine = unit(f).dot(planes[p]);
      if (!(cosine > most[p]) && seeds[p] >= 0) continue;
      most[p] = cosine;
      seeds[p] = f;
    }
    return seeds;
  }

  // Grows both parts at once, next the tile of least cost: area times squared difference of its
  // normal.
  void grow(const std::array<Index, 2>& seeds, const std::array<Vector3, 2>& planes) {
    struct Offer {
      double cost;
      Index tile;
      int part;
      bool operator>(const Offer& o) const {
        return std::tie(cost, tile, part) > std::tie(o.cost, o.tile, o.part);
      }
    };
    const std::vector<std::vector<Index>> sides = sides_of_tiles();
    std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers;
    part_.assign(to_size(mesh_.face_count()), -1);
    for (int p = 0; p < 2; ++p) offers.push({-1, seeds[static_cast<std::size_t>(p)], p});
    while (!offers.empty()) {
      const Offer offer = offers.top();
      offers.pop();
      if (part_[offer.tile] >= 0) continue;
      part_[offer.tile] = offer.part;
      const Vector3& plane = planes[static_cast<std::size_t>(offer.part)];
      for (const Index h : sides[offer.tile]) {
        const Index t = tiles_.find(face_of(mesh_.opposite(h)));
        if (part_[t] < 0)
          offers.push({normal_[t].norm() * (unit(t) - plane).squaredNorm(), t, offer.part});
      }
    }
  }

  // Grows both parts at once, tile by tile, the part with the smaller area first.
  void grow_evenly(const std::array<Index, 2>& seeds) {
    const std::vector<std::vector<Index>> sides = sides_of_tiles();
    part_.assign(to_size(mesh_.face_count()), -1);
    std::array<std::vector<Index>, 2> reached;  // by the number of tiles on the way
    std::array<std::size_t, 2> next = {0, 0};
    std::array<double, 2> area = {0, 0};
    const auto take = [&](Index t, std::size_t p) {
      if (part_[t] >= 0) return;
      part_[t] = static_cast<int>(p);
      area[p] += normal_[t].norm();
      reached[p].push_back(t);
    };
    for (std::size_t p = 0; p < 2; ++p) take(seeds[p], p);
    for (;;) {
      const auto can_grow = [&](std::size_t p) { return next[p] < reached[p].size(); };
      if (!can_grow(0) && !can_grow(1)) return;
      const std::size_t p = !can_grow(1) || (can_grow(0) && area[0] <= area[1]) ? 0 : 1;
      for (const Index h : sides[reached[p][next[p]++]])
        take(tiles_.find(face_of(mesh_.opposite(h))), p);
    }
  }

  // Moves tiles to the other part if they have one neighbour in their own and a more expensive
  // border with the other.
  void smooth() {
    const std::vector<std::vector<Index>> sides = sides_of_tiles();
    const std::array<Vector3, 2> planes = planes_of_parts();
    std::array<Index, 2> sizes = {0, 0};
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (tiles_.find(f) == f) ++sizes[static_cast<std::size_t>(part_[f])];
    for (bool any = true; any;) {
      any = false;
      for (Index t = 0; t < mesh_.face_count(); ++t) {
        if (tiles_.find(t) != t) continue;
        const int mine = part_[t];
        const auto other = static_cast<std::size_t>(1 - mine);
        double inside = 0, border = 0;
        std::set<Index> own;
        for (const Index h : sides[t]) {
          const Index n = tiles_.find(face_of(mesh_.opposite(h)));
          (part_[n] == mine ? inside : border) += cost_[h];
          if (part_[n] == mine) own.insert(n);
        }
        if (own.size() > 1 || sizes[1 - other] == 1 || !(border > inside * (1 + kCostRounding)) ||
            unit(t).dot(planes[other]) < kMinPlaneCosine)
          continue;
        part_[t] = 1 - mine;
        --sizes[1 - other];
        ++sizes[other];
        any = true;
      }
    }
  }

  const SurfaceMesh& mesh_;
  const Vec& cost_;
  UnionFind tiles_;              // faces: those of a polygon
  std::vector<Vector3> normal_;  // of tiles, by their first faces; length twice the area
  std::vector<int> part_;        // likewise, 0 or 1
};

}  // namespace

std::vector<char> border_of_two_parts(const SurfaceMesh& chart, const Vec& cost,
                                      PartsAround centres, const StopCheck& stop) {
  return TwoParts(chart, cost).cut(centres, stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
