#include <cstring>
#include <nlohmann/json.hpp>

#include "io/cube_map.h"
#include "io/io_test_helpers.h"
#include "majorant/io/base64.h"
#include "majorant/io/layout_scale.h"
#include "majorant/pictures/internal/page_data.h"
#include "majorant/pictures/page_text.h"
#include "majorant/pictures/pictures.h"

namespace majorant {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::vector<T> array_of(const Json& base64) {
  const std::string bytes = decode_base64(base64.get<std::string>()).value();
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t start = text.find(open) + open.size();
  return text.substr(start, text.find(close, start) - start);
}

MapPage strip_page(int degree) {
  MapPage page;
  page.title = "strip.obj";
  page.map = random_strip(degree, 6, 3);
  page.map.input_vertex = Eigen::VectorXi::LinSpaced(page.map.points.rows(), 0,
                                                     static_cast<int>(page.map.points.rows()) - 1);
  return page;
}

TEST(WritePage, HoldsTheMapExactly) {
  for (int degree = 1; degree <= 8; ++degree) {
    const MapPage page = strip_page(degree);
    const MapFile& map = page.map;
    const Json data = page_data(page);
    const auto uv = array_of<double>(data["uv"]);
    const auto positions = array_of<double>(data["positions"]);
    const auto cells = array_of<std::uint32_t>(data["cells"]);
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(map.cells.size()));
    EXPECT_EQ(positions.size(), 3 * data["corners"].get<std::size_t>());
    const auto multi_indices = bezier_multi_indices(degree);
    for (Index cell = 0; cell < map.cells.rows(); ++cell)
      for (std::size_t local = 0; local < multi_indices.size(); ++local) {
        const auto& [i, j, k] = multi_indices[local];
        const int row = degree - i;
        const std::size_t place =
            to_size(cell) * multi_indices.size() + to_size(row * (row + 1) / 2 + k);
        const Index point = map.cells(cell, static_cast<Index>(local));
        for (std::size_t d = 0; d < 2; ++d)
          EXPECT_EQ(uv[2 * cells[place] + d], map.uv(point, static_cast<Index>(d)));
        if (local >= 3) continue;
        for (std::size_t d = 0; d < 3; ++d)
          EXPECT_EQ(positions[3 * cells[place] + d], map.points(point, static_cast<Index>(d)));
      }
  }
}

TEST(WritePage, NamesScalesAndTheLayoutsScale) {
  MapPage page = strip_page(2);
  page.map.claims.clear();
  Json data = page_data(page);
  EXPECT_EQ(data["scale"]["assumed"], true);
  EXPECT_EQ(data["scale"]["value"], layout_scale(page.map));
  EXPECT_EQ(data["scales"].size(), 4u);
  page.map.claims = R"({"energy": "symmetric-dirichlet + 0.1*asap"})";
  data = page_data(page);
  EXPECT_EQ(data["scale"]["assumed"], false);
  ASSERT_EQ(data["scales"].size(), 5u);
  EXPECT_EQ(data["scales"][0]["name"], "density");
  EXPECT_EQ(data["scales"][0]["neutral"], 4.0);
  EXPECT_EQ(array_of<std::uint8_t>(data["scales"][0]["colors"]).size(), 768u);
  EXPECT_EQ(data["scales"][0]["ticks"][0]["label"], "4");
}

TEST(WritePage, PointsAreDrawnAtEveryCopy) {
  MapPage page;
  page.map = to_map_file(cube_map(2));
  page.points = {{.vertex = 0, .target = Vector2(1, 2), .hold = PagePoint::Hold::Handle}};
  const Json data = page_data(page);
  const auto vertices = array_of<std::int32_t>(data["input_vertex"]);
  EXPECT_EQ(data["points"][0]["corners"].size(),
            static_cast<std::size_t>(std::count(vertices.begin(), vertices.end(), 0)));
  EXPECT_GT(data["points"][0]["corners"].size(), 1u);
  EXPECT_EQ(data["points"][0]["hold"], "handle");
  EXPECT_EQ(data["cones"].size(), 24u);
  EXPECT_EQ(array_of<std::int32_t>(data["seam_edges"]).size(), 3 * 48u);
}

TEST(WritePage, SnapshotsFollowTheNumberingOfThePage) {
  MapPage page = strip_page(3);
  page.snapshots = {{.iteration = 4, .degree = 1, .energy = 5.5, .uv = 2 * page.map.uv}};
  const Json data = page_data(page);
  const auto uv = array_of<double>(data["uv"]);
  const auto then = array_of<float>(data["snapshots"][0]["uv"]);
  ASSERT_EQ(then.size(), uv.size());
  for (std::size_t k = 0; k < uv.size(); ++k) EXPECT_EQ(then[k], static_cast<float>(2 * uv[k]));
  EXPECT_EQ(data["snapshots"][0]["iteration"], 4);
}

TEST(WritePage, RefusesDataOfAnotherMap) {
  const TemporaryFolder folder;
  const auto refused = [&](const auto& change) {
    MapPage page = strip_page(2);
    change(page);
    return error_message(ErrorKind::Invalid, [&] { write_page(folder.file("a.html"), page); });
  };
  const auto mentions = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  EXPECT_TRUE(mentions(refused([](MapPage& p) { p.faults = {{6, "no"}}; }), "cell 6"));
  EXPECT_TRUE(
      mentions(refused([](MapPage& p) { p.points = {{.vertex = 999, .target = Vector2(0, 0)}}; }),
               "vertex 999"));
  EXPECT_TRUE(mentions(refused([](MapPage& p) { p.snapshots.resize(1); }), "snapshot"));
  EXPECT_TRUE(mentions(refused([](MapPage& p) { p.facts = "[1]"; }), "JSON object"));
  EXPECT_TRUE(mentions(refused([](MapPage& p) { p.map = random_strip(9, 2, 3); }), "degree 9"));
  refused([](MapPage& p) { p.map.uv(0, 0) = std::nan(""); });
  EXPECT_EQ(entries(folder), 0u);
}

TEST(WritePage, TextsNeverBecomeMarkup) {
  const TemporaryFolder folder;
  const std::string hostile = "</script><script>alert(1)</script>{{data}}\xff\"&<b>";
  MapPage page = strip_page(1);
  page.title = hostile;
  page.faults = {{2, hostile}};
  page.facts = Json{{"message", "</script><!--<script>"}}.dump();
  write_page(folder.file("a.html"), page);
  const std::string text = content_of(folder.file("a.html"));
  EXPECT_EQ(between(text, "<title>", "</title>"), html_text(hostile));
  EXPECT_EQ(html_text("a<b>&\"\xff"), "a&lt;b&gt;&amp;&quot;\ufffd");
  const std::string json = between(text, "id=\"data\">", "</script>");
  const Json data = Json::parse(json);
  EXPECT_EQ(data["faults"][0]["text"], "</script><script>alert(1)</script>{{data}}\ufffd\"&<b>");
  EXPECT_EQ(data["facts"]["message"], "</script><!--<script>");
  // The page consists of two scripts and loads nothing.
  std::size_t scripts = 0;
  for (std::size_t p = text.find("<script"); p != std::string::npos;
       p = text.find("<script", p + 1))
    ++scripts;
  EXPECT_EQ(scripts, 2u);
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
}

TEST(WritePage, IsSmallEnough) {
  const TemporaryFolder folder;
  MapPage page;
  page.map = random_strip(3, 10000, 3);
  write_page(folder.file("a.html"), page);
  EXPECT_LT(content_of(folder.file("a.html")).size(), 3u << 20);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
