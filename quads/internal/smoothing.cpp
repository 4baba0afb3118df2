#include "majorant/quads/internal/smoothing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "majorant/mesh/nearest_point.h"
#include "majorant/quads/internal/surface_below.h"

namespace majorant {
namespace {

class Smoother {
 public:
  Smoother(PolygonMesh& mesh, const SurfaceMesh& surface, const HeldVertices& held,
           const StopCheck& stop)
      : mesh_(mesh),
        surface_mesh_(surface),
        surface_(surface),
        stop_(stop),
        has_features_(!held.feature_edges.empty()),
        lengths_(surface, held.is_feature),
        border_(held.points),
        sides_(mesh.positions.size()),
        quads_(mesh.positions.size()),
        likely_(mesh.positions.size(), -1),
        below_(mesh.polygons.size(), -1),
        is_turned_(mesh.polygons.size(), 0) {
    for (Index q = 0; q < static_cast<Index>(mesh.polygons.size()); ++q) {
      for (const Index v : mesh.polygons[q]) quads_[v].push_back(q);
      is_turned_[q] = is_turned(q);
    }
    if (!surface.boundary_loops().empty() || !held.feature_edges.empty())
      find_sliding(surface, held);
  }

  void smooth() {
    // Sweeps; the last ones change little. Chosen, not tuned.
    constexpr int kSweeps = 5, kRepairs = 30;
    const std::vector<Vector3> start = mesh_.positions;
    const std::vector<BorderPoint> border_start = border_;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t v = 0; v < quads_.size(); ++v) {
        stop_.poll_at(v);
        if (is_on_border(v))
          smooth_border(v, border_start[v]);
        else
          move_towards(v, (1 - kStay) * middle(v) + kStay * start[v]);
      }
    }
    for (int sweep = 0; sweep < kRepairs; ++sweep)
      if (!repair()) break;
    untangle();
  }

 private:
  // A corner is good above this sine: 30 degrees.
  static constexpr double kGood = 0.5;
  // The part that where the map has a vertex has in its goal: tips of the surface are not left.
  static constexpr double kStay = 0.5;
  struct OnBorder {
    Index before = -1, after = -1;  // vertices
    bool slides = false;
  };

  bool is_on_border(std::size_t v) const { return border_[v].half_edge >= 0; }

  // Vertices of the border and of features that are no corners, and their neighbours along them.
  void find_sliding(const SurfaceMesh& surface, const HeldVertices& held) {
    const std::vector<char> is_corner = held_corners(surface, held.is_feature, held.border_turn);
    std::set<std::pair<Index, Index>> edges;
    for (const auto quad : mesh_.polygons)
      for (std::size_t k = 0; k < 4; ++k) edges.emplace(quad[k], quad[(k + 1) % 4]);
    for (const auto& [from, to] : held.feature_edges) {
      sides_[from].after = to;
      sides_[to].before = from;
    }
    for (const auto& [from, to] : edges) {
      if (edges.count({to, from}) > 0) continue;
      sides_[from].after = to;
      sides_[to].before = from;
    }
    for (std::size_t v = 0; v < border_.size(); ++v) {
      const BorderPoint& at = border_[v];
      if (at.half_edge < 0 || sides_[v].before < 0 || sides_[v].after < 0) continue;
      sides_[v].slides = !((at.along == 0 && is_corner[surface.from_vertex(at.half_edge)]) ||
                           (at.along == 1 && is_corner[surface.to_vertex(at.half_edge)]));
    }
  }

  // Lengths along its line from a vertex back to the one before it and on to the one after it.
  std::array<double, 2> room_of(std::size_t v) const {
    const Index h = border_[v].half_edge;
    const BorderPoint &before = border_[to_size(sides_[v].before)],
                      &after = border_[to_size(sides_[v].after)];
    const double all = lengths_.loop_length(h), here = lengths_.length_at(border_[v]);
    // A neighbour on another line is where this one begins or ends.
    const auto length_of = [&](const BorderPoint& p, double end) {
      return lengths_.loop_of(p.half_edge) == lengths_.loop_of(h) ? lengths_.length_at(p) : end;
    };
    const auto forward = [&](double length) {
      return lengths_.is_closed(h) ? length - all * std::floor(length / all)
                                   : std::max(length, 0.0);
    };
    return {forward(here - length_of(before, 0)), forward(length_of(after, all) - here)};
  }

  // By so much along the border, if that is no worse. Returns whether it moved.
  bool slide(std::size_t v, double by) {
    const BorderPoint before = border_[v];
    const Vector3 place = mesh_.positions[v];
    const double quality = std::min(worst(v), kGood);
    border_[v] = lengths_.point_at(before.half_edge, lengths_.length_at(before) + by);
    mesh_.positions[v] = lengths_.position(border_[v]);
    if (worst(v) >= quality && turns_no_more(v)) return true;
    border_[v] = before;
    mesh_.positions[v] = place;
    return false;
  }

  void smooth_border(std::size_t v, const BorderPoint& start) {
    if (!sides_[v].slides) return;
    const auto [back, on] = room_of(v);
    const double all = lengths_.loop_length(start.half_edge);
    const double way = lengths_.length_at(start) - lengths_.length_at(border_[v]);
    const double home = lengths_.is_closed(start.half_edge) ? std::remainder(way, all) : way;
    const double goal = (1 - kStay) * (on - back) / 2 + kStay * home;
    for (const double part : {1.0, 0.5, 0.25})
      if (const double by = part * goal; - back < by && by < on && slide(v, by)) return;
  }

  bool repair_border(std::size_t v) {
    bool has_helped = false;
    for (const double part : {0.3, 0.1, 0.03})
      for (const std::size_t side : {0, 1}) {
        if (!sides_[v].slides) continue;
        const double before = worst(v);
        const int turned = known_turned_around(v);
        if (slide(v, (side == 0 ? -part : part) * room_of(v)[side]))
          has_helped |= worst(v) > before || known_turned_around(v) < turned;
      }
    return has_helped;
  }

  std::array<Vector3, 4> corners_of(Index q) const {
    const std::span<const Index> c = mesh_.polygons[q];
    return {mesh_.positions[c[0]], mesh_.positions[c[1]], mesh_.positions[c[2]],
            mesh_.positions[c[3]]};
  }

  static Vector3 normal_of(const std::array<Vector3, 4>& p) {
    return (p[2] - p[0]).cross(p[3] - p[1]);
  }

  // The test of check_quads(), without the corners of quads whose middle is right.
  bool is_turned(Index q) {
    const std::array<Vector3, 4> p = corners_of(q);
    const NearestPoint nearest =
        surface_.tree().nearest((p[0] + p[1] + p[2] + p[3]) / 4, below_[q]);
    below_[q] = nearest.face;
    return surface_.is_away(p, nearest);
  }

  int turned_around(std::size_t v) {
    int count = 0;
    for (const Index q : quads_[v]) count += is_turned(q);
    return count;
  }

  int known_turned_around(std::size_t v) const {
    int count = 0;
    for (const Index q : quads_[v]) count += is_turned_[q];
    return count;
  }

  // Returns whether no more quads around a vertex are turned than are known to be. If so, these are
  // the ones that are known from then on.
  bool turns_no_more(std::size_t v) {
    const int most = known_turned_around(v);
    int count = 0;
    turned_now_.clear();
    for (const Index q : quads_[v]) {
      turned_now_.push_back(is_turned(q));
      count += turned_now_.back();
      if (count > most) return false;
    }
    for (std::size_t k = 0; k < turned_now_.size(); ++k) is_turned_[quads_[v][k]] = turned_now_[k];
    return true;
  }

  void note_turned(std::size_t v) {
    for (const Index q : quads_[v]) is_turned_[q] = is_turned(q);
  }

  // The least sine of a corner of the quads around a vertex, against their normals.
  double worst(std::size_t v) const {
    double least = 1;
    for (const Index q : quads_[v]) {
      const std::array<Vector3, 4> p = corners_of(q);
      const Vector3 n = normal_of(p).stableNormalized();
      for (std::size_t k = 0; k < 4; ++k) least = std::min(least, sine_at(p, k, n));
    }
    return least;
  }

  Vector3 middle(std::size_t v) const {
    Vector3 sum = Vector3::Zero();
    for (const Index q : quads_[v]) {
      const std::span<const Index> c = mesh_.polygons[q];
      for (std::size_t k = 0; k < 4; ++k)
        if (c[k] == static_cast<Index>(v))  // every neighbour is the next one in one quad
          sum += mesh_.positions[c[(k + 1) % 4]];
    }
    return sum / static_cast<double>(quads_[v].size());
  }

  Vector3 on_surface(std::size_t v, const Vector3& p) {
    const NearestPoint nearest = surface_.tree().nearest(p, likely_[v]);
    likely_[v] = nearest.face;
    Vector3 point = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      point += nearest.barycentric[k] *
               Vector3(surface_.positions().row(surface_mesh_.faces()(nearest.face, k)));
    return point;
  }

  // Returns whether it moved.
  bool move_towards(std::size_t v, const Vector3& goal) {
    const Vector3 before = mesh_.positions[v];
    const double quality = std::min(worst(v), kGood);
    for (const double part : {1.0, 0.5, 0.25}) {
      mesh_.positions[v] = on_surface(v, before + part * (goal - before));
      if (worst(v) >= quality && turns_no_more(v)) return true;
    }
    mesh_.positions[v] = before;
    return false;
  }

  // One sweep over the vertices of bad quads: steps around them after which fewer are turned, or
  // the worst corner is better. Returns whether there is anything left to do, and it helps.
  bool repair() {
    constexpr double kBad = 0.1;
    constexpr int kDirections = 8;
    bool has_helped = false;
    for (std::size_t v = 0; v < quads_.size(); ++v) {
      stop_.poll_at(v);
      double best = worst(v);
      int fewest = known_turned_around(v);
      if (best >= kBad && fewest == 0) continue;
      if (is_on_border(v)) {
        has_helped |= repair_border(v);
        continue;
      }
      Vector3 place = mesh_.positions[v];
      const Vector3 center = place, target = middle(v);
      Vector3 normal = Vector3::Zero();
      double size = 0;
      for (const Index q : quads_[v]) {
        const std::array<Vector3, 4> p = corners_of(q);
        normal += normal_of(p);
        size = std::max(size, (p[2] - p[0]).norm());
      }
      const Vector3 first = normal.stableNormalized().unitOrthogonal();
      const Vector3 second = normal.stableNormalized().cross(first);
      const auto attempt = [&](const Vector3& p) {
        mesh_.positions[v] = on_surface(v, p);
        const double now = worst(v);
        const int turned = now > std::min(best, kBad) ? turned_around(v) : fewest + 1;
        if (turned < fewest || (turned == fewest && now > best)) {
          best = now;
          fewest = turned;
          place = mesh_.positions[v];
          has_helped = true;
        }
      };
      attempt(target);
      for (const double radius : {0.3, 0.1, 0.03})
        for (int k = 0; k < kDirections; ++k) {
          const double angle = 2 * std::numbers::pi * k / kDirections;
          attempt(center + radius * size * (std::cos(angle) * first + std::sin(angle) * second));
        }
      mesh_.positions[v] = place;
      note_turned(v);
    }
    return has_helped;
  }

  // Where quads are still folded, one vertex at a time cannot mend them: the sum of an energy over
  // all quads around them is lowered, which is the higher the smaller, or the more negative,
  // corners are against the surface's normal [GKKPRS21]. Keeps the result where fewer quads are
  // bad.
  void untangle() {
    // Rings of quads around the bad ones that take part; sweeps, and those in a row after which no
    // fewer are bad, where more are in vain. Chosen.
    constexpr std::array<int, 2> kRings = {3, 6};
    constexpr int kSweeps = 40, kInVain = 8;
    for (const int rings : kRings) {
      if (!has_folded()) return;
      const std::vector<Index> bad = bad_quads();
      const std::vector<Vector3> positions_before = mesh_.positions;
      const std::vector<BorderPoint> border_before = border_;
      const std::vector<Index> around = quads_around(bad, rings);
      std::size_t fewest = bad.size();
      for (int sweep = 0, in_vain = 0; sweep < kSweeps && in_vain < kInVain; ++sweep) {
        sweep_energy(around);
        const std::size_t now = bad_quads().size();
        in_vain = now < fewest ? 0 : in_vain + 1;
        fewest = std::min(fewest, now);
        if (now == 0) break;
      }
      if (bad_quads().size() >= bad.size()) {
        mesh_.positions = positions_before;
        border_ = border_before;
      }
      for (const Index q : around) is_turned_[q] = is_turned(q);
    }
  }

  // One step of every vertex of these quads.
  void sweep_energy(const std::vector<Index>& quads) {
    note_normals(quads);
    std::vector<char> takes_part(quads_.size(), 0);
    double least = 0;
    for (const Index q : quads) {
      least = std::min(least, least_corner(q));
      for (const Index v : mesh_.polygons[q]) takes_part[v] = 1;
    }
    const double eps = std::clamp(-least, kLeastEps, kMostEps);
    for (std::size_t v = 0; v < quads_.size(); ++v) {
      stop_.poll_at(v);
      if (takes_part[v]) lower_energy(v, eps);
    }
  }

  // Relative to the squares of lengths, of a corner's area below which its energy grows as 1 / area
  // no more.
  static constexpr double kLeastEps = 1e-3, kMostEps = 0.05;

  bool is_folded(Index q) const {
    constexpr double kAlmost = 1e-3;
    const std::array<Vector3, 4> p = corners_of(q);
    const Vector3 n = normal_of(p).stableNormalized();
    for (std::size_t k = 0; k < 4; ++k)
      if (sine_at(p, k, n) < kAlmost) return true;
    return false;
  }

  bool has_folded() const {
    for (Index q = 0; q < static_cast<Index>(mesh_.polygons.size()); ++q)
      if (is_folded(q)) return true;
    return false;
  }

  std::vector<Index> bad_quads() {
    std::vector<Index> bad;
    for (Index q = 0; q < static_cast<Index>(mesh_.polygons.size()); ++q)
      if (is_folded(q) || is_turned(q)) bad.push_back(q);
    return bad;
  }

  // In order of their numbers.
  std::vector<Index> quads_around(const std::vector<Index>& quads, int rings) const {
    std::set<Index> found(quads.begin(), quads.end());
    std::vector<Index> outer = quads;
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<Index> next;
      for (const Index q : outer)
        for (const Index v : mesh_.polygons[q])
          for (const Index near : quads_[v])
            if (found.insert(near).second) next.push_back(near);
      outer = std::move(next);
    }
    return {found.begin(), found.end()};
  }

  // Of the surface under the middle and the corners of these quads, and of those that share a
  // vertex with them.
  void note_normals(const std::vector<Index>& quads) {
    normals_.resize(mesh_.polygons.size(), Vector3::Zero());
    const auto note = [&](Index q) {
      const std::array<Vector3, 4> p = corners_of(q);
      below_[q] = surface_.tree().nearest((p[0] + p[1] + p[2] + p[3]) / 4, below_[q]).face;
      Vector3 sum = normal_below(below_[q]);
      for (const Index v : mesh_.polygons[q]) {
        if (is_on_border(v)) continue;
        likely_[v] = surface_.tree().nearest(mesh_.positions[v], likely_[v]).face;
        sum += normal_below(likely_[v]);
      }
      normals_[q] = sum.stableNormalized();
    };
    for (const Index q : quads_around(quads, 1)) note(q);
  }

  Vector3 normal_below(Index face) const {
    const auto corner = [&](int k) {
      return Vector3(surface_mesh_.positions().row(surface_mesh_.faces()(face, k)));
    };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
  }

  // Of the corners of a quad: the least area against the surface's normal, relative to its sides.
  double least_corner(Index q) const {
    const std::array<Vector3, 4> p = corners_of(q);
    double least = 1;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 along = p[(k + 1) % 4] - p[k], back = p[(k + 3) % 4] - p[k];
      const double size = along.squaredNorm() + back.squaredNorm();
      if (size > 0) least = std::min(least, 2 * along.cross(back).dot(normals_[q]) / size);
    }
    return least;
  }

  // Of the quads around a vertex.
  double energy(std::size_t v, double eps) const {
    double sum = 0;
    for (const Index q : quads_[v]) {
      const std::array<Vector3, 4> p = corners_of(q);
      const double scale = normal_of(p).norm() + (p[2] - p[0]).squaredNorm() / 4;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector3 along = p[(k + 1) % 4] - p[k], back = p[(k + 3) % 4] - p[k];
        const double area = along.cross(back).dot(normals_[q]);
        const double size = along.squaredNorm() + back.squaredNorm();
        const double least = eps * std::max(size, scale) / 2;
        sum += size / (area + std::hypot(area, least));
      }
    }
    return sum;
  }

  void lower_energy(std::size_t v, double eps) {
    constexpr std::array<double, 4> kParts = {1, 0.3, 0.1, 0.03};
    const double before = energy(v, eps);
    if (is_on_border(v)) {
      if (!sides_[v].slides) return;
      for (const double part : kParts)
        for (const std::size_t side : {0, 1}) {
          const BorderPoint at = border_[v];
          const Vector3 place = mesh_.positions[v];
          const double by = (side == 0 ? -0.5 : 0.5) * part * room_of(v)[side];
          border_[v] = lengths_.point_at(at.half_edge, lengths_.length_at(at) + by);
          mesh_.positions[v] = lengths_.position(border_[v]);
          if (energy(v, eps) < before) return;
          border_[v] = at;
          mesh_.positions[v] = place;
        }
      return;
    }
    const Vector3 place = mesh_.positions[v];
    Vector3 normal = Vector3::Zero();
    double size = 0;  // of the longest edge
    for (const Index q : quads_[v]) {
      normal += normals_[q];
      const std::span<const Index> c = mesh_.polygons[q];
      for (std::size_t k = 0; k < 4; ++k)
        if (c[k] == static_cast<Index>(v))
          size = std::max(size, (mesh_.positions[c[(k + 1) % 4]] - place).norm());
    }
    const Index face = surface_.tree().nearest(place, likely_[v]).face;
    const Vector3 first = normal.stableNormalized().unitOrthogonal();
    const Vector3 second = normal.stableNormalized().cross(first);
    // By differences.
    const double h = 1e-4 * size;
    const auto at = [&](double s, double t) {
      mesh_.positions[v] = place + h * (s * first + t * second);
      return energy(v, eps);
    };
    const double e10 = at(1, 0), e_10 = at(-1, 0), e01 = at(0, 1), e0_1 = at(0, -1), e11 = at(1, 1),
                 e_1_1 = at(-1, -1);
    const Vector2 gradient((e10 - e_10) / 2, (e01 - e0_1) / 2);
    const double a = e10 + e_10 - 2 * before, c = e01 + e0_1 - 2 * before,
                 b = (e11 + e_1_1 - 2 * before - a - c) / 2;
    const double middle = (a + c) / 2, off = std::hypot((a - c) / 2, b);
    const double shift = std::max(0.0, 1e-3 * (std::abs(middle) + off) - (middle - off));
    const double det = (a + shift) * (c + shift) - b * b;
    Vector2 step = -gradient;
    if (det > 0)
      step = -Vector2((c + shift) * gradient.x() - b * gradient.y(),
                      (a + shift) * gradient.y() - b * gradient.x()) /
             det;
    step *= h;
    if (!step.allFinite() || step.norm() == 0) {
      mesh_.positions[v] = place;
      return;
    }
    constexpr double kMostStep = 0.3, kLeastCosine = 0.8;
    if (step.norm() > kMostStep * size) step *= kMostStep * size / step.norm();
    for (const double part : kParts) {
      mesh_.positions[v] = on_surface(v, place + part * (step.x() * first + step.y() * second));
      // Features are not crossed.
      const bool is_beyond =
          has_features_ && normal_below(face).dot(normal_below(likely_[v])) < kLeastCosine;
      if (!is_beyond && energy(v, eps) < before) return;
    }
    mesh_.positions[v] = place;
  }

  static double sine_at(const std::array<Vector3, 4>& p, std::size_t k, const Vector3& n) {
    const Vector3 along = (p[(k + 1) % 4] - p[k]).stableNormalized();
    const Vector3 back = (p[(k + 3) % 4] - p[k]).stableNormalized();
    return along.cross(back).dot(n);
  }

  PolygonMesh& mesh_;
  const SurfaceMesh& surface_mesh_;
  const SurfaceBelow surface_;
  const StopCheck& stop_;
  const bool has_features_;
  const BorderLengths lengths_;
  std::vector<BorderPoint> border_;        // by vertex
  std::vector<OnBorder> sides_;            // by vertex
  std::vector<std::vector<Index>> quads_;  // by vertex
  std::vector<Index> likely_, below_;      // faces of the surface, by vertex and by quad
  std::vector<char> is_turned_;            // by quad
  std::vector<char> turned_now_;           // around the vertex that was moved last
  std::vector<Vector3> normals_;           // by quad, of the surface below; where it untangles
};

}  // namespace

void smooth_quads(PolygonMesh& mesh, const SurfaceMesh& surface, const HeldVertices& held,
                  const StopCheck& stop) {
  Smoother(mesh, surface, held, stop).smooth();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
