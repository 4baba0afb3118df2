#include "majorant/certify/stacked_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "majorant/certify/map_proof.h"
#include "majorant/io/io.h"
#include "majorant/maps/map_file.h"
#include "mesh/list_edits.h"

namespace majorant {
namespace {

// Returns two quads of a surface with a common edge, and the uv of their corners.
PolygonMesh two_quads(const std::vector<Vector2>& uv) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0.2}, {2, 1, 0}};
  mesh.polygons = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  mesh.texcoords = uv;
  mesh.polygon_texcoords = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  return mesh;
}

const std::vector<Vector2> kFirst{{0.125, 0.25}, {0.5, 0.3}, {0.55, 0.7}, {0.1, 0.6}};

MapFile file_of(const std::vector<Vector2>& second) {
  std::vector<Vector2> uv = kFirst;
  uv.insert(uv.end(), second.begin(), second.end());
  return to_map_file(two_quads(uv));
}

std::vector<Vector2> rotated(std::size_t by) {
  std::vector<Vector2> list;
  for (std::size_t k = 0; k < 4; ++k) list.push_back(kFirst[(k + by) % 4]);
  return list;
}

std::vector<Vector2> reversed() { return {kFirst[1], kFirst[0], kFirst[3], kFirst[2]}; }

ProofStatus verdict(const MapFile& file, ProofRequest::Stacks stacks) {
  ProofRequest request;
  request.cuts = CutRule::Free;
  request.overlap = ProofRequest::Overlap::Forbidden;
  request.stacks = stacks;
  return MapProof(file, "quads", request).verdict();
}

constexpr auto kAllowed = ProofRequest::Stacks::Allowed;
constexpr auto kForbidden = ProofRequest::Stacks::Forbidden;

TEST(StackedCharts, QuadsOnEachOtherHoweverTheyAreDivided) {
  for (std::size_t by = 0; by < 4; ++by) {
    const MapFile file = file_of(rotated(by));
    const StackedCharts found = find_stacks(file, "quads");
    EXPECT_EQ(found.stacks, 1);
    EXPECT_EQ(found.mirrored, 0);
    EXPECT_EQ(found.stack, (std::vector<Index>{0, 0}));
    EXPECT_EQ(found.is_first, (std::vector<char>{1, 0}));
    EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Proven);
    EXPECT_EQ(verdict(file, kForbidden), ProofStatus::Violated);
  }
}

TEST(StackedCharts, MirroredChartsAreTurnedBack) {
  const MapFile file = file_of(reversed());
  const StackedCharts found = find_stacks(file, "quads");
  EXPECT_EQ(found.stacks, 1);
  EXPECT_EQ(found.mirrored, 1);
  EXPECT_EQ(found.is_mirrored, (std::vector<char>{0, 1}));
  const MapFile turned = turned_back(file, found);
  EXPECT_EQ((turned.uv.col(0).array() < 0).count(), 4);
  EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Proven);
  EXPECT_EQ(verdict(file, kForbidden), ProofStatus::Violated);
}

// Both sides of a fold may share points: the surface is reflected at the common edge of the two
// quads.
TEST(StackedCharts, SidesOfAFold) {
  PolygonMesh mesh = two_quads(kFirst);
  mesh.polygon_texcoords = {{0, 1, 2, 3}, {1, 0, 3, 2}};
  const StackedCharts found = find_stacks(to_map_file(mesh), "fold");
  EXPECT_EQ(found.stacks, 1);
  EXPECT_EQ(found.mirrored, 1);
  EXPECT_EQ(verdict(to_map_file(mesh), kAllowed), ProofStatus::Proven);
}

TEST(StackedCharts, OneDigitMakesAnOverlap) {
  for (const auto& second : {rotated(0), reversed()}) {
    std::vector<Vector2> moved = second;
    moved[2].x() = std::nextafter(moved[2].x(), 1);
    const MapFile file = file_of(moved);
    EXPECT_EQ(find_stacks(file, "quads").stacks, 0);
    EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Violated);
  }
}

TEST(StackedCharts, AnInvertedChartWithoutAStackIsNotMirrored) {
  std::vector<Vector2> beside = reversed();
  for (Vector2& p : beside) p.x() += 2;
  const MapFile file = file_of(beside);
  EXPECT_EQ(find_stacks(file, "quads").mirrored, 0);
  EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Violated);
}

// Pieces of a surface at different heights, congruent to their images.
struct Piece {
  std::vector<Vector2> uv;
  std::vector<std::vector<Index>> polygons;
};

PolygonMesh surface_of(const std::vector<Piece>& pieces) {
  PolygonMesh mesh;
  double height = 0;
  for (const Piece& piece : pieces) {
    const auto first = static_cast<Index>(mesh.texcoords.size());
    for (const Vector2& p : piece.uv) {
      mesh.texcoords.push_back(p);
      mesh.positions.emplace_back(p.x(), p.y(), height + 0.1 * p.x() * p.y());
    }
    for (std::vector<Index> polygon : piece.polygons) {
      for (Index& v : polygon) v += first;
      mesh.polygons.push_back(polygon);
      mesh.polygon_texcoords.push_back(polygon);
    }
    height += 100;
  }
  return mesh;
}

std::vector<Vector2> moved(std::vector<Vector2> uv, double u) {
  for (Vector2& p : uv) p.x() += u;
  return uv;
}

ProofStatus verdict_of_quads(const std::vector<std::vector<Vector2>>& quads) {
  std::vector<Piece> pieces;
  for (const std::vector<Vector2>& uv : quads) pieces.push_back({uv, {{0, 1, 2, 3}}});
  return verdict(to_map_file(surface_of(pieces)), kAllowed);
}

// Of stacked charts, one is tested against overlaps with the others.
TEST(StackedCharts, AThirdChartAcrossAStack) {
  EXPECT_EQ(verdict_of_quads({kFirst, kFirst, moved(kFirst, 0.1)}), ProofStatus::Violated);
  EXPECT_EQ(verdict_of_quads({reversed(), kFirst, moved(kFirst, 0.1)}), ProofStatus::Violated);
  EXPECT_EQ(verdict_of_quads({moved(kFirst, 0.1), reversed(), kFirst}), ProofStatus::Violated);
  EXPECT_EQ(verdict_of_quads({reversed(), kFirst, moved(kFirst, 2)}), ProofStatus::Proven);
}

// A reflected chart at u < 0 is reflected back onto another one, which is not an overlap.
TEST(StackedCharts, AChartWhereAMirroredOneIsTurnedBackTo) {
  std::vector<Vector2> across;
  for (const Vector2& p : reversed()) across.emplace_back(3 - p.x(), p.y());
  EXPECT_EQ(verdict_of_quads({moved(reversed(), -3), moved(kFirst, -3), across}),
            ProofStatus::Proven);
}

// The edges of both are those of the ring. The small chart lies in the hole.
TEST(StackedCharts, ARingAndTheSameWithoutItsHole) {
  const std::vector<Vector2> uv{{0, 0}, {9, 0}, {4, 9}, {3, 2}, {5, 2}, {4, 4}};
  Piece ring{uv, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
  Piece filled = ring;
  filled.polygons.push_back({3, 4, 5});
  const Piece small{{{3.75, 2.5}, {4.25, 2.5}, {4, 3}}, {{0, 1, 2}}};
  const MapFile file = to_map_file(surface_of({ring, filled, small}));
  EXPECT_EQ(find_stacks(file, "ring").stacks, 0);
  EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Violated);
  const MapFile rings = to_map_file(surface_of({ring, ring, small}));
  EXPECT_EQ(find_stacks(rings, "rings").stacks, 1);
  EXPECT_EQ(verdict(rings, kAllowed), ProofStatus::Proven);
}

// Two halves of a ring, and two charts that each cover the hole and end at its far side. Edges and
// boundary are equal, but not the polygons.
TEST(StackedCharts, PolygonsOfTheSameEdges) {
  const std::vector<Vector2> uv{{10, 13}, {7, 10}, {10, 7}, {13, 10},   // around: top, left, ...
                                {10, 11}, {9, 10}, {10, 9}, {11, 10}};  // the hole
  const Piece halves{
      uv, {{1, 2, 6}, {1, 6, 5}, {1, 5, 4}, {1, 4, 0}, {3, 0, 4}, {3, 4, 7}, {3, 7, 6}, {3, 6, 2}}};
  const Piece across{
      uv, {{1, 2, 6}, {1, 6, 7}, {1, 7, 4}, {1, 4, 0}, {3, 0, 4}, {3, 4, 5}, {3, 5, 6}, {3, 6, 2}}};
  MapFile file = to_map_file(surface_of({halves, across}));
  for (Index c = 0; c < file.cells.rows(); ++c) file.input_face[c] = c / 4;
  EXPECT_EQ(find_stacks(file, "halves").stacks, 0);
  EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Violated);
}

// Where labelled pieces are not disks, cells are compared: a ring, and one with other triangles.
TEST(StackedCharts, LabelsOfNoDisc) {
  const std::vector<Vector2> uv{{0, 0}, {9, 0}, {4, 9}, {3, 2}, {5, 2}, {4, 4}};
  const Piece ring{uv, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
  const Piece other{uv, {{0, 1, 3}, {1, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
  const auto stacks = [](const std::vector<Piece>& pieces) {
    MapFile file = to_map_file(surface_of(pieces));
    for (Index c = 0; c < file.cells.rows(); ++c) file.input_face[c] = c / 6;
    return find_stacks(file, "rings").stacks;
  };
  EXPECT_EQ(stacks({ring, ring}), 1);
  EXPECT_EQ(stacks({ring, other}), 0);
}

// After reflection at u = 0 the two sides of a fold coincide; each is a chart nevertheless.
TEST(StackedCharts, AFoldAtTheAxis) {
  PolygonMesh mesh;
  mesh.positions = {{-1, 0, 0.3}, {-1, 1, 0.3}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0.3}, {1, 1, 0.3}};
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.polygons = {{0, 2, 3, 1}, {2, 4, 5, 3}};
  mesh.polygon_texcoords = {{1, 0, 3, 2}, {0, 1, 2, 3}};
  const auto with = [&](double u) {
    PolygonMesh all = mesh;
    for (const Vector2& p : std::vector<Vector2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      all.positions.emplace_back(5 + p.x(), p.y(), 0.2 * p.x() * p.y());
      all.texcoords.emplace_back(u + p.x(), 0.25 + 0.5 * p.y());
    }
    all.polygons.push_back({6, 7, 8, 9});
    all.polygon_texcoords.push_back({4, 5, 6, 7});
    return all;
  };
  for (int order = 0; order < 4; ++order) {
    if (order % 2 == 1) {
      swap_lists(mesh.polygons, 0, 1);
      swap_lists(mesh.polygon_texcoords, 0, 1);
    }
    if (order == 2) {  // vertices in reverse order
      for (Index& v : mesh.polygons.indices()) v = 5 - v;
      std::reverse(mesh.positions.begin(), mesh.positions.end());
    }
    EXPECT_EQ(verdict(to_map_file(mesh), kAllowed), ProofStatus::Proven);
    EXPECT_EQ(verdict(to_map_file(with(2)), kAllowed), ProofStatus::Proven);
    EXPECT_EQ(verdict(to_map_file(with(0.5)), kAllowed), ProofStatus::Violated);
  }
}

// Two adjacent quads with shared or equal texture coordinates are one chart. A quad on the first
// one only is not a stack, and the overlap is reported.
TEST(StackedCharts, EqualCoordinatesAreOneChart) {
  PolygonMesh mesh;
  mesh.positions = {{5, 0, 0}, {6, 0, 0}, {6, 1, 0.2}, {5, 1, 0}, {0, 0, 0},
                    {1, 0, 0}, {2, 0, 0}, {0, 1, 0},   {1, 1, 0}, {2, 1, 0.2}};
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}};
  mesh.polygons = {{0, 1, 2, 3}, {4, 5, 8, 7}, {5, 6, 9, 8}};
  mesh.polygon_texcoords = {{0, 1, 2, 3}, {0, 1, 2, 3}, {4, 5, 6, 7}};
  EXPECT_EQ(find_stacks(to_map_file(mesh), "two").stacks, 0);
  EXPECT_EQ(verdict(to_map_file(mesh), kAllowed), ProofStatus::Violated);
  const auto add_quad = [&](double z, const std::vector<Vector2>& uv) {
    const auto v = static_cast<Index>(mesh.positions.size());
    const auto t = static_cast<Index>(mesh.texcoords.size());
    for (const Vector2& p : uv) mesh.positions.emplace_back(p.x(), p.y(), z);
    mesh.texcoords.insert(mesh.texcoords.end(), uv.begin(), uv.end());
    mesh.polygons.push_back({v, v + 1, v + 2, v + 3});
    mesh.polygon_texcoords.push_back({t, t + 1, t + 2, t + 3});
  };
  add_quad(7, {{1.25, 0.25}, {1.75, 0.25}, {1.75, 0.75}, {1.25, 0.75}});
  EXPECT_EQ(verdict(to_map_file(mesh), kAllowed), ProofStatus::Violated);
}

// Quads of different layers may overlap, those of one layer may not.
TEST(StackedCharts, Layers) {
  const std::vector<std::vector<Vector2>> quads{kFirst, moved(kFirst, 0.1), kFirst, kFirst};
  const auto of_layers = [&](std::vector<Index> layers, ProofRequest::Stacks stacks) {
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < layers.size(); ++k) pieces.push_back({quads[k], {{0, 1, 2, 3}}});
    ProofRequest request{.cuts = CutRule::Free, .overlap = ProofRequest::Overlap::Forbidden};
    request.stacks = stacks;
    for (const Index layer : layers) request.layers.insert(request.layers.end(), 2, layer);
    const MapProof proof(to_map_file(surface_of(pieces)), "layers", request);
    EXPECT_EQ(proof.stacks.stacks, 0);
    return proof.verdict();
  };
  EXPECT_EQ(of_layers({0, 0}, kForbidden), ProofStatus::Violated);
  EXPECT_EQ(of_layers({0, 1}, kForbidden), ProofStatus::Proven);
  EXPECT_EQ(of_layers({4, 1, 2}, kForbidden), ProofStatus::Proven);
  EXPECT_EQ(of_layers({1, 4, 4}, kForbidden), ProofStatus::Violated);
  EXPECT_EQ(of_layers({1, 2, 2, 3}, kForbidden), ProofStatus::Violated);
  EXPECT_EQ(of_layers({1, 2, 1}, ProofRequest::Stacks::Allowed), ProofStatus::Violated);
}

// Two squares with separate but equal vertices, also in space, are one piece within a layer and two
// pieces in two layers, where an overlap with the second one is reported.
TEST(StackedCharts, SplitPiecesOfLayers) {
  PolygonMesh mesh;
  for (const double left : {0.0, 1.0, 1.25}) {
    const double height = left == 1.25 ? 7 : 0;
    const auto v = static_cast<Index>(mesh.positions.size());
    for (const Vector2& p : {Vector2(0, 0), Vector2(1, 0), Vector2(1, 1), Vector2(0, 1)}) {
      mesh.texcoords.emplace_back(left + p.x(), p.y());
      mesh.positions.emplace_back(left + p.x(), p.y(), height);
    }
    mesh.polygons.push_back({v, v + 1, v + 2, v + 3});
  }
  mesh.polygon_texcoords = mesh.polygons;
  const auto of_layers = [&](Index first, Index second, Index above) {
    ProofRequest request{.cuts = CutRule::Free, .overlap = ProofRequest::Overlap::Forbidden};
    request.layers = {first, first, second, second, above, above};
    return MapProof(to_map_file(mesh), "split", request).verdict();
  };
  EXPECT_EQ(of_layers(0, 0, 1), ProofStatus::Proven);
  EXPECT_EQ(of_layers(0, 1, 2), ProofStatus::Proven);
  EXPECT_EQ(of_layers(0, 1, 1), ProofStatus::Violated);
  EXPECT_EQ(of_layers(0, 0, 0), ProofStatus::Violated);
  EXPECT_EQ(of_layers(1, 0, 0), ProofStatus::Violated);
}

// Two cells of one quad in two layers: each is a chart.
TEST(StackedCharts, AChartInTwoLayers) {
  const std::vector<Vector2> upper{{0.3, 0.8}, {0.35, 0.8}, {0.35, 0.85}, {0.3, 0.85}};
  ProofRequest request{.cuts = CutRule::Free, .overlap = ProofRequest::Overlap::Forbidden};
  const std::vector<Vector2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const MapFile file = to_map_file(surface_of({{square, {{0, 1, 2, 3}}}, {upper, {{0, 1, 2, 3}}}}));
  const bool first_is_upper =
      file.uv(file.cells(0, 1), 1) + file.uv(file.cells(0, 2), 1) + file.uv(file.cells(0, 0), 1) >
      1.5;
  for (const bool is_with_upper : {true, false}) {
    request.layers = {0, 0, 2, 2};
    request.layers[first_is_upper == is_with_upper ? 0 : 1] = 2;
    EXPECT_EQ(MapProof(file, "two", request).verdict(),
              is_with_upper ? ProofStatus::Violated : ProofStatus::Proven);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
