#include "majorant/mesh/repair.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/argument_check.h"
#include "majorant/mesh/half_edge.h"
#include "majorant/mesh/internal/mesh_messages.h"
#include "majorant/mesh/internal/mesh_validation.h"
#include "majorant/mesh/internal/place_text.h"
#include "majorant/mesh/internal/sheets.h"
#include "majorant/mesh/internal/texture_borders.h"
#include "majorant/mesh/internal/triangle_list.h"
#include "majorant/mesh/internal/triangulate_polygon.h"
#include "majorant/mesh/internal/weld.h"

namespace majorant {
namespace {

using Places = std::vector<std::array<Index, 2>>;

// Rest triangles of faces without area and of needles: repair.h says which, and why.
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

  // Over the longest edge, in parts of it.
  double height(Index f) const {
    const double longest = std::max({length(f, 0), length(f, 1), length(f, 2)});
    return (edge(f, 0) / longest).cross(edge(f, 1) / longest).norm();
  }

  // The foot of its height stays where it is.
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
  std::vector<double> sum_;   // by vertex: lengths of edges there that have one,
  std::vector<Index> count_;  // how many
  double mean_;
};

const FindingText& text_of(RepairKind kind) {
  static constexpr std::array<FindingText, 10> kTexts = {{
      {"welded", "vertex welded to another", "vertices welded to others", "vertex"},
      {"repeated_vertex", "face with a repeated vertex split off",
       "faces with a repeated vertex split off", "face"},
      {"duplicate_face", "duplicate or folded face split off",
       "duplicate or folded faces split off", "face"},
      {"split_edge", "edge of more than two faces split", "edges of more than two faces split",
       "edge"},
      {"split_vertex", "vertex split, a copy for every sheet",
       "vertices split, a copy for every sheet", "vertex"},
      {"turned_face", "face turned to agree with its neighbours",
       "faces turned to agree with their neighbours", "face"},
      {"cut_edge", "edge cut, where faces cannot agree on a side",
       "edges cut, where faces cannot agree on a side", "edge"},
      {"crossing_polygon", "polygon that crosses itself taken as triangles",
       "polygons that cross themselves taken as triangles", "face"},
      {"regularized_face", "face with no or nearly no area measured against a needle",
       "faces with no or nearly no area measured against needles", "face"},
      {"moved_to_origin", "mesh moved to the origin for the run",
       "meshes moved to the origin for the run", ""},
  }};
  return kTexts[static_cast<std::size_t>(kind)];
}

// Where every coordinate is far from 0 for their range, a point from which all differences are
// exact: half way between the smallest and the largest, of which none is more than twice another.
Vector3 origin_of(const PolygonMesh& input, const std::vector<Index>& used) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vector3 low = Vector3::Constant(kInfinity), high = -low, origin = Vector3::Zero();
  for (const Index v : used) {
    low = low.cwiseMin(input.positions[v]);
    high = high.cwiseMax(input.positions[v]);
  }
  const double extent = (high - low).maxCoeff();
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  if (!(largest > kFarAway * extent)) return origin;
  for (int k = 0; k < 3; ++k) {
    const double a = std::min(std::abs(low[k]), std::abs(high[k]));
    const double b = std::max(std::abs(low[k]), std::abs(high[k]));
    if (std::signbit(low[k]) == std::signbit(high[k]) && b <= 2 * a)
      origin[k] = low[k] + (high[k] - low[k]) / 2;
  }
  return origin;
}

// Part of the area of a polygon's triangles that may face aside or away: coordinates of
// five digits; polygons that are bent more do not cross themselves in space.
constexpr double kAside = 1e-4;

// Whether triangles over these corners are in one plane, and some face its other side.
bool disagree(const std::vector<Vector3>& corners,
              const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Vector3> areas;
  Vector3 normal = Vector3::Zero();  // of the largest
  double sum = 0;
  for (const auto& t : triangles) {
    const Vector3& first = corners[t[0]];
    areas.push_back((corners[t[1]] - first).cross(corners[t[2]] - first));
    if (areas.back().norm() > normal.norm()) normal = areas.back();
    sum += areas.back().norm();
  }
  if (sum == 0) return false;
  normal.normalize();
  bool is_plane = true, is_any_away = false;
  for (const Vector3& area : areas) {
    is_plane = is_plane && area.cross(normal).norm() <= kAside * sum;
    is_any_away = is_any_away || area.dot(normal) < -kAside * sum;
  }
  return is_plane && is_any_away;
}

// triangles: of the polygon with these corners; texture coordinates may have chosen them.
bool is_crossing(const std::vector<Vector3>& corners,
                 const std::vector<std::array<int, 3>>& triangles) {
  if (!disagree(corners, triangles)) return false;
  try {
    return disagree(corners, triangulate_polygon(corners));
  } catch (const Error&) {
    return true;
  }
}

class Repairing {
 public:
  Repairing(const PolygonMesh& input, const RepairOptions& options, const StopCheck& stop)
      : input_(input), options_(options), stop_(stop) {}

  RepairedSurface run() {
    require_sound_lists(input_);
    if (options_.weld) require_at_least("repair: RepairOptions::weld", *options_.weld, 0);
    weld_vertices();
    stop_.poll();
    list_ = triangulate(input_, Crossing::Fanned, stop_);
    given_.resize(static_cast<Index>(list_.triangles.size()), 3);
    for (Index f = 0; f < given_.rows(); ++f)
      for (Index k = 0; k < 3; ++k) given_(f, k) = welded_[list_.triangles[f][k]];
    std::vector<std::vector<Index>> polygons = input_.polygons;
    for (auto& polygon : polygons)
      for (Index& v : polygon) v = welded_[v];
    sheets_ =
        make_sheets(given_, list_.polygon, polygons, input_.positions, options_.orientation, stop_);
    out_.one_sided = sheets_.one_sided;
    turn_corners();
    build();
    find_given_cuts();
    for (const Index v : coincident_vertices(input_)) out_.coincident_left += welded_[v] == v;
    note_all();
    return std::move(out_);
  }

 private:
  void weld_vertices() {
    if (options_.weld || is_soup(input_)) {
      welded_ = weld(input_, options_.weld.value_or(0), stop_);
      return;
    }
    welded_.resize(input_.positions.size());
    std::iota(welded_.begin(), welded_.end(), 0);
  }

  // The list as the faces are in the end.
  void turn_corners() {
    for (std::size_t f = 0; f < list_.triangles.size(); ++f)
      if (sheets_.is_turned[f]) {
        std::swap(list_.triangles[f][1], list_.triangles[f][2]);
        std::swap(list_.corners[f][1], list_.corners[f][2]);
      }
  }

  void build() {
    SurfaceParts parts;
    parts.file = input_.file;
    parts.input_face = list_.polygon;
    parts.faces = sheets_.faces;
    parts.input_vertex = sheets_.vertex;
    if (options_.numerics == Numerics::ForSolving) parts.origin = origin_of(input_, sheets_.vertex);
    parts.positions.resize(static_cast<Index>(sheets_.vertex.size()), 3);
    for (Index v = 0; v < parts.positions.rows(); ++v) {
      const Vector3& p = input_.positions[sheets_.vertex[v]];
      parts.positions.row(v) = parts.origin.isZero(0) ? p : Vector3(p - parts.origin);
    }
    place_texcoords(input_, list_, parts);
    parts.rest_triangles =
        Regularizing(parts.positions, parts.faces)
            .triangles(options_.numerics == Numerics::ForSolving ? kNeedleHeight
                                                                 : kDegenerateHeight);
    out_.mesh =
        std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts), stop_));
    out_.polygon_corner.resize(given_.rows(), 3);
    for (Index f = 0; f < given_.rows(); ++f)
      for (Index k = 0; k < 3; ++k) out_.polygon_corner(f, k) = list_.corners[f][k];
  }

  // An edge that welding closed, whose two sides have other texture coordinates.
  void find_given_cuts() {
    const SurfaceMesh& mesh = *out_.mesh;
    out_.given_cuts.assign(to_size(mesh.half_edge_count()), 0);
    const CornerPoints& uv = mesh.corner_texcoords();
    if (uv.rows() == 0) return;
    const auto file_vertex = [&](Index c) { return list_.triangles[face_of(c)][corner_of(c)]; };
    const auto texture = [&](Index c) -> Vector2 {
      return uv.row(face_of(c)).segment<2>(2 * corner_of(c));
    };
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      const Index o = mesh.opposite(h);
      if (o < h || !is_textured(mesh, face_of(h)) || !is_textured(mesh, face_of(o))) continue;
      const bool is_welded =
          file_vertex(h) != file_vertex(next(o)) || file_vertex(next(h)) != file_vertex(o);
      if (is_welded && (texture(h) != texture(next(o)) || texture(next(h)) != texture(o)))
        out_.given_cuts[h] = out_.given_cuts[o] = 1;
    }
  }

  void note(RepairKind kind, Places places) {
    if (places.empty()) return;
    Repair repair{kind, static_cast<Index>(places.size()), std::move(places)};
    if (repair.places.size() > kNamedPlaces) repair.places.resize(kNamedPlaces);
    out_.repairs.push_back(std::move(repair));
  }

  // Polygons that these triangles belong to.
  Places polygons(const std::vector<Index>& triangles) const {
    Places places;
    for (const Index t : triangles) places.push_back({list_.polygon[t], -1});
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

  Places edges(const std::vector<Index>& half_edges) const {
    Places places;
    for (const Index h : half_edges) {
      const auto [a, b] = std::minmax({from_vertex(given_, h), to_vertex(given_, h)});
      places.push_back({a, b});
    }
    std::sort(places.begin(), places.end());
    return places;
  }

  // Triangles of a polygon come one after the other.
  Places crossing_polygons() const {
    Places places;
    for (std::size_t t = 0, end = 0; t < list_.polygon.size(); t = end) {
      const Index p = list_.polygon[t];
      std::vector<std::array<int, 3>> triangles;
      for (; end < list_.polygon.size() && list_.polygon[end] == p; ++end) {
        triangles.push_back(list_.corners[end]);
        if (sheets_.is_turned[end]) std::swap(triangles.back()[1], triangles.back()[2]);
      }
      if (triangles.size() == 1) continue;
      std::vector<Vector3> corners;
      for (const Index v : input_.polygons[p]) corners.push_back(input_.positions[v]);
      if (is_crossing(corners, triangles)) places.push_back({p, -1});
    }
    return places;
  }

  static Places vertices(const std::vector<Index>& vertices) {
    Places places;
    for (const Index v : vertices) places.push_back({v, -1});
    return places;
  }

  void note_all() {
    Places welded;
    for (std::size_t v = 0; v < welded_.size(); ++v)
      if (welded_[v] != static_cast<Index>(v)) welded.push_back({static_cast<Index>(v), -1});
    note(RepairKind::Welded, std::move(welded));
    note(RepairKind::RepeatedVertex, polygons(sheets_.repeated));
    note(RepairKind::DuplicateFace, polygons(sheets_.duplicates));
    note(RepairKind::SplitEdge, edges(sheets_.split_edges));
    note(RepairKind::SplitVertex, vertices(sheets_.split_vertices));
    note(RepairKind::TurnedFace, polygons(sheets_.turned));
    note(RepairKind::CutEdge, edges(sheets_.cut_edges));
    out_.cut_edges = static_cast<Index>(sheets_.cut_edges.size());
    for (const Index h : sheets_.cut_edges)
      out_.cut_length +=
          (input_.positions[to_vertex(given_, h)] - input_.positions[from_vertex(given_, h)])
              .norm();
    note(RepairKind::CrossingPolygon, crossing_polygons());
    std::vector<Index> regularized;
    for (const RestTriangle& t : out_.mesh->rest_triangles()) regularized.push_back(t.face);
    note(RepairKind::RegularizedFace, polygons(regularized));
    if (!out_.mesh->origin().isZero(0)) out_.repairs.push_back({RepairKind::MovedToOrigin, 1, {}});
  }

  const PolygonMesh& input_;
  const RepairOptions& options_;
  const StopCheck& stop_;
  std::vector<Index> welded_;
  TriangleList list_;
  Cells given_;
  Sheets sheets_;
  RepairedSurface out_;
};

}  // namespace

std::string_view name_of(RepairKind kind) { return text_of(kind).name; }

std::string describe(const Repair& repair) {
  return described(text_of(repair.kind), repair.count, repair.places);
}

RepairedSurface repair(const PolygonMesh& input, const RepairOptions& options,
                       const StopCheck& stop) {
  return Repairing(input, options, stop).run();
}

PolygonMesh with_welded_vertices(PolygonMesh input, const RepairedSurface& surface) {
  const SurfaceMesh& mesh = *surface.mesh;
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) {
      auto& polygon = input.polygons[mesh.input_face(f)];
      Index& vertex = polygon[surface.polygon_corner(f, k)];
      const Index welded = mesh.input_vertex(mesh.faces()(f, k));
      if (input.positions[vertex] != input.positions[welded]) vertex = welded;
    }
  return input;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
