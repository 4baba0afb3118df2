#include "majorant/certify/stacked_charts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "majorant/certify/map_proof.h"
#include "majorant/io/io.h"
#include "majorant/parametrization/maps/map_file.h"

namespace majorant {
namespace {

// Two quads in a row on the surface that share an edge, and uv of their corners.
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

TEST(StackedCharts, MirroredOnesAreTurnedBack) {
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

// Points of a fold may be shared: the surface mirrored at the edge of the two quads.
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

TEST(StackedCharts, TurnedOverAloneIsNotMirrored) {
  std::vector<Vector2> beside = reversed();
  for (Vector2& p : beside) p.x() += 2;
  const MapFile file = file_of(beside);
  EXPECT_EQ(find_stacks(file, "quads").mirrored, 0);
  EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Violated);
}

// Of charts that lie on each other the lowest must keep off the others.
TEST(StackedCharts, AThirdChartAcrossAStack) {
  PolygonMesh mesh = two_quads(kFirst);
  for (const Vector2& p : kFirst) mesh.texcoords.push_back(p);
  for (const Vector2& p : kFirst) mesh.texcoords.emplace_back(p.x() + 0.1, p.y());
  for (const Vector3& p : std::vector<Vector3>(mesh.positions))
    mesh.positions.emplace_back(p.x(), p.y(), p.z() + 5);
  mesh.polygons.push_back({6, 7, 10, 9});
  mesh.polygon_texcoords.push_back({8, 9, 10, 11});
  const MapFile file = to_map_file(mesh);
  EXPECT_EQ(find_stacks(file, "three").stacks, 1);
  EXPECT_EQ(verdict(file, kAllowed), ProofStatus::Violated);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
