#include "majorant/pictures/large_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "io/io_test_helpers.h"
#include "majorant/io/map_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {
namespace {

constexpr Index kSide = 24;

Index at(Index i, Index j) { return i * (kSide + 1) + j; }

// A bumpy square with a bent layout, a cut along its middle up to the centre, a seam beside it, and
// a cone at the centre.
MapPage bumpy_page() {
  MapPage page;
  MapFile& map = page.map;
  const Index points = (kSide + 1) * (kSide + 1), cut = kSide / 2;
  map.points.resize(points + cut, 3);
  map.uv.resize(points + cut, 2);
  map.input_vertex.resize(points + cut);
  map.cone = Eigen::VectorXi::Zero(points + cut);
  for (Index i = 0; i <= kSide; ++i)
    for (Index j = 0; j <= kSide; ++j) {
      const double x = static_cast<double>(i) / kSide, y = static_cast<double>(j) / kSide;
      map.points.row(at(i, j)) << x, y, 0.1 * std::sin(7 * x) * std::cos(5 * y);
      map.uv.row(at(i, j)) << x + 0.04 * std::sin(6 * y), y + 0.04 * std::sin(5 * x);
      map.input_vertex[at(i, j)] = at(i, j);
    }
  for (Index j = 0; j < cut; ++j) {  // copies of the points below the centre
    const Index from = at(cut, j);
    map.points.row(points + j) = map.points.row(from);
    map.uv.row(points + j) = map.uv.row(from);
    map.input_vertex[points + j] = from;
  }
  map.cone[at(cut, cut)] = 1;
  map.cells.resize(2 * kSide * kSide, 3);
  map.seam_edges = Cells::Zero(2 * kSide * kSide, 3);
  map.input_face.resize(2 * kSide * kSide);
  Index face = 0;
  for (Index i = 0; i < kSide; ++i)
    for (Index j = 0; j < kSide; ++j) {
      const auto corner = [&](Index a, Index b) {
        return i == cut && a == cut && b < cut ? points + b : at(a, b);
      };
      map.cells.row(face++) << corner(i, j), corner(i + 1, j), corner(i + 1, j + 1);
      map.cells.row(face++) << corner(i, j), corner(i + 1, j + 1), corner(i, j + 1);
      if (i == cut && j < cut) map.seam_edges(face - 1, 2) = 3;
    }
  for (Index f = 0; f < face; ++f) map.input_face[f] = f;
  page.points = {{.vertex = at(5, 7), .target = Vector2(0, 0), .hold = PagePoint::Hold::Pin}};
  page.faults = {{300, "a reason"}};
  page.facts = R"({"command": "parametrize", "result": {"value": 4.5}})";
  page.snapshots = {{0, 1, 5.0, map.uv}};
  return page;
}

double area(const MapFile& map, Index face) {
  const auto uv = [&](Index k) { return Vector2(map.uv.row(map.cells(face, k))); };
  return cross(Vector2(uv(1) - uv(0)), Vector2(uv(2) - uv(0)));
}

std::set<std::pair<Index, Index>> boundary(const MapFile& map) {
  std::set<std::pair<Index, Index>> edges;
  for (Index f = 0; f < map.cells.rows(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const auto vertex = [&](Index c) { return map.input_vertex[map.cells(f, c % 3)]; };
      edges.emplace(vertex(k), vertex(k + 1));
    }
  std::erase_if(edges, [all = edges](const auto& e) { return all.contains({e.second, e.first}); });
  return edges;
}

TEST(LargePage, KeepsOutlinesSeamsAndMarks) {
  const MapPage page = bumpy_page();
  const auto coarser = coarser_page(page, page_bytes(page) / 2);
  ASSERT_TRUE(coarser.has_value());
  const MapFile& map = coarser->map;
  EXPECT_EQ(map_defect(map), "");
  EXPECT_LT(map.cells.rows(), page.map.cells.rows() * 6 / 10);
  EXPECT_GT(map.cells.rows(), page.map.cells.rows() * 3 / 10);
  EXPECT_EQ(boundary(map), boundary(page.map));
  std::multiset<Index> kept, cones;
  for (Index p = 0; p < map.points.rows(); ++p) {
    const Index vertex = map.input_vertex[p];
    kept.insert(vertex);
    EXPECT_EQ(map.points.row(p), page.map.points.row(vertex));
    EXPECT_EQ(map.uv.row(p), page.map.uv.row(vertex));
    EXPECT_EQ(coarser->snapshots[0].uv.row(p), page.map.uv.row(vertex).cast<double>());
    if (map.cone[p] != 0) cones.insert(vertex);
  }
  for (Index j = 0; j < kSide / 2; ++j) EXPECT_EQ(kept.count(at(kSide / 2, j)), 2u);
  EXPECT_EQ(cones, std::multiset<Index>{at(kSide / 2, kSide / 2)});
  EXPECT_TRUE(kept.contains(at(5, 7)));
  Index seams = 0;
  for (Index f = 0; f < map.cells.rows(); ++f) {
    EXPECT_GT(area(map, f), 0);
    for (Index k = 0; k < 3; ++k) {
      if (map.seam_edges(f, k) == 0) continue;
      ++seams;
      EXPECT_EQ(map.seam_edges(f, k), 3);
      EXPECT_EQ(map.input_vertex[map.cells(f, k)], map.input_vertex[map.cells(f, (k + 1) % 3)] + 1);
    }
  }
  EXPECT_EQ(seams, kSide / 2);
  ASSERT_EQ(coarser->faults.size(), 1u);
  for (Index k = 0; k < 3; ++k)
    EXPECT_EQ(map.input_vertex[map.cells(coarser->faults[0].cell, k)],
              page.map.input_vertex[page.map.cells(300, k)]);
  const auto facts = nlohmann::json::parse(coarser->facts);
  EXPECT_EQ(facts["picture"]["faces"], map.cells.rows());
  EXPECT_EQ(facts["picture"]["map_faces"], page.map.cells.rows());
  EXPECT_EQ(facts["result"]["value"], 4.5);
}

// Collapsing the neighbours of a face would invert it in a strongly bent layout.
TEST(LargePage, TurnsNoFaceOver) {
  MapPage page = bumpy_page();
  page.snapshots.clear();
  for (Index p = 0; p < page.map.uv.rows(); ++p) {
    const double x = page.map.points(p, 0), y = page.map.points(p, 1);
    const double turn = 3 * x * x + 3 * y;
    page.map.uv.row(p) << std::exp(x) * std::cos(turn), std::exp(x) * std::sin(turn);
  }
  Index turned = 0;
  for (Index f = 0; f < page.map.cells.rows(); ++f) turned += area(page.map, f) > 0 ? 0 : 1;
  const auto coarser = coarser_page(page, page_bytes(page) / 4);
  ASSERT_TRUE(coarser.has_value());
  EXPECT_LT(coarser->map.cells.rows(), page.map.cells.rows() * 95 / 100);
  Index now = 0;
  for (Index f = 0; f < coarser->map.cells.rows(); ++f) now += area(coarser->map, f) > 0 ? 0 : 1;
  EXPECT_EQ(now, turned);
}

TEST(LargePage, CurvesBecomeStraight) {
  MapPage page;
  page.map = random_strip(3, 6, 3);
  page.facts = "{}";
  const auto coarser = coarser_page(page, page_bytes(page) - 1);
  ASSERT_TRUE(coarser.has_value());
  EXPECT_EQ(coarser->map.degree, 1);
  EXPECT_EQ(coarser->map.cells.rows(), 6);
  const auto picture = nlohmann::json::parse(coarser->facts)["picture"];
  EXPECT_EQ(picture["map_degree"], 3);
}

TEST(LargePage, DoesNotChangeSmallOrPairedPages) {
  MapPage page = bumpy_page();
  const std::size_t bytes = page_bytes(page);
  EXPECT_FALSE(coarser_page(page, bytes));
  MapPage pair = page;
  pair.other = std::make_shared<MapPage>(page);
  EXPECT_FALSE(coarser_page(pair, bytes / 2));
  page.facts = R"({"command": "quads"})";
  EXPECT_FALSE(coarser_page(page, bytes / 2));
  page = bumpy_page();
  page.map.cells.row(1).reverseInPlace();  // an inverted neighbour
  EXPECT_FALSE(coarser_page(page, bytes / 2));
}

// Large pages of both kinds are announced, others are not.
TEST(LargePage, IsAnnounced) {
  const std::string path = ::testing::TempDir() + "large_page.html";
  MapPage page = bumpy_page();
  EXPECT_EQ(write_page_or_coarser(path, page), "");
  ::setenv("MAJORANT_PAGE_BYTES", std::to_string(page_bytes(page) / 2).c_str(), 1);
  const std::string coarser = write_page_or_coarser(path, page);
  page.facts = R"({"command": "quads"})";
  const std::string whole = write_page_or_coarser(path, page);
  ::unsetenv("MAJORANT_PAGE_BYTES");
  EXPECT_TRUE(coarser.starts_with("shows ")) << coarser;
  EXPECT_NE(coarser.find(" of 1,152 faces, since"), std::string::npos) << coarser;
  EXPECT_TRUE(whole.starts_with("browsers are slow")) << whole;
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
