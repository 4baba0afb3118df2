// The points of a product of manifolds among the unknowns of a problem.
//
// Unknowns x are those that terms see. Coordinates y stand for them: one for each unknown on no
// manifold, and those of its tangent space for each point, which is R(base, y - origin).
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/terms/manifold.h"

namespace majorant {

class ManifoldPoints {
 public:
  struct Point {
    std::shared_ptr<const Manifold> manifold;
    std::vector<Index> unknowns;
    Index first = 0;  // of its coordinates
    Index base = 0;   // where it begins among the bases of all points
  };

  // The points know unknowns alone. Throws InvalidArgument for an unknown that is not there, or on
  // two manifolds.
  ManifoldPoints(Index unknown_count, std::vector<Point> points);

  Index unknown_count() const { return static_cast<Index>(coordinate_.size()); }
  Index coordinate_count() const { return coordinate_count_; }
  const std::vector<Point>& points() const { return points_; }
  // The point that an unknown belongs to, -1: none; its place there.
  Index point_of(Index unknown) const { return point_of_[to_size(unknown)]; }
  int place_of(Index unknown) const { return place_of_[to_size(unknown)]; }
  // Returns the coordinate of an unknown on no manifold, or the first one of a point's first
  // unknown.
  Index coordinate_of(Index unknown) const { return coordinate_[to_size(unknown)]; }

  // The bases of all points, and their origins: all that moves with a step.
  struct Chart {
    Vec bases;    // of all points, one after the other
    Vec origins;  // y where x is the base: 0 for other unknowns
  };
  // The chart around x, brought onto the manifolds; y becomes its coordinates. Throws
  // InvalidArgument, with unknown and manifold, where a point has no nearest one on it.
  Chart around(const Vec& x, Vec& y) const;
  // x of y, full unknowns; as chart for that point, with these coordinates.
  Vec expand(const Chart& chart, VecIn y) const;
  Chart moved(const Chart& chart, VecIn y) const;

 private:
  std::vector<Point> points_;
  std::vector<Index> point_of_, coordinate_;
  std::vector<int> place_of_;
  Index coordinate_count_ = 0, base_count_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
