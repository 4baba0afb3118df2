// cut_in_two(), cut_across(), paths_across(), cost_of_cuts(), unfolds() and unfolds_at_creases() of
// choose_cuts.h.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/seams/cut_paths.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// Relative: a border costs more than another by more than rounding.
constexpr double kLonger = 1e-9;
constexpr double kFar = std::numeric_limits<double>::infinity();

// Grows two connected parts of a chart around planes, and moves these into the middle of what they
// have [CSAD04]. What is not divided are polygons of the file, but where there is only one.
class TwoParts {
 public:
  TwoParts(const SurfaceMesh& mesh, const CutPreferences& wanted)
      : mesh_(mesh), cost_(cut_costs(mesh, wanted)), tiles_(mesh.face_count()) {
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
  static constexpr int kRounds = 6;  // of [CSAD04]; two planes settle in three or four
  // Cosine of the angle to its plane above which a face may go to the other part for the sake of a
  // shorter border.
  static constexpr double kMovable = 0.7;

  void grow_around_planes(const StopCheck& stop) {
    std::array<Index, 2> seeds = first_seeds();
    for (int k = 0; k < kRounds; ++k) {
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

  // Tiles as far from each other as their normals go, else across faces.
  std::array<Index, 2> first_seeds() {
    Vector3 mean = Vector3::Zero();
    for (const Vector3& n : normal_) mean += n;
    const Index one = farthest_from(mean.stableNormalized(), 0);
    const Index other = farthest_from(unit(one), one);
    if (one != other && unit(one).dot(unit(other)) < 1 - kCurved) return {one, other};
    return ends();
  }

  // Tiles as far from each other as faces go.
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

  // Half-edges from each tile to another one.
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

  // Both at once, next the tile that costs least: area times squared distance of its normal.
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

  // Both at once, tile by tile, the part with the smaller area first.
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

  // Tiles with one neighbour in their part, and a border with the other that costs more, go over to
  // it.
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
        if (own.size() > 1 || sizes[1 - other] == 1 || !(border > inside * (1 + kLonger)) ||
            unit(t).dot(planes[other]) < kMovable)
          continue;
        part_[t] = 1 - mine;
        --sizes[1 - other];
        ++sizes[other];
        any = true;
      }
    }
  }

  const SurfaceMesh& mesh_;
  const Vec cost_;
  UnionFind tiles_;              // faces: those of a polygon
  std::vector<Vector3> normal_;  // of tiles, by their first faces: twice the area
  std::vector<int> part_;        // likewise, 0 or 1
};

// The cheapest way across a chart, for the area of its smaller side.
//
// Paths run from one boundary vertex to another and touch the outer loop nowhere else; along holes
// they cost nothing. They are looked for between windows of the boundary: the two sides of the
// chart at the same distance from one of its ends, or one place and all others.
class Across {
 public:
  Across(const SurfaceMesh& mesh, const CutPreferences& wanted)
      : mesh_(mesh),
        cost_(cut_costs(mesh, wanted)),
        leaving_(to_size(mesh.vertex_count())),
        place_(to_size(mesh.vertex_count()), -1) {
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      const Index o = mesh.opposite(h);
      leaving_[mesh.from_vertex(h)].push_back({mesh.to_vertex(h), h, o >= 0 ? cost_[h] : 0.0});
      if (o < 0) leaving_[mesh.to_vertex(h)].push_back({mesh.from_vertex(h), h, 0.0});
    }
    const auto& loops = mesh.boundary_loops();
    std::size_t longest = 0;
    for (std::size_t l = 1; l < loops.size(); ++l)
      if (loops[l].size() > loops[longest].size()) longest = l;
    take_outer(loops[longest]);
  }

  // Paths across the chart as a map lays it out. uv: 2 #V, injective.
  Across(const SurfaceMesh& mesh, const CutPreferences& wanted, const Vec& uv)
      : Across(mesh, wanted) {
    const auto& loops = mesh.boundary_loops();
    const auto area = [&](const std::vector<Index>& loop) { return enclosed_area(uv, loop); };
    take_outer(*std::max_element(loops.begin(), loops.end(),
                                 [&](const auto& a, const auto& b) { return area(a) < area(b); }));
    uv_ = uv;
  }

  std::vector<char> cut(PathsAcross paths, const StopCheck& stop) {
    const auto n = static_cast<Index>(outer_.size());
    const Index v = paths == PathsAcross::FromOverlaps ? most_turned() : -1;
    const auto take = [&](const Search& search, Index end) { take_if_better(search, end); };
    if (v >= 0) {
      for (Index k = 0; k < kWindows; ++k) {
        stop.poll();
        const Index from = k * n / kWindows, to = (k + 1) * n / kWindows;
        search_between(
            {v},
            [&](Index w) {
              const Index i = (place_[w] - place_[v] + n) % n;
              return w != v && i >= from && i < to;
            },
            take);
      }
    } else {
      search_between_ends(stop, take);
    }
    return best_.empty() ? std::vector<char>(to_size(mesh_.half_edge_count()), 0) : best_;
  }

  // Those between the ends, one a window, and from each bottom of a bay to every part of the outer
  // loop and every other bottom.
  std::vector<PathAcross> all_paths(const StopCheck& stop) {
    std::vector<PathAcross> paths;
    const auto take = [&](const Search& search, Index end) {
      if (std::optional<PathAcross> path = path_of(search, end)) paths.push_back(std::move(*path));
    };
    search_between_ends(stop, take);
    const auto n = static_cast<Index>(outer_.size());
    const std::vector<Index> bottoms = bottoms_of_bays();
    for (const Index v : bottoms) {
      stop.poll();
      const Search search = search_from({v}, [](Index) { return false; });
      std::vector<Index> nearest(kParts, -1);
      for (const Index w : outer_) {
        if (w == v || search.entered[to_size(w)].first < 0) continue;
        Index& best = nearest[to_size((place_[w] - place_[v] + n) % n * kParts / n)];
        if (best < 0 || search.distance[to_size(w)] < search.distance[to_size(best)]) best = w;
      }
      nearest.insert(nearest.end(), bottoms.begin(), bottoms.end());
      std::sort(nearest.begin(), nearest.end());
      nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
      for (const Index w : nearest)
        if (w >= 0 && w != v) take(search, w);
    }
    return paths;
  }

 private:
  struct Way {
    Index to, half_edge;
    double cost;
  };
  struct Search {
    std::vector<double> distance;
    std::vector<std::pair<Index, Index>> entered;  // vertex, half-edge; -1 where it starts
  };
  using Found = std::function<void(const Search&, Index end)>;
  static constexpr Index kWindows = 8;  // a part has an eighth of the way at least
  // Parts of the outer loop that paths from the bottom of a bay are looked for to.
  static constexpr Index kParts = 12;
  // Bottoms of bays at most, the largest bays first.
  static constexpr std::size_t kMostBays = 8;
  // Parts of the square root of the area of the outer loop: smaller wiggles are no bays.
  static constexpr double kBay = 0.06;
  // The smaller side of a path, as a part of the area, at least.
  static constexpr double kSmallestSide = 0.04;

  void take_outer(const std::vector<Index>& loop) {
    outer_ = loop;
    std::fill(place_.begin(), place_.end(), -1);
    for (std::size_t i = 0; i < outer_.size(); ++i) place_[outer_[i]] = static_cast<Index>(i);
  }

  static double enclosed_area(const Vec& uv, const std::vector<Index>& loop) {
    double twice = 0;
    const Vector2 origin = uv.segment<2>(2 * loop.front());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2 a = uv.segment<2>(2 * loop[i]) - origin,
                    b = uv.segment<2>(2 * loop[(i + 1) % loop.size()]) - origin;
      twice += cross(a, b);
    }
    return twice / 2;
  }

  void search_between_ends(const StopCheck& stop, const Found& found) {
    const auto n = static_cast<Index>(outer_.size());
    const Index one = farthest(distances(outer_[0]));
    const Vec far = distances(one);
    const Index other = farthest(far);
    const Index along = (place_[other] - place_[one] + n) % n;
    for (Index k = 1; k + 2 < kWindows; ++k) {
      stop.poll();
      const double low = far[other] * k / kWindows, high = far[other] * (k + 2) / kWindows;
      const auto is_in = [&](Index w) { return far[w] >= low && far[w] <= high; };
      const auto is_left = [&](Index w) { return (place_[w] - place_[one] + n) % n < along; };
      std::vector<Index> sources;
      for (const Index w : outer_)
        if (w != one && is_in(w) && is_left(w)) sources.push_back(w);
      search_between(
          sources, [&](Index w) { return w != other && is_in(w) && !is_left(w); }, found);
    }
  }

  Vector2 place_of(Index vertex) const { return uv_.segment<2>(2 * vertex); }

  // Vertices of the outer loop where its outline, but for wiggles, turns to the right: corners of
  // an L, ends of the bays between limbs.
  std::vector<Index> bottoms_of_bays() const {
    const auto n = static_cast<Index>(outer_.size());
    const double size = std::sqrt(enclosed_area(uv_, outer_));
    const std::vector<Index> corners = corners_of_outline(kBay * size);
    std::vector<std::pair<double, Index>> bays;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto at = [&](std::size_t i) {
        return place_of(outer_[to_size(corners[i % corners.size()] % n)]);
      };
      const Vector2 in = at(k) - at(k + corners.size() - 1), out = at(k + 1) - at(k);
      const double depth = -cross(in, out) / std::max(in.norm(), out.norm());
      if (depth > kBay * size) bays.emplace_back(-depth, outer_[to_size(corners[k])]);
    }
    std::sort(bays.begin(), bays.end());
    if (bays.size() > kMostBays) bays.resize(kMostBays);
    std::vector<Index> bottoms;
    for (const auto& [unused, v] : bays) bottoms.push_back(v);
    return bottoms;
  }

  // Places of the corners of a polygon that the outer loop is nowhere farther from than this
  // [DP73], from the two that are farthest from each other on.
  std::vector<Index> corners_of_outline(double tolerance) const {
    const auto n = static_cast<Index>(outer_.size());
    const auto at = [&](Index i) { return place_of(outer_[to_size(i % n)]); };
    const auto farthest_from = [&](Index i) {
      Index most = i;
      for (Index k = 0; k < n; ++k)
        if ((at(k) - at(i)).squaredNorm() > (at(most) - at(i)).squaredNorm()) most = k;
      return most;
    };
    const Index first = farthest_from(0), second = farthest_from(first);
    std::vector<Index> corners;
    std::vector<std::pair<Index, Index>> runs{{second, first + (first < second ? n : 0)},
                                              {first, second + (second < first ? n : 0)}};
    while (!runs.empty()) {
      const auto [from, to] = runs.back();
      runs.pop_back();
      const Vector2 chord = at(to) - at(from);
      const double squared = chord.squaredNorm();
      Index most = -1;
      double far = tolerance;
      for (Index k = from + 1; k < to; ++k) {
        const Vector2 p = at(k) - at(from);
        const double t = squared > 0 ? std::clamp(p.dot(chord) / squared, 0.0, 1.0) : 0;
        if (const double d = (p - t * chord).norm(); d > far) far = d, most = k;
      }
      if (most < 0) {
        corners.push_back(from % n);
        continue;
      }
      runs.emplace_back(most, to);
      runs.emplace_back(from, most);
    }
    return corners;
  }

  // None where one side has next to no area, or nothing is cut.
  std::optional<PathAcross> path_of(const Search& search, Index end) const {
    PathAcross path;
    std::vector<Index> vertices{end};
    for (Index v = end; search.entered[to_size(v)].first >= 0;) {
      const auto [before, h] = search.entered[to_size(v)];
      if (mesh_.opposite(h) >= 0) path.half_edges.push_back(h);
      vertices.push_back(v = before);
    }
    if (path.half_edges.empty()) return std::nullopt;
    std::reverse(vertices.begin(), vertices.end());
    const auto n = static_cast<Index>(outer_.size());
    const auto add_outer = [&](Index from, Index to, std::vector<Index>& outline) {
      for (Index i = (from + 1) % n; i != to; i = (i + 1) % n)
        outline.push_back(outer_[to_size(i)]);
    };
    path.outlines[0] = vertices;
    add_outer(place_[end], place_[vertices.front()], path.outlines[0]);
    path.outlines[1].assign(vertices.rbegin(), vertices.rend());
    add_outer(place_[vertices.front()], place_[end], path.outlines[1]);
    const double all = enclosed_area(uv_, outer_);
    path.smaller_area =
        std::min(enclosed_area(uv_, path.outlines[0]), enclosed_area(uv_, path.outlines[1]));
    if (!(path.smaller_area > kSmallestSide * all)) return std::nullopt;
    for (const Index h : path.half_edges) path.length += mesh_.edge_length(h);
    return path;
  }

  // The boundary vertex around which there is most, if that is more than fits into the plane.
  Index most_turned() const {
    Vec angle = Vec::Zero(mesh_.vertex_count());
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      angle[mesh_.from_vertex(h)] += corner_angle(mesh_, h).radians();
    Index most = -1;
    double largest = 2 * std::numbers::pi - kCurved;
    for (const Index v : outer_)
      if (angle[v] > largest) largest = angle[v], most = v;
    return most;
  }

  Vec distances(Index start) const {
    Vec distance = Vec::Constant(mesh_.vertex_count(), kFar);
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    distance[start] = 0;
    front.emplace(0, start);
    while (!front.empty()) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance[v]) continue;
      for (const Way& way : leaving_[v]) {
        const double next = d + mesh_.edge_length(way.half_edge);
        if (next >= distance[way.to]) continue;
        distance[way.to] = next;
        front.emplace(next, way.to);
      }
    }
    return distance;
  }
  Index farthest(const Vec& distance) const {
    return *std::max_element(outer_.begin(), outer_.end(),
                             [&](Index a, Index b) { return distance[a] < distance[b]; });
  }

  // Paths touch the outer loop at their ends only.
  Search search_from(const std::vector<Index>& sources, const std::function<bool(Index)>& is_end,
                     Index* end = nullptr) const {
    Search search{std::vector<double>(to_size(mesh_.vertex_count()), kFar),
                  std::vector<std::pair<Index, Index>>(to_size(mesh_.vertex_count()), {-1, -1})};
    std::vector<double>& distance = search.distance;
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (const Index v : sources) {
      distance[v] = 0;
      front.emplace(0, v);
    }
    while (!front.empty()) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance[v]) continue;
      if (d > 0 && place_[v] >= 0) {
        if (!is_end(v)) continue;  // nowhere else along the outer loop
        *end = v;
        break;
      }
      for (const Way& way : leaving_[v]) {
        const bool is_outer = mesh_.opposite(way.half_edge) < 0 && place_[v] >= 0;
        if (is_outer || d + way.cost >= distance[way.to]) continue;
        distance[way.to] = d + way.cost;
        search.entered[way.to] = {v, way.half_edge};
        front.emplace(distance[way.to], way.to);
      }
    }
    return search;
  }

  void search_between(const std::vector<Index>& sources, const std::function<bool(Index)>& is_end,
                      const Found& found) const {
    Index end = -1;
    const Search search = search_from(sources, is_end, &end);
    if (end >= 0) found(search, end);
  }

  void take_if_better(const Search& search, Index end) {
    std::vector<char> is_cut(to_size(mesh_.half_edge_count()), 0);
    for (Index v = end; search.entered[v].first >= 0; v = search.entered[v].first)
      if (const Index h = search.entered[v].second, o = mesh_.opposite(h); o >= 0)
        is_cut[h] = is_cut[o] = 1;
    const double price = search.distance[end] / smaller_area(is_cut);
    if (!(price < price_)) return;
    price_ = price;
    best_ = std::move(is_cut);
  }

  double smaller_area(const std::vector<char>& is_cut) const {
    std::vector<Index> opposite = mesh_.opposites();
    for (std::size_t h = 0; h < opposite.size(); ++h)
      if (is_cut[h]) opposite[h] = -1;
    const std::vector<Index> part = face_components(opposite);
    double area[2] = {0, 0};
    for (Index f = 0; f < mesh_.face_count(); ++f)
      area[part[f] > 0] += area_vector(mesh_, f).norm();
    return std::min(area[0], area[1]);
  }

  const SurfaceMesh& mesh_;
  const Vec cost_;
  std::vector<std::vector<Way>> leaving_;
  std::vector<Index> place_;  // #V: place in the outer loop, -1 elsewhere
  std::vector<Index> outer_;  // the loop with most vertices, or the outer one of the map
  Vec uv_;                    // 2 #V, or nothing
  std::vector<char> best_;
  double price_ = kFar;
};

// The same cuts along straighter paths, where that leaves as many parts, each planar.
std::vector<char> smoothed(const SurfaceMesh& chart, const CutPreferences& wanted,
                           std::vector<char> is_cut, const StopCheck& stop) {
  std::vector<char> straight = is_cut;
  smooth_cuts(chart, {}, cut_costs(chart, wanted), straight, stop);
  if (straight == is_cut) return is_cut;
  const auto parts = [&](const std::vector<char>& flags) {
    return chart.cut_along(flags, nullptr).split(stop);
  };
  const std::vector<SurfacePiece> after = parts(straight);
  const bool is_planar_each = std::all_of(
      after.begin(), after.end(), [](const SurfacePiece& part) { return is_planar(*part.mesh); });
  return is_planar_each && after.size() == parts(is_cut).size() ? straight : is_cut;
}

}  // namespace

std::vector<char> cut_in_two(const SurfaceMesh& chart, const CutPreferences& wanted,
                             PartsAround centres, const StopCheck& stop) {
  return smoothed(chart, wanted, TwoParts(chart, wanted).cut(centres, stop), stop);
}

std::vector<char> cut_across(const SurfaceMesh& chart, const CutPreferences& wanted,
                             PathsAcross paths, const StopCheck& stop) {
  return smoothed(chart, wanted, Across(chart, wanted).cut(paths, stop), stop);
}

std::vector<PathAcross> paths_across(const SurfaceMesh& chart, const CutPreferences& wanted,
                                     const Vec& uv, const StopCheck& stop) {
  return Across(chart, wanted, uv).all_paths(stop);
}

std::vector<char> cut_along_path(const SurfaceMesh& chart, const CutPreferences& wanted,
                                 const PathAcross& path, const StopCheck& stop) {
  std::vector<char> is_cut(to_size(chart.half_edge_count()), 0);
  for (const Index h : path.half_edges) is_cut[h] = is_cut[chart.opposite(h)] = 1;
  return smoothed(chart, wanted, std::move(is_cut), stop);
}

double cost_of_cuts(const SurfaceMesh& mesh, const CutPreferences& wanted,
                    const std::vector<char>& is_cut) {
  const Vec cost = cut_costs(mesh, wanted);
  double sum = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h]) sum += 0.5 * cost[h];
  return sum;
}

bool unfolds(const SurfaceMesh& chart) {
  return chart.rest_triangles().empty() && angle_defects(chart).cwiseAbs().maxCoeff() <= kCurved;
}

bool unfolds_at_creases(const SurfaceMesh& chart, const CutPreferences& wanted) {
  if (!unfolds(chart)) return false;
  if (dihedral_angles(chart).maxCoeff() <= kCurved) return true;
  const Vec sharp = sharpness(chart, wanted.creases);
  for (Index h = 0; h < chart.half_edge_count(); ++h)
    if (sharp[h] > 0 && chart.opposite(h) >= 0) return true;
  return false;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
