// Constrained Delaunay triangulations of CGAL and of this library: time per point, the least of
// several alternating runs. The points lie in a square, on a grid, on a circle, in clusters, on a
// parabola, and at many scales; the last case is a polygon with its edges as constraints.
//
// Sample run:
//   build/release/bench/majorant_delaunay_bench 1000 100000
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "majorant/mesh/constrained_delaunay.h"

namespace {

using namespace majorant;

constexpr int kRuns = 5;
constexpr const char* kKinds[] = {"square",   "grid",   "circle", "clusters",
                                  "parabola", "scales", "polygon"};

std::vector<Vector2> points_of(int kind, int count) {
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const int side = static_cast<int>(std::sqrt(count));
  std::vector<Vector2> points;
  for (int k = 0; k < count; ++k) {
    const double x = uniform(), y = uniform(), angle = 2 * std::numbers::pi * x;
    const Vector2 direction(std::cos(angle), std::sin(angle));
    switch (kind) {
      case 0:
        points.emplace_back(x, y);
        break;
      case 1:
        points.emplace_back(k % side, k / side);
        break;
      case 2:
        points.push_back(direction);
        break;
      case 3:
        points.emplace_back(0.1 * (k % 7) + 1e-3 * x, 1 + 1e-12 * y);
        break;
      case 4:
        points.emplace_back(x, x * x);
        break;
      case 5:
        points.push_back(std::pow(10.0, -12 * y) * direction);
        break;
      default: {
        const double turn = 2 * std::numbers::pi * k / count;
        points.push_back((1 + 0.3 * std::sin(9 * turn) + 0.2 / side * y) *
                         Vector2(std::cos(turn), std::sin(turn)));
      }
    }
  }
  return points;
}

template <class Delaunay>
double seconds(const std::vector<Vector2>& points, bool is_polygon, int repetitions) {
  const std::clock_t start = std::clock();
  for (int k = 0; k < repetitions; ++k) {
    Delaunay delaunay;
    const std::vector<Index> vertices = delaunay.insert(points);
    if (!is_polygon) continue;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (!delaunay.insert_constraint(vertices[v], vertices[(v + 1) % vertices.size()]))
        fmt::print("the polygon crosses itself\n");
  }
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / repetitions;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> counts;
  for (int k = 1; k < argc; ++k) counts.push_back(std::atoi(argv[k]));
  if (counts.empty()) counts = {300, 30000, 300000};
  fmt::print("points    of         CGAL  own  (microseconds a point)  own / CGAL\n");
  for (int kind = 0; kind < 7; ++kind)
    for (const int count : counts) {
      const std::vector<Vector2> points = points_of(kind, count);
      const int repetitions = std::max(1, 30000 / count);
      double theirs = std::numeric_limits<double>::infinity(), own = theirs;
      for (int run = 0; run < kRuns; ++run) {
        theirs = std::min(theirs, seconds<CgalDelaunay>(points, kind == 6, repetitions));
        own = std::min(own, seconds<IncrementalDelaunay>(points, kind == 6, repetitions));
      }
      const double unit = 1e6 / static_cast<double>(points.size());
      fmt::print("{:9} {:9} {:6.3f} {:6.3f} {:6.2f}\n", points.size(), kKinds[kind], unit * theirs,
                 unit * own, own / theirs);
    }
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
