#include "majorant/quads/internal/smoothing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "majorant/quads/internal/untangling.h"

namespace majorant {
namespace {

// The weight of a vertex's position by the map in its goal. It preserves tips of the surface.
constexpr double kStay = 0.5;

class Smoother {
 public:
  Smoother(MovableQuads& quads, const StopCheck& stop) : quads_(quads), stop_(stop) {}

  void smooth() {
    // Numbers of sweeps, after which little changes. Chosen, not tuned.
    constexpr int kSweeps = 5, kRepairs = 30;
    const std::vector<Vector3> start = quads_.mesh().positions;
    const std::vector<BorderPoint> border_start = quads_.border();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t v = 0; v < quads_.vertex_count(); ++v) {
        stop_.poll_at(v);
        if (quads_.is_on_border(v))
          smooth_border(v, border_start[v]);
        else
          quads_.move_towards(v, (1 - kStay) * quads_.middle(v) + kStay * start[v]);
      }
    }
    for (int sweep = 0; sweep < kRepairs; ++sweep)
      if (!repair()) break;
    untangle(quads_, stop_);
  }

 private:
  void smooth_border(std::size_t v, const BorderPoint& start) {
    if (!quads_.slides(v)) return;
    const auto [back, on] = quads_.room_of(v);
    const double all = quads_.lengths().loop_length(start.half_edge);
    const double way =
        quads_.lengths().length_at(start) - quads_.lengths().length_at(quads_.border()[v]);
    const double home =
        quads_.lengths().is_closed(start.half_edge) ? std::remainder(way, all) : way;
    const double goal = (1 - kStay) * (on - back) / 2 + kStay * home;
    for (const double part : {1.0, 0.5, 0.25})
      if (const double by = part * goal; - back < by && by < on && quads_.slide(v, by)) return;
  }

  bool repair_border(std::size_t v) {
    bool has_helped = false;
    for (const double part : {0.3, 0.1, 0.03})
      for (const std::size_t side : {0, 1}) {
        if (!quads_.slides(v)) continue;
        const double before = quads_.worst(v);
        const int turned = quads_.known_turned_around(v);
        if (quads_.slide(v, (side == 0 ? -part : part) * quads_.room_of(v)[side]))
          has_helped |= quads_.worst(v) > before || quads_.known_turned_around(v) < turned;
      }
    return has_helped;
  }

  // Does one sweep over the vertices of bad quads, with steps after which fewer surrounding quads
  // are turned or the worst corner is better. Returns whether bad quads are left and the sweep
  // helped.
  bool repair() {
    constexpr double kBad = 0.1;
    constexpr int kDirections = 8;
    bool has_helped = false;
    for (std::size_t v = 0; v < quads_.vertex_count(); ++v) {
      stop_.poll_at(v);
      double best = quads_.worst(v);
      int fewest = quads_.known_turned_around(v);
      if (best >= kBad && fewest == 0) continue;
      if (quads_.is_on_border(v)) {
        has_helped |= repair_border(v);
        continue;
      }
      Vector3 place = quads_.mesh().positions[v];
      const Vector3 center = place, target = quads_.middle(v);
      Vector3 normal = Vector3::Zero();
      double size = 0;
      for (const Index q : quads_.around(v)) {
        const std::array<Vector3, 4> p = quads_.corners_of(q);
        normal += MovableQuads::normal_of(p);
        size = std::max(size, (p[2] - p[0]).norm());
      }
      const Vector3 first = normal.stableNormalized().unitOrthogonal();
      const Vector3 second = normal.stableNormalized().cross(first);
      const auto attempt = [&](const Vector3& p) {
        quads_.place(v, quads_.on_surface(v, p));
        const double now = quads_.worst(v);
        const int turned = now > std::min(best, kBad) ? quads_.turned_around(v) : fewest + 1;
        if (turned < fewest || (turned == fewest && now > best)) {
          best = now;
          fewest = turned;
          place = quads_.mesh().positions[v];
          has_helped = true;
        }
      };
      attempt(target);
      for (const double radius : {0.3, 0.1, 0.03})
        for (int k = 0; k < kDirections; ++k) {
          const double angle = 2 * std::numbers::pi * k / kDirections;
          attempt(center + radius * size * (std::cos(angle) * first + std::sin(angle) * second));
        }
      quads_.place(v, place);
      quads_.note_turned(v);
    }
    return has_helped;
  }

  MovableQuads& quads_;
  const StopCheck& stop_;
};

}  // namespace

void smooth_quads(PolygonMesh& mesh, const SurfaceMesh& surface, const HeldVertices& held,
                  const StopCheck& stop) {
  MovableQuads quads(mesh, surface, held);
  Smoother(quads, stop).smooth();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
