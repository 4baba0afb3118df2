#include "majorant/quads/internal/untangling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

namespace majorant {
namespace {

class Untangler {
 public:
  Untangler(MovableQuads& quads, const StopCheck& stop) : quads_(quads), stop_(stop) {}

  void untangle() {
    // Numbers of rings of quads around bad ones that move; the number of sweeps, and of consecutive
    // sweeps without success after which untangling ends. Chosen, not tuned.
    constexpr std::array<int, 2> kRings = {3, 6};
    constexpr int kSweeps = 40, kInVain = 8;
    for (const int rings : kRings) {
      if (!has_folded()) return;
      const std::vector<Index> bad = bad_quads();
      const std::vector<Vector3> positions_before = quads_.mesh().positions;
      const std::vector<BorderPoint> border_before = quads_.border();
      const std::vector<Index> around = quads_around(bad, rings);
      std::size_t fewest = bad.size();
      for (int sweep = 0, in_vain = 0; sweep < kSweeps && in_vain < kInVain; ++sweep) {
        sweep_energy(around);
        const std::size_t now = bad_quads().size();
        in_vain = now < fewest ? 0 : in_vain + 1;
        fewest = std::min(fewest, now);
        if (now == 0) break;
      }
      if (bad_quads().size() >= bad.size()) quads_.restore(positions_before, border_before);
      for (const Index q : around) quads_.note_turned_quad(q);
    }
  }

 private:
  // Moves each vertex of these quads by one step.
  void sweep_energy(const std::vector<Index>& quads) {
    note_normals(quads);
    std::vector<char> takes_part(quads_.vertex_count(), 0);
    double least = 0;
    for (const Index q : quads) {
      least = std::min(least, least_corner(q));
      for (const Index v : quads_.mesh().polygons[q]) takes_part[v] = 1;
    }
    const double eps = std::clamp(-least, kLeastEps, kMaxEps);
    for (std::size_t v = 0; v < quads_.vertex_count(); ++v) {
      stop_.poll_at(v);
      if (takes_part[v]) lower_energy(v, eps);
    }
  }

  // Bounds of eps, the area of a corner relative to squared lengths below which its energy grows
  // more slowly than 1 / area.
  static constexpr double kLeastEps = 1e-3, kMaxEps = 0.05;

  bool is_folded(Index q) const {
    constexpr double kAlmost = 1e-3;
    const std::array<Vector3, 4> p = quads_.corners_of(q);
    const Vector3 n = MovableQuads::normal_of(p).stableNormalized();
    for (std::size_t k = 0; k < 4; ++k)
      if (MovableQuads::sine_at(p, k, n) < kAlmost) return true;
    return false;
  }

  bool has_folded() const {
    for (Index q = 0; q < quads_.quad_count(); ++q)
      if (is_folded(q)) return true;
    return false;
  }

  std::vector<Index> bad_quads() {
    std::vector<Index> bad;
    for (Index q = 0; q < quads_.quad_count(); ++q)
      if (is_folded(q) || quads_.is_turned(q)) bad.push_back(q);
    return bad;
  }

  // Returns the quads in so many rings around these, in ascending order.
  std::vector<Index> quads_around(const std::vector<Index>& quads, int rings) const {
    std::set<Index> found(quads.begin(), quads.end());
    std::vector<Index> outer = quads;
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<Index> next;
      for (const Index q : outer)
        for (const Index v : quads_.mesh().polygons[q])
          for (const Index near : quads_.around(v))
            if (found.insert(near).second) next.push_back(near);
      outer = std::move(next);
    }
    return {found.begin(), found.end()};
  }

  // Records the normals of the surface under the centroids and corners of these quads, and of quads
  // that share a vertex with them.
  void note_normals(const std::vector<Index>& quads) {
    normals_.resize(quads_.mesh().polygons.size(), Vector3::Zero());
    const auto note = [&](Index q) {
      Vector3 sum = quads_.normal_below(quads_.face_below_quad(q));
      for (const Index v : quads_.mesh().polygons[q]) {
        if (!quads_.is_on_border(v)) sum += quads_.normal_below(quads_.face_below_vertex(v));
      }
      normals_[q] = sum.stableNormalized();
    };
    for (const Index q : quads_around(quads, 1)) note(q);
  }

  // Returns the least area of a quad's corners relative to the surface's normal and to its sides.
  double least_corner(Index q) const {
    const std::array<Vector3, 4> p = quads_.corners_of(q);
    double least = 1;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 along = p[(k + 1) % 4] - p[k], back = p[(k + 3) % 4] - p[k];
      const double size = along.squaredNorm() + back.squaredNorm();
      if (size > 0) least = std::min(least, 2 * along.cross(back).dot(normals_[q]) / size);
    }
    return least;
  }

  // Returns the energy of the quads around a vertex.
  double energy(std::size_t v, double eps) const {
    double sum = 0;
    for (const Index q : quads_.around(v)) {
      const std::array<Vector3, 4> p = quads_.corners_of(q);
      const double scale = MovableQuads::normal_of(p).norm() + (p[2] - p[0]).squaredNorm() / 4;
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
    if (quads_.is_on_border(v)) {
      if (!quads_.slides(v)) return;
      for (const double part : kParts)
        for (const std::size_t side : {0, 1}) {
          const BorderPoint at = quads_.border()[v];
          const Vector3 place = quads_.mesh().positions[v];
          const double by = (side == 0 ? -0.5 : 0.5) * part * quads_.room_of(v)[side];
          quads_.place_on_border(
              v, quads_.lengths().point_at(at.half_edge, quads_.lengths().length_at(at) + by));
          if (energy(v, eps) < before) return;
          quads_.restore(v, place, at);
        }
      return;
    }
    const Vector3 place = quads_.mesh().positions[v];
    Vector3 normal = Vector3::Zero();
    double size = 0;  // of the longest edge
    for (const Index q : quads_.around(v)) {
      normal += normals_[q];
      const std::span<const Index> c = quads_.mesh().polygons[q];
      for (std::size_t k = 0; k < 4; ++k)
        if (c[k] == static_cast<Index>(v))
          size = std::max(size, (quads_.mesh().positions[c[(k + 1) % 4]] - place).norm());
    }
    const Vector3 below = quads_.normal_below(quads_.face_near(v, place));
    const Vector3 first = normal.stableNormalized().unitOrthogonal();
    const Vector3 second = normal.stableNormalized().cross(first);
    // The gradient and the Hessian are finite differences.
    const double h = 1e-4 * size;
    const auto at = [&](double s, double t) {
      quads_.place(v, place + h * (s * first + t * second));
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
      quads_.place(v, place);
      return;
    }
    constexpr double kMaxStep = 0.3, kLeastCosine = 0.8;
    if (step.norm() > kMaxStep * size) step *= kMaxStep * size / step.norm();
    for (const double part : kParts) {
      quads_.place(v, quads_.on_surface(v, place + part * (step.x() * first + step.y() * second)));
      // Vertices must not cross features.
      const bool is_beyond = quads_.has_features() &&
                             below.dot(quads_.normal_below(quads_.last_face(v))) < kLeastCosine;
      if (!is_beyond && energy(v, eps) < before) return;
    }
    quads_.place(v, place);
  }

  MovableQuads& quads_;
  const StopCheck& stop_;
  std::vector<Vector3> normals_;  // by quad: normal of the surface below
};

}  // namespace

void untangle(MovableQuads& quads, const StopCheck& stop) { Untangler(quads, stop).untangle(); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
