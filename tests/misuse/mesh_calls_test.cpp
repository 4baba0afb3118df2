// Wrong calls of functions that make surfaces. Surfaces come from arrays: messages count from 0 and
// name neither files nor the command.
#include <limits>
#include <memory>

#include "majorant/mesh/repair.h"
#include "majorant/mesh/seams.h"
#include "majorant/mesh/surface_mesh.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace mesh_calls {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PolygonMesh square() {
  PolygonMesh m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  m.polygons = {{0, 1, 2}, {0, 2, 3}};
  return m;
}
PolygonMesh changed(const std::function<void(PolygonMesh&)>& change) {
  PolygonMesh m = square();
  change(m);
  return m;
}
void surface(const std::function<void(PolygonMesh&)>& change) {
  SurfaceMesh::from_polygons(changed(change));
}

RowMatrix positions() {
  RowMatrix v(4, 3);
  v << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  return v;
}
Cells faces() { return (Cells(2, 3) << 0, 1, 2, 0, 2, 3).finished(); }
void arrays(const std::function<void(RowMatrix&, Cells&)>& change) {
  RowMatrix v = positions();
  Cells f = faces();
  change(v, f);
  SurfaceMesh::from_arrays(v, f);
}

SurfaceMesh tetrahedron() {
  RowMatrix v(4, 3);
  v << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  Cells f(4, 3);
  f << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return SurfaceMesh::from_arrays(v, f);
}

void parts(const std::function<void(SurfaceParts&)>& change) {
  SurfaceParts p;
  p.positions = positions();
  p.faces = faces();
  p.input_vertex = {0, 1, 2, 3};
  p.input_face = {0, 1};
  change(p);
  SurfaceMesh::from_parts(p);
}

const std::vector<Call> kCalls{
    {"index_too_large", "InvalidArgument: polygon 1 has vertex 9, there are 4",
     [] { surface([](PolygonMesh& m) { m.polygons[1][2] = 9; }); }},
    {"index_negative", "InvalidArgument: polygon 0 has vertex -1, there are 4",
     [] { surface([](PolygonMesh& m) { m.polygons[0][0] = -1; }); }},
    {"polygon_of_two", "InvalidArgument: polygon 1 has 2 corners",
     [] { surface([](PolygonMesh& m) {
            m.polygons = {{0, 1, 2}, {0, 1}};
          }); }},
    {"polygon_of_none", "InvalidArgument: polygon 0 has 0 corners",
     [] { surface([](PolygonMesh& m) {
            m.polygons = {{}, {0, 2, 3}};
          }); }},
    {"nan_position", "InvalidArgument: vertex 3 is at (0, nan, 0), finite numbers are needed",
     [] { surface([](PolygonMesh& m) { m.positions[3].y() = kNan; }); }},
    {"infinite_position", "InvalidArgument: vertex 0 is at (-inf, 0, 0)",
     [] { surface([](PolygonMesh& m) { m.positions[0].x() = -1 / 0.0; }); }},
    {"no_faces", "Error Unsupported: the mesh has no faces",
     [] { surface([](PolygonMesh& m) { m.polygons.clear(); }); }},
    {"nothing", "Error Unsupported: the mesh has no faces",
     [] { SurfaceMesh::from_polygons(PolygonMesh{}); }},
    {"texcoord_lists", "InvalidArgument: texture coordinates of 1 polygons, there are 2",
     [] { surface([](PolygonMesh& m) { m.polygon_texcoords = {{}}; }); }},
    {"texcoord_corners", "InvalidArgument: polygon 1 has 3 corners, but 2 texture coordinates",
     [] { surface([](PolygonMesh& m) {
            m.polygon_texcoords = {{}, {0, 0}};
          }); }},
    {"texcoord_index", "InvalidArgument: polygon 0: texture coordinates have index 5, there are 1",
     [] {
       surface([](PolygonMesh& m) {
         m.texcoords = {{0, 0}};
         m.polygon_texcoords = {{0, 5, 0}, {}};
       });
     }},
    {"nan_texcoord", "InvalidArgument: texture coordinates 0 are not finite",
     [] { surface([](PolygonMesh& m) {
            m.texcoords = {{kNan, 0}};
          }); }},
    {"vertex_twice", "Error Unsupported: face 1: a vertex occurs twice; repair() makes",
     [] { surface([](PolygonMesh& m) {
            m.polygons = {{0, 1, 2}, {0, 2, 2}};
          }); }},
    {"huge",
     "Error Unsupported: edges of length 1e+200 to 1.41e+200: areas leave the range of doubles; "
     "scale the mesh",
     [] {
       surface([](PolygonMesh& m) {
         for (auto& p : m.positions) p *= 1e200;
       });
     }},
    {"tiny", "Error Unsupported: edges of length 1e-200 to 1.41e-200: areas leave the range",
     [] {
       surface([](PolygonMesh& m) {
         for (auto& p : m.positions) p *= 1e-200;
       });
     }},
    {"lengths_overflow", "Error Unsupported: edges of length",
     [] {
       surface([](PolygonMesh& m) {
         for (auto& p : m.positions) p = 1.7e308 * (2 * p - Vector3(1, 1, 0));
       });
     }},
    {"large", "accepted",
     [] {
       surface([](PolygonMesh& m) {
         for (auto& p : m.positions) p *= 1e140;
       });
     }},
    {"small", "accepted",
     [] {
       surface([](PolygonMesh& m) {
         for (auto& p : m.positions) p *= 1e-140;
       });
     }},
    {"zero_area", "Error Unsupported: face 1: zero area (vertices 0, 2, 3)",
     [] { surface([](PolygonMesh& m) {
            m.positions[3] = {0.5, 0.5, 0};
          }); }},
    {"face_twice", "Error Unsupported: face 2: the same face occurs twice; repair()",
     [] { surface([](PolygonMesh& m) {
            m.polygons.push_back({1, 2, 0});
          }); }},
    {"three_faces_at_an_edge",
     "Error Unsupported: face 2: edge (0, 2) has more than two faces (non-manifold); repair()",
     [] {
       surface([](PolygonMesh& m) {
         m.positions.push_back({0, 0, 1});
         m.polygons.push_back({0, 2, 4});
       });
     }},
    {"turned_face", "Error Unsupported: face 1: faces on both sides of edge (0, 2) run against",
     [] { surface([](PolygonMesh& m) {
            m.polygons = {{0, 1, 2}, {0, 3, 2}};
          }); }},
    {"two_components", "Error Unsupported: face 2: the mesh has 2 components, a second one starts",
     [] {
       surface([](PolygonMesh& m) {
         m.positions.insert(m.positions.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
         m.polygons.push_back({4, 5, 6});
       });
     }},
    {"sheets_that_touch", "Error Unsupported: vertex 0: sheets of the surface touch there",
     [] {
       surface([](PolygonMesh& m) {
         m.positions.insert(m.positions.end(), {{-1, 0, 0}, {-1, -1, 0}});
         m.polygons.push_back({0, 4, 5});
       });
     }},
    {"far_away", "Error Unsupported: face 0: an edge of length 1 at coordinates near 1e+15",
     [] {
       surface([](PolygonMesh& m) {
         for (Vector3& p : m.positions) p.x() += 1e15;
       });
     }},
    {"closed_is_no_disk",
     "Error Unsupported: the surface is closed (genus 0, no boundary); unwrap() cuts it open",
     [] { tetrahedron().require_disk(); }},
    {"closed_is_not_planar", "Error Unsupported: the surface is closed (genus 0",
     [] { tetrahedron().require_planar(); }},
    {"arrays_of_plane_points",
     "InvalidArgument: SurfaceMesh::from_arrays: positions have 2 columns, 3 are needed",
     [] { SurfaceMesh::from_arrays(RowMatrix::Zero(4, 2), faces()); }},
    {"arrays_of_edges", "InvalidArgument: polygon 0 has 2 corners",
     [] { SurfaceMesh::from_arrays(positions(), Cells::Zero(2, 2)); }},
    {"arrays_from_one", "InvalidArgument: polygon 1 has vertex 4, there are 4",
     [] { arrays([](RowMatrix&, Cells& f) { f.array() += 1; }); }},
    {"arrays_negative", "InvalidArgument: polygon 1 has vertex -3",
     [] { arrays([](RowMatrix&, Cells& f) { f(1, 1) = -3; }); }},
    {"arrays_nan", "InvalidArgument: vertex 2 is at (nan, 1, 0)",
     [] { arrays([](RowMatrix& v, Cells&) { v(2, 0) = kNan; }); }},
    {"arrays_empty", "Error Unsupported: the mesh has no faces",
     [] { SurfaceMesh::from_arrays(RowMatrix(0, 3), Cells(0, 3)); }},
    {"arrays_transposed", "InvalidArgument: SurfaceMesh::from_arrays: positions have 4 columns",
     [] { SurfaceMesh::from_arrays(positions().transpose(), faces()); }},
    {"parts_short_input_vertex", "InvalidArgument: SurfaceMesh: input_vertex has 2 numbers, 4",
     [] { parts([](SurfaceParts& p) {
            p.input_vertex = {0, 1};
          }); }},
    {"parts_no_input_face", "InvalidArgument: SurfaceMesh: input_face has 0 numbers, 2",
     [] { parts([](SurfaceParts& p) { p.input_face.clear(); }); }},
    {"parts_vertex", "InvalidArgument: SurfaceMesh: face 0 has vertex 4, there are 4",
     [] { parts([](SurfaceParts& p) { p.faces(0, 0) = 4; }); }},
    {"parts_quads", "InvalidArgument: SurfaceMesh: faces have 4 columns, 3 are needed",
     [] { parts([](SurfaceParts& p) { p.faces = Cells::Zero(2, 4); }); }},
    {"parts_nan", "InvalidArgument: row 1 of the positions of a SurfaceMesh is not finite",
     [] { parts([](SurfaceParts& p) { p.positions(1, 1) = kNan; }); }},
    {"parts_rest_triangle", "InvalidArgument: SurfaceMesh: the face of a rest triangle 2",
     [] { parts([](SurfaceParts& p) {
            p.rest_triangles.push_back({2, {}});
          }); }},
    {"cut_few_flags", "InvalidArgument: SurfaceMesh::cut_along: is_cut has 3 numbers, 6",
     [] {
       SurfaceMesh::from_arrays(positions(), faces()).cut_along({0, 0, 0}, nullptr);
     }},
    {"cut_one_side", "InvalidArgument: SurfaceMesh::cut_along: half-edge 2 is cut, its opposite 3",
     [] {
       SurfaceMesh::from_arrays(positions(), faces()).cut_along({0, 0, 1, 0, 0, 0}, nullptr);
     }},
    {"other_faces_of_other_vertices", "InvalidArgument: SurfaceMesh: face 0 has vertex 7",
     [] {
       SurfaceMesh::from_arrays(positions(), faces()).with_faces(Cells::Constant(1, 3, 7), {0});
     }},
    {"opposites_of_quads", "InvalidArgument: opposite_half_edges: faces have 4 columns",
     [] { opposite_half_edges(Cells::Zero(1, 4)); }},
    {"opposites_of_a_book", "InvalidArgument: opposite_half_edges: edge (0, 1) has more than two",
     [] { opposite_half_edges((Cells(3, 3) << 0, 1, 2, 1, 0, 3, 0, 1, 4).finished()); }},
    {"repair_index", "InvalidArgument: polygon 1 has vertex 9, there are 4",
     [] { repair(changed([](PolygonMesh& m) { m.polygons[1][2] = 9; })); }},
    {"repair_nan", "InvalidArgument: vertex 1 is at (nan, 0, 0)",
     [] { repair(changed([](PolygonMesh& m) { m.positions[1].x() = kNan; })); }},
    {"repair_nothing", "Error Unsupported: the mesh has no faces", [] { repair(PolygonMesh{}); }},
    {"repair_negative_weld", "InvalidArgument: repair: RepairOptions::weld is -1",
     [] { repair(square(), {.weld = -1.0}); }},
    {"defects_index", "InvalidArgument: polygon 0 has vertex 4",
     [] { find_defects(changed([](PolygonMesh& m) { m.polygons[0][0] = 4; })); }},
    {"seam_half_edge", "InvalidArgument: Seams: half-edge 12 does not exist, there are 6",
     [] {
       Seams(faces(), {0, 1, 2, 3}, {{12, 3, 0}}, {0, 0, 0, 0});
     }},
    {"seam_turns", "InvalidArgument: Seams: turns 4 does not exist, there are 4",
     [] {
       Seams(faces(), {0, 1, 2, 3}, {{2, 3, 4}}, {0, 0, 0, 0});
     }},
    {"seam_vertices", "InvalidArgument: Seams: surface_vertex has fewer numbers",
     [] {
       Seams(faces(), {0}, {{2, 3, 0}}, {0, 0, 0, 0});
     }},
    {"seam_quarter_turns", "InvalidArgument: Seams: vertex 1 does not exist, there are 1",
     [] {
       Seams(faces(), {0, 1, 2, 3}, {{2, 3, 0}}, {0});
     }},
};

}  // namespace mesh_calls

class MeshCalls : public Misuse {};
TEST_P(MeshCalls, IsRefused) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, MeshCalls, testing::ValuesIn(mesh_calls::kCalls), name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
