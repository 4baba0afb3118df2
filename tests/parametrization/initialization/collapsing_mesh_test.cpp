// Triangles lose vertices and stay a surface of the same topology; undoing brings every one back.
#include "majorant/parametrization/initialization/collapsing_mesh.h"

#include <algorithm>
#include <set>

#include "majorant/framework/parallel.h"
#include "mesh/list_edits.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

Cells faces_of(const CollapsingMesh& mesh) {
  Cells faces(mesh.faces_left(), 3);
  Index row = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.has_face(f))
      faces.row(row++) << mesh.from(3 * f), mesh.from(3 * f + 1), mesh.from(3 * f + 2);
  return faces;
}

CollapsingMesh collapsing(const SurfaceMesh& mesh) {
  return {mesh.faces(), mesh.opposites(), mesh.vertex_count()};
}

std::set<Index> used(const Cells& faces) { return {faces.data(), faces.data() + faces.size()}; }

// Compares with a surface built from the remaining faces by independent code.
void expect_same_topology(const CollapsingMesh& mesh, const Topology& before) {
  const Cells faces = faces_of(mesh);
  const std::vector<Index> opposite = opposite_half_edges(faces);
  EXPECT_EQ(find_touching_vertex(faces, opposite), -1);
  const auto vertices = static_cast<Index>(used(faces).size());
  EXPECT_EQ(vertices, mesh.vertices_left());
  const auto open = std::count(opposite.begin(), opposite.end(), -1);
  const auto edges = static_cast<Index>((opposite.size() + static_cast<std::size_t>(open)) / 2);
  EXPECT_EQ(vertices - edges + mesh.faces_left(), before.euler_characteristic());
  const auto loops = boundary_half_edges(faces, opposite);
  EXPECT_EQ(static_cast<Index>(loops.size()), before.boundary_loops);
  for (const auto& loop : loops) EXPECT_GE(loop.size(), 3u);
}

// Expects rings in the order of the faces: from the boundary on, or cyclic.
void expect_rings(const CollapsingMesh& mesh) {
  const Cells faces = faces_of(mesh);
  std::vector<Index> ring;
  for (const Index v : used(faces)) {
    mesh.ring(v, ring);
    std::set<Index> neighbours;
    Index around = 0;
    for (Index f = 0; f < static_cast<Index>(faces.rows()); ++f)
      for (int k = 0; k < 3; ++k)
        if (faces(f, k) == v) {
          ++around;
          neighbours.insert({faces(f, (k + 1) % 3), faces(f, (k + 2) % 3)});
        }
    EXPECT_EQ(std::set<Index>(ring.begin(), ring.end()), neighbours) << "vertex " << v;
    EXPECT_EQ(static_cast<Index>(ring.size()), around + (mesh.on_boundary(v) ? 1 : 0)) << v;
  }
}

const SurfaceMesh& with_holes() {
  static const auto mesh = [] {
    PolygonMesh plain = grid(12, bumpy);
    for (const std::size_t f : {200u, 100u, 60u}) erase_lists(plain.polygons, f, 1);
    plain.polygon_lines.resize(plain.polygons.size());
    return surface(plain);
  }();
  return *mesh;
}

void expect_way_there_and_back(const SurfaceMesh& surface, Index least) {
  CollapsingMesh mesh = collapsing(surface);
  std::vector<Cells> states{faces_of(mesh)};
  for (Index goal = surface.face_count() / 2; goal >= least; goal /= 2) {
    decimate(mesh, surface.positions(), {goal, {}});
    EXPECT_LE(mesh.faces_left(), goal);
    expect_same_topology(mesh, surface.topology());
    expect_rings(mesh);
    states.push_back(faces_of(mesh));
  }
  for (; !states.empty(); states.pop_back()) {
    const Cells& state = states.back();
    while (mesh.faces_left() < state.rows()) {
      const auto back = mesh.restore();
      EXPECT_TRUE(mesh.is_present(back.vertex));
      std::vector<Index> ring;
      mesh.ring(back.vertex, ring);
      EXPECT_EQ(std::count(ring.begin(), ring.end(), back.onto), 1);
    }
    EXPECT_EQ(faces_of(mesh), state);
    expect_rings(mesh);
  }
}

TEST(CollapsingMesh, KeepsTheTopologyAndComesBack) {
  for (const char* name : {"cap", "creature", "ribbon", "tube", "wavy_disk"}) {
    SCOPED_TRACE(name);
    expect_way_there_and_back(*generated(name), 60);
  }
}

TEST(CollapsingMesh, KeepsHoles) { expect_way_there_and_back(with_holes(), 60); }

TEST(CollapsingMesh, RefusesCollapsesThatTearOrFold) {
  const auto both_ends = {CollapsingMesh::End::Start, CollapsingMesh::End::Target};
  CollapsingMesh single =
      collapsing(*surface(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})));
  for (const Index h : {0, 1, 2})
    for (const auto end : both_ends) EXPECT_FALSE(single.may_collapse(h, end, 16));
  // Two triangles: their common edge joins boundary vertices, the others may collapse.
  CollapsingMesh pair = collapsing(*surface(grid(1)));
  for (Index h = 0; h < 6; ++h)
    for (const auto end : both_ends)
      EXPECT_EQ(pair.may_collapse(h, end, 16), pair.opposite(h) < 0) << h;
  // A closed fan: the apex is inside, the rim on the boundary, and an inner vertex may not collapse
  // to the boundary.
  CollapsingMesh fan = collapsing(*surface(cone(6, true)));
  fan.for_each_leaving(
      0, [&](Index h) { EXPECT_FALSE(fan.may_collapse(h, CollapsingMesh::End::Start, 16)); });
}

TEST(CollapsingMesh, LimitsTheNumberOfNeighbours) {
  CollapsingMesh mesh = collapsing(*surface(grid(6)));
  Index inner = -1;
  for (Index h = 0; h < 3 * mesh.face_slots(); ++h)
    if (!mesh.on_boundary(mesh.from(h)) && !mesh.on_boundary(mesh.to(h))) inner = h;
  ASSERT_GE(inner, 0);  // both have 6 neighbours: 8 remain
  EXPECT_TRUE(mesh.may_collapse(inner, CollapsingMesh::End::Start, 8));
  EXPECT_FALSE(mesh.may_collapse(inner, CollapsingMesh::End::Start, 7));
}

TEST(Decimation, KeepsHeldVertices) {
  const auto mesh = surface(grid(16, bumpy));
  CollapsingMesh left = collapsing(*mesh);
  decimate(left, mesh->positions(), {20, mesh->boundary_flags()});
  const std::vector<char> held = mesh->boundary_flags();
  for (Index v = 0; v < mesh->vertex_count(); ++v) EXPECT_TRUE(left.is_present(v) || !held[v]) << v;
  EXPECT_LT(left.vertices_left(), mesh->vertex_count() / 2);
}

// Returns a square sheet with an additional triangle at every border edge.
std::shared_ptr<const SurfaceMesh> sheet_with_ears() {
  const auto sheet = surface(grid(12, bumpy));
  std::vector<Vector3> positions;
  for (Index v = 0; v < sheet->vertex_count(); ++v) positions.push_back(sheet->positions().row(v));
  std::vector<std::vector<Index>> faces;
  for (Index f = 0; f < sheet->face_count(); ++f)
    faces.push_back({sheet->faces()(f, 0), sheet->faces()(f, 1), sheet->faces()(f, 2)});
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : positions) centre += p / static_cast<double>(positions.size());
  for (Index h = 0; h < sheet->half_edge_count(); ++h) {
    if (sheet->opposite(h) >= 0) continue;
    const Index a = sheet->from_vertex(h), b = sheet->to_vertex(h);
    const Vector3 middle = (positions[a] + positions[b]) / 2;
    faces.push_back({b, a, static_cast<Index>(positions.size())});
    positions.push_back(middle + 0.1 * (middle - centre));
  }
  return surface(polygon_mesh(positions, faces));
}

// Returns the number of reinserted ears.
int returned_ears(Ears ears) {
  const auto mesh = sheet_with_ears();
  CollapsingMesh left = collapsing(*mesh);
  decimate(left, mesh->positions(), {20, {}, ears});
  EXPECT_LT(left.vertices_left(), mesh->vertex_count() / 2);
  int count = 0;
  while (left.vertices_left() < mesh->vertex_count())
    count += left.is_ear(left.restore().vertex) ? 1 : 0;
  return count;
}

TEST(Decimation, EarsStayOnRequest) {
  EXPECT_GT(returned_ears(Ears::Leave), 0);
  EXPECT_EQ(returned_ears(Ears::Stay), 0);
}

TEST(Decimation, IsTheSameOnAnyNumberOfThreads) {
  const auto mesh = surface(grid(60, bumpy));
  const auto collapses = [&](int threads) {
    const ThreadCount count(threads);
    CollapsingMesh left = collapsing(*mesh);
    decimate(left, mesh->positions(), {100, {}});
    std::vector<std::pair<Index, Index>> all;
    for (Index k = 0; k < left.vertex_count() - left.vertices_left(); ++k) {
      const CollapsingMesh::Restored gone = left.collapsed(k);
      all.emplace_back(gone.vertex, gone.onto);
    }
    return all;
  };
  const auto alone = collapses(1);
  EXPECT_GT(alone.size(), 3000u);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(collapses(threads), alone) << threads;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
