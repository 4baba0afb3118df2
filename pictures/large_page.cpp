#include "majorant/pictures/large_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/map_check.h"
#include "majorant/parametrization/initialization/collapsing_mesh.h"

namespace majorant {
namespace {

using Json = nlohmann::ordered_json;

// Upper bound on repetitions that keep the corners around faces that were turned over.
constexpr int kMaxRounds = 8;

// Returns the size of a map's arrays in base64.
std::size_t plane_bytes(const MapFile& map) {
  const auto points = static_cast<std::size_t>(map.points.rows());
  const auto faces = static_cast<std::size_t>(map.cells.rows());
  std::size_t bytes = 2 * sizeof(double) * points +
                      sizeof(Index) * static_cast<std::size_t>(map.cells.cols()) * faces;
  bytes += sizeof(Index) * static_cast<std::size_t>(map.input_face.size() + map.chart.size() +
                                                    map.seam_edges.size());
  return bytes / 3 * 4;
}

// Returns these rows of an array; none if it has no rows.
template <class Array>
Array picked(const Array& rows, const std::vector<Index>& from) {
  if (rows.rows() == 0) return {};
  Array result(static_cast<Index>(from.size()), rows.cols());
  for (std::size_t k = 0; k < from.size(); ++k)
    result.row(static_cast<Index>(k)) = rows.row(from[k]);
  return result;
}

// The corners of a map's cells without the other points.
struct StraightMap {
  std::vector<Index> corners;  // points of the map
  Cells faces;                 // #F by 3, of `corners`
};

StraightMap straight_part(const MapFile& map) {
  StraightMap straight;
  std::vector<Index> number(to_size(static_cast<Index>(map.points.rows())), -1);
  const Cells corners = map.cells.leftCols(3);
  for (const Index point : corners.reshaped()) number[point] = 0;
  for (std::size_t point = 0; point < number.size(); ++point) {
    if (number[point] < 0) continue;
    number[point] = static_cast<Index>(straight.corners.size());
    straight.corners.push_back(static_cast<Index>(point));
  }
  straight.faces = corners.unaryExpr([&](Index point) { return number[point]; });
  return straight;
}

// Returns the straight map with these faces: corners by number in `straight`; slots: their faces in
// the map.
MapFile map_of(const MapFile& map, const StraightMap& straight, const Cells& faces,
               const std::vector<Index>& slots) {
  MapFile result;
  std::vector<Index> number(straight.corners.size(), -1), points;
  for (const Index corner : faces.reshaped()) number[corner] = 0;
  for (std::size_t corner = 0; corner < number.size(); ++corner) {
    if (number[corner] < 0) continue;
    number[corner] = static_cast<Index>(points.size());
    points.push_back(straight.corners[corner]);
  }
  result.points = picked(map.points, points);
  result.points_rounding = map.points_rounding;
  result.uv = picked(map.uv, points);
  result.cells = faces.unaryExpr([&](Index corner) { return number[corner]; });
  result.input_vertex = picked(map.input_vertex, points);
  result.cone = picked(map.cone, points);
  result.input_face = picked(map.input_face, slots);
  result.chart = picked(map.chart, slots);
  result.claims = map.claims;
  if (map.seam_edges.rows() == 0) return result;
  // Edges of seams are still there, but may belong to other faces.
  std::map<std::pair<Index, Index>, Index> chains;
  const auto edge_of = [](const Cells& of, Index face, Index k) {
    return std::pair(of(face, k), of(face, (k + 1) % 3));
  };
  for (Index face = 0; face < straight.faces.rows(); ++face)
    for (Index k = 0; k < 3; ++k)
      if (map.seam_edges(face, k) != 0)
        chains[edge_of(straight.faces, face, k)] = map.seam_edges(face, k);
  result.seam_edges = Cells::Zero(faces.rows(), 3);
  for (Index face = 0; face < faces.rows(); ++face)
    for (Index k = 0; k < 3; ++k)
      if (const auto found = chains.find(edge_of(faces, face, k)); found != chains.end())
        result.seam_edges(face, k) = found->second;
  return result;
}

// A picture of a map: its corners, and those that must stay.
class Picture {
 public:
  Picture(const MapPage& page, StraightMap straight)
      : page_(page),
        straight_(std::move(straight)),
        opposite_(opposite_half_edges(straight_.faces)) {
    if (find_touching_vertex(straight_.faces, opposite_) >= 0)
      throw InvalidArgument("sheets touch at a vertex");
    positions_ = picked(page.map.points, straight_.corners);
    uv_ = picked(page.map.uv, straight_.corners);
    hold();
  }

  // Returns the page with so many faces, or more if nothing else may go; none if faces would be
  // turned over.
  std::optional<MapPage> with_faces(Index count) {
    for (int round = 0; round < kMaxRounds; ++round) {
      CollapsingMesh left(straight_.faces, opposite_, static_cast<Index>(positions_.rows()));
      decimate(left, positions_, {count, held_, Ears::Stay});
      if (!hold_around_turned_faces(left)) return page_of(left);
    }
    return std::nullopt;
  }

 private:
  double area(const std::array<Index, 3>& face) const {
    const Vector2 a = uv_.row(face[1]) - uv_.row(face[0]), b = uv_.row(face[2]) - uv_.row(face[0]);
    return a.x() * b.y() - a.y() * b.x();
  }
  static std::array<Index, 3> corners(const CollapsingMesh& left, Index face) {
    return {left.from(3 * face), left.from(3 * face + 1), left.from(3 * face + 2)};
  }

  void hold() {
    const MapFile& map = page_.map;
    held_.assign(straight_.corners.size(), 0);
    const auto hold_face = [&](Index face) {
      for (Index k = 0; k < 3; ++k) held_[straight_.faces(face, k)] = 1;
    };
    for (Index face = 0; face < straight_.faces.rows(); ++face) {
      for (Index k = 0; k < 3; ++k)
        if (opposite_[3 * face + k] < 0 ||
            (map.seam_edges.rows() > 0 && map.seam_edges(face, k) != 0))
          held_[straight_.faces(face, k)] = held_[straight_.faces(face, (k + 1) % 3)] = 1;
      const std::array<Index, 3> own = {straight_.faces(face, 0), straight_.faces(face, 1),
                                        straight_.faces(face, 2)};
      if (!(area(own) > 0)) hold_face(face);
    }
    for (const PageFault& fault : page_.faults) hold_face(fault.cell);
    std::set<Index> vertices;
    for (const PagePoint& point : page_.points) vertices.insert(point.vertex);
    for (std::size_t corner = 0; corner < held_.size(); ++corner) {
      const Index point = straight_.corners[corner];
      if (map.cone.size() > 0 && map.cone[point] != 0) held_[corner] = 1;
      if (map.input_vertex.size() > 0 && vertices.contains(map.input_vertex[point]))
        held_[corner] = 1;
    }
  }

  // Holds all corners that collapsed onto those of faces that were turned over. Returns whether
  // there are any.
  bool hold_around_turned_faces(const CollapsingMesh& left) {
    std::vector<char> is_around(held_.size(), 0);
    bool has_any = false;
    for (Index face = 0; face < left.face_slots(); ++face) {
      if (!left.has_face(face)) continue;
      const std::array<Index, 3> own = corners(left, face);
      if (area(own) > 0 ||
          (held_[own[0]] && held_[own[1]] && held_[own[2]] && is_unchanged(left, face)))
        continue;
      has_any = true;
      for (const Index corner : own) is_around[corner] = 1;
    }
    if (!has_any) return false;
    for (Index k = left.vertex_count() - left.vertices_left() - 1; k >= 0; --k) {
      const auto [vertex, onto] = left.collapsed(k);
      is_around[vertex] = is_around[onto];
    }
    for (std::size_t corner = 0; corner < held_.size(); ++corner)
      if (is_around[corner]) held_[corner] = 1;
    return true;
  }

  bool is_unchanged(const CollapsingMesh& left, Index face) const {
    for (Index k = 0; k < 3; ++k)
      if (left.from(3 * face + k) != straight_.faces(face, k)) return false;
    return true;
  }

  MapPage page_of(const CollapsingMesh& left) const {
    Cells faces(left.faces_left(), 3);
    std::vector<Index> slots, number(to_size(left.face_slots()), -1);
    for (Index face = 0; face < left.face_slots(); ++face) {
      if (!left.has_face(face)) continue;
      const auto place = static_cast<Index>(slots.size());
      const std::array<Index, 3> own = corners(left, face);
      for (Index k = 0; k < 3; ++k) faces(place, k) = own[to_size(k)];
      number[face] = place;
      slots.push_back(face);
    }
    MapPage coarser = page_;
    coarser.map = map_of(page_.map, straight_, faces, slots);
    for (PageFault& fault : coarser.faults) fault.cell = number[fault.cell];
    std::vector<char> is_used(straight_.corners.size(), 0);
    for (const Index corner : faces.reshaped()) is_used[corner] = 1;
    std::vector<Index> points;
    for (std::size_t corner = 0; corner < is_used.size(); ++corner)
      if (is_used[corner]) points.push_back(straight_.corners[corner]);
    for (PageSnapshot& snapshot : coarser.snapshots) snapshot.uv = picked(snapshot.uv, points);
    return coarser;
  }

  const MapPage& page_;
  StraightMap straight_;
  std::vector<Index> opposite_;
  Points3 positions_;
  Points2 uv_;
  std::vector<char> held_;
};

MapFile straightened(const MapFile& map) {
  const StraightMap straight = straight_part(map);
  std::vector<Index> slots(to_size(static_cast<Index>(map.cells.rows())));
  for (std::size_t k = 0; k < slots.size(); ++k) slots[k] = static_cast<Index>(k);
  return map_of(map, straight, straight.faces, slots);
}

bool is_of_quads(const Json& facts) {
  return facts.is_object() && facts.value("command", Json()) == "quads";
}

std::string thousands(Index count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    if (k > 0 && (digits.size() - k) % 3 == 0) text += ',';
    text += digits[k];
  }
  return text;
}

}  // namespace

std::size_t page_bytes(const MapPage& page) {
  std::size_t bytes = plane_bytes(page.map);
  // Large maps have about half as many corners as faces.
  const std::size_t corners = std::min(static_cast<std::size_t>(page.map.points.rows()),
                                       static_cast<std::size_t>(page.map.cells.rows()) / 2);
  bytes += (3 * sizeof(double) + sizeof(Index)) * corners / 3 * 4;
  for (const PageSnapshot& snapshot : page.snapshots)
    bytes += 2 * sizeof(float) * static_cast<std::size_t>(snapshot.uv.rows()) / 3 * 4;
  if (page.scaffold) bytes += plane_bytes(*page.scaffold);
  if (page.other) bytes += page_bytes(*page.other);
  return bytes;
}

std::optional<MapPage> coarser_page(const MapPage& page, std::size_t most_bytes) {
  if (page_bytes(page) <= most_bytes || page.other) return std::nullopt;
  Json facts = Json::parse(page.facts.empty() ? "{}" : page.facts, nullptr, false);
  if (!facts.is_object() || is_of_quads(facts)) return std::nullopt;
  const auto all = static_cast<Index>(page.map.cells.rows());
  try {
    MapPage small = page;
    if (small.scaffold) small.scaffold = straightened(*small.scaffold);
    MapPage sized = small;
    sized.map = straightened(page.map);
    for (PageSnapshot& snapshot : sized.snapshots)
      snapshot.uv.conservativeResize(sized.map.points.rows(), Eigen::NoChange);
    const double part = static_cast<double>(most_bytes) / static_cast<double>(page_bytes(sized));
    Picture picture(small, straight_part(page.map));
    std::optional<MapPage> coarser =
        picture.with_faces(part < 1 ? static_cast<Index>(part * all) : all);
    if (!coarser) return std::nullopt;
    facts["picture"] = {
        {"faces", coarser->map.cells.rows()}, {"map_faces", all}, {"map_degree", page.map.degree}};
    coarser->facts = facts.dump(-1, ' ', false, Json::error_handler_t::replace);
    return coarser;
  } catch (const InvalidArgument&) {
    return std::nullopt;
  }
}

std::string write_page_or_coarser(const std::string& path, const MapPage& page) {
  require_sound(path, page.map);
  std::size_t most = kLargestPage;
  if (const char* override_bytes = std::getenv("MAJORANT_PAGE_BYTES"))
    most = std::strtoull(override_bytes, nullptr, 10);
  const std::optional<MapPage> coarser = coarser_page(page, most);
  write_page(path, coarser ? *coarser : page);
  const std::size_t bytes = page_bytes(page);
  const double megabytes = static_cast<double>(bytes) / 1e6;
  if (coarser)
    return fmt::format("shows {} of {} faces{}, since browsers are slow with a page of {:.0f} MB",
                       thousands(static_cast<Index>(coarser->map.cells.rows())),
                       thousands(static_cast<Index>(page.map.cells.rows())),
                       page.map.degree > 1 ? ", straight" : "", megabytes);
  if (bytes > most)
    return fmt::format("browsers are slow with its {:.0f} MB; an .svg or .png opens sooner",
                       megabytes);
  return {};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
