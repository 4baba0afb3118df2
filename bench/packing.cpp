// Measures time and fill of packing by the number of charts: each method on the same charts, and
// pack() with proofs.
//
// Sample runs:
//   build/release/bench/majorant_packing_bench               (to 10,000 charts)
//   build/release/bench/majorant_packing_bench 64 200        (these alone)
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "majorant/parametrization/packing/internal/nesting.h"
#include "majorant/parametrization/packing/internal/raster.h"
#include "majorant/parametrization/packing/internal/skyline.h"
#include "majorant/parametrization/packing/pack.h"

namespace {

using namespace majorant;

constexpr int kMostNested = 150;

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// Returns stars with this number of corners, and sizes from 1 down to `smallest`.
std::vector<BezierMap> stars(int count, int corners, double smallest) {
  std::mt19937_64 random(7);
  std::vector<BezierMap> charts;
  for (int k = 0; k < count; ++k) {
    PolygonMesh mesh;
    const double size = std::pow(smallest, uniform(random, 0, 1));
    std::vector<Index> star;
    for (int c = 0; c < corners; ++c) {
      const double angle = 2 * std::numbers::pi * (c + uniform(random, -0.3, 0.3)) / corners;
      const double radius = size * uniform(random, 0.4, 1);
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
      star.push_back(c);
    }
    mesh.polygons.push_back(star);
    auto surface = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(mesh));
    Vec uv(2 * surface->vertex_count());
    for (Index v = 0; v < surface->vertex_count(); ++v)
      uv.segment<2>(2 * v) = surface->positions().row(v).head<2>();
    charts.push_back(BezierMap::linear(surface, uv));
  }
  return charts;
}

double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void report(int count, int corners, double smallest) {
  const std::vector<BezierMap> charts = stars(count, corners, smallest);
  const PackingJob job =
      packing_job(charts, std::vector<AllowedRotations>(charts.size()), 4.0 / 1024);
  fmt::print("{:6} {:7} {:8}", count, corners, smallest);
  double side = std::sqrt(job.area);
  const auto time = [&](const StripPacker& strip, const SquareSearch& search) {
    std::optional<Placements> found;
    const double spent = seconds([&] { found = smallest_square(job, strip, search); });
    fmt::print("  {:8.3f} {:6.4f}", spent, found ? job.area / (found->side * found->side) : 0);
    return found ? found->side : side;
  };
  side = time([&](double width) { return skyline_strip(job, width); }, {1.5 * side, 1.25, 14});
  const double guess = 0.9 * side;
  for (const int cells : {1024, 2048})
    side = time([&](double width) { return raster_strip(job, cells, width); }, {guess, 1.08, 4});
  if (count <= kMostNested)
    time([&](double width) { return nested_strip(job, width); }, {side, 1.08, 4});
  else
    fmt::print("  {:>15}", "-");
  Packing packing;
  const double spent = seconds([&] { packing = pack(charts); });
  fmt::print("  {:8.3f} {:6.4f} {}\n", spent, packing.fill, name_of(packing.method));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print(
      "charts corners smallest  skyline: s fill   raster 512: s fill  1024           2048"
      "             pack(): s fill method\n");
  std::vector<int> counts;
  for (int k = 1; k < argc; ++k) counts.push_back(std::atoi(argv[k]));
  if (counts.empty()) counts = {5, 20, 60, 150, 400, 1000, 3000, 10000};
  for (const int count : counts) {
    report(count, 3, 0.5);
    report(count, 12, 0.5);
    report(count, 12, 1e-3);
  }
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
