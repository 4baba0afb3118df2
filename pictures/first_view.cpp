#include "majorant/pictures/first_view.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "majorant/pictures/internal/raster_scene.h"

namespace majorant {
namespace {

constexpr double kOneSided = 0.2;  // |sum of normals| / area above which one side is the front
constexpr int kSide = 96;          // pixels of the pictures that are compared
constexpr int kDirections = 12;    // around the vertical axis
constexpr double kAzimuth = 20, kElevation = 20;  // of the first one, degrees
constexpr double kBetter = 1e-3;                  // improvement that a later direction needs

// Returns zero if no side is the front.
Vector3 front_of(const MapFile& map) {
  const Vector3 low = map.points.colwise().minCoeff(), high = map.points.colwise().maxCoeff();
  const double size = (0.5 * high - 0.5 * low).maxCoeff();
  Vector3 sum = Vector3::Zero();
  double area = 0;
  for (Index c = 0; c < map.cells.rows(); ++c) {
    const auto corner = [&](Index k) -> Vector3 {
      return (0.5 * Vector3(map.points.row(map.cells(c, k))) - 0.5 * low) / size;
    };
    const Vector3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    sum += normal;
    area += normal.norm();
  }
  return sum.norm() > kOneSided * area ? Vector3(sum / sum.norm()) : Vector3::Zero();
}

// Returns the entropy of the cells' shares of the picture, in bits.
double entropy(const MapFile& map, const Vector3& view) {
  constexpr PixelSize kSize{kSide, kSide};
  constexpr std::size_t kRow = kSide * kSamplesPerPixel;
  std::vector<Index> shown(kRow * kSide, -1);
  std::vector<RasterTriangle> triangles = surface_triangles(map, view, kSize);
  std::erase_if(triangles, [](const RasterTriangle& t) { return t.is_line; });
  rasterize(triangles, kSize, [&](int y, std::span<const Fragment> samples) {
    for (std::size_t k = 0; k < samples.size(); ++k) shown[to_size(y) * kRow + k] = samples[k].cell;
  });
  std::vector<double> samples(to_size(static_cast<Index>(map.cells.rows())));
  double all = 0;
  for (const Index cell : shown)
    if (cell >= 0) ++samples[cell], ++all;
  double sum = 0;
  for (const double count : samples)
    if (count > 0) sum -= count / all * std::log2(count / all);
  return sum;
}

Vector3 direction(double azimuth, double elevation) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double level = std::cos(kDegree * elevation);
  return {level * std::sin(kDegree * azimuth), std::sin(kDegree * elevation),
          level * std::cos(kDegree * azimuth)};
}

}  // namespace

Vector3 first_view(const MapFile& map) {
  if (const Vector3 front = front_of(map); !front.isZero(0)) return front;
  Vector3 best = direction(kAzimuth, kElevation);
  double most = entropy(map, best);
  for (int k = 1; k < kDirections; ++k) {
    const Vector3 view = direction(kAzimuth + k * 360.0 / kDirections, kElevation);
    const double found = entropy(map, view);
    if (!(found > most + kBetter * most)) continue;
    most = found;
    best = view;
  }
  return best;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
