#include "majorant/quads/internal/curve_match.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "majorant/mesh/geometry.h"
#include "majorant/mesh/nearest_point.h"
#include "majorant/quads/features.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/surface_below.h"

namespace majorant {
namespace {

// A place on a border loop or a feature line: the number of preceding edges, and the fraction of
// its own edge.
struct CurvePlace {
  Index curve;
  double along;
};

// ---- Borders ----

// The border of a surface by places.
class BorderPlaces {
 public:
  BorderPlaces(const SurfaceMesh& surface, const Points3& positions, double close)
      : surface_(surface), loops_(surface.boundary_loops()), close_(close) {
    Index edges = 0;
    for (const auto& loop : loops_) edges += static_cast<Index>(loop.size());
    Cells segments(edges, 3);  // degenerate triangles
    Index row = 0;
    for (std::size_t l = 0; l < loops_.size(); ++l)
      for (std::size_t i = 0; i < loops_[l].size(); ++i) {
        const Index a = loops_[l][i], b = loops_[l][(i + 1) % loops_[l].size()];
        segments.row(row++) << a, b, b;
        edge_places_.push_back({static_cast<Index>(l), static_cast<double>(i)});
      }
    tree_.emplace(positions, segments);
    find_touching();
  }

  struct Places {
    double distance;  // of the nearest border point
    std::vector<CurvePlace> on_border;
  };

  // Returns the nearest place of the border; several places if vertices or edges of the border
  // coincide.
  Places places_of(const Vector3& p) const {
    const NearestPoint found = tree_->nearest(p);
    CurvePlace nearest = edge_places_[found.face];
    nearest.along += std::clamp(1 - found.barycentric[0], 0.0, 1.0);
    Places places{found.distance, {}};
    const std::vector<Index>& loop = loops_[nearest.curve];
    const auto before = to_size(static_cast<Index>(nearest.along)) % loop.size();
    for (const std::size_t i : {before, (before + 1) % loop.size()}) {
      const auto vertices = touching_.find(key_of(loop[i]));
      if (vertices == touching_.end() || (surface_.input_position(loop[i]) - p).norm() > close_)
        continue;
      places.on_border = vertices->second;
      return places;
    }
    const auto edges =
        touching_edges_.find(ends_of(loop[before], loop[(before + 1) % loop.size()]));
    if (edges == touching_edges_.end()) {
      places.on_border = {nearest};
      return places;
    }
    const auto start_of = [&](const CurvePlace& edge) {
      return key_of(loops_[edge.curve][static_cast<std::size_t>(edge.along)]);
    };
    const double part = nearest.along - static_cast<double>(before);
    for (const CurvePlace& edge : edges->second) {
      const bool runs_along = start_of(edge) == key_of(loop[before]);
      places.on_border.push_back({edge.curve, edge.along + (runs_along ? part : 1 - part)});
    }
    return places;
  }

  // Returns whether a loop, whose vertices have these candidate places, goes around a loop of the
  // surface once, in order.
  bool is_followed(const std::vector<Places>& places, Index curve) const {
    std::vector<std::vector<double>> along;
    for (const Places& of_vertex : places) {
      along.emplace_back();
      for (const CurvePlace& place : of_vertex.on_border)
        if (place.curve == curve) along.back().push_back(place.along);
      if (along.back().empty()) return false;
    }
    // Starts at a vertex with a single place, if there is one, and always takes the next place.
    const auto first = std::find_if(along.begin(), along.end(),
                                    [](const auto& choice) { return choice.size() == 1; });
    if (first != along.end()) std::rotate(along.begin(), first, along.end());
    const auto length = static_cast<double>(loops_[curve].size());
    const double start = along.front().front();
    double here = start, around = 0;
    for (std::size_t i = 1; i <= along.size(); ++i) {
      double least = std::numeric_limits<double>::infinity(), next_place = here;
      for (const double there : i < along.size() ? along[i] : std::vector<double>{start}) {
        double step = std::fmod(there - here, length);
        if (step <= 0) step += length;  // also if two vertices are at one place
        if (step < least) {
          least = step;
          next_place = there;
        }
      }
      around += least;
      here = next_place;
    }
    constexpr double kHalf = 0.5;  // of a turn; sums are whole turns up to rounding
    return around < (1 + kHalf) * length;
  }

 private:
  using Key = std::array<double, 3>;
  Key key_of(Index vertex) const {
    const Vector3 p = surface_.input_position(vertex);
    return {p.x(), p.y(), p.z()};
  }

  using Ends = std::pair<Key, Key>;
  Ends ends_of(Index a, Index b) const { return std::minmax({key_of(a), key_of(b)}); }

  void find_touching() {
    for (std::size_t l = 0; l < loops_.size(); ++l)
      for (std::size_t i = 0; i < loops_[l].size(); ++i)
        touching_[key_of(loops_[l][i])].push_back({static_cast<Index>(l), static_cast<double>(i)});
    for (const CurvePlace& edge : edge_places_) {
      const std::vector<Index>& loop = loops_[edge.curve];
      const auto i = static_cast<std::size_t>(edge.along);
      touching_edges_[ends_of(loop[i], loop[(i + 1) % loop.size()])].push_back(edge);
    }
    const auto is_single = [](const auto& places) { return places.second.size() < 2; };
    std::erase_if(touching_, is_single);
    std::erase_if(touching_edges_, is_single);
  }

  const SurfaceMesh& surface_;
  const std::vector<std::vector<Index>>& loops_;  // vertices of each loop
  const double close_;
  std::optional<SurfaceTree> tree_;      // of all border edges, as degenerate triangles
  std::vector<CurvePlace> edge_places_;  // starts of these edges
  // The starts of border vertices and edges that coincide with others.
  std::map<Key, std::vector<CurvePlace>> touching_;
  std::map<Ends, std::vector<CurvePlace>> touching_edges_;
};

// ---- Feature lines ----

// The feature lines of a surface, and the vertices of quads on them.
class LinesOfQuads {
 public:
  LinesOfQuads(const QuadSurface& quads, const SurfaceMesh& surface, const FeatureLines& features,
               const StopCheck& stop)
      : quads_(quads),
        surface_(surface),
        features_(features),
        stop_(stop),
        neighbours_(quads.valence.size()),
        of_line_(features.lines.size()) {
    find_places();
    for (Index h = 0; h < quads.half_edge_count(); ++h) {
      neighbours_[quads.from(h)].push_back(quads.to(h));
      if (quads.opposite[h] < 0) neighbours_[quads.to(h)].push_back(quads.from(h));
    }
    for (std::size_t v = 0; v < places_.size(); ++v)
      for (const CurvePlace& place : places_[v])
        of_line_[place.curve].emplace_back(static_cast<Index>(v), place.along);
  }

  // Returns whether edges of quads follow a line, from each vertex on it to the next one.
  bool is_covered(Index l) const {
    const FeatureLine& line = features_.lines[l];
    const Index first_vertex = surface_.from_vertex(line.half_edges.front());
    const bool is_loop = line.is_closed && !features_.is_corner[first_vertex];
    for (const auto& [v, along] : of_line_[l]) {
      stop_.poll();
      if (is_loop ? leads_along(l, is_loop, v, along) : along == 0 && leads_along(l, is_loop, v, 0))
        return true;
      if (is_loop) return false;  // a loop leads through all its vertices, from any of them
    }
    return false;
  }

 private:
  bool leads_along(Index l, bool is_loop, Index start, double begin) const {
    const auto length = static_cast<double>(features_.lines[l].half_edges.size());
    Index here = start;
    double along = begin;
    for (std::size_t step = 0; step <= of_line_[l].size(); ++step) {
      Index best = -1;
      double least = std::numeric_limits<double>::infinity();
      for (const Index neighbour : neighbours_[here])
        for (const CurvePlace& place : places_[neighbour]) {
          if (place.curve != l) continue;
          double on = place.along;
          if (is_loop && on <= begin) on += length;
          if (on > along && on < least) {
            least = on;
            best = neighbour;
          }
        }
      if (best < 0) return false;
      if (least >= begin + length || (is_loop && best == start))
        return step >= 2 || !features_.lines[l].is_closed;
      here = best;
      along = least;
    }
    return false;
  }

  // Finds the places. A vertex at ends of lines is on all of them.
  void find_places() {
    std::vector<CurvePlace> begins;  // starts of edges
    std::vector<std::array<Index, 2>> edges;
    std::vector<std::vector<CurvePlace>> at_vertex(to_size(surface_.vertex_count()));
    for (std::size_t l = 0; l < features_.lines.size(); ++l) {
      const std::vector<Index>& half_edges = features_.lines[l].half_edges;
      for (std::size_t i = 0; i < half_edges.size(); ++i) {
        const Index a = surface_.from_vertex(half_edges[i]), b = surface_.to_vertex(half_edges[i]);
        begins.push_back({static_cast<Index>(l), static_cast<double>(i)});
        edges.push_back({a, b});
        at_vertex[a].push_back(begins.back());
        if (i + 1 == half_edges.size())
          at_vertex[b].push_back({static_cast<Index>(l), static_cast<double>(i + 1)});
      }
    }
    Cells segments(static_cast<Index>(edges.size()), 3);  // degenerate triangles
    for (std::size_t e = 0; e < edges.size(); ++e)
      segments.row(static_cast<Index>(e)) << edges[e][0], edges[e][1], edges[e][1];
    const Points3 positions = positions_in_file(surface_);
    const double close = kBorderClose * diagonal(positions);
    const SurfaceTree tree(positions, segments);
    places_.resize(quads_.valence.size());
    for (std::size_t v = 0; v < places_.size(); ++v) {
      if (quads_.valence[v] == 0) continue;
      stop_.poll_at(v);
      const Vector3& p = quads_.mesh.positions[v];
      const auto is_at = [&](Index end) {
        return (surface_.input_position(end) - p).norm() <= close;
      };
      // Solids that touch have several lines at one place.
      const std::vector<Index> near = tree.faces_within(p, close);
      std::set<Index> ends;
      for (const Index e : near)
        for (const Index end : edges[e])
          if (is_at(end)) ends.insert(end);
      for (const Index end : ends)
        places_[v].insert(places_[v].end(), at_vertex[end].begin(), at_vertex[end].end());
      for (const Index e : near) {
        const auto& [a, b] = edges[e];
        if (is_at(a) || is_at(b)) continue;
        const Vector3 from = surface_.input_position(a), along = surface_.input_position(b) - from;
        CurvePlace place = begins[e];
        place.along += std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
        places_[v].push_back(place);
      }
    }
  }

  const QuadSurface& quads_;
  const SurfaceMesh& surface_;
  const FeatureLines& features_;
  const StopCheck& stop_;
  std::vector<std::vector<CurvePlace>> places_;                 // by vertex of the quads
  std::vector<std::vector<Index>> neighbours_;                  // by vertex of the quads
  std::vector<std::vector<std::pair<Index, double>>> of_line_;  // vertices with their lengths along
                                                                // the line
};

}  // namespace

void match_borders(const QuadSurface& quads, const SurfaceMesh& surface, double border_turn,
                   const StopCheck& stop, std::vector<std::string>& defects) {
  const Points3 positions = positions_in_file(surface);
  const double close = kBorderClose * diagonal(positions);
  const BorderPlaces border(surface, positions, close);
  const std::vector<char> is_corner = border_corners(surface, border_turn);
  std::vector<char> is_followed(surface.boundary_loops().size(), 0);
  std::vector<Index> off, wrong, missing;
  std::size_t polls = 0;
  for (const std::vector<Index>& loop : quads.loops) {
    std::vector<BorderPlaces::Places> places;
    for (const Index h : loop) {
      stop.poll_at(polls++);
      places.push_back(border.places_of(quads.point(quads.from(h))));
      if (!(places.back().distance <= close)) off.push_back(quads.from(h));
    }
    const std::vector<CurvePlace>& starts = places.front().on_border;
    const auto followed = std::find_if(starts.begin(), starts.end(), [&](const CurvePlace& place) {
      return !is_followed[place.curve] && border.is_followed(places, place.curve);
    });
    if (followed == starts.end()) wrong.push_back(quads.from(loop[0]));
    const Index curve = followed == starts.end() ? starts.front().curve : followed->curve;
    is_followed[curve] = 1;
    for (const Index v : surface.boundary_loops()[curve]) {
      if (!is_corner[v]) continue;
      stop.poll();  // stop is polled after each loop
      const Vector3 p = surface.input_position(v);
      const bool is_met = std::any_of(loop.begin(), loop.end(), [&](Index h) {
        return (quads.point(quads.from(h)) - p).norm() <= close;
      });
      if (!is_met) missing.push_back(v);
    }
  }
  if (!off.empty())
    defects.push_back(listed("border vertex is off the surface's border",
                             "border vertices are off the surface's border", off));
  if (!wrong.empty())
    defects.push_back(
        listed("border loop does not follow one of the surface once, in order (vertex",
               "border loops do not follow one of the surface once, in order (vertices", wrong) +
        ")");
  if (!missing.empty())
    defects.push_back(listed("corner of the surface's border has no vertex (of the surface)",
                             "corners of the surface's border have no vertex (of the surface)",
                             missing));
}

FeatureMatch match_features(const QuadSurface& quads, const SurfaceMesh& surface,
                            const std::vector<char>& is_feature, const StopCheck& stop,
                            std::vector<std::string>& defects) {
  const FeatureLines features = feature_lines(surface, is_feature);
  FeatureMatch match{static_cast<Index>(features.lines.size()), {}};
  if (features.lines.empty()) return match;
  const LinesOfQuads lines(quads, surface, features, stop);
  for (Index l = 0; l < match.lines; ++l)
    if (!lines.is_covered(l))
      match.uncovered.push_back({surface.from_vertex(features.lines[l].half_edges.front()),
                                 surface.to_vertex(features.lines[l].half_edges.back())});
  if (match.uncovered.empty()) return match;
  std::vector<std::string> ends;
  for (const LineEnds& line : match.uncovered) {
    if (ends.size() == kNamedInDefects) break;
    ends.push_back(fmt::format("{} to {}", surface.input_vertex(line.from) + 1,
                               surface.input_vertex(line.to) + 1));
  }
  defects.push_back(
      fmt::format("{} of {} feature lines {} not covered by edges of quads (vertices of the "
                  "surface {}{})",
                  match.uncovered.size(), match.lines, match.uncovered.size() == 1 ? "is" : "are",
                  fmt::join(ends, ", "), match.uncovered.size() > kNamedInDefects ? ", ..." : ""));
  return match;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
