// Generated closed surfaces and surfaces with several boundaries, and the closed meshes of the
// public collection if available.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

#include "mesh/obj_file.h"

namespace majorant {

using Voxel = std::array<int, 3>;

// Returns the surface of a set of unit cubes, oriented outwards. Cubes that touch must share a face
// or a common neighbour; otherwise the surface is not manifold.
inline PolygonMesh voxel_surface(const std::set<Voxel>& cubes) {
  std::map<Voxel, Index> number;
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> squares;
  const auto vertex = [&](const Voxel& v) {
    const auto [place, is_new] = number.try_emplace(v, static_cast<Index>(positions.size()));
    if (is_new) positions.push_back({double(v[0]), double(v[1]), double(v[2])});
    return place->second;
  };
  for (const Voxel& cube : cubes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Voxel beyond = cube;
        beyond[axis] += 2 * side - 1;
        if (cubes.count(beyond)) continue;
        std::vector<Index> square;
        for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          Voxel corner = cube;
          corner[axis] += side;
          corner[(axis + 1) % 3] += side ? a : b;
          corner[(axis + 2) % 3] += side ? b : a;
          square.push_back(vertex(corner));
        }
        squares.push_back(square);
      }
  return polygon_mesh(std::move(positions), std::move(squares));
}

inline std::set<Voxel> box(int nx, int ny, int nz) {
  std::set<Voxel> cubes;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) cubes.insert({x, y, z});
  return cubes;
}

// Returns a bar with `handles` square holes through it; every unit has fine^3 cubes.
inline PolygonMesh bar_with_holes(int handles, int fine) {
  std::set<Voxel> cubes = box((2 * handles + 1) * fine, 3 * fine, fine);
  for (int hole = 0; hole < handles; ++hole)
    for (const Voxel& c : box(fine, fine, fine))
      cubes.erase({c[0] + (2 * hole + 1) * fine, c[1] + fine, c[2]});
  return voxel_surface(cubes);
}

inline PolygonMesh transformed(PolygonMesh mesh, const std::function<Vector3(const Vector3&)>& f) {
  for (Vector3& p : mesh.positions) p = f(p);
  return mesh;
}

// Returns the surface of n^3 cubes, projected to a sphere.
inline PolygonMesh cube_sphere(int n) {
  return transformed(voxel_surface(box(n, n, n)), [n](const Vector3& p) -> Vector3 {
    return (p - Vector3::Constant(n / 2.0)).normalized();
  });
}

inline PolygonMesh tetrahedron() {
  return polygon_mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
}

inline PolygonMesh octahedron() {
  return polygon_mesh(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

// Returns a grid without the given squares, numbered row by row.
inline PolygonMesh grid_without(int n, const std::set<int>& squares, const Height& height = flat) {
  PolygonMesh mesh = grid(n, height);
  IndexLists kept;
  for (std::size_t f = 0; f < mesh.polygons.size(); ++f)
    if (!squares.count(static_cast<int>(f / 2))) kept.push_back(mesh.polygons[f]);
  return polygon_mesh(mesh.positions, std::move(kept));
}

inline PolygonMesh one_triangle() {
  return polygon_mesh({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
}

inline std::vector<std::pair<std::string, PolygonMesh>> surfaces_of_any_genus() {
  return {{"tetrahedron", tetrahedron()},
          {"octahedron", octahedron()},
          {"cube", voxel_surface(box(1, 1, 1))},
          {"cube sphere", cube_sphere(6)},
          {"box", voxel_surface(box(5, 3, 2))},
          {"torus", torus(24, 12, 0)},
          {"coarse torus", torus(3, 3, 0)},
          {"torus with a hole", torus(12, 8, 2)},
          {"square ring", bar_with_holes(1, 2)},
          {"genus 2", bar_with_holes(2, 3)},
          {"coarse genus 3", bar_with_holes(3, 1)},
          {"disk", grid(6, bumpy)},
          {"flat disk", grid(5)},
          {"annulus", grid_without(7, {24}, bumpy)},
          {"flat, 3 holes", grid_without(9, {20, 24, 60})},
          {"one triangle", one_triangle()},
          {"two triangles", grid(1)},
          {"fan", cone(5, true)}};
}

inline std::vector<std::string> obj_files(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".obj") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
