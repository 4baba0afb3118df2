#include "majorant/certify/internal/face_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "majorant/mesh/repair.h"
#include "mesh/list_edits.h"

namespace majorant {
namespace {

// Returns a tetrahedron, oriented outwards.
PolygonMesh four_triangles() {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.polygons = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

PolygonMesh with_a_fin() {
  PolygonMesh mesh = four_triangles();
  mesh.positions.emplace_back(2, -1, 0);
  mesh.polygons.push_back({0, 1, 4});
  return mesh;
}

// Returns two curved quads of opposite orientations.
PolygonMesh turned_quads() {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0.5}, {0, 1, 0}, {1, 1, 0.25}, {2, 1, 0}};
  mesh.polygons = {{0, 1, 4, 3}, {1, 4, 5, 2}};
  return mesh;
}

PolygonMesh soup() {
  const PolygonMesh mesh = four_triangles();
  PolygonMesh out;
  for (const auto& polygon : mesh.polygons) {
    std::vector<Index> corners;
    for (const Index v : polygon) {
      corners.push_back(static_cast<Index>(out.positions.size()));
      out.positions.push_back(mesh.positions[v]);
    }
    out.polygons.push_back(corners);
  }
  return out;
}

// The surface in a file: triangles over its vertices, with the polygon of each.
struct Written {
  PolygonMesh cells;
  std::vector<Index> face;
};

Written written(const PolygonMesh& surface) {
  const RepairedSurface repaired = repair(surface);
  const SurfaceMesh& mesh = *repaired.mesh;
  Written out;
  out.cells.positions = surface.positions;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](Index k) { return mesh.input_vertex(mesh.faces()(f, k)); };
    out.cells.polygons.push_back({corner(0), corner(1), corner(2)});
    out.face.push_back(mesh.input_face(f));
  }
  return out;
}

std::optional<SurfaceMatch> match(const Written& file, const PolygonMesh& surface) {
  const RepairedSurface cells =
      repair(file.cells, {.orientation = Orientation::AsGiven, .numerics = Numerics::AsGiven});
  return match_faces({*cells.mesh, file.face}, surface, Orientation::MadeConsistent);
}

std::string defect(const Written& file, const PolygonMesh& surface) {
  return match(file, surface).value().defect;
}

// Files without the faces of their cells, in any order of cells.
TEST(FaceMatch, FacesAreFoundByTheirCorners) {
  PolygonMesh twice = turned_quads();
  twice.polygons.push_back({0, 1, 4, 3});
  twice.polygons.push_back({0, 1, 4});
  for (const PolygonMesh& surface : {with_a_fin(), turned_quads(), soup(), twice}) {
    Written file = written(surface);
    file.face.clear();
    EXPECT_EQ(defect(file, surface), "");
    change_lists(file.cells.polygons, [](auto& all) { std::reverse(all.begin(), all.end()); });
    EXPECT_EQ(defect(file, surface), "");
    Written less = file;
    less.cells.polygons.resize(less.cells.polygons.size() - 1);
    EXPECT_NE(defect(less, surface), "");
    Written other = file;
    change_lists(other.cells.polygons, [](auto& all) { all.back() = all.front(); });
    EXPECT_NE(defect(other, surface), "");
  }
  // the other diagonal of the first quad, on the right side
  Written bent = written(turned_quads());
  bent.face.clear();
  set_list(bent.cells.polygons, 0, {0, 1, 3});
  set_list(bent.cells.polygons, 1, {1, 4, 3});
  EXPECT_EQ(defect(bent, turned_quads()), "");
  std::swap(bent.cells.polygons[1][0], bent.cells.polygons[1][1]);
  EXPECT_NE(defect(bent, turned_quads()), "");
}

TEST(FaceMatch, RepairedSurfacesMatchTheirFiles) {
  for (const PolygonMesh& surface : {with_a_fin(), turned_quads(), soup()}) {
    const Written file = written(surface);
    EXPECT_EQ(defect(file, surface), "");
    EXPECT_EQ(match(file, surface)->same, static_cast<Index>(surface.polygons.size()));
  }
  PolygonMesh flipped = four_triangles();
  std::swap(flipped.polygons[2][0], flipped.polygons[2][1]);
  EXPECT_EQ(defect(written(flipped), flipped), "");
  PolygonMesh twice = four_triangles();
  twice.polygons.push_back(twice.polygons[1]);
  twice.polygons.push_back({0, 1, 1});  // and a repeated vertex
  EXPECT_EQ(defect(written(twice), twice), "");
}

TEST(FaceMatch, OpenSurfacesWithoutDefectsAreLeftOut) {
  const PolygonMesh surface = four_triangles();
  EXPECT_EQ(defect(written(surface), surface), "");
  PolygonMesh open = surface;
  open.polygons = {{0, 1, 2}};
  EXPECT_FALSE(match(written(open), surface).has_value());
}

TEST(FaceMatch, CoincidentVerticesAreOnePlace) {
  const PolygonMesh surface = soup();
  Written file = written(surface);
  file.cells.polygons = surface.polygons;  // as in an OBJ
  EXPECT_EQ(defect(file, surface), "");
}

TEST(FaceMatch, AnyValidDiagonalIsAccepted) {
  const PolygonMesh surface = turned_quads();
  Written file = written(surface);
  ASSERT_EQ(file.face, (std::vector<Index>{0, 0, 1, 1}));
  const std::vector<std::vector<Index>> one = {{0, 1, 4}, {0, 4, 3}},
                                        other = {{0, 1, 3}, {1, 4, 3}};
  for (const auto& cells : {one, other}) {
    for (std::size_t c = 0; c < 2; ++c) set_list(file.cells.polygons, c, cells[c]);
    EXPECT_EQ(defect(file, surface), "");
  }
  set_list(file.cells.polygons, 1, one[1]);  // both cells are this one, and a corner has none
  EXPECT_NE(defect(file, surface).find("face 0 is mapped by cells"), std::string::npos);
  set_list(file.cells.polygons, 0, one[1]);
  EXPECT_NE(defect(file, surface), "");
}

// Every triangle in four pieces, as in formats without curves. New vertices at midpoints of edges
// belong to one triangle, or are shared along edges.
enum class Middles { Shared, Own };
PolygonMesh in_pieces(const PolygonMesh& cells, Middles middles) {
  PolygonMesh out;
  out.positions = cells.positions;
  std::map<std::pair<Index, Index>, Index> known;
  for (const auto& cell : cells.polygons) {
    if (middles == Middles::Own) known.clear();
    std::array<Index, 3> middle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = cell[k], b = cell[(k + 1) % 3];
      const auto [entry, is_new] =
          known.emplace(std::minmax(a, b), static_cast<Index>(out.positions.size()));
      if (is_new) out.positions.emplace_back((cells.positions[a] + cells.positions[b]) / 2);
      middle[k] = entry->second;
    }
    out.polygons.push_back({middle[0], middle[1], middle[2]});
    for (std::size_t k = 0; k < 3; ++k)
      out.polygons.push_back({cell[k], middle[k], middle[(k + 2) % 3]});
  }
  return out;
}

TEST(FaceMatch, PiecesOfFaces) {
  PolygonMesh twice = four_triangles();
  twice.polygons.push_back(twice.polygons[1]);
  PolygonMesh bow_tie;
  bow_tie.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0}};
  bow_tie.polygons = {{5, 1, 2}, {0, 3, 4}, {0, 3, 1}};
  for (const PolygonMesh& surface : {with_a_fin(), soup(), twice, bow_tie})
    for (const Middles middles : {Middles::Shared, Middles::Own}) {
      const PolygonMesh cells = in_pieces(written(surface).cells, middles);
      EXPECT_EQ(defect({cells, {}}, surface), "");
      EXPECT_EQ(match({cells, {}}, surface)->changed, static_cast<Index>(surface.polygons.size()));
      PolygonMesh bad = cells;
      bad.polygons.resize(cells.polygons.size() - 1);
      EXPECT_NE(defect({bad, {}}, surface), "");  // one is missing
      bad.polygons.push_back(bad.polygons[0]);
      EXPECT_NE(defect({bad, {}}, surface), "");  // another one occurs twice
      bad = cells;
      std::swap(bad.polygons[1][1], bad.polygons[1][2]);
      EXPECT_NE(defect({bad, {}}, surface), "");  // inverted
      bad = cells;
      bad.positions.back() += Vector3(1e-6, 2e-6, 3e-6);
      EXPECT_NE(defect({bad, {}}, surface), "");  // beside its edge
      bad = cells;
      bad.polygons.push_back({0, 1, 2});
      EXPECT_NE(defect({bad, {}}, surface), "");  // one too many
    }
}

TEST(FaceMatch, FacesThatDisagreeAsTheyAreGiven) {
  PolygonMesh surface = four_triangles();
  std::swap(surface.polygons[2][0], surface.polygons[2][1]);
  const RepairedSurface cells =
      repair(surface, {.orientation = Orientation::AsGiven, .numerics = Numerics::AsGiven});
  const ShownCells shown{*cells.mesh};
  EXPECT_NE(match_faces(shown, surface, Orientation::MadeConsistent)->defect, "");
  EXPECT_EQ(match_faces(shown, surface, Orientation::AsGiven)->defect, "");
}

TEST(FaceMatch, DefectsAreNamed) {
  const PolygonMesh surface = with_a_fin();
  const Written good = written(surface);
  const auto says = [&](const Written& file) { return defect(file, surface); };
  Written bad = good;
  bad.cells.polygons.resize(bad.cells.polygons.size() - 1);
  bad.face.pop_back();
  EXPECT_EQ(says(bad), "face 4 of the surface has 0 cells instead of 1");
  bad = good;
  bad.cells.positions[4].z() += 1e-6;
  EXPECT_EQ(says(bad), "vertex 4 is not where the surface has it");
  bad = good;
  std::swap(bad.cells.polygons[4][0], bad.cells.polygons[4][1]);
  EXPECT_EQ(says(bad), "face 4 is mapped by cells that are not its own, or turned over");
  bad = good;
  std::swap(bad.face[0], bad.face[3]);
  EXPECT_EQ(says(bad), "face 0 is mapped by cells that are not its own, or turned over");
  bad = good;
  bad.face[4] = 7;
  EXPECT_EQ(says(bad), "the surface has no face 7");
  bad = good;
  bad.cells.positions.push_back(bad.cells.positions[4]);
  set_list(bad.cells.polygons, 4, {0, 1, 5});
  EXPECT_EQ(says(bad), "the surface has no vertex 5");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
