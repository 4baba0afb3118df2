#include "majorant/quads/check_quads.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <tuple>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/nearest_point.h"
#include "majorant/mesh/union_find.h"
#include "majorant/quads/exact_normals.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/surface_below.h"

namespace majorant {
namespace {

// Shares of judging that are done once corners are measured, and distances to and from the surface.
constexpr double kCornersShare = 0.1, kToSurfaceShare = 0.5, kFromSurfaceShare = 0.9;
constexpr double kThird = 1.0 / 3;  // of a share: middles, vertices and edges of quads
constexpr std::size_t kNamed = 8;   // places that a sentence names

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

// "3 quads are folded (1, 7, 9)"; of many the first.
std::string listed(std::string_view one, std::string_view several,
                   const std::vector<Index>& from_0) {
  std::vector<Index> shown;
  for (const Index i : from_0) {
    if (shown.size() == kNamed) break;
    shown.push_back(i + 1);
  }
  return fmt::format("{} {} ({}{})", from_0.size(), from_0.size() == 1 ? one : several,
                     fmt::join(shown, ", "), from_0.size() > kNamed ? ", ..." : "");
}

// Half-edge 4 q + k runs along quad q from its corner k to its corner k + 1 (mod 4).
Index quad_of(Index half_edge) { return half_edge / 4; }
Index after(Index half_edge) { return half_edge % 4 == 3 ? half_edge - 3 : half_edge + 1; }
Index before(Index half_edge) { return half_edge % 4 == 0 ? half_edge + 3 : half_edge - 1; }

// Of every component its Euler characteristic and its number of border loops, sorted.
using Components = std::vector<std::pair<Index, Index>>;

// Of a manifold whose half-edge `corners` f + k starts at corner k of face f, at from() of it, and
// has the one beyond it for opposite(); negative: none. on_loops: a vertex of every border loop.
template <class From, class Opposite>
Components components_of(Index faces, Index corners, Index vertices, const From& from,
                         const Opposite& opposite, const std::vector<Index>& on_loops) {
  UnionFind same(faces);
  for (Index h = 0; h < corners * faces; ++h)
    if (opposite(h) >= 0) same.join(h / corners, opposite(h) / corners);
  std::map<Index, std::pair<Index, Index>> found;  // by face
  std::vector<Index> name_of(to_size(vertices), -1);
  for (Index h = 0; h < corners * faces; ++h) {
    const Index name = same.find(h / corners);
    Index& euler_characteristic = found[name].first;
    if (h % corners == 0) ++euler_characteristic;      // the face
    if (opposite(h) < h) --euler_characteristic;       // the edge, of both sides once
    if (name_of[from(h)] < 0) ++euler_characteristic;  // the vertex
    name_of[from(h)] = name;
  }
  for (const Index v : on_loops) ++found[name_of[v]].second;
  Components all;
  for (const auto& [name, component] : found) all.push_back(component);
  std::sort(all.begin(), all.end());
  return all;
}

class QuadJudge {
 public:
  QuadJudge(const PolygonMesh& quads, const SurfaceMesh* surface, const std::vector<char>& features,
            const StopCheck& stop, double border_turn)
      : quads_(quads),
        surface_(surface),
        features_(features),
        stop_(stop),
        border_turn_(border_turn) {
    const auto vertices = static_cast<Index>(quads.positions.size());
    for (const Vector3& p : quads.positions)
      if (!p.allFinite()) throw InvalidArgument("check_quads: a position is not finite");
    for (const Index v : quads.polygons.indices())
      require_index("check_quads: vertex", v, vertices);
  }

  QuadCheck judge() {
    check_.count = static_cast<Index>(quads_.polygons.size());
    if (!are_all_quads() || !join_edges() || !has_single_fans()) return check_;
    check_.is_surface = true;
    count_topology();
    measure_corners();
    if (surface_) compare();
    return check_;
  }

 private:
  void blame(std::string defect) { check_.defects.push_back(std::move(defect)); }
  Index half_edge_count() const { return 4 * check_.count; }
  Index from(Index half_edge) const { return quads_.polygons[quad_of(half_edge)][half_edge % 4]; }
  Index to(Index half_edge) const { return from(after(half_edge)); }
  const Vector3& point(Index vertex) const { return quads_.positions[vertex]; }

  bool are_all_quads() {
    std::vector<Index> others;
    for (Index q = 0; q < check_.count; ++q) {
      const std::span<const Index> polygon = quads_.polygons[q];
      std::vector<Index> corners(polygon.begin(), polygon.end());
      std::sort(corners.begin(), corners.end());
      const bool repeats = std::adjacent_find(corners.begin(), corners.end()) != corners.end();
      if (corners.size() != 4 || repeats) others.push_back(q);
    }
    if (check_.count == 0) blame("there are no faces");
    if (!others.empty())
      blame(listed("face is no quad of four vertices", "faces are no quads of four vertices",
                   others));
    return check_.defects.empty();
  }

  // Opposites. An edge has at most two quads, which run against each other along it.
  bool join_edges() {
    std::vector<Index> order(to_size(half_edge_count()));
    std::iota(order.begin(), order.end(), 0);
    const auto ends = [&](Index h) { return std::minmax({from(h), to(h)}); };
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return std::tuple(ends(a), a) < std::tuple(ends(b), b); });
    opposite_.assign(order.size(), -1);
    std::vector<std::string> crowded, opposed;
    for (std::size_t i = 0, j = 0; i < order.size(); i = j) {
      while (j < order.size() && ends(order[j]) == ends(order[i])) ++j;
      const auto [a, b] = ends(order[i]);
      if (j - i > 2) crowded.push_back(fmt::format("({}, {})", a + 1, b + 1));
      if (j - i != 2) continue;
      if (from(order[i]) == from(order[i + 1]))
        opposed.push_back(fmt::format("({}, {})", a + 1, b + 1));
      opposite_[order[i]] = order[i + 1];
      opposite_[order[i + 1]] = order[i];
    }
    const auto blame_edges = [&](std::string_view what, const std::vector<std::string>& edges) {
      if (edges.empty()) return;
      const auto shown =
          edges.begin() + static_cast<std::ptrdiff_t>(std::min(kNamed, edges.size()));
      blame(fmt::format("{} {} (vertices {}{})", edges.size(), what,
                        fmt::join(edges.begin(), shown, ", "),
                        edges.size() > kNamed ? ", ..." : ""));
    };
    blame_edges("edges with more than two quads", crowded);
    blame_edges("edges along which both quads run the same way", opposed);
    return check_.defects.empty();
  }

  // The quads of every vertex hang together around it.
  bool has_single_fans() {
    corners_.assign(quads_.positions.size(), 0);
    is_border_.assign(quads_.positions.size(), 0);
    std::vector<Index> leaving(quads_.positions.size(), -1);
    for (Index h = 0; h < half_edge_count(); ++h) {
      ++corners_[from(h)];
      if (leaving[from(h)] < 0 || opposite_[h] < 0) leaving[from(h)] = h;  // the fan's first
      if (opposite_[h] < 0) is_border_[from(h)] = is_border_[to(h)] = 1;
    }
    std::vector<Index> touching;
    for (Index v = 0; v < static_cast<Index>(corners_.size()); ++v) {
      if (leaving[v] < 0) continue;
      Index fan = 0, h = leaving[v];
      do {
        ++fan;
        h = opposite_[before(h)];
      } while (h >= 0 && h != leaving[v] && fan <= corners_[v]);
      if (fan != corners_[v]) touching.push_back(v);
    }
    if (!touching.empty())
      blame(listed("vertex in which quads merely touch", "vertices in which quads merely touch",
                   touching));
    return touching.empty();
  }

  void count_topology() {
    Topology& t = check_.topology;
    UnionFind components(check_.count);
    Index borders = 0;
    for (Index h = 0; h < half_edge_count(); ++h) {
      if (opposite_[h] < 0)
        ++borders;
      else
        components.join(quad_of(h), quad_of(opposite_[h]));
    }
    for (const Index corners : corners_) t.vertices += corners > 0;
    for (Index v = 0; v < static_cast<Index>(corners_.size()); ++v)
      check_.irregular += corners_[v] > 0 && !is_border_[v] && corners_[v] != 4;
    t.edges = (half_edge_count() + borders) / 2;
    t.faces = check_.count;
    for (Index q = 0; q < check_.count; ++q) t.components += components.find(q) == q;
    find_loops();
    t.boundary_loops = static_cast<Index>(loops_.size());
  }

  // Border loops as half-edges, the quads on their left.
  void find_loops() {
    std::vector<char> seen(to_size(half_edge_count()), 0);
    for (Index first = 0; first < half_edge_count(); ++first) {
      if (opposite_[first] >= 0 || seen[first]) continue;
      std::vector<Index>& loop = loops_.emplace_back();
      for (Index h = first; !seen[h];) {
        seen[h] = 1;
        loop.push_back(h);
        for (h = after(h); opposite_[h] >= 0;) h = after(opposite_[h]);
      }
    }
  }

  void measure_corners() {
    double deviation = 0, least = std::numeric_limits<double>::infinity(), sum = 0;
    for (Index q = 0; q < check_.count; ++q) {
      stop_.poll_at(to_size(q));
      const std::array<Vector3, 4> p = corners_of(q);
      bool is_folded = false;
      double least_sine = std::numeric_limits<double>::infinity();
      const Vector3 n = (p[2] - p[0]).cross(p[3] - p[1]).stableNormalized();
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector3 &a = p[k], &b = p[(k + 1) % 4], &d = p[(k + 3) % 4];
        is_folded |= sign_of_normals({a, b}, {a, d}, {p[0], p[2]}, {p[1], p[3]}) <= 0;
        const Vector3 along = (b - a).stableNormalized(), back = (d - a).stableNormalized();
        least_sine = std::min(least_sine, along.cross(back).dot(n));
        deviation += std::abs(degrees(std::atan2(along.cross(back).norm(), along.dot(back))) - 90);
      }
      if (is_folded) check_.folded.push_back(q);
      least = std::min(least, least_sine);
      sum += least_sine;
    }
    check_.min_scaled_jacobian = least;
    check_.mean_scaled_jacobian = sum / check_.count;
    check_.angle_deviation = deviation / (4.0 * check_.count);
    if (!check_.folded.empty()) blame(listed("quad is folded", "quads are folded", check_.folded));
  }

  std::array<Vector3, 4> corners_of(Index q) const {
    const std::span<const Index> v = quads_.polygons[q];
    return {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
  }

  void compare() {
    const Topology &t = check_.topology, &s = surface_->topology();
    const std::size_t before = check_.defects.size();
    const auto compare_counts = [&](std::string_view what, Index ours, Index theirs) {
      if (ours != theirs)
        blame(fmt::format("{} of the quads: {}, of the surface: {}", what, ours, theirs));
    };
    compare_counts("Euler characteristic", t.euler_characteristic(), s.euler_characteristic());
    compare_counts("components", t.components, s.components);
    compare_counts("border loops", t.boundary_loops, s.boundary_loops);
    if (check_.defects.size() == before && are_other_components())
      blame(
          "Euler characteristics and border loops are those of the surface in sum, not component "
          "by component");
    compare_positions();
    if (t.boundary_loops == s.boundary_loops && t.boundary_loops > 0) compare_borders();
    if (!features_.empty()) compare_features();
  }

  bool are_other_components() const {
    std::vector<Index> ours, theirs;
    for (const auto& loop : loops_) ours.push_back(from(loop.front()));
    for (const auto& loop : surface_->boundary_loops()) theirs.push_back(loop.front());
    return components_of(
               check_.count, 4, static_cast<Index>(quads_.positions.size()),
               [&](Index h) { return from(h); }, [&](Index h) { return opposite_[h]; }, ours) !=
           components_of(
               surface_->face_count(), 3, surface_->vertex_count(),
               [&](Index h) { return surface_->from_vertex(h); },
               [&](Index h) { return surface_->opposite(h); }, theirs);
  }

  // Positions of the surface as the file has them.
  Points3 surface_points() const {
    return surface_->positions().rowwise() + surface_->origin().transpose();
  }

  void compare_positions() {
    const SurfaceBelow below(*surface_);
    Points3 middles(check_.count, 3);
    for (Index q = 0; q < check_.count; ++q) {
      const std::array<Vector3, 4> p = corners_of(q);
      middles.row(q) = (p[0] + p[1] + p[2] + p[3]) / 4;
    }
    const StopCheck told = stop_.between(kCornersShare, kToSurfaceShare);
    const std::vector<NearestPoint> nearest = below.tree().locate(middles, told.between(0, kThird));
    const std::vector<NearestFaces> near = faces_near_vertices(below, told);
    for (const NearestPoint& p : nearest)
      check_.hausdorff.to_surface = std::max(check_.hausdorff.to_surface, p.distance);
    for (const NearestFaces& faces : near)
      check_.hausdorff.to_surface = std::max(check_.hausdorff.to_surface, faces.distance);
    Points3 midpoints(half_edge_count(), 3);
    Index rows = 0;
    for (Index h = 0; h < half_edge_count(); ++h)
      if (opposite_[h] < h) midpoints.row(rows++) = (point(from(h)) + point(to(h))) / 2;
    midpoints.conservativeResize(rows, 3);
    check_.hausdorff.to_surface = below.tree().largest_distance(
        midpoints, check_.hausdorff.to_surface, told.between(2 * kThird, 1));
    for (Index q = 0; q < check_.count; ++q) {
      stop_.poll_at(to_size(q));
      const std::span<const Index> v = quads_.polygons[q];
      if (below.is_turned(corners_of(q), nearest[to_size(q)],
                          {&near[to_size(v[0])], &near[to_size(v[1])], &near[to_size(v[2])],
                           &near[to_size(v[3])]}))
        check_.turned.push_back(q);
    }
    if (!check_.turned.empty())
      blame(listed("quad is turned over", "quads are turned over", check_.turned));
    measure_from_surface(below.positions());
  }

  // Returns the nearest faces of each vertex; vertices without quads have none.
  std::vector<NearestFaces> faces_near_vertices(const SurfaceBelow& below,
                                                const StopCheck& told) const {
    constexpr Index kVerticesOfTask = 256;
    const auto count = static_cast<Index>(corners_.size());
    std::vector<NearestFaces> near(corners_.size());
    std::atomic<std::size_t> done = 0;
    const StopCheck share = told.between(kThird, 2 * kThird);
    parallel_tasks((count + kVerticesOfTask - 1) / kVerticesOfTask, [&](Index task, int) {
      share.poll();
      Index likely = -1;
      const Index last = std::min(count, (task + 1) * kVerticesOfTask);
      for (Index v = task * kVerticesOfTask; v < last; ++v) {
        if (corners_[to_size(v)] == 0) continue;
        near[to_size(v)] = below.faces_near(quads_.positions[to_size(v)], likely);
        likely = near[to_size(v)].faces.front();
      }
      share.advance(done += to_size(kVerticesOfTask), to_size(count));
    });
    return near;
  }

  void measure_from_surface(const Points3& positions) {
    Cells halves(2 * check_.count, 3);
    for (Index q = 0; q < check_.count; ++q) {
      const std::span<const Index> v = quads_.polygons[q];
      halves.row(2 * q) << v[0], v[1], v[2];
      halves.row(2 * q + 1) << v[0], v[2], v[3];
    }
    Points3 points(static_cast<Index>(quads_.positions.size()), 3);
    for (Index v = 0; v < static_cast<Index>(points.rows()); ++v)
      points.row(v) = quads_.positions[v];
    const SurfaceTree tree(points, halves);
    const Index faces = surface_->face_count(), vertices = surface_->vertex_count();
    Points3 samples(faces + vertices, 3);
    samples.topRows(vertices) = positions;
    for (Index f = 0; f < faces; ++f) {
      Vector3 sum = Vector3::Zero();
      for (int k = 0; k < 3; ++k) sum += positions.row(surface_->faces()(f, k));
      samples.row(vertices + f) = sum / 3;
    }
    const StopCheck told = stop_.between(kToSurfaceShare, kFromSurfaceShare);
    check_.hausdorff.from_surface = tree.largest_distance(samples, 0, told);
  }

  // Borders. A place on the surface's border: the loop, and the vertex of it that comes before,
  // plus the part of its edge.
  struct Place {
    Index loop;
    double along, distance;
  };

  // All border edges of the surface as triangles without an area, which are the segments.
  void open_borders(const Points3& positions) {
    const auto& loops = surface_->boundary_loops();
    Index edges = 0;
    for (const auto& loop : loops) edges += static_cast<Index>(loop.size());
    Cells segments(edges, 3);
    Index row = 0;
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (std::size_t i = 0; i < loops[l].size(); ++i) {
        const Index a = loops[l][i], b = loops[l][(i + 1) % loops[l].size()];
        segments.row(row++) << a, b, b;
        edge_places_.push_back({static_cast<Index>(l), static_cast<double>(i), 0});
      }
    border_tree_.emplace(positions, segments);
  }

  Place nearest_place(const Vector3& p) const {
    const NearestPoint nearest = border_tree_->nearest(p);
    Place place = edge_places_[nearest.face];
    place.along += std::clamp(1 - nearest.barycentric[0], 0.0, 1.0);
    place.distance = nearest.distance;
    return place;
  }

  // The nearest place of the border; where several vertices or edges of it are at one place, on all
  // of these.
  std::vector<Place> places_of(const Vector3& p, double close) const {
    const Place nearest = nearest_place(p);
    const std::vector<Index>& loop = surface_->boundary_loops()[nearest.loop];
    const auto before = to_size(static_cast<Index>(nearest.along)) % loop.size();
    for (const std::size_t i : {before, (before + 1) % loop.size()}) {
      const auto found = touching_.find(key_of(loop[i]));
      if (found == touching_.end() || (surface_->input_position(loop[i]) - p).norm() > close)
        continue;
      std::vector<Place> places;
      for (const auto& [on, along] : found->second) places.push_back({on, along, nearest.distance});
      return places;
    }
    const auto edges =
        touching_edges_.find(ends_of(loop[before], loop[(before + 1) % loop.size()]));
    if (edges == touching_edges_.end()) return {nearest};
    const auto start_of = [&](const Place& edge) {
      return key_of(surface_->boundary_loops()[edge.loop][static_cast<std::size_t>(edge.along)]);
    };
    const double part = nearest.along - static_cast<double>(before);
    std::vector<Place> places;
    for (const Place& edge : edges->second) {
      const bool runs_along = start_of(edge) == key_of(loop[before]);
      places.push_back({edge.loop, edge.along + (runs_along ? part : 1 - part), nearest.distance});
    }
    return places;
  }

  using Key = std::array<double, 3>;
  Key key_of(Index vertex) const {
    const Vector3 p = surface_->input_position(vertex);
    return {p.x(), p.y(), p.z()};
  }

  using Ends = std::pair<Key, Key>;
  Ends ends_of(Index a, Index b) const { return std::minmax({key_of(a), key_of(b)}); }

  void find_touching_borders() {
    const auto& loops = surface_->boundary_loops();
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (std::size_t i = 0; i < loops[l].size(); ++i)
        touching_[key_of(loops[l][i])].emplace_back(static_cast<Index>(l), static_cast<double>(i));
    for (const Place& edge : edge_places_) {
      const std::vector<Index>& loop = loops[edge.loop];
      const auto i = static_cast<std::size_t>(edge.along);
      touching_edges_[ends_of(loop[i], loop[(i + 1) % loop.size()])].push_back(edge);
    }
    const auto is_single = [](const auto& places) { return places.second.size() < 2; };
    std::erase_if(touching_, is_single);
    std::erase_if(touching_edges_, is_single);
  }

  // Whether the vertices of a loop, which may be at these places, go around that one of the surface
  // once, in order.
  bool follows(const std::vector<std::vector<Place>>& places, Index on) const {
    std::vector<std::vector<double>> along;
    for (const std::vector<Place>& of_vertex : places) {
      along.emplace_back();
      for (const Place& place : of_vertex)
        if (place.loop == on) along.back().push_back(place.along);
      if (along.back().empty()) return false;
    }
    // From a vertex that is at one place only, if there is one, always to the next place.
    const auto first = std::find_if(along.begin(), along.end(),
                                    [](const auto& choice) { return choice.size() == 1; });
    if (first != along.end()) std::rotate(along.begin(), first, along.end());
    const auto length = static_cast<double>(surface_->boundary_loops()[on].size());
    const double start = along.front().front();
    double here = start, around = 0;
    for (std::size_t i = 1; i <= along.size(); ++i) {
      double least = std::numeric_limits<double>::infinity(), next = here;
      for (const double there : i < along.size() ? along[i] : std::vector<double>{start}) {
        double step = std::fmod(there - here, length);
        if (step <= 0) step += length;  // also where two vertices are at one place
        if (step < least) {
          least = step;
          next = there;
        }
      }
      around += least;
      here = next;
    }
    constexpr double kHalf = 0.5;  // of a turn: sums are whole turns but for rounding
    return around < (1 + kHalf) * length;
  }

  void compare_borders() {
    const Points3 positions = surface_points();
    open_borders(positions);
    find_touching_borders();
    const double close =
        kBorderClose * (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
    const std::vector<char> is_corner = border_corners(*surface_, border_turn_);
    const auto& loops = surface_->boundary_loops();
    std::vector<char> is_followed(loops.size(), 0);
    std::vector<Index> off, wrong;
    std::size_t polls = 0;
    for (const std::vector<Index>& loop : loops_) {
      std::vector<std::vector<Place>> places;
      for (const Index h : loop) {
        stop_.poll_at(polls++);
        places.push_back(places_of(point(from(h)), close));
        if (!(places.back().front().distance <= close)) off.push_back(from(h));
      }
      const auto followed =
          std::find_if(places.front().begin(), places.front().end(), [&](const Place& place) {
            return !is_followed[place.loop] && follows(places, place.loop);
          });
      if (followed == places.front().end()) wrong.push_back(from(loop[0]));
      const Index on =
          followed == places.front().end() ? places.front().front().loop : followed->loop;
      is_followed[on] = 1;
      missing_corners(is_corner, loops[on], loop, close);
    }
    if (!off.empty())
      blame(listed("border vertex is off the surface's border",
                   "border vertices are off the surface's border", off));
    if (!wrong.empty())
      blame(listed("border loop does not follow one of the surface once, in order (vertex",
                   "border loops do not follow one of the surface once, in order (vertices",
                   wrong) +
            ")");
    if (!missing_.empty())
      blame(listed("corner of the surface's border has no vertex (of the surface)",
                   "corners of the surface's border have no vertex (of the surface)", missing_));
  }

  // Vertices of quads on feature lines, with how far along these they are: edges, and the part of
  // the last one.
  struct OnLine {
    Index line;
    double along;
  };

  void compare_features() {
    const FeatureLines features = feature_lines(*surface_, features_);
    check_.feature_lines = static_cast<Index>(features.lines.size());
    if (features.lines.empty()) return;
    const Points3 positions = surface_points();
    const double close = kBorderClose * diagonal(positions);
    const std::vector<std::vector<OnLine>> on_lines = places_on_lines(features, positions, close);
    std::vector<std::vector<Index>> neighbours(quads_.positions.size());
    for (Index h = 0; h < half_edge_count(); ++h) {
      neighbours[from(h)].push_back(to(h));
      if (opposite_[h] < 0) neighbours[to(h)].push_back(from(h));
    }
    std::vector<std::vector<std::pair<Index, double>>> of_line(features.lines.size());
    for (std::size_t v = 0; v < on_lines.size(); ++v)
      for (const OnLine& place : on_lines[v])
        of_line[place.line].emplace_back(static_cast<Index>(v), place.along);
    for (std::size_t l = 0; l < of_line.size(); ++l)
      if (!is_covered(features, static_cast<Index>(l), of_line[l], on_lines, neighbours))
        check_.uncovered.push_back({surface_->from_vertex(features.lines[l].half_edges.front()),
                                    surface_->to_vertex(features.lines[l].half_edges.back())});
    blame_uncovered();
  }

  void blame_uncovered() {
    if (check_.uncovered.empty()) return;
    std::vector<std::string> ends;
    for (const LineEnds& line : check_.uncovered) {
      if (ends.size() == kNamed) break;
      ends.push_back(fmt::format("{} to {}", surface_->input_vertex(line.from) + 1,
                                 surface_->input_vertex(line.to) + 1));
    }
    const bool is_one = check_.uncovered.size() == 1;
    blame(
        fmt::format("{} of {} feature lines {} not covered by edges of quads (vertices of the "
                    "surface {}{})",
                    check_.uncovered.size(), check_.feature_lines, is_one ? "is" : "are",
                    fmt::join(ends, ", "), check_.uncovered.size() > kNamed ? ", ..." : ""));
  }

  // By vertex of the quads. Those at ends of lines are on all of these.
  std::vector<std::vector<OnLine>> places_on_lines(const FeatureLines& features,
                                                   const Points3& positions, double close) const {
    std::vector<OnLine> begins;  // of edges
    std::vector<std::array<Index, 3>> edges;
    std::vector<std::vector<OnLine>> at_vertex(to_size(surface_->vertex_count()));
    for (std::size_t l = 0; l < features.lines.size(); ++l) {
      const std::vector<Index>& half_edges = features.lines[l].half_edges;
      for (std::size_t i = 0; i < half_edges.size(); ++i) {
        const Index a = surface_->from_vertex(half_edges[i]),
                    b = surface_->to_vertex(half_edges[i]);
        begins.push_back({static_cast<Index>(l), static_cast<double>(i)});
        edges.push_back({a, b, b});
        at_vertex[a].push_back(begins.back());
        if (i + 1 == half_edges.size())
          at_vertex[b].push_back({static_cast<Index>(l), static_cast<double>(i + 1)});
      }
    }
    Cells segments(static_cast<Index>(edges.size()), 3);
    for (std::size_t e = 0; e < edges.size(); ++e)
      segments.row(static_cast<Index>(e)) << edges[e][0], edges[e][1], edges[e][2];
    const SurfaceTree tree(positions, segments);
    std::vector<std::vector<OnLine>> places(quads_.positions.size());
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (corners_[v] == 0) continue;
      stop_.poll_at(v);
      const Vector3& p = quads_.positions[v];
      const auto is_at = [&](Index end) {
        return (surface_->input_position(end) - p).norm() <= close;
      };
      // Solids that touch have several lines at one place.
      const std::vector<Index> near = tree.faces_within(p, close);
      std::set<Index> ends;
      for (const Index e : near)
        for (const Index end : {edges[e][0], edges[e][1]})
          if (is_at(end)) ends.insert(end);
      for (const Index end : ends)
        places[v].insert(places[v].end(), at_vertex[end].begin(), at_vertex[end].end());
      for (const Index e : near) {
        const auto& [a, b, last] = edges[e];
        if (is_at(a) || is_at(b)) continue;
        const Vector3 from = surface_->input_position(a),
                      along = surface_->input_position(b) - from;
        OnLine place = begins[e];
        place.along += std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
        places[v].push_back(place);
      }
    }
    return places;
  }

  // Whether edges lead along a line, each from a vertex on it to the next of its neighbours there.
  bool is_covered(const FeatureLines& features, Index l,
                  const std::vector<std::pair<Index, double>>& on_it,
                  const std::vector<std::vector<OnLine>>& on_lines,
                  const std::vector<std::vector<Index>>& neighbours) const {
    const FeatureLine& line = features.lines[l];
    const auto length = static_cast<double>(line.half_edges.size());
    const Index first_vertex = surface_->from_vertex(line.half_edges.front());
    const bool is_loop = line.is_closed && !features.is_corner[first_vertex];
    const auto goes_on = [&](Index start, double begin) {
      Index here = start;
      double along = begin;
      for (std::size_t step = 0; step <= on_it.size(); ++step) {
        Index best = -1;
        double least = std::numeric_limits<double>::infinity();
        for (const Index next : neighbours[here])
          for (const OnLine& place : on_lines[next]) {
            if (place.line != l) continue;
            double on = place.along;
            if (is_loop && on <= begin) on += length;
            if (on > along && on < least) {
              least = on;
              best = next;
            }
          }
        if (best < 0) return false;
        if (least >= begin + length || (is_loop && best == start))
          return step >= 2 || !line.is_closed;
        here = best;
        along = least;
      }
      return false;
    };
    for (const auto& [v, along] : on_it) {
      stop_.poll();
      if (is_loop ? goes_on(v, along) : along == 0 && goes_on(v, 0)) return true;
      if (is_loop) return false;  // it leads through all of its vertices, from any
    }
    return false;
  }

  // Corners of the surface's border where no vertex of the quads' is.
  void missing_corners(const std::vector<char>& is_corner, const std::vector<Index>& border,
                       const std::vector<Index>& loop, double close) {
    for (const Index v : border) {
      if (!is_corner[v]) continue;
      stop_.poll();  // all of the loop is looked through
      const Vector3 p = surface_->input_position(v);
      const bool is_met = std::any_of(
          loop.begin(), loop.end(), [&](Index h) { return (point(from(h)) - p).norm() <= close; });
      if (!is_met) missing_.push_back(v);
    }
  }

  const PolygonMesh& quads_;
  const SurfaceMesh* const surface_;
  const std::vector<char>& features_;  // of the surface, or empty
  const StopCheck& stop_;
  const double border_turn_;
  QuadCheck check_;
  std::vector<Index> opposite_, corners_;  // by half-edge; quads of every vertex
  std::vector<char> is_border_;            // by vertex
  std::vector<std::vector<Index>> loops_;
  std::optional<SurfaceTree> border_tree_;
  // Where several vertices of the surface's border are at one place: loops, and vertices of them.
  std::map<Key, std::vector<std::pair<Index, double>>> touching_;
  std::map<Ends, std::vector<Place>> touching_edges_;  // the same of edges: where they begin
  std::vector<Place> edge_places_;                     // where the segments of border_tree_ begin
  std::vector<Index> missing_;
};

}  // namespace

QuadCheck check_quads(const PolygonMesh& quads, const SurfaceMesh* surface,
                      const std::vector<char>& features, const StopCheck& stop,
                      double border_turn) {
  if (surface && !features.empty() && features.size() != to_size(surface->half_edge_count()))
    throw InvalidArgument("check_quads: features must have 3 #F entries");
  return QuadJudge(quads, surface, features, stop, border_turn).judge();
}

void require_near(QuadCheck& check, const SurfaceMesh& surface, double max_distance) {
  if (!check.is_surface) return;
  const double size = diagonal(surface.positions());
  const auto judge = [&](double distance, std::string_view what) {
    if (!(distance <= max_distance * size))
      check.defects.push_back(
          fmt::format("{}: up to {:.3g}, {:.3g} % of the surface's diagonal, more than {:g} %",
                      what, distance, 100 * distance / size, 100 * max_distance));
  };
  judge(check.hausdorff.to_surface, "quads are away from the surface");
  judge(check.hausdorff.from_surface, "the surface is away from the quads");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
