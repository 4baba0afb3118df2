#include "majorant/certify/overlap_extent.h"

#include <algorithm>
#include <array>

#include "majorant/mesh/box_tree.h"

namespace majorant {
namespace {

using TriangleCorners = std::array<Vector2, 3>;

// Segments of an edge of a curved face, which gives 16 pieces a face.
constexpr int kSegments = 4;
// Overlaps of a smaller part of the smaller piece are attributed to rounding along a common edge.
constexpr double kLeastPart = 1e-9;
// The largest number of pairs of pieces whose boxes meet, about four seconds. With more pairs the
// extent is not measured.
constexpr std::size_t kMaxPairs = 100'000'000;

double twice_area(const TriangleCorners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

// Returns the area that two positive triangles share, by clipping b at one side of a after the
// other.
double shared_area(const TriangleCorners& a, const TriangleCorners& b) {
  constexpr std::size_t kMaximum = 9;  // corners; each side adds at most half as many, with any
                                       // rounding
  std::array<Vector2, kMaximum> polygon, next;
  std::size_t count = 3;
  for (std::size_t k = 0; k < 3; ++k) polygon[k] = b[k] - a[0];
  for (std::size_t side = 0; side < 3 && count > 0; ++side) {
    const Vector2 from = a[side] - a[0], along = a[(side + 1) % 3] - a[side];
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2 &p = polygon[k], &q = polygon[(k + 1) % count];
      const double at_p = cross(along, p - from), at_q = cross(along, q - from);
      if (at_p >= 0) next[kept++] = p;
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
        next[kept++] = p + at_p / (at_p - at_q) * (q - p);
    }
    polygon = next;
    count = kept;
  }
  double twice = 0;
  for (std::size_t k = 2; k < count; ++k)
    twice += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return twice / 2;
}

class ExtentOfOverlap {
 public:
  ExtentOfOverlap(const BezierMap& map, const std::vector<Index>& layer) : layer_(layer) {
    area_.setZero(map.mesh().face_count());
    for (Index f = 0; f < area_.size(); ++f) add_pieces(map, f);
  }

  std::optional<OverlapExtent> measure(const StopCheck& stop) {
    std::vector<Box2> boxes;
    for (const TriangleCorners& t : pieces_)
      boxes.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])});
    covered_.setZero(area_.size());
    std::size_t pairs = 0;
    BoxTree(std::move(boxes)).visit_pairs([&](Index i, Index j) {
      stop.poll_at(pairs);
      compare(i, j);
      return ++pairs <= kMaxPairs;
    });
    if (pairs > kMaxPairs) return std::nullopt;
    OverlapExtent found;
    found.faces = static_cast<Index>((covered_.array() > 0).count());
    if (found.faces > 0) found.share = covered_.cwiseMin(area_).sum() / area_.sum();
    return found;
  }

 private:
  void add_pieces(const BezierMap& map, Index face) {
    const int n = map.degree() == 1 ? 1 : kSegments;
    const auto point = [&](int i, int j) {
      return map.evaluate(face, Barycentric(n - i - j, i, j) / n);
    };
    const auto add = [&](const TriangleCorners& piece) {
      const double area = twice_area(piece) / 2;
      if (!(area > 0)) return;
      pieces_.push_back(piece);
      face_.push_back(face);
      area_[face] += area;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add({point(i, j), point(i + 1, j), point(i, j + 1)});
        if (i + j + 1 < n) add({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
  }

  void compare(Index i, Index j) {
    const Index f = face_[to_size(i)], g = face_[to_size(j)];
    if (f == g || (!layer_.empty() && layer_[to_size(f)] != layer_[to_size(g)])) return;
    const TriangleCorners &a = pieces_[to_size(i)], &b = pieces_[to_size(j)];
    const double shared = shared_area(a, b);
    if (shared <= kLeastPart * std::min(twice_area(a), twice_area(b)) / 2) return;
    covered_[f] += shared;
    covered_[g] += shared;
  }

  const std::vector<Index>& layer_;
  std::vector<TriangleCorners> pieces_;
  std::vector<Index> face_;  // by piece
  Vec area_, covered_;       // areas by face; covered: by each other face
};

}  // namespace

std::optional<OverlapExtent> overlap_extent(const BezierMap& map, const std::vector<Index>& layer,
                                            const StopCheck& stop) {
  return ExtentOfOverlap(map, layer).measure(stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
