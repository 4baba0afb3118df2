#include "majorant/parametrization/tessellation/tessellate_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/triangulate_polygon.h"
#include "majorant/mesh/weld.h"
#include "majorant/parametrization/tessellation/internal/cut_pieces.h"
#include "majorant/parametrization/tessellation/internal/map_pieces.h"

namespace majorant {
namespace {

// Returns whether the edges of a closed polygon meet in its corners only.
bool is_simple(const std::vector<Vector2>& corners) {
  const std::size_t n = corners.size();
  std::vector<Box2> boxes;
  const auto corner = [&](std::size_t k) -> const Vector2& { return corners[k % n]; };
  for (std::size_t k = 0; k < n; ++k)
    boxes.push_back({corner(k).cwiseMin(corner(k + 1)), corner(k).cwiseMax(corner(k + 1))});
  bool result = true;
  BoxTree(boxes).visit_pairs([&](Index i, Index j) {
    const std::size_t e = to_size(i), f = to_size(j);
    if (f == e + 1)
      result = !segments_fold(corner(e), corner(f), corner(f + 1));
    else if (f + 1 == e + n)
      result = !segments_fold(corner(f), corner(e), corner(e + 1));
    else
      result = !segments_meet(corner(e), corner(e + 1), corner(f), corner(f + 1));
    return result;
  });
  return result;
}

[[noreturn]] void refuse_surface(const std::string& problem) {
  throw Error(ErrorKind::Invalid, problem + "; give the mesh the map was made from");
}

// The faces of the mesh from which the cells of a map were made.
struct InputFaces {
  // The cells of a polygon are consecutive: polygon p has first[p] to first[p + 1] - 1.
  std::vector<Index> first;
  std::vector<std::array<std::size_t, 3>> corners;  // of its polygon, by cell
  bool is_complete = true;                          // MapFile::is_complete
};

// The uncut cells of a map, each one piece; the counterpart of MapPieces.
class WholeCells {
 public:
  explicit WholeCells(CornerMesh coarse) : coarse_(std::move(coarse)) {}

  Index cell_count() const { return static_cast<Index>(coarse_.cell.size()); }
  std::array<MapPieces::Point, 3> points(Index cell) const {
    std::array<MapPieces::Point, 3> points;
    for (int k = 0; k < 3; ++k) {
      const Index v = coarse_.vertices(cell, k);
      points[k] = {v, coarse_.texcoord_ids(cell, k), v, Vector3::Unit(k)};
    }
    return points;
  }
  static std::array<MapPieces::Piece, 1> pieces(Index) { return {{{{0, 1, 2}}}}; }
  const std::vector<Vector3>& positions() const { return coarse_.positions; }
  const std::vector<Vector2>& texcoords() const { return coarse_.texcoords; }

 private:
  CornerMesh coarse_;
};

// Returns the corner of the face at this point, found by vertex number, else by position. Excludes
// `taken`, the cell's other corners, since a polygon may have a vertex twice.
std::size_t corner_at(const MapFile& map, Index point, const PolygonMesh& input, std::size_t face,
                      std::span<const std::size_t> taken) {
  const auto& polygon = input.polygons[face];
  const auto find = [&](const auto& is_it) {
    for (std::size_t k = 0; k < polygon.size(); ++k)
      if (is_it(polygon[k]) && std::find(taken.begin(), taken.end(), k) == taken.end()) return k;
    return polygon.size();
  };
  std::size_t found = polygon.size();
  if (map.input_vertex.size() > 0)
    found = find([&](Index v) { return v == map.input_vertex[point]; });
  if (found == polygon.size()) {
    const Vector3 position = map.points.row(point).transpose();
    found = find([&](Index v) { return input.positions[v] == position; });
  }
  if (found == polygon.size())
    refuse_surface(fmt::format("map point {} is no corner of face {} of the input", point, face));
  return found;
}

// Returns the points around the cells from `first` to `last`, none unless they are one cycle.
std::vector<Index> cycle_around(const MapFile& map, const CornerMesh& coarse, Index first,
                                Index last) {
  std::map<Index, Index> next_of;  // along the border
  std::set<std::pair<Index, Index>> edges;
  for (Index c = first; c < last; ++c)
    for (Index k = 0; k < 3; ++k)
      edges.emplace(map.cells(coarse.cell[c], k), map.cells(coarse.cell[c], (k + 1) % 3));
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from}) && !next_of.emplace(from, to).second) return {};
  std::vector<Index> cycle;
  for (Index p = next_of.empty() ? -1 : next_of.begin()->first; cycle.size() < next_of.size();) {
    cycle.push_back(p);
    const auto found = next_of.find(p);
    if (found == next_of.end()) return {};
    p = found->second;
    if (p == cycle.front() && cycle.size() < next_of.size()) return {};
  }
  return cycle;
}

// Finds the corners of a polygon all at once, around it. If several are at one place, neither the
// place nor the number of a welded vertex identifies them. Of the rotations around the polygon the
// one with most matching numbers is taken; without any, nothing changes.
void find_corners_around(const MapFile& map, const PolygonMesh& input, std::size_t face,
                         CornerMesh& coarse, InputFaces& faces) {
  const auto& polygon = input.polygons[face];
  const std::size_t n = polygon.size();
  const std::vector<Index> cycle =
      cycle_around(map, coarse, faces.first[face], faces.first[face + 1]);
  if (cycle.size() != n) return;
  const auto corner = [n](std::size_t start, bool is_turned, std::size_t k) {
    return is_turned ? (start + n - k) % n : (start + k) % n;
  };
  std::optional<std::pair<std::size_t, bool>> best;
  std::size_t most = 0;
  for (const bool is_turned : {false, true})
    for (std::size_t start = 0; start < n; ++start) {
      std::size_t right = 0;
      bool fits = true;
      for (std::size_t k = 0; k < n && fits; ++k) {
        const Index v = polygon[corner(start, is_turned, k)];
        right += map.input_vertex.size() > 0 && map.input_vertex[cycle[k]] == v;
        fits = Vector3(map.points.row(cycle[k])) == input.positions[v];
      }
      if (!fits || (best && right <= most)) continue;
      best = {start, is_turned};
      most = right;
    }
  if (!best) return;
  std::map<Index, std::size_t> corner_of;  // by point
  for (std::size_t k = 0; k < n; ++k) corner_of[cycle[k]] = corner(best->first, best->second, k);
  for (Index c = faces.first[face]; c < faces.first[face + 1]; ++c)
    for (Index k = 0; k < 3; ++k) {
      faces.corners[c][k] = corner_of.at(map.cells(coarse.cell[c], k));
      coarse.vertices(c, k) = polygon[faces.corners[c][k]];
    }
}

// Gives the mesh of the cells the vertices of the input.
InputFaces find_input(const MapFile& map, const PolygonMesh& input, CornerMesh& coarse) {
  InputFaces faces{std::vector<Index>(input.polygons.size() + 1, 0), {}, map.is_complete};
  const auto count = static_cast<Index>(coarse.cell.size());
  faces.corners.resize(coarse.cell.size());
  for (Index c = 0; c < count; ++c) {
    const Index cell = coarse.cell[c];
    const Index face = map.input_face.size() == 0 ? cell : map.input_face[cell];
    if (face < 0 || to_size(face) >= input.polygons.size())
      refuse_surface(
          fmt::format("cell {} belongs to face {}, which the input does not have", cell, face));
    ++faces.first[face + 1];
    for (Index k = 0; k < 3; ++k) {
      const Index point = map.cells(cell, k);
      const std::span<const std::size_t> taken(faces.corners[c].data(), to_size(k));
      faces.corners[c][k] = corner_at(map, point, input, to_size(face), taken);
      coarse.vertices(c, k) = input.polygons[face][faces.corners[c][k]];
    }
  }
  std::partial_sum(faces.first.begin(), faces.first.end(), faces.first.begin());
  for (std::size_t p = 0; p < input.polygons.size(); ++p)
    if (has_corners_at_one_place(input, static_cast<Index>(p)))
      find_corners_around(map, input, p, coarse, faces);
  coarse.positions = input.positions;
  return faces;
}

template <class Pieces>
void add_triangle(const Pieces& pieces, Index c, const MapPieces::Piece& piece, PolygonMesh& mesh) {
  const auto& points = pieces.points(c);
  const auto [i, j, k] = piece.corners;
  mesh.polygons.push_back({points[i].v, points[j].v, points[k].v});
  mesh.polygon_texcoords.push_back({points[i].vt, points[j].vt, points[k].vt});
}

// Replaces the polygons of the input by the pieces of a map. Pieces: MapPieces or WholeCells.
template <class Pieces>
class PolygonTransfer {
 public:
  PolygonTransfer(const Pieces& pieces, const PolygonMesh& input, const InputFaces& faces,
                  std::vector<PolygonOrigin>* origins)
      : pieces_(pieces), input_(input), faces_(faces), origins_(origins) {}

  PolygonMesh run() {
    for (auto* lists : {&result_.polygons, &result_.polygon_texcoords})
      lists->reserve(input_.polygons.size(), input_.polygons.indices().size());
    result_.positions = pieces_.positions();
    result_.texcoords = pieces_.texcoords();
    result_.has_partial_layout = !faces_.is_complete;
    result_.normals = input_.normals;
    if (!input_.colors.empty()) add_colors();
    auto directive = input_.directives.begin();
    for (std::size_t face = 0; face < input_.polygons.size(); ++face) {
      while (directive != input_.directives.end() && to_size(directive->first) <= face)
        keep_directive((directive++)->second);
      add_face(face);
    }
    while (directive != input_.directives.end()) keep_directive((directive++)->second);
    return std::move(result_);
  }

 private:
  // Cells that share a new vertex on their edge interpolate the same colours there.
  void add_colors() {
    result_.colors = input_.colors;
    result_.colors.resize(result_.positions.size());
    for (Index c = 0; c < pieces_.cell_count(); ++c) {
      const auto& points = pieces_.points(c);
      for (std::size_t p = 3; p < points.size(); ++p) {
        Vector3 color = Vector3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
          const double weight = points[p].xi[static_cast<Index>(k)];
          // Corners with weight 0 are skipped, since they may have no colour.
          if (weight != 0) color += weight * input_.colors[points[k].v];
        }
        result_.colors[points[p].v] = color;
      }
    }
  }

  void keep_directive(const std::string& text) {
    result_.directives.emplace_back(static_cast<Index>(result_.polygons.size()), text);
  }

  void add_face(std::size_t face) {
    if (!faces_.is_complete && faces_.first[face] == faces_.first[face + 1])
      return add_unmapped(face);
    std::vector<Index> texcoords = texcoords_of_corners(face);
    if (texcoords.empty()) {
      for (Index c = faces_.first[face]; c < faces_.first[face + 1]; ++c) add_pieces(face, c);
      return;
    }
    const auto turn = [is_turned = is_turned(face)](auto&& list) {
      if (is_turned) std::reverse(list.begin(), list.end());
    };
    const auto keep = [&turn](std::span<const Index> list, IndexLists& lists) {
      lists.push_back(list);
      turn(lists.back());
    };
    if (origins_) {
      origins_->push_back({static_cast<Index>(face), all_corners(face)});
      turn(origins_->back().corners);
    }
    keep(input_.polygons[face], result_.polygons);
    keep(texcoords, result_.polygon_texcoords);
    if (has_normals()) keep(input_.polygon_normals[face], result_.polygon_normals);
  }

  void add_unmapped(std::size_t face) {
    if (origins_) origins_->push_back({static_cast<Index>(face), all_corners(face)});
    result_.polygons.push_back(input_.polygons[face]);
    result_.polygon_texcoords.push_back({});
    if (has_normals()) result_.polygon_normals.push_back(input_.polygon_normals[face]);
  }

  std::vector<PlaceOnPolygon> all_corners(std::size_t face) const {
    std::vector<PlaceOnPolygon> places;
    for (std::size_t k = 0; k < input_.polygons[face].size(); ++k)
      places.push_back({{k, k, k}, Barycentric::Unit(0)});
    return places;
  }

  // Returns whether the map has the face with the other side up: its cells run backwards around it.
  bool is_turned(std::size_t face) const {
    const auto& [a, b, c] = faces_.corners[faces_.first[face]];
    return (a < b) + (b < c) + (c < a) == 1;
  }

  bool has_each_vertex_once(std::size_t face) const {
    const auto& polygon = input_.polygons[face];
    return std::set(polygon.begin(), polygon.end()).size() == polygon.size();
  }

  // Returns the texture coordinates of the face's corners, or none if the polygon cannot be kept
  // whole.
  std::vector<Index> texcoords_of_corners(std::size_t face) const {
    std::vector<Index> texcoords(input_.polygons[face].size(), -1);
    bool is_whole = true;
    for (Index c = faces_.first[face]; c < faces_.first[face + 1]; ++c) {
      is_whole &= pieces_.pieces(c).size() == 1;
      const auto& points = pieces_.points(c);
      for (std::size_t k = 0; k < 3; ++k) {
        const Index vt = points[k].vt;
        Index& texcoord = texcoords[faces_.corners[c][k]];
        is_whole &= texcoord < 0 || texcoord == vt;  // otherwise a cut runs through the polygon
        texcoord = vt;
      }
    }
    const bool is_covered = std::ranges::count(texcoords, -1) == 0;
    // Cells over corners at the same vertex do not say which of these they cover.
    if (!is_covered && has_each_vertex_once(face) &&
        !has_corners_at_one_place(input_, static_cast<Index>(face)))
      refuse_surface(fmt::format("face {} of the input is not covered by cells", face));
    if (!is_whole || !is_covered) return {};
    if (texcoords.size() == 3) return texcoords;
    std::vector<Vector2> uv;
    std::vector<Vector3> corners;
    for (const Index vt : texcoords) uv.push_back(pieces_.texcoords()[vt]);
    for (const Index v : input_.polygons[face]) corners.push_back(input_.positions[v]);
    // Two positive triangles on both sides of a diagonal are a simple polygon.
    constexpr std::size_t kAlwaysSimple = 4;
    if (uv.size() > kAlwaysSimple && !is_simple(uv)) return {};
    if (is_turned(face)) {  // in the order in which it is written
      std::reverse(uv.begin(), uv.end());
      std::reverse(corners.begin(), corners.end());
    }
    const auto is_unfolded = [&](std::size_t first) {
      return is_unfolded_cut_from(first, corners, uv, PolygonUse::Written);
    };
    const bool is_quad = uv.size() == 4;
    if (has_one_side(face) && !(is_unfolded(0) && (!is_quad || is_unfolded(1)))) return {};
    return texcoords;
  }

  // Returns whether the triangles of a face have one orientation in the plane. If not, the map is
  // no valid result, and its polygons are kept.
  bool has_one_side(std::size_t face) const {
    int sum = 0;
    for (Index c = faces_.first[face]; c < faces_.first[face + 1]; ++c) {
      const auto& points = pieces_.points(c);
      const auto uv = [&](std::size_t k) { return pieces_.texcoords()[points[k].vt]; };
      sum += orientation(uv(0), uv(1), uv(2));
    }
    return std::abs(sum) == faces_.first[face + 1] - faces_.first[face];
  }

  void add_pieces(std::size_t face, Index c) {
    const std::vector<Index> normals = normals_of_points(face, c);
    for (const auto& piece : pieces_.pieces(c)) {
      add_triangle(pieces_, c, piece, result_);
      if (origins_) {
        origins_->push_back({static_cast<Index>(face), {}});
        for (const int p : piece.corners)
          origins_->back().corners.push_back({faces_.corners[c], pieces_.points(c)[p].xi});
      }
      if (!has_normals()) continue;
      std::vector<Index> of_piece;
      if (!normals.empty())
        for (const int p : piece.corners) of_piece.push_back(normals[p]);
      result_.polygon_normals.push_back(of_piece);
    }
  }

  bool has_normals() const { return !input_.polygon_normals.empty(); }

  // Returns numbers of the normals at a cell's points, with new ones interpolated; empty if the
  // face has none.
  std::vector<Index> normals_of_points(std::size_t face, Index c) {
    if (!has_normals() || input_.polygon_normals[face].empty()) return {};
    std::vector<Index> numbers;
    for (std::size_t k = 0; k < 3; ++k)
      numbers.push_back(input_.polygon_normals[face][faces_.corners[c][k]]);
    const auto& points = pieces_.points(c);
    for (std::size_t p = 3; p < points.size(); ++p) {
      Vector3 normal = Vector3::Zero();
      for (std::size_t k = 0; k < 3; ++k)
        normal += points[p].xi[static_cast<Index>(k)] * input_.normals[numbers[k]];
      numbers.push_back(static_cast<Index>(result_.normals.size()));
      result_.normals.push_back(normal.stableNormalized());
    }
    return numbers;
  }

  const Pieces& pieces_;
  const PolygonMesh& input_;
  const InputFaces& faces_;
  std::vector<PolygonOrigin>* origins_;
  PolygonMesh result_;
};

// Returns the triangles without an input.
template <class Pieces>
PolygonMesh mesh_of(const Pieces& pieces) {
  PolygonMesh mesh;
  mesh.positions = pieces.positions();
  mesh.texcoords = pieces.texcoords();
  for (Index c = 0; c < pieces.cell_count(); ++c)
    for (const auto& piece : pieces.pieces(c)) add_triangle(pieces, c, piece, mesh);
  return mesh;
}

template <class Pieces>
PolygonMesh mesh_of(const Pieces& pieces, const PolygonMesh* input, const InputFaces& faces,
                    std::vector<PolygonOrigin>* origins) {
  return input != nullptr ? PolygonTransfer<Pieces>(pieces, *input, faces, origins).run()
                          : mesh_of(pieces);
}

}  // namespace

PolygonMesh tessellate_map(const MapFile& map, const PolygonMesh* input,
                           const TessellationOptions& options,
                           std::vector<PolygonOrigin>* origins) {
  CornerMesh coarse = corner_mesh(map, "");
  InputFaces faces;
  if (input != nullptr) faces = find_input(map, *input, coarse);
  if (map.degree == 1 && options.refine == 1)
    return mesh_of(WholeCells(std::move(coarse)), input, faces, origins);
  std::optional<MapFile> united;
  if (Cells cells = united_cells(map); cells != map.cells) {
    united = map;
    united->cells = std::move(cells);
  }
  MapPieces pieces(united ? *united : map, std::move(coarse), options.refine);
  cut_until_positive(pieces, options.overlap);
  return mesh_of(pieces, input, faces, origins);
}

std::vector<Index> split_polygons(const MapFile& map, const PolygonMesh& input,
                                  const TessellationOptions& options) {
  const auto is_triangle = [](const auto& polygon) { return polygon.size() == 3; };
  if (std::all_of(input.polygons.begin(), input.polygons.end(), is_triangle)) return {};
  std::vector<PolygonOrigin> origins;
  tessellate_map(map, &input, options, &origins);
  std::vector<Index> pieces(input.polygons.size(), 0), split;
  for (const PolygonOrigin& origin : origins) ++pieces[to_size(origin.polygon)];
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (input.polygons[p].size() > 3 && pieces[p] > 1) split.push_back(static_cast<Index>(p));
  return split;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
