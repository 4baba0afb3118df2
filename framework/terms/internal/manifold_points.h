// The points of a product of manifolds among the unknowns of a problem.
//
// Terms see the unknowns x. Coordinates y represent them: one for each unknown on no manifold, and
// for each point on a manifold those of its tangent space; the point is R(base, y - origin).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "majorant/framework/terms/manifold.h"

namespace majorant {

class ManifoldPoints {
 public:
  struct Point {
    std::shared_ptr<const Manifold> manifold;
    std::vector<Index> unknowns;
    Index first = 0;  // of its coordinates
    Index base = 0;   // the place of its base among those of all points
  };

  // Throws InvalidArgument for an unknown that does not exist, or is on two manifolds.
  ManifoldPoints(Index unknown_count, std::vector<Point> points);

  Index unknown_count() const { return static_cast<Index>(coordinate_.size()); }
  Index coordinate_count() const { return coordinate_count_; }
  Index base_count() const { return base_count_; }  // numbers of the bases of all points
  const std::vector<Point>& points() const { return points_; }
  // Returns the point of an unknown (-1: none), and the unknown's place there.
  Index point_of(Index unknown) const { return point_of_[to_size(unknown)]; }
  int place_of(Index unknown) const { return place_of_[to_size(unknown)]; }
  // Returns the coordinate of an unknown on no manifold, or the first one of a point's first
  // unknown.
  Index coordinate_of(Index unknown) const { return coordinate_[to_size(unknown)]; }

  // The bases of all points, and their origins, which move with each step.
  struct Chart {
    Vec bases;    // of all points, one after the other
    Vec origins;  // the y of the bases; 0 for unknowns on no manifold
  };
  // Returns the chart around x, which is moved onto the manifolds first; writes the coordinates y.
  // Throws InvalidArgument, with unknown and manifold, if a point has no nearest one on it.
  Chart around(const Vec& x, Vec& y) const;
  // The chart where x has these coordinates.
  Chart around(const Vec& x, const Vec& y) const;
  // x of y, full unknowns.
  Vec expand(const Chart& chart, VecIn y) const;
  // dx/dy there.
  Eigen::SparseMatrix<double> slopes(const Chart& chart, VecIn y) const;

 private:
  std::vector<Point> points_;
  std::vector<Index> point_of_, coordinate_;
  std::vector<int> place_of_;
  Index coordinate_count_ = 0, base_count_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
