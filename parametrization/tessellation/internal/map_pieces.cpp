#include "majorant/parametrization/tessellation/internal/map_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {
namespace {

// The points of a triangle's regular subdivision, corners first, then rows of constant b, where (a,
// b) has the barycentric coordinates (1 - (a + b) / K, a / K, b / K).
class Lattice {
 public:
  explicit Lattice(int refine) : K_(refine), number_(to_size((K_ + 1) * (K_ + 1)), -1) {
    for (const auto& [a, b] : {std::pair(0, 0), {K_, 0}, {0, K_}}) add(a, b);
    for (int b = 0; b <= K_; ++b)
      for (int a = 0; a + b <= K_; ++a)
        if (number(a, b) < 0) add(a, b);
  }

  int refine() const { return K_; }
  const std::vector<Vector3>& points() const { return points_; }
  // Returns the point s = 1 .. K - 1 along edge 0 (corner 0 to 1), 1 (1 to 2) or 2 (2 to 0).
  int on_edge(int edge, int s) const {
    return edge == 0 ? number(s, 0) : edge == 1 ? number(K_ - s, s) : number(0, K_ - s);
  }
  std::vector<MapPieces::Piece> pieces() const {
    std::vector<MapPieces::Piece> result;
    for (int b = 0; b < K_; ++b)
      for (int a = 0; a + b < K_; ++a) {
        result.push_back({{number(a, b), number(a + 1, b), number(a, b + 1)}});
        if (a + b + 1 == K_) continue;
        result.push_back({{number(a + 1, b), number(a + 1, b + 1), number(a, b + 1)}});
      }
    return result;
  }

 private:
  int number(int a, int b) const { return number_[b * (K_ + 1) + a]; }
  void add(int a, int b) {
    number_[b * (K_ + 1) + a] = static_cast<int>(points_.size());
    const double K = K_;
    points_.emplace_back((K_ - a - b) / K, a / K, b / K);
  }

  int K_;
  std::vector<int> number_;
  std::vector<Vector3> points_;
};

Eigen::MatrixXd bernstein_values(int degree, const std::vector<Vector3>& xi) {
  Points3 points(static_cast<Eigen::Index>(xi.size()), 3);
  for (std::size_t p = 0; p < xi.size(); ++p)
    points.row(static_cast<Eigen::Index>(p)) = xi[p].transpose();
  return majorant::bernstein_values(degree, points);
}

void require_moderate(const MapFile& map, int refine) {
  constexpr int kMostRefine = 10000;  // keeps the products below within 64 bits
  const long long most = std::numeric_limits<Index>::max();
  const long long samples = (refine + 1LL) * (refine + 2LL) / 2;
  if (refine < 1) throw Error(ErrorKind::Usage, fmt::format("refine {} is less than 1", refine));
  if (refine > kMostRefine || samples > most / (2 * map.cells.rows() + map.points.rows()))
    throw Error(ErrorKind::Usage, fmt::format("refine {} gives too many triangles", refine));
}

}  // namespace

MapPieces::MapPieces(const MapFile& map, CornerMesh coarse, int refine)
    : map_(map),
      coarse_(std::move(coarse)),
      edges_(map, coarse_),
      next_node_(static_cast<Index>(coarse_.positions.size())),
      positions_(coarse_.positions),
      texcoords_(coarse_.texcoords) {
  require_moderate(map, refine);
  cells_.resize(coarse_.cell.size());
  for (Index c = 0; c < cell_count(); ++c)
    for (int k = 0; k < 3; ++k) {
      const Index v = coarse_.vertices(c, k);
      cells_[c].points.push_back({v, coarse_.texcoord_ids(c, k), edges_.node(v), Vector3::Unit(k)});
    }
  fill_lattice(refine);
}

Index MapPieces::map_cell(Index cell) const { return coarse_.cell[cell]; }

const Vector2& MapPieces::uv(Index cell, int point) const {
  return texcoords_[of(cell).points[point].vt];
}

const Vector3& MapPieces::position(Index cell, int point) const {
  return positions_[of(cell).points[point].v];
}

int MapPieces::plane_sides(Index cell, int cell_edge) const {
  return edges_.plane_sides(plane_edge(cell, cell_edge));
}

Index MapPieces::plane_edge(Index cell, int cell_edge) const {
  return edges_.of(cell).plane[cell_edge];
}

// ---- The start ----

void MapPieces::fill_lattice(int refine) {
  const Lattice lattice(refine);
  const std::vector<MapPieces::Piece> pieces = lattice.pieces();
  const Eigen::MatrixXd bernstein = bernstein_values(map_.degree, lattice.points());
  std::vector<Index> first_v(to_size(edges_.space_count()), -1),
      first_vt(to_size(edges_.plane_count()), -1), first_node(to_size(edges_.surface_count()), -1);
  for (Index c = 0; c < cell_count(); ++c) {
    Cell& cell = cells_[c];
    const MapEdges::Numbers& edges = edges_.of(c);
    cell.pieces = pieces;
    cell.points.resize(lattice.points().size(), {-1, -1, -1, Vector3::Zero()});
    for (std::size_t p = 0; p < cell.points.size(); ++p) cell.points[p].xi = lattice.points()[p];
    const Eigen::MatrixXd control = map_.uv(map_.cells.row(map_cell(c)), Eigen::all);
    const auto place = [&](int p) { return flat_point(c, cell.points[p].xi); };
    const auto value = [&](int p) -> Vector2 { return (bernstein.row(p) * control).transpose(); };
    for (int edge = 0; edge < 3; ++edge) {
      const bool is_forward = cell.points[edge].node < cell.points[next(edge)].node;
      Index& v = first_v[edges.space[edge]];
      Index& vt = first_vt[edges.plane[edge]];
      Index& node = first_node[edges.surface[edge]];
      const bool is_new = v < 0, is_new_in_plane = vt < 0;
      if (is_new) v = static_cast<Index>(positions_.size());
      if (is_new_in_plane) vt = static_cast<Index>(texcoords_.size());
      if (node < 0) node = std::exchange(next_node_, next_node_ + refine - 1);
      for (int s = 1; s < refine; ++s) {  // from the smaller corner to the larger
        const int p = lattice.on_edge(edge, is_forward ? s : refine - s);
        cell.points[p].v = v + s - 1;
        cell.points[p].vt = vt + s - 1;
        cell.points[p].node = node + s - 1;
        if (is_new) positions_.push_back(place(p));
        if (is_new_in_plane) texcoords_.push_back(value(p));
      }
    }
    for (std::size_t p = 0; p < cell.points.size(); ++p) {
      if (cell.points[p].v >= 0) continue;
      cell.points[p].v = static_cast<Index>(positions_.size());
      cell.points[p].vt = static_cast<Index>(texcoords_.size());
      cell.points[p].node = next_node_++;
      positions_.push_back(place(static_cast<int>(p)));
      texcoords_.push_back(value(static_cast<int>(p)));
    }
  }
}

// ---- Cutting ----

int MapPieces::cell_edge(const Edge& edge) const {
  const Vector3 &a = of(edge.cell).points[edge.i].xi, &b = of(edge.cell).points[edge.j].xi;
  for (int k = 0; k < 3; ++k)
    if (a[previous(k)] == 0 && b[previous(k)] == 0) return k;
  return -1;
}

MapPieces::Edge MapPieces::seen_from(const MapEdges::Side& other, const Edge& edge) const {
  Edge result{other.cell, -1, -1};
  const std::vector<Point>& points = of(other.cell).points;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p].xi[previous(other.edge)] != 0) continue;
    if (points[p].node == of(edge.cell).points[edge.i].node) result.i = static_cast<int>(p);
    if (points[p].node == of(edge.cell).points[edge.j].node) result.j = static_cast<int>(p);
  }
  return result;
}

std::vector<MapPieces::Edge> MapPieces::sides(const Edge& edge) const {
  std::vector<Edge> result{edge};
  const int k = cell_edge(edge);
  if (k < 0) return result;
  for (const MapEdges::Side& other : edges_.sides_of(edges_.of(edge.cell).surface[k])) {
    if (other.cell == edge.cell && other.edge == k) continue;
    const Edge side = seen_from(other, edge);
    // A cell of a file that has a vertex twice may not have the edge.
    if (side.i >= 0 && side.j >= 0 && side.i != side.j) result.push_back(side);
  }
  return result;
}

Vector2 MapPieces::evaluate(Index cell, const Vector3& xi) const {
  const Eigen::MatrixXd control = map_.uv(map_.cells.row(map_cell(cell)), Eigen::all);
  return (bernstein_values(map_.degree, std::vector<Vector3>{xi}) * control).transpose();
}

Vector3 MapPieces::flat_point(Index cell, const Vector3& xi) const {
  Vector3 result = Vector3::Zero();
  for (int k = 0; k < 3; ++k) result += xi[k] * position(cell, k);
  return result;
}

std::vector<Vector2> MapPieces::middles(const std::vector<Edge>& sides) const {
  std::vector<Vector2> result;
  std::vector<Index> plane;
  for (const Edge& side : sides) {
    const int k = cell_edge(side);
    plane.push_back(k < 0 ? -1 : plane_edge(side.cell, k));
    const auto known = std::find(plane.begin(), plane.end() - 1, plane.back());
    if (known != plane.end() - 1) {
      result.push_back(result[static_cast<std::size_t>(known - plane.begin())]);
      continue;
    }
    const std::vector<Point>& points = of(side.cell).points;
    result.push_back(evaluate(side.cell, (points[side.i].xi + points[side.j].xi) / 2));
  }
  return result;
}

void MapPieces::split(const Edge& edge) {
  const std::vector<Edge> all = sides(edge);
  const std::vector<Vector2> uv = middles(all);
  const Index node = next_node_++;
  std::map<Index, Index> v_of_space_edge, vt_of_plane_edge;
  for (std::size_t s = 0; s < all.size(); ++s) {
    const auto [c, i, j] = all[s];
    Cell& cell = cells_[c];
    const Vector3 xi = (cell.points[i].xi + cell.points[j].xi) / 2;
    const int k = cell_edge(all[s]);
    const auto [place, is_new_place] = v_of_space_edge.try_emplace(
        k < 0 ? -1 : edges_.of(c).space[k], static_cast<Index>(positions_.size()));
    if (is_new_place) positions_.push_back(flat_point(c, xi));
    const auto [entry, is_new] = vt_of_plane_edge.try_emplace(
        k < 0 ? -1 : plane_edge(c, k), static_cast<Index>(texcoords_.size()));
    if (is_new) texcoords_.push_back(uv[s]);
    const auto middle = static_cast<int>(cell.points.size());
    cell.points.push_back({place->second, entry->second, node, xi});
    const std::size_t before = cell.pieces.size();
    for (std::size_t p = 0; p < before; ++p) {
      const auto corners = cell.pieces[p].corners;
      const auto from = std::find(corners.begin(), corners.end(), i);
      const auto to = std::find(corners.begin(), corners.end(), j);
      if (from == corners.end() || to == corners.end()) continue;
      ++cell.pieces[p].depth;
      Piece half = cell.pieces[p];
      cell.pieces[p].corners[static_cast<std::size_t>(to - corners.begin())] = middle;
      half.corners[static_cast<std::size_t>(from - corners.begin())] = middle;
      cell.pieces.push_back(half);
    }
  }
}

void MapPieces::flip(Index cell, std::array<int, 2> pieces,
                     const std::array<std::array<int, 3>, 2>& corners) {
  std::vector<Piece>& all = cells_[cell].pieces;
  const int depth = std::max(all[pieces[0]].depth, all[pieces[1]].depth);
  for (std::size_t k = 0; k < 2; ++k) all[pieces[k]] = {corners[k], depth};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
