// Generated closed surfaces, their cones, and cuts to a disk.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "mesh/test_meshes.h"

namespace majorant {

// Returns one random number per vertex.
inline Vec random_factors(const SurfaceMesh& mesh, double amount) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  Vec u(mesh.vertex_count());
  for (double& value : u) value = uniform(random);
  return u;
}

// Returns the surface of [0, n]^3: 6 n^2 unit squares, each divided into two triangles.
inline PolygonMesh cube(int n) {
  std::map<std::array<int, 3>, Index> numbers;
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> faces;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [found, is_new] = numbers.try_emplace(p, static_cast<Index>(positions.size()));
    if (is_new) positions.emplace_back(p[0], p[1], p[2]);
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int s, int t) {
            std::array<int, 3> p{};
            p[axis] = side * n;
            p[(axis + 1) % 3] = s;
            p[(axis + 2) % 3] = t;
            return vertex(p);
          };
          std::vector<Index> quad{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                                  corner(i, j + 1)};
          if (side == 0) std::reverse(quad.begin() + 1, quad.end());
          faces.push_back({quad[0], quad[1], quad[2]});
          faces.push_back({quad[0], quad[2], quad[3]});
        }
  return polygon_mesh(std::move(positions), std::move(faces));
}

// Returns the cube projected to the unit sphere; the cube's corners keep their directions.
inline PolygonMesh sphere(int n) {
  PolygonMesh mesh = cube(n);
  for (Vector3& p : mesh.positions) p = (p - Vector3::Constant(0.5 * n)).normalized();
  return mesh;
}

// Returns quarter turns by vertex: `turns` at the vertex nearest to each of `points`, 4 elsewhere.
inline std::vector<int> quarter_turns_at(const SurfaceMesh& mesh,
                                         const std::vector<Vector3>& points, int turns) {
  std::vector<int> result(to_size(mesh.vertex_count()), 4);
  for (const Vector3& p : points) {
    Index nearest = 0;
    (mesh.positions().rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    result[nearest] = turns;
  }
  return result;
}

// Returns the eight corners of a cube around `middle` of half edge length `size`.
inline std::vector<Vector3> cube_corners(const Vector3& middle, double size) {
  std::vector<Vector3> points;
  for (int c = 0; c < 8; ++c)
    points.push_back(middle + size * Vector3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1));
  return points;
}

// Returns `count` vertices far from each other by Euclidean distance; the first is the farthest
// from vertex 0.
inline std::vector<Index> spread_vertices(const SurfaceMesh& mesh, int count) {
  const auto distances = [&](Index v) -> Vec {
    return (mesh.positions().rowwise() - mesh.positions().row(v)).rowwise().norm();
  };
  Vec nearest = distances(0);
  std::vector<Index> chosen;
  for (int k = 0; k < count; ++k) {
    Index v = 0;
    nearest.maxCoeff(&v);
    chosen.push_back(v);
    nearest = k == 0 ? distances(v) : nearest.cwiseMin(distances(v));
  }
  return chosen;
}

// Returns cuts (3 #F flags) that leave one disk: the edges that a breadth-first tree of faces does
// not cross, without dangling paths that reach no cone (quarter turns other than 4).
inline std::vector<char> cut_through_cones(const SurfaceMesh& mesh,
                                           const std::vector<int>& quarter_turns) {
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 1);
  const auto join = [&](Index h) { is_cut[h] = is_cut[mesh.opposite(h)] = 0; };
  std::vector<char> seen(to_size(mesh.face_count()), 0);
  std::vector<Index> faces{0};
  seen[0] = 1;
  for (std::size_t done = 0; done < faces.size(); ++done)
    for (int k = 0; k < 3; ++k) {
      const Index h = mesh.opposite(3 * faces[done] + k);
      if (h < 0 || seen[h / 3]) continue;
      seen[h / 3] = 1;
      join(h);
      faces.push_back(h / 3);
    }
  // cut half-edges by their start
  std::vector<std::vector<Index>> around(to_size(mesh.vertex_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h]) around[mesh.from_vertex(h)].push_back(h);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    for (Index end = v; quarter_turns[end] == 4;) {
      std::erase_if(around[end], [&](Index h) { return !is_cut[h]; });
      if (around[end].size() != 1 || mesh.opposite(around[end][0]) < 0) break;
      const Index h = around[end][0];
      join(h);
      end = mesh.to_vertex(h);
    }
  return is_cut;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
