#include "majorant/certify/cut_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "majorant/constraints/cut_surface.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/sound_surface.h"

namespace majorant {
namespace {

constexpr Index kHalfEdges = 16384;  // of a task, about 0.1 ms

// Returns the surface of the cells. vertex: by point; points with one number are at one position.
SurfaceParts parts_of(const MapFile& file, const Eigen::VectorXi& vertex,
                      const std::vector<Vector3>& positions, const std::string& name) {
  const auto corners = file.cells.leftCols<3>();
  std::vector<Index> number(positions.size(), -1);
  for (const Index point : corners.reshaped<Eigen::RowMajor>()) number[vertex[point]] = 0;
  SurfaceParts parts;
  parts.file = name;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<Index>(parts.input_vertex.size());
    parts.input_vertex.push_back(static_cast<Index>(v));
  }
  parts.positions.resize(static_cast<Index>(parts.input_vertex.size()), 3);
  for (Index v = 0; v < parts.positions.rows(); ++v)
    parts.positions.row(v) = positions[parts.input_vertex[v]];
  parts.faces.resize(corners.rows(), 3);
  for (Index c = 0; c < corners.rows(); ++c)
    for (Index k = 0; k < 3; ++k) parts.faces(c, k) = number[vertex[corners(c, k)]];
  parts.input_face.resize(to_size(static_cast<Index>(corners.rows())));
  std::iota(parts.input_face.begin(), parts.input_face.end(), 0);
  return parts;
}

std::shared_ptr<const SurfaceMesh> welded(const MapFile& file, const std::string& name) {
  const Eigen::VectorXi vertex =
      knows_vertices(file) ? file.input_vertex : number_by_place(file.points, {});
  PolygonMesh polygons;
  polygons.file = name;
  polygons.positions = vertex_positions(file, vertex, name);
  if (auto sound = sound_surface(parts_of(file, vertex, polygons.positions, name)))
    return std::make_shared<const SurfaceMesh>(std::move(*sound));
  const auto corners = file.cells.leftCols<3>();
  for (Index c = 0; c < corners.rows(); ++c)
    polygons.polygons.push_back(
        {vertex[corners(c, 0)], vertex[corners(c, 1)], vertex[corners(c, 2)]});
  return repair(polygons, {.orientation = Orientation::AsGiven, .numerics = Numerics::AsGiven})
      .mesh;
}

// Returns the nearest numbers of quarter turns, 0 at the boundary of the uncut surface.
std::vector<int> quarter_turns(const SurfaceMesh& mesh, const std::vector<Index>& surface_vertex,
                               VecIn angle_sums) {
  std::vector<double> sum(to_size(mesh.vertex_count()), 0);
  for (std::size_t v = 0; v < surface_vertex.size(); ++v)
    sum[surface_vertex[v]] += angle_sums[static_cast<Index>(v)];
  std::vector<int> turns;
  for (const double s : sum)
    turns.push_back(std::max(1, static_cast<int>(std::lround(2 * s / std::numbers::pi))));
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) turns[v] = 0;
  return turns;
}

}  // namespace

bool knows_vertices(const MapFile& file) {
  return file.input_vertex.size() == file.points.rows() &&
         file.input_vertex(file.cells.leftCols<3>().reshaped()).minCoeff() >= 0;
}

Eigen::VectorXi number_by_place(const Points3& points, const PolygonMesh& known) {
  std::map<std::array<double, 3>, Index> number;
  const auto key = [](const Vector3& p) {  // turns -0 into 0
    return std::array<double, 3>{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
  };
  for (const Index v : known.polygons.indices()) number.emplace(key(known.positions[v]), v);
  auto next = static_cast<Index>(known.positions.size());
  Eigen::VectorXi vertex(points.rows());
  for (Index p = 0; p < points.rows(); ++p) {
    const auto [entry, is_new] = number.emplace(key(points.row(p)), next);
    next += is_new;
    vertex[p] = entry->second;
  }
  return vertex;
}

CutMap::CutMap(const MapFile& file, std::string name)
    : file_(file),
      name_(std::move(name)),
      surface_(welded(file, name_)),
      edge_points_(to_size(file.degree) + 1),
      differs_(to_size(surface_->half_edge_count()), 0),
      is_unshared_(differs_) {
  parallel_for(surface_->half_edge_count(), kHalfEdges, [&](Index h) {
    const Index opposite = surface_->opposite(h);
    if (opposite < h) return;
    std::size_t shared = 0, equal = 0;
    for (std::size_t i = 0; i < edge_points_; ++i) {
      const Index p = point(h, i), q = opposite_point(h, i);
      const bool is_end = i == 0 || i + 1 == edge_points_;
      shared += p == q && (!is_end || edge_points_ == 2);
      equal += file.uv.row(p) == file.uv.row(q);
    }
    differs_[h] = differs_[opposite] = equal < edge_points_;
    is_unshared_[h] = is_unshared_[opposite] = edge_points_ == 2 ? shared < 2 : shared == 0;
  });
}

// Returns point i = 0..n along a half-edge; the direction of the opposite half-edge is reversed.
Index CutMap::point(Index h, std::size_t i) const {
  return file_.cells(face_of(h), TriangleIndices::of_degree(file_.degree).edge(corner_of(h))[i]);
}

Index CutMap::opposite_point(Index h, std::size_t i) const {
  return point(surface_->opposite(h), edge_points_ - 1 - i);
}

CutMap::Fit CutMap::fit(Index h) const {
  Fit best{0, INFINITY};
  for (int turns = 0; turns < 4; ++turns) {
    double worst = 0;
    for (std::size_t i = 1; i < edge_points_; ++i) {
      const Vector2 mine = file_.uv.row(point(h, i)) - file_.uv.row(point(h, 0));
      const Vector2 other = file_.uv.row(opposite_point(h, i)) - file_.uv.row(opposite_point(h, 0));
      worst = std::max(worst, (mine - rotated(other, turns)).lpNorm<Eigen::Infinity>());
    }
    if (worst < best.mismatch) best = {turns, worst};
  }
  return best;
}

double CutMap::diagonal() const {
  Eigen::AlignedBox2d box;
  for (const Index point : file_.cells.reshaped()) box.extend(Vector2(file_.uv.row(point)));
  return box.isEmpty() ? 0 : (box.max() - box.min()).norm();
}

double CutMap::mean_length() const {
  double sum = 0;
  for (Index h = 0; h < surface_->half_edge_count(); ++h)
    sum += (file_.uv.row(point(h, 0)) - file_.uv.row(point(h, edge_points_ - 1))).norm();
  return sum / surface_->half_edge_count();
}

std::array<Index, 2> CutMap::input_edge(Index h) const {
  return {surface_->input_vertex(surface_->from_vertex(h)),
          surface_->input_vertex(surface_->to_vertex(h))};
}

std::string CutMap::place(Index h) const {
  const auto [from, to] = input_edge(h);
  return fmt::format("edge ({}, {})", from, to);
}

BezierMap CutMap::map_cut_along(const std::vector<char>& is_cut) const {
  // A map without cuts stays the same.
  auto cut = std::count(is_cut.begin(), is_cut.end(), 0) == surface_->half_edge_count()
                 ? surface_
                 : std::make_shared<const SurfaceMesh>(surface_->cut_along(is_cut, nullptr));
  auto space =
      std::make_shared<const BezierTriangleSpace>(cut->faces(), cut->vertex_count(), file_.degree);
  Vec x = node_values(file_, *space, name_);
  return BezierMap(std::move(cut), std::move(space), std::move(x));
}

BezierMap CutMap::map_with_seams() const {
  const double tolerance = kSeamTolerance * mean_length();
  std::vector<char> is_seam(differs_.size(), 0);
  std::vector<int> turns(differs_.size(), 0);
  for (Index h = 0; h < surface_->half_edge_count(); ++h) {
    const Index opposite = surface_->opposite(h);
    if (opposite < h || !(differs(h) || is_unshared(h))) continue;
    const Fit best = fit(h);
    if (!(best.mismatch <= tolerance))
      throw Error(ErrorKind::Invalid,
                  fmt::format("{}: the map is not continuous and not seamless at {}: its sides "
                              "differ by {:.3g} after the best rotation by a multiple of 90 "
                              "degrees",
                              name_, place(h), best.mismatch));
    is_seam[h] = is_seam[opposite] = 1;
    turns[h] = best.turns;
    turns[opposite] = (4 - best.turns) % 4;
  }
  std::vector<Index> surface_vertex;
  const SurfaceMesh cut = surface_->cut_along(is_seam, &surface_vertex);
  const auto space =
      std::make_shared<const BezierTriangleSpace>(cut.faces(), cut.vertex_count(), file_.degree);
  Vec x = node_values(file_, *space, name_);
  const CutSurface open =
      cut_open(*surface_, is_seam, turns,
               quarter_turns(*surface_, surface_vertex, vertex_angle_sums(*space, x)));
  return BezierMap(open.mesh, space, std::move(x), open.seams);
}

bool is_cut(const MapFile& file) {
  std::unordered_set<Index> seen;
  return std::any_of(file.input_vertex.begin(), file.input_vertex.end(),
                     [&](Index v) { return v >= 0 && !seen.insert(v).second; });
}

std::vector<std::array<Index, 2>> unshared_edges(const MapFile& file, const std::string& name) {
  std::vector<std::array<Index, 2>> edges;
  if (!is_cut(file)) return edges;
  const CutMap cut(file, name);
  for (Index h = 0; h < cut.surface().half_edge_count(); ++h)
    if (cut.surface().opposite(h) > h && cut.is_unshared(h)) edges.push_back(cut.input_edge(h));
  return edges;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
