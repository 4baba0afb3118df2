#include "majorant/framework/terms/internal/manifold_points.h"

#include <fmt/format.h>

#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"

namespace majorant {

ManifoldPoints::ManifoldPoints(Index unknown_count, std::vector<Point> points)
    : points_(std::move(points)),
      point_of_(to_size(unknown_count), -1),
      coordinate_(to_size(unknown_count), -1),
      place_of_(to_size(unknown_count), 0) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Point& point = points_[p];
    point.base = base_count_;
    base_count_ += point.manifold->size();
    require_size(
        "ManifoldProblem: the unknowns of a point on a " + std::string(point.manifold->name()),
        static_cast<Index>(point.unknowns.size()), point.manifold->size());
    for (std::size_t k = 0; k < point.unknowns.size(); ++k) {
      const Index unknown = point.unknowns[k];
      require_index("ManifoldProblem: an unknown of a point", unknown, unknown_count);
      if (point_of_[to_size(unknown)] >= 0)
        throw InvalidArgument(fmt::format(
            "ManifoldProblem: unknown {} lies on two manifolds, or twice on one", unknown));
      point_of_[to_size(unknown)] = static_cast<Index>(p);
      place_of_[to_size(unknown)] = static_cast<int>(k);
    }
  }
  // Coordinates have the order of the unknowns, so that neighbours stay neighbours.
  std::vector<char> is_numbered(points_.size(), 0);
  for (Index i = 0; i < unknown_count; ++i) {
    const Index p = point_of_[to_size(i)];
    if (p >= 0 && is_numbered[to_size(p)]) continue;
    coordinate_[to_size(i)] = coordinate_count_;
    if (p < 0) {
      ++coordinate_count_;
      continue;
    }
    is_numbered[to_size(p)] = 1;
    points_[to_size(p)].first = coordinate_count_;
    coordinate_count_ += points_[to_size(p)].manifold->dimension();
  }
}

ManifoldPoints::Chart ManifoldPoints::around(const Vec& x, Vec& y) const {
  require_size("ManifoldProblem: x", x.size(), unknown_count());
  require_finite("ManifoldProblem: x", x);
  Chart chart{Vec(base_count_), Vec::Zero(coordinate_count_)};
  y = Vec::Zero(coordinate_count_);
  for (Index i = 0; i < unknown_count(); ++i)
    if (point_of(i) < 0) y[coordinate_of(i)] = x[i];
  for (const Point& point : points_) {
    double* const base = chart.bases.data() + point.base;
    for (std::size_t k = 0; k < point.unknowns.size(); ++k) base[k] = x[point.unknowns[k]];
    if (!point.manifold->project(base))
      throw InvalidArgument(fmt::format(
          "ManifoldProblem: the point that begins with unknown {} has no nearest one on the {}; "
          "start elsewhere",
          point.unknowns.front(), point.manifold->name()));
  }
  return chart;
}

Vec ManifoldPoints::expand(const Chart& chart, VecIn y) const {
  Vec x(unknown_count());
  for (Index i = 0; i < unknown_count(); ++i)
    if (point_of(i) < 0) x[i] = y[coordinate_of(i)];
  for (const Point& point : points_) {
    const Vec t = y.segment(point.first, point.manifold->dimension()) -
                  chart.origins.segment(point.first, point.manifold->dimension());
    Vec at(point.manifold->size());
    point.manifold->retract(chart.bases.data() + point.base, t.data(), at.data(), nullptr, nullptr);
    for (std::size_t k = 0; k < point.unknowns.size(); ++k)
      x[point.unknowns[k]] = at[static_cast<Index>(k)];
  }
  return x;
}

ManifoldPoints::Chart ManifoldPoints::around(const Vec& x, const Vec& y) const {
  Vec ignored;
  Chart chart = around(x, ignored);
  for (const Point& point : points_)
    chart.origins.segment(point.first, point.manifold->dimension()) =
        y.segment(point.first, point.manifold->dimension());
  return chart;
}

Eigen::SparseMatrix<double> ManifoldPoints::slopes(const Chart& chart, VecIn y) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < unknown_count(); ++i)
    if (point_of(i) < 0) entries.emplace_back(i, coordinate_of(i), 1.0);
  for (const Point& point : points_) {
    const Index d = point.manifold->dimension(), size = point.manifold->size();
    const Vec t = y.segment(point.first, d) - chart.origins.segment(point.first, d);
    Vec at(size), parts(size * d);
    point.manifold->retract(chart.bases.data() + point.base, t.data(), at.data(), parts.data(),
                            nullptr);
    for (Index k = 0; k < size; ++k)
      for (Index a = 0; a < d; ++a)
        entries.emplace_back(point.unknowns[to_size(k)], point.first + a, parts[k * d + a]);
  }
  Eigen::SparseMatrix<double> all(unknown_count(), coordinate_count());
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
