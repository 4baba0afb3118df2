#include "majorant/mesh/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/internal/collapsed_edges.h"
#include "majorant/mesh/internal/needles.h"
#include "majorant/mesh/internal/place_text.h"
#include "majorant/mesh/internal/polygon_crossing.h"
#include "majorant/mesh/internal/sheets.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/mesh/triangle_list.h"
#include "majorant/mesh/weld.h"

namespace majorant {
namespace {

using Places = std::vector<std::array<Index, 2>>;

const FindingText& text_of(RepairKind kind) {
  static constexpr std::array<FindingText, 11> kTexts = {{
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
      {"collapsed_edge", "edge of no length collapsed", "edges of no length collapsed", "edge"},
  }};
  return kTexts[static_cast<std::size_t>(kind)];
}

// Returns a point from which all differences are exact. In each coordinate it is half way between
// the smallest and the largest value if neither exceeds twice the other, otherwise 0.
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

// The proposed weld distance, relative to the length of edges: chains of such steps do not cross a
// face.
constexpr double kWeldPart = 0.1;

class Repairing {
 public:
  Repairing(const PolygonMesh& input, const RepairOptions& options, const StopCheck& stop)
      : input_(input), options_(options), stop_(stop) {}

  RepairedSurface run() {
    require_sound_lists(input_);
    if (options_.weld) require_usable_distance(*options_.weld);
    weld_vertices();
    stop_.poll();
    list_ = triangulate(input_, Crossing::Fanned, stop_);
    given_.resize(static_cast<Index>(list_.triangles.size()), 3);
    for (Index f = 0; f < given_.rows(); ++f)
      for (Index k = 0; k < 3; ++k) given_(f, k) = welded_[list_.triangles[f][k]];
    IndexLists polygons = input_.polygons;
    for (Index& v : polygons.indices()) v = welded_[v];
    sheets_ = make_sheets({given_, input_.positions, list_.polygon, polygons, place_},
                          options_.orientation, options_.crowded_edges, stop_);
    out_.one_sided = sheets_.one_sided;
    turn_corners();
    build();
    name_welded();
    find_texture_seams();
    for (const Index v : coincident_vertices(input_)) out_.coincident_left += out_.welded[v] == v;
    note_all();
    return std::move(out_);
  }

 private:
  void require_usable_distance(double distance) const {
    require_at_least("repair: RepairOptions::weld", distance, 0);
    if (const double most = usable_weld_distance(input_); distance > most)
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: vertices {:g} apart cannot be welded: most faces have edges of "
                              "{:.3g} and less, and would be torn apart; give a weld distance well "
                              "below that, such as {:.1g}",
                              input_.file, distance, most, kWeldPart * most));
  }

  void weld_vertices() {
    const bool is_soup_welded = options_.welding != Welding::Nothing && is_soup(input_);
    if (options_.weld || is_soup_welded) {
      welded_ = weld(input_, options_.weld.value_or(0), stop_);
      return;
    }
    welded_.resize(input_.positions.size());
    std::iota(welded_.begin(), welded_.end(), 0);
    if (options_.welding != Welding::EqualPlaces) return;
    place_ = first_at_place(input_);
    if (place_ == welded_) place_.clear();
  }

  // Returns the number of pieces of the file, with vertices compared by number.
  Index pieces_given() const {
    if (!place_.empty()) return sheets_.pieces_given;
    Cells triangles(given_.rows(), 3);
    for (Index f = 0; f < triangles.rows(); ++f)
      for (Index k = 0; k < 3; ++k) triangles(f, k) = list_.triangles[f][k];
    const std::vector<Index> none;
    return make_sheets({triangles, input_.positions, list_.polygon, input_.polygons, none},
                       options_.orientation, options_.crowded_edges, stop_)
        .pieces_given;
  }

  // Turns the triangles of the list like the faces of the surface.
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
        needles_of(parts.positions, parts.faces,
                   options_.numerics == Numerics::ForSolving ? kNeedleHeight : kDegenerateHeight);
    out_.mesh =
        std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts), stop_));
    out_.polygon_corner.resize(given_.rows(), 3);
    for (Index f = 0; f < given_.rows(); ++f)
      for (Index k = 0; k < 3; ++k) out_.polygon_corner(f, k) = list_.corners[f][k];
  }

  Index file_vertex(Index corner) const {
    return list_.triangles[face_of(corner)][corner_of(corner)];
  }

  // Sets out_.welded. A vertex whose corners are copies gets the name of the first copy.
  void name_welded() {
    const SurfaceMesh& mesh = *out_.mesh;
    out_.welded.resize(input_.positions.size());
    std::iota(out_.welded.begin(), out_.welded.end(), 0);
    for (Index c = mesh.half_edge_count() - 1; c >= 0; --c)
      out_.welded[file_vertex(c)] = mesh.input_vertex(mesh.from_vertex(c));
  }

  // Across welded edges values are compared instead of numbers, since each of the vertices has
  // numbers of its own.
  void find_texture_seams() {
    const SurfaceMesh& mesh = *out_.mesh;
    out_.texture_seams.assign(to_size(mesh.half_edge_count()), 0);
    const CornerPoints& uv = mesh.corner_texcoords();
    if (uv.rows() == 0) return;
    const auto texture = [&](Index c) -> Vector2 {
      return uv.row(face_of(c)).segment<2>(2 * corner_of(c));
    };
    out_.texture_seams = texture_borders(mesh);
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      const Index o = mesh.opposite(h);
      if (o < h || !is_textured(mesh, face_of(h)) || !is_textured(mesh, face_of(o))) continue;
      const bool is_welded =
          file_vertex(h) != file_vertex(next(o)) || file_vertex(next(h)) != file_vertex(o);
      if (is_welded)
        out_.texture_seams[h] = out_.texture_seams[o] =
            texture(h) != texture(next(o)) || texture(next(h)) != texture(o);
    }
  }

  void note(RepairKind kind, Places places) {
    if (places.empty()) return;
    Repair repair{kind, static_cast<Index>(places.size()), std::move(places)};
    if (repair.places.size() > kNamedPlaces) repair.places.resize(kNamedPlaces);
    out_.repairs.push_back(std::move(repair));
  }

  // Returns the polygons of these triangles.
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
      if (welded_[v] != static_cast<Index>(v) || out_.welded[v] != static_cast<Index>(v))
        welded.push_back({static_cast<Index>(v), -1});
    if (!welded.empty()) {
      note(RepairKind::Welded, std::move(welded));
      out_.repairs.back().pieces = {pieces_given(), out_.mesh->topology().components};
    }
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
  std::vector<Index> place_;  // by vertex, the first vertex at its position; empty: joined by
                              // number
  TriangleList list_;
  Cells given_;
  Sheets sheets_;
  RepairedSurface out_;
};

// Returns the surface of collapsed.mesh with the vertices, polygons and corners of the input.
RepairedSurface in_input(const CollapsedEdges& collapsed, RepairedSurface surface) {
  SurfaceParts parts = surface.mesh->parts();
  for (std::size_t f = 0; f < parts.input_face.size(); ++f) {
    const Index left = parts.input_face[f];
    parts.input_face[f] = collapsed.polygon[left];
    for (Index& corner : surface.polygon_corner.row(static_cast<Index>(f)))
      corner = collapsed.corners[left][corner];
  }
  surface.mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts)));
  const std::vector<Index> welded = surface.welded;
  for (std::size_t v = 0; v < welded.size(); ++v) surface.welded[v] = welded[collapsed.vertex[v]];
  for (Repair& repair : surface.repairs)
    if (text_of(repair.kind).place == std::string_view("face"))
      for (auto& [face, none] : repair.places) face = collapsed.polygon[face];
  const auto count = static_cast<Index>(collapsed.edges.size());
  Repair repair{RepairKind::CollapsedEdge, count, collapsed.edges};
  if (repair.places.size() > kNamedPlaces) repair.places.resize(kNamedPlaces);
  surface.repairs.insert(surface.repairs.begin(), std::move(repair));
  return surface;
}

}  // namespace

std::string_view name_of(RepairKind kind) { return text_of(kind).name; }

std::string describe(const Repair& repair) {
  std::string text = described(text_of(repair.kind), repair.count, repair.places);
  if (repair.pieces)
    text += fmt::format(": {} piece{} before, {} after", (*repair.pieces)[0],
                        (*repair.pieces)[0] == 1 ? "" : "s", (*repair.pieces)[1]);
  return text;
}

RepairedSurface repair(const PolygonMesh& input, const RepairOptions& options,
                       const StopCheck& stop) {
  if (options.short_edges == ShortEdges::Kept) return Repairing(input, options, stop).run();
  require_sound_lists(input);
  const CollapsedEdges collapsed = collapse_short_edges(input, stop);
  if (collapsed.edges.empty()) return Repairing(input, options, stop).run();
  return in_input(collapsed, Repairing(collapsed.mesh, options, stop).run());
}

PolygonMesh with_welded_vertices(PolygonMesh input, const RepairedSurface& surface) {
  const SurfaceMesh& mesh = *surface.mesh;
  // Neither positions nor vertex numbers then identify the corner of a welded vertex.
  const auto is_ambiguous = [&](Index polygon) {
    return input.polygons[polygon].size() > 3 && has_corners_at_one_place(input, polygon);
  };
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const std::span<Index> polygon = input.polygons[mesh.input_face(f)];
      Index& vertex = polygon[surface.polygon_corner(f, k)];
      const Index welded = mesh.input_vertex(mesh.faces()(f, k));
      if (vertex != welded &&
          (input.positions[vertex] != input.positions[welded] || is_ambiguous(mesh.input_face(f))))
        vertex = welded;
    }
  return input;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
