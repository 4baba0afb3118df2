#include "majorant/pictures/internal/raster_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "majorant/maps/bezier_cell.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/pictures/internal/bezier_image.h"

namespace majorant {
namespace {

constexpr double kUpright = 0.9986;    // cosine of 3 degrees
constexpr double kSceneMargin = 0.02;  // relative to the box
constexpr double kChord = 0.1;         // pixels from the curve
constexpr int kMaxPieces = 64;         // along an edge
constexpr double kMaxTriangles = 4e6;
constexpr double kCutWidth = 0.9;  // pixels, on either side of a cut
constexpr double kCutLift = 2.5;   // pixels, towards the eye

// Returns the axes as rows: right, up, towards the eye.
Eigen::Matrix3d view_axes(const Vector3& view) {
  const Vector3 eye = view.stableNormalized();
  const Vector3 up = std::abs(eye.y()) > kUpright ? Vector3::UnitZ() : Vector3::UnitY();
  Eigen::Matrix3d axes;
  axes.row(0) = up.cross(eye).normalized();
  axes.row(1) = eye.cross(axes.row(0).transpose());
  axes.row(2) = eye;
  return axes;
}

// Maps the box between low and high into the middle of the picture, as large as it fits.
struct Frame {
  Vector2 middle;
  double scale;  // pixels a unit
  PixelSize size;

  Frame(const Vector2& low, const Vector2& high, PixelSize pixels)
      : middle(0.5 * low + 0.5 * high), size(pixels) {
    const Vector2 extent = (high - low).cwiseMax(1e-300);
    const double margin = kSceneMargin * std::min(size.width, size.height);
    scale = std::min((size.width - 2 * margin) / extent[0], (size.height - 2 * margin) / extent[1]);
  }

  Vector2 operator()(const Vector2& p) const {
    const Vector2 q = scale * (p - middle);
    return {0.5 * size.width + q.x(), 0.5 * size.height - q.y()};
  }
};

// Returns the largest distance of a cell's control points from the lattice of its straight
// triangle, in pixels.
double curvature_of(const MapFile& map, double scale) {
  double most = 0;
  const auto indices = bezier_multi_indices(map.degree);
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (std::size_t l = 3; l < indices.size(); ++l) {
      const auto [i, j, k] = indices[l];
      const auto point = [&](Index local) { return Vector2(map.uv.row(map.cells(c, local))); };
      const Vector2 straight = (i * point(0) + j * point(1) + k * point(2)) / map.degree;
      most = std::max(most, scale * (point(static_cast<Index>(l)) - straight).norm());
    }
  return most;
}

// Returns the number of pieces along an edge, the same for all cells, so that neighbours match.
int pieces(const MapFile& map, double scale) {
  if (map.degree == 1) return 1;
  const double needed = std::ceil(std::sqrt(curvature_of(map, scale) / kChord));
  const double most = std::sqrt(kMaxTriangles / static_cast<double>(map.cells.rows()));
  return static_cast<int>(std::clamp(std::min(needed, most), 1.0, double{kMaxPieces}));
}

// The position of a corner on the surface, by which corners of several cells are identified.
using Place = std::array<double, 3>;
Place place_of(const MapFile& map, Index c, Index k) {
  const Vector3 p = map.points.row(map.cells(c, k));
  return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // turns -0 into 0
}

// Returns the edges that the map cuts. Flag k of a cell: the edge opposite to corner k.
std::vector<std::array<bool, 3>> cut_edges(const MapFile& map) {
  std::map<std::pair<Place, Place>, std::vector<std::pair<Index, Index>>> sides;  // from, to
  const auto ends = [&](Index c, Index k) -> std::pair<Place, Place> {  // across from corner k
    return std::minmax(place_of(map, c, next(k)), place_of(map, c, previous(k)));
  };
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (Index k = 0; k < 3; ++k)
      sides[ends(c, k)].emplace_back(std::minmax(map.cells(c, next(k)), map.cells(c, previous(k))));
  std::vector<std::array<bool, 3>> cut(majorant::to_size(static_cast<Index>(map.cells.rows())));
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (Index k = 0; k < 3; ++k) {
      const auto& same = sides.at(ends(c, k));
      cut[majorant::to_size(c)][majorant::to_size(k)] =
          std::any_of(same.begin(), same.end(), [&](const auto& side) { return side != same[0]; });
    }
  return cut;
}

// Adds lines along cuts, two triangles for each side, between the sides' corners on the screen.
// They are moved towards the eye, by as much as faces seen at a steep angle rise within their
// width. depth: of a pixel.
void add_cut_lines(const MapFile& map, double depth, std::vector<RasterTriangle>& triangles) {
  const auto cut = cut_edges(map);
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (Index k = 0; k < 3; ++k) {
      if (!cut[majorant::to_size(c)][majorant::to_size(k)]) continue;
      const RasterTriangle& face = triangles[majorant::to_size(c)];
      const auto from = majorant::to_size(next(k)), to = majorant::to_size(previous(k));
      const Vector2 along = face.corners[to] - face.corners[from];
      if (!(along.norm() > 0)) continue;
      const Vector2 way = kCutWidth * along.normalized(), side(-way.y(), way.x());
      const auto corner = [&](RasterTriangle& t, std::size_t at, std::size_t end, double sign) {
        t.corners[at] = face.corners[end] + (end == from ? -way : way) + sign * side;
        t.depth[at] = face.depth[end] + kCutLift * depth;
        t.xi[at] = face.xi[end];
      };
      RasterTriangle left;
      left.cell = c;
      left.is_line = true;
      RasterTriangle right = left;
      corner(left, 0, from, -1);
      corner(left, 1, to, -1);
      corner(left, 2, to, 1);
      corner(right, 0, from, -1);
      corner(right, 1, to, 1);
      corner(right, 2, from, 1);
      triangles.push_back(left);
      triangles.push_back(right);
    }
}

}  // namespace

std::vector<RasterTriangle> surface_triangles(const MapFile& map, const Vector3& view,
                                              PixelSize size) {
  const Vector3 low = map.points.colwise().minCoeff(), high = map.points.colwise().maxCoeff();
  const Vector3 middle = 0.5 * low + 0.5 * high;
  const double radius = std::max((0.5 * high - 0.5 * low).stableNorm(), 1e-300);
  const Eigen::Matrix3d axes = view_axes(view);
  std::vector<RasterTriangle> triangles(static_cast<std::size_t>(map.cells.rows()));
  Vector2 left_low = Vector2::Constant(std::numeric_limits<double>::infinity());
  Vector2 right_high = -left_low;
  for (Index c = 0; c < map.cells.rows(); ++c) {
    RasterTriangle& t = triangles[c];
    t.cell = c;
    for (Index k = 0; k < 3; ++k) {
      const Vector3 p = axes * ((Vector3(map.points.row(map.cells(c, k))) - middle) / radius);
      t.corners[k] = p.head<2>();
      t.depth[k] = p.z();
      t.xi[k] = Barycentric::Unit(k);
      left_low = left_low.cwiseMin(t.corners[k]);
      right_high = right_high.cwiseMax(t.corners[k]);
    }
  }
  const Frame frame(left_low, right_high, size);
  for (RasterTriangle& t : triangles)
    for (Vector2& corner : t.corners) corner = frame(corner);
  add_cut_lines(map, 1 / frame.scale, triangles);
  return triangles;
}

std::vector<RasterTriangle> layout_triangles(const MapFile& map, double scale,
                                             const std::function<Vector2(const Vector2&)>& place) {
  const int n = pieces(map, scale);
  const BezierImage image(map, 1);
  std::vector<RasterTriangle> triangles;
  for (Index c = 0; c < map.cells.rows(); ++c) {
    const auto corner = [&](RasterTriangle& t, std::size_t k, int i, int j) {
      t.xi[k] = Barycentric(i, j, n - i - j) / n;
      t.corners[k] = place(image.uv(c, t.xi[k]));
      t.cell = c;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        RasterTriangle up, down;
        corner(up, 0, i, j);
        corner(up, 1, i + 1, j);
        corner(up, 2, i, j + 1);
        triangles.push_back(up);
        if (i + j + 1 == n) continue;
        corner(down, 0, i + 1, j + 1);
        corner(down, 1, i, j + 1);
        corner(down, 2, i + 1, j);
        triangles.push_back(down);
      }
  }
  return triangles;
}

// Corners at one place are one point, so that cuts are invisible.
SmoothNormals::SmoothNormals(const MapFile& map) : normals_(3 * map.cells.rows(), 3) {
  std::map<Place, Vector3> at_place;
  const auto corner = [&](Index c, Index k) { return Vector3(map.points.row(map.cells(c, k))); };
  for (Index c = 0; c < map.cells.rows(); ++c) {
    const Vector3 normal = (corner(c, 1) - corner(c, 0)).cross(corner(c, 2) - corner(c, 0));
    for (Index k = 0; k < 3; ++k)
      at_place.try_emplace(place_of(map, c, k), Vector3::Zero()).first->second += normal;
  }
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (Index k = 0; k < 3; ++k)
      normals_.row(3 * c + k) = at_place.at(place_of(map, c, k)).stableNormalized();
}

Vector3 SmoothNormals::at(Index cell, const Barycentric& xi) const {
  return (normals_.middleRows(3 * cell, 3).transpose() * xi).stableNormalized();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
