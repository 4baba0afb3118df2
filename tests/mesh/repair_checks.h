// Properties of every result of repair(), tested with the file and the result only, without
// half-edges, opposites or other data that the library derives.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "majorant/mesh/repair.h"
#include "mesh/list_edits.h"

namespace majorant {

// Expects that edges have one face, or two in opposite directions, and that the faces reached
// around a vertex across edges are all of its faces.
inline void expect_manifold(const Cells& faces, Index vertices) {
  std::map<std::pair<Index, Index>, Index> face_with;  // directed edge -> its face
  std::vector<std::vector<Index>> around(to_size(vertices));
  for (Index f = 0; f < faces.rows(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const Index a = faces(f, k), b = faces(f, (k + 1) % 3);
      ASSERT_NE(a, b) << "face " << f;
      ASSERT_TRUE(face_with.emplace(std::pair(a, b), f).second) << a << " " << b;
      around[a].push_back(f);
    }
  for (Index v = 0; v < vertices; ++v) {
    ASSERT_FALSE(around[v].empty()) << "vertex " << v;
    std::vector<Index> left = around[v], reached = {left.back()};
    left.pop_back();
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (auto it = left.begin(); it != left.end();) {
        bool touches = false;
        for (Index j = 0; j < 3; ++j) {
          const Index w = faces(reached[k], j);
          const auto in = face_with.find({v, w}), out = face_with.find({w, v});
          if (w != v && in != face_with.end() && out != face_with.end())
            touches |= (in->second == reached[k] && out->second == *it) ||
                       (out->second == reached[k] && in->second == *it);
        }
        if (touches) reached.push_back(*it);
        it = touches ? left.erase(it) : it + 1;
      }
    ASSERT_TRUE(left.empty()) << "vertex " << v << " has several fans";
  }
}

inline void expect_repaired(const PolygonMesh& input, const RepairedSurface& out,
                            double moved = 0) {
  const SurfaceMesh& mesh = *out.mesh;
  std::size_t triangles = 0;
  for (const auto& polygon : input.polygons) triangles += polygon.size() - 2;
  ASSERT_EQ(to_size(mesh.face_count()), triangles);
  ASSERT_EQ(out.polygon_corner.rows(), mesh.face_count());
  ASSERT_EQ(out.texture_seams.size(), 3 * triangles);
  std::vector<std::size_t> met(input.polygons.size(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto p = to_size(mesh.input_face(f));
    ASSERT_TRUE(f == 0 || mesh.input_face(f) >= mesh.input_face(f - 1)) << "order of faces";
    ++met[p];
    for (Index k = 0; k < 3; ++k) {
      const Index corner = out.polygon_corner(f, k), v = mesh.faces()(f, k);
      const Vector3& place = input.positions[input.polygons[p][corner]];
      if (moved == 0) {
        ASSERT_EQ(mesh.input_position(v), place) << "face " << f;
      } else {
        ASSERT_LE((mesh.input_position(v) - place).norm(), moved);
      }
      if (mesh.corner_texcoords().rows() > 0) {
        const Index vt = input.polygon_texcoords[p][corner];
        ASSERT_EQ(mesh.texcoord_ids()(f, k), vt);
        ASSERT_EQ(Vector2(mesh.corner_texcoords().row(f).segment<2>(2 * k)), input.texcoords[vt]);
      }
    }
  }
  for (std::size_t p = 0; p < met.size(); ++p) ASSERT_EQ(met[p], input.polygons[p].size() - 2) << p;
  expect_manifold(mesh.faces(), mesh.vertex_count());
  for (std::size_t r = 1; r < out.repairs.size(); ++r)
    EXPECT_LT(out.repairs[r - 1].kind, out.repairs[r].kind);
  for (const Repair& r : out.repairs) {
    EXPECT_GT(r.count, 0);
    EXPECT_EQ(r.places.size(),
              r.kind == RepairKind::MovedToOrigin ? 0 : std::min(to_size(r.count), kNamedPlaces));
  }
}

// Returns the number of repairs of that kind.
inline Index count_of(const RepairedSurface& out, RepairKind kind) {
  for (const Repair& r : out.repairs)
    if (r.kind == kind) return r.count;
  return 0;
}

inline RepairedSurface repaired(const PolygonMesh& mesh, const RepairOptions& options = {}) {
  RepairedSurface out = repair(mesh, options);
  expect_repaired(mesh, out);
  return out;
}

// Returns components, boundary loops and Euler characteristic.
inline std::array<Index, 3> shape_of(const RepairedSurface& out) {
  const Topology& t = out.mesh->topology();
  return {t.components, t.boundary_loops, t.euler_characteristic()};
}
using Shape = std::array<Index, 3>;

inline PolygonMesh both(PolygonMesh a, const PolygonMesh& b) {
  const auto first = static_cast<Index>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  append_lists(a.polygons, b.polygons, first);
  return a;
}

// Returns the mesh with texture coordinates (x, y) of the vertices, translated by (10 part, 0).
inline PolygonMesh textured(PolygonMesh mesh, const std::function<int(const Vector3&)>& part) {
  for (const auto& polygon : mesh.polygons) {
    Vector3 middle = Vector3::Zero();
    for (const Index v : polygon) middle += mesh.positions[v] / double(polygon.size());
    std::vector<Index> corners;
    for (const Index v : polygon) {
      corners.push_back(static_cast<Index>(mesh.texcoords.size()));
      mesh.texcoords.emplace_back(mesh.positions[v].head<2>());
      mesh.texcoords.back().x() += 10 * part(middle);
    }
    mesh.polygon_texcoords.push_back(corners);
  }
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
