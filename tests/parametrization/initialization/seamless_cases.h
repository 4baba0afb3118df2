// Cut surfaces with known seamless coordinates: unit squares glued along their sides (polycubes,
// tori), and fans of any number of quarter turns.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/test_meshes.h"

namespace majorant {

struct SeamlessCase {
  std::shared_ptr<const SurfaceMesh> mesh;  // with texture coordinates
  PolygonMesh polygons;                     // the input of the mesh
  std::vector<char> is_cut;                 // 3 #F
  CornerPoints corners;                     // #F by 6

  Start start() const { return seamless_from_corners(*mesh, is_cut, corners); }
};

// Returns the case of triangles over shared vertices with the coordinates of their corners and the
// edges to cut (pairs of vertices). It has one vt for each copy of a vertex after cutting.
inline SeamlessCase seamless_case(std::vector<Vector3> positions,
                                  const std::vector<std::array<Index, 3>>& triangles,
                                  const std::vector<std::array<Vector2, 3>>& uv,
                                  const std::vector<std::array<char, 3>>& cut_sides) {
  SeamlessCase out;
  IndexLists polygons;
  for (const auto& t : triangles) polygons.push_back({t[0], t[1], t[2]});
  out.polygons = polygon_mesh(std::move(positions), std::move(polygons));
  const SurfaceMesh plain = SurfaceMesh::from_polygons(out.polygons);
  out.corners.resize(plain.face_count(), 6);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      out.corners.row(Index(f)).segment<2>(2 * Index(k)) = uv[f][k];
      out.is_cut.push_back(cut_sides[f][k]);
    }
  for (Index h = 0; h < plain.half_edge_count(); ++h)
    if (out.is_cut[h] && plain.opposite(h) < 0) out.is_cut[h] = 0;
  const SurfaceMesh cut = plain.cut_along(out.is_cut, nullptr);
  out.polygons.texcoords.resize(to_size(cut.vertex_count()));
  for (Index f = 0; f < cut.face_count(); ++f) {
    const auto corner = [&](Index k) { return cut.faces()(f, k); };
    out.polygons.polygon_texcoords.push_back({corner(0), corner(1), corner(2)});
    for (Index k = 0; k < 3; ++k)
      out.polygons.texcoords[corner(k)] = out.corners.row(f).segment<2>(2 * k);
  }
  out.mesh = surface(out.polygons);
  return out;
}

// ---- Squares ----

// Unit squares by their corners, counterclockwise from outside; an edge has each direction in one
// square at most. positions: of the corners.
struct Squares {
  std::vector<Vector3> positions;
  std::vector<std::array<Index, 4>> squares;
};

// Returns the surface of a union of unit cubes. Cubes must not share an edge without sharing a
// face.
inline Squares polycube(const std::vector<std::array<int, 3>>& cubes) {
  const auto has = [&](const std::array<int, 3>& c) {
    return std::find(cubes.begin(), cubes.end(), c) != cubes.end();
  };
  Squares out;
  std::map<std::array<int, 3>, Index> vertex;
  for (const auto& cube : cubes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        std::array<int, 3> next = cube;
        next[axis] += side ? 1 : -1;
        if (has(next)) continue;
        std::array<Index, 4> square{};
        for (std::size_t k = 0; k < 4; ++k) {
          std::array<int, 3> p = cube;
          p[axis] += side;
          const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
          p[side ? a : b] += k == 1 || k == 2;
          p[side ? b : a] += k >= 2;
          const auto [it, fresh] = vertex.try_emplace(p, Index(out.positions.size()));
          if (fresh) out.positions.push_back(Vector3(p[0], p[1], p[2]));
          square[k] = it->second;
        }
        out.squares.push_back(square);
      }
  return out;
}

inline Squares unit_cube() { return polycube({{0, 0, 0}}); }

// Returns a plate with `holes` square holes in a row, of genus `holes`.
inline Squares holed_plate(int holes) {
  std::vector<std::array<int, 3>> cubes;
  for (int i = 0; i < 2 * holes + 1; ++i)
    for (int j = 0; j < 3; ++j)
      if (i % 2 == 0 || j != 1) cubes.push_back({i, j, 0});
  return polycube(cubes);
}

// Returns m by n squares around a torus.
inline Squares square_torus(int m, int n) {
  Squares out;
  out.positions = torus(m, n, 0).positions;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const int i1 = (i + 1) % m, j1 = (j + 1) % n;
      out.squares.push_back({j * m + i, j * m + i1, j1 * m + i1, j1 * m + i});
    }
  return out;
}

// ConeTree: cut along a short tree that joins the vertices without four squares (genus 0 only).
enum class Charts { OnePerSquare, One, OneWithoutSlits, ConeTree };

inline Vector2 square_corner(int k) { return Vector2(k == 1 || k == 2, k >= 2); }

using Side = std::pair<Index, Index>;  // of a square, from corner to corner

// Returns the sides, in both directions, of a tree that joins the cones: repeatedly a shortest path
// from the tree to the next cone.
inline std::set<Side> cone_tree(const Squares& s) {
  std::vector<std::vector<Index>> neighbours(s.positions.size());
  for (const auto& square : s.squares)
    for (std::size_t k = 0; k < 4; ++k) neighbours[square[k]].push_back(square[(k + 1) % 4]);
  std::set<Side> tree;
  std::vector<char> in_tree(s.positions.size(), 0);
  const auto is_cone = [&](Index v) { return neighbours[v].size() != 4; };
  for (Index v = 0; v < Index(s.positions.size()) && tree.empty(); ++v)
    if (is_cone(v)) {
      in_tree[v] = 1;
      break;
    }
  for (bool grown = true; grown;) {
    grown = false;
    std::vector<Index> queue, from(s.positions.size(), -1);
    for (Index v = 0; v < Index(s.positions.size()); ++v)
      if (in_tree[v]) queue.push_back(from[v] = v);
    for (std::size_t head = 0; head < queue.size() && !grown; ++head)
      for (const Index w : neighbours[queue[head]]) {
        if (from[w] >= 0) continue;
        from[w] = queue[head];
        queue.push_back(w);
        if (!is_cone(w)) continue;
        for (Index v = w; !in_tree[v]; v = from[v]) {
          tree.insert({v, from[v]});
          tree.insert({from[v], v});
          in_tree[v] = 1;
        }
        grown = true;
        break;
      }
  }
  return tree;
}

// Positions of the squares in the plane: uv = i^turns (s, t) + offset, and the cut sides.
struct SquareLayout {
  std::vector<int> turns;
  std::vector<Vector2> offset;
  std::vector<std::array<char, 4>> cut;
};

using SquareSides = std::map<Side, std::pair<std::size_t, int>>;  // square, number of the side

// Removes dangling paths of cuts, beginning at their ends at vertices of 360 degrees.
inline void remove_slits(const Squares& s, const SquareSides& side_of, SquareLayout& out) {
  const std::size_t count = s.squares.size();
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<int> cuts(s.positions.size(), 0), squares(s.positions.size(), 0);
    for (std::size_t q = 0; q < count; ++q)
      for (int k = 0; k < 4; ++k) {
        ++squares[s.squares[q][k]];
        cuts[s.squares[q][k]] += out.cut[q][k];  // an edge counts once from each end
      }
    for (std::size_t q = 0; q < count && !changed; ++q)
      for (int k = 0; k < 4 && !changed; ++k)
        for (const int end : {k, (k + 1) % 4}) {
          const auto v = to_size(s.squares[q][end]);
          if (!out.cut[q][k] || cuts[v] != 1 || squares[v] != 4) continue;
          const auto [n, side] = side_of.at({s.squares[q][(k + 1) % 4], s.squares[q][k]});
          out.cut[q][k] = out.cut[n][side] = 0;
          changed = true;
          break;
        }
  }
}

inline SquareLayout lay_out(const Squares& s, Charts charts) {
  const std::size_t count = s.squares.size();
  SquareSides side_of;
  for (std::size_t q = 0; q < count; ++q)
    for (int k = 0; k < 4; ++k) side_of[{s.squares[q][k], s.squares[q][(k + 1) % 4]}] = {q, k};
  SquareLayout out{std::vector<int>(count, 0), std::vector<Vector2>(count, Vector2(0, 0)),
                   std::vector<std::array<char, 4>>(count, {1, 1, 1, 1})};
  for (std::size_t q = 0; q < count; ++q) out.offset[q] = Vector2(1.25 * double(q), 0);
  if (charts == Charts::OnePerSquare) return out;
  const auto opposite = [&](std::size_t q, int k) {
    return side_of.at({s.squares[q][(k + 1) % 4], s.squares[q][k]});
  };
  const std::set<Side> tree = charts == Charts::ConeTree ? cone_tree(s) : std::set<Side>();
  std::vector<char> met(count, 0);
  std::vector<std::size_t> queue{0};
  met[0] = 1;
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (int k = 0; k < 4; ++k) {
      const std::size_t q = queue[head];
      const auto [n, side] = opposite(q, k);
      if (charts == Charts::ConeTree) {
        const char cut = tree.count({s.squares[q][k], s.squares[q][(k + 1) % 4]}) > 0;
        out.cut[q][k] = out.cut[n][side] = cut;
        if (cut) continue;
      }
      if (met[n]) continue;
      met[n] = 1;
      queue.push_back(n);
      out.cut[q][k] = out.cut[n][side] = 0;
      out.turns[n] = (out.turns[q] + k + 6 - side) % 4;
      out.offset[n] = rotated(square_corner((k + 1) % 4), out.turns[q]) + out.offset[q] -
                      rotated(square_corner(side), out.turns[n]);
    }
  if (charts != Charts::OneWithoutSlits) return out;
  remove_slits(s, side_of, out);
  return out;
}

// Divides every square into m by m, two triangles each. `lift` maps positions on the flat squares
// to space.
inline SeamlessCase squares_case(
    const Squares& s, int m, Charts charts,
    const std::function<Vector3(const Vector3&)>& lift = [](const Vector3& p) { return p; }) {
  const SquareLayout layout = lay_out(s, charts);
  std::map<std::array<Index, 4>, Index> vertex;
  std::vector<Vector3> positions;
  const auto number = [&](std::size_t q, int i, int j) {
    const auto& c = s.squares[q];
    const std::array<int, 4> on{j == 0, i == m, j == m, i == 0};
    const std::array<int, 4> along{i, j, m - i, m - j};
    std::array<Index, 4> key{0, Index(q), i, j};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!on[k]) continue;
      const Index a = c[k], b = c[(k + 1) % 4];
      if (along[k] == 0 || along[k] == m)
        key = {1, along[k] ? b : a, 0, 0};
      else
        key = {2, std::min(a, b), std::max(a, b), a < b ? along[k] : m - along[k]};
    }
    const auto [it, fresh] = vertex.try_emplace(key, Index(positions.size()));
    if (fresh) {
      const double x = double(i) / m, y = double(j) / m;
      const auto p = [&](std::size_t k) { return s.positions[c[k]]; };
      positions.push_back(
          lift((1 - x) * (1 - y) * p(0) + x * (1 - y) * p(1) + x * y * p(2) + (1 - x) * y * p(3)));
    }
    return it->second;
  };
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Vector2, 3>> uv;
  std::vector<std::array<char, 3>> cut;
  for (std::size_t q = 0; q < s.squares.size(); ++q)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) {
        const auto place = [&](int a, int b) -> Vector2 {
          return rotated(Vector2(double(a) / m, double(b) / m), layout.turns[q]) + layout.offset[q];
        };
        const auto& c = layout.cut[q];
        triangles.push_back({number(q, i, j), number(q, i + 1, j), number(q, i + 1, j + 1)});
        uv.push_back({place(i, j), place(i + 1, j), place(i + 1, j + 1)});
        cut.push_back({char(j == 0 && c[0]), char(i + 1 == m && c[1]), 0});
        triangles.push_back({number(q, i, j), number(q, i + 1, j + 1), number(q, i, j + 1)});
        uv.push_back({place(i, j), place(i + 1, j + 1), place(i, j + 1)});
        cut.push_back({0, char(j + 1 == m && c[2]), char(i == 0 && c[3])});
      }
  return seamless_case(std::move(positions), triangles, uv, cut);
}

// Returns the surface with additional cuts: each edge is cut with this probability, and each piece
// is turned and moved at random.
inline SeamlessCase with_random_cuts(SeamlessCase c, double probability, unsigned seed) {
  std::mt19937 random(seed);
  for (Index h = 0; h < c.mesh->half_edge_count(); ++h) {
    const Index o = c.mesh->opposite(h);
    if (o > h && double(random()) < probability * 4294967296.0) c.is_cut[h] = c.is_cut[o] = 1;
  }
  std::vector<char> met(to_size(c.mesh->face_count()), 0);
  for (Index seed_face = 0; seed_face < c.mesh->face_count(); ++seed_face) {
    if (met[seed_face]) continue;
    met[seed_face] = 1;
    const int turns = int(random() % 4);
    const Vector2 offset(double(random() % 16), double(random() % 16));
    std::vector<Index> queue{seed_face};
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * queue[head] + k, o = c.mesh->opposite(h);
        auto corner = c.corners.row(h / 3).segment<2>(2 * k);
        corner = (rotated(corner, turns) + offset).transpose().eval();
        if (o < 0 || c.is_cut[h] || met[o / 3]) continue;
        met[o / 3] = 1;
        queue.push_back(o / 3);
      }
  }
  return c;
}

// ---- Fans ----

// Returns rings of triangles around a vertex of `quarter_turns` (at least 3 sectors each), cut
// along one ray. If `inner` > 0, the first rings are missing: an annulus.
inline SeamlessCase fan_case(int quarter_turns, int rings, int inner = 0) {
  const int sectors = std::max(3 * quarter_turns, 4);
  std::vector<Vector3> positions;
  std::vector<Index> numbers;
  const auto number = [&](int r, int s) {
    return r == 0 ? 0 : (r - std::max(inner, 1)) * sectors + s % sectors + (inner ? 0 : 1);
  };
  if (!inner) positions.push_back({0, 0, 1});
  for (int r = std::max(inner, 1); r <= rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const double t = 2 * kPi * s / sectors;
      positions.push_back({r * std::cos(t), r * std::sin(t), 1.0 / (1 + r)});
    }
  const auto place = [&](int r, int s) -> Vector2 {
    const double t = 0.5 * kPi * quarter_turns * s / sectors;
    return {r * std::cos(t), r * std::sin(t)};
  };
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Vector2, 3>> uv;
  std::vector<std::array<char, 3>> cut;
  for (int r = inner; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const char first = s == 0, last = s + 1 == sectors;
      triangles.push_back({number(r, s), number(r + 1, s), number(r + 1, s + 1)});
      uv.push_back({place(r, s), place(r + 1, s), place(r + 1, s + 1)});
      cut.push_back({first, 0, char(r == 0 && last)});
      if (r == 0) continue;
      triangles.push_back({number(r, s), number(r + 1, s + 1), number(r, s + 1)});
      uv.push_back({place(r, s), place(r + 1, s + 1), place(r, s + 1)});
      cut.push_back({0, last, 0});
    }
  return seamless_case(std::move(positions), triangles, uv, cut);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
