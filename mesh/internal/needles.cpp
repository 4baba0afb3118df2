#include "majorant/mesh/internal/needles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "majorant/mesh/repair.h"

namespace majorant {
namespace {

class Regularizing {
 public:
  Regularizing(const Points3& positions, const Cells& faces)
      : positions_(positions),
        faces_(faces),
        sum_(to_size(vertices())),
        count_(to_size(vertices())) {
    double total = 0;
    Index edges = 0;
    for (Index f = 0; f < faces.rows(); ++f)
      for (Index k = 0; k < 3; ++k) {
        const double l = length(f, k);
        if (!(l > 0)) continue;
        for (const Index v : {faces(f, k), faces(f, next(k))}) {
          sum_[v] += l;
          ++count_[v];
        }
        total += l;
        ++edges;
      }
    mean_ = edges > 0 ? total / edges : 1;
  }

  std::vector<RestTriangle> triangles(double least_height) const {
    std::vector<RestTriangle> out;
    for (Index f = 0; f < faces_.rows(); ++f) {
      Index longest = 0;
      for (Index k = 1; k < 3; ++k)
        if (length(f, k) > length(f, longest)) longest = k;
      const double size = length(f, longest);
      if (!(size > 0))
        out.push_back({f, point(f)});
      else if (!(height(f) > least_height))
        out.push_back({f, needle(f, longest, size)});
    }
    return out;
  }

 private:
  Index vertices() const { return static_cast<Index>(positions_.rows()); }
  Vector3 edge(Index f, Index k) const {
    return positions_.row(faces_(f, next(k))) - positions_.row(faces_(f, k));
  }
  double length(Index f, Index k) const { return edge(f, k).stableNorm(); }

  // Returns the height over the longest edge, relative to that edge.
  double height(Index f) const {
    const double longest = std::max({length(f, 0), length(f, 1), length(f, 2)});
    return (edge(f, 0) / longest).cross(edge(f, 1) / longest).norm();
  }

  // Returns the rest triangle of a needle; the foot of its height keeps its place.
  std::array<Vector2, 3> needle(Index f, Index longest, double size) const {
    const Vector3 along = edge(f, longest) / size, up = -edge(f, previous(longest));
    std::array<Vector2, 3> corners;
    corners[longest] = {0, 0};
    corners[next(longest)] = {size, 0};
    corners[previous(longest)] = {std::clamp(along.dot(up), 0.0, size), kNeedleHeight * size};
    return corners;
  }

  std::array<Vector2, 3> point(Index f) const {
    double sum = 0;
    Index count = 0;
    for (Index k = 0; k < 3; ++k) {
      sum += sum_[faces_(f, k)];
      count += count_[faces_(f, k)];
    }
    const double side = kNeedleHeight * (count > 0 ? sum / count : mean_);
    return {Vector2(0, 0), Vector2(side, 0), Vector2(side / 2, std::sqrt(0.75) * side)};
  }

  const Points3& positions_;
  const Cells& faces_;
  std::vector<double> sum_;   // by vertex: the total length of its edges of positive length,
  std::vector<Index> count_;  // and their number
  double mean_;
};

}  // namespace

std::vector<RestTriangle> needles_of(const Points3& positions, const Cells& faces,
                                     double least_height) {
  return Regularizing(positions, faces).triangles(least_height);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
