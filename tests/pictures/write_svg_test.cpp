#include <Eigen/Geometry>
#include <algorithm>

#include "io/cube_map.h"
#include "io/io_test_helpers.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/io/xml_tree.h"
#include "majorant/parametrization/maps/bezier_cell.h"
#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/pictures.h"

namespace majorant {
namespace {

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t result = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) {
    ++result;
  }
  return result;
}

TEST(WriteSvg, OnePathPerCellWithItsCurves) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 8; ++degree) {
    const MapFile map = random_strip(degree, 6, 3);
    write_svg(folder.file("a.svg"), map);
    write_svg(folder.file("b.svg"), map);
    const std::string text = content_of(folder.file("a.svg"));
    EXPECT_EQ(text, content_of(folder.file("b.svg")));
    EXPECT_EQ(parse_xml("a.svg", text).name, "svg");
    EXPECT_EQ(count(text, "<path"), 6u);
    const std::string outline = text.substr(text.find("d=\"M") + 3);
    const std::string first = outline.substr(0, outline.find('Z'));
    const auto letters = [&](char c) { return std::count(first.begin(), first.end(), c); };
    EXPECT_EQ(letters('L'), degree == 1 ? 3 : 0);
    EXPECT_EQ(letters('Q'), degree == 2 ? 3 : 0);
    EXPECT_EQ(letters('C'), degree < 3 ? 0 : degree == 3 ? 3 : 12);
  }
}

TEST(WriteSvg, PlacesTheLayoutWithTheVAxisUp) {
  const TemporaryFolder folder;
  MapFile map = random_strip(1, 1, 3);
  map.uv << 0, 0, 2, 0, 0, 1;
  map.distortion.resize(0);
  write_svg(folder.file("a.svg"), map);
  const std::string text = content_of(folder.file("a.svg"));
  EXPECT_NE(text.find("viewBox=\"0 0 1000 510\""), std::string::npos) << text;
  EXPECT_NE(text.find("d=\"M10,500L990,500L10,10L10,500Z\""), std::string::npos) << text;
}

TEST(WriteSvg, ChartsHaveOutlinesInTheirColours) {
  const TemporaryFolder folder;
  MapFile map = random_strip(2, 4, 3);  // a strip: cells share an edge with the next one
  const auto drawn = [&] {
    write_svg(folder.file("a.svg"), map);
    return content_of(folder.file("a.svg"));
  };
  const std::string plain = drawn();
  map.chart = Eigen::Vector4i(3, 3, 3, 3);
  EXPECT_EQ(drawn(), plain);
  map.chart = Eigen::Vector4i(0, 0, 1, 1);
  const std::string text = drawn();
  EXPECT_EQ(count(text, "<path"), 4u + 2u);
  EXPECT_EQ(count(text, "<path fill="), 4u);
  const std::string outlines = text.substr(text.find("<path stroke="));
  const std::string first = outlines.substr(0, outlines.find("/>"));
  EXPECT_EQ(count(first, "M"), 4u);  // two cells less their common edge, twice
  EXPECT_EQ(count(text, "fill-opacity"), 0u);
  map.distortion.resize(0);
  EXPECT_EQ(count(drawn(), "fill-opacity"), 1u);
  EXPECT_EQ(count(drawn(), "#dddddd"), 0u);
}

TEST(WriteSvg, ExtremeLayoutsGiveNumbers) {
  const TemporaryFolder folder;
  MapFile map = random_strip(4, 2, 3);
  for (const double scale : {1e308, 1e-300, 0.0}) {
    MapFile scaled = map;
    scaled.uv *= scale;
    write_svg(folder.file("a.svg"), scaled);
    const std::string text = content_of(folder.file("a.svg"));
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
  }
  map.uv(0, 0) = std::nan("");
  error_message(ErrorKind::Invalid, [&] { write_svg(folder.file("b.svg"), map); });
}

// Two triangles, the first of density `first`.
MapFile two_triangles(double first) {
  MapFile map = random_strip(1, 2, 3);
  map.uv << 0, 0, 2, 0, 0, 1, 2, 1;
  map.distortion = Vec::Constant(2, first);
  map.distortion[1] = 5;
  map.claims = R"({"energy": "symmetric-dirichlet", "pins": [], "seams": false,
                   "boundary": "free", "init": "tutte", "options": {"handles": ""}})";
  return map;
}

std::string drawing_of(const MapFile& map, const SvgOptions& options = {}) {
  const TemporaryFolder folder;
  write_svg(folder.file("a.svg"), map, options);
  return content_of(folder.file("a.svg"));
}

// The colours of the cells, in order.
std::vector<std::string> fills(const std::string& text) {
  std::vector<std::string> result;
  for (std::size_t at = text.find("<path fill=\"#"); at != std::string::npos;
       at = text.find("<path fill=\"#", at + 1))
    result.push_back(text.substr(at + 12, 7));
  return result;
}

TEST(WriteSvg, ADensityHasOneColourInAllMaps) {
  const ColorScale scale = color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}});
  for (const double first : {4.0, 4.003, 12.0, 39.0, 400.0}) {
    const std::string text = drawing_of(two_triangles(first));
    EXPECT_EQ(fills(text), (std::vector{scale.color(first).hex(), scale.color(5).hex()}));
    expect_contains(text, {">symmetric-dirichlet density, degree 1<", ">isometry 4; smallest ",
                           ">4</text>", ">40</text>", "<rect width=\"1000\""});
    EXPECT_EQ(count(text, "1 of 2 triangle means above 40"), first > 40 ? 1u : 0u);
    EXPECT_EQ(count(text, "<polygon"), first > 40 ? 1u : 0u);
  }
  const std::string ranged = drawing_of(two_triangles(5.5), {.color_range = ColorRange{4.5, 5}});
  expect_contains(ranged, {">4.5</text>", ">5</text>", "1 of 2 triangle means above 5<"});
  EXPECT_EQ(fills(ranged), (std::vector(2, scale.colors().back().hex())));
  expect_contains(error_message(ErrorKind::Usage,
                                [] {
                                  drawing_of(two_triangles(4), {.color_range = ColorRange{3, 5}});
                                }),
                  {"the color range: ", "4 at isometry"});
}

TEST(WriteSvg, EveryQuantityHasItsScale) {
  MapFile map = two_triangles(4);
  map.face_distortion.resize(2, 6);
  map.face_distortion.row(0) << 2, 0.5, 1.25, 4, 2, 2;
  map.face_distortion.row(1) << 3, -1, -2, 9, 9, 9;  // turned over
  for (const auto& [quantity, value] : {std::pair{Quantity::SigmaMax, 2.0},
                                        {Quantity::SigmaMin, 0.5},
                                        {Quantity::Area, 1.25},
                                        {Quantity::Angle, 4.0}}) {
    const ColorScale scale = color_scale(quantity, {});
    const std::string text = drawing_of(map, {.quantity = quantity});
    EXPECT_EQ(fills(text), (std::vector{scale.color(value).hex(), kFlippedColor.hex()}));
    expect_contains(text, {fmt::format(">{}, degree 1<", scale.label())});
  }
  EXPECT_EQ(drawing_of(map, {.quantity = Quantity::Density}), drawing_of(map));
  map.face_distortion.resize(0, 6);  // measured where the file does not say
  EXPECT_EQ(fills(drawing_of(map, {.quantity = Quantity::Area})).size(), 2u);
  map.distortion.resize(0);
  expect_contains(
      error_message(ErrorKind::Usage, [&] { drawing_of(map, {.quantity = Quantity::Density}); }),
      {"no density"});
}

// Not the means that are drawn: what reports have, of the whole map.
TEST(WriteSvg, LargestIsThatOfTheMap) {
  for (const int degree : {1, 2, 3, 5}) {
    MapFile map = random_strip(degree, 1, 3);
    map.points.col(2).setZero();
    map.points.col(0) = map.uv.col(0);
    map.points.col(1) = map.uv.col(1);
    // (u, v) -> (u, v + u^2 / 2) bends the middle of a flat triangle.
    const auto& indices = bezier_multi_indices(degree);
    for (Index l = 0; l < map.cells.cols(); ++l) {
      const auto [i, j, k] = indices[l];
      const double u = double(j) / degree, v = double(k) / degree;
      map.points.row(map.cells(0, l)) << u, v, 0;
      const double bent = degree > 1 ? 0.5 * j * (j - 1) / degree / (degree - 1) : 0;
      map.uv.row(map.cells(0, l)) << u, v + bent;
    }
    map.distortion = Vec::Constant(1, 4.5);
    map.claims = R"({"energy": "symmetric-dirichlet"})";
    const std::string text = drawing_of(map);
    // J = (1 0; u 1): |J|^2 + |J^-1|^2 = 4 + 2 u^2, u from 0 to 1.
    expect_contains(text, {degree == 1 ? "smallest 4, largest 4<"
                                       : "smallest 4, largest 6 (45 points a face)<"});
  }
}

TEST(WriteSvg, WithoutAnEnergyThereIsNoScale) {
  MapFile map = two_triangles(4);
  for (const char* claims : {"", "{", "[]", R"({"energy": 3})", R"({"energy": "unknown"})"}) {
    map.claims = claims;
    EXPECT_EQ(fills(drawing_of(map)), (std::vector<std::string>(2, "#dddddd"))) << claims;
  }
}

TEST(WriteSvg, LayoutsThatNothingHoldsLieAlongTheirLongerSide) {
  MapFile map = two_triangles(4);
  const std::string lying = drawing_of(map, {.alignment = Alignment::Never});
  const Eigen::Rotation2Dd turn(1.0);
  for (Index k = 0; k < 4; ++k) map.uv.row(k) = (turn * Vector2(map.uv.row(k))).transpose();
  const auto height = [](const std::string& text) { return text.substr(text.find("viewBox"), 30); };
  EXPECT_EQ(height(drawing_of(map)), height(lying));
  EXPECT_NE(height(drawing_of(map, {.alignment = Alignment::Never})), height(lying));
  const std::string free = map.claims;
  for (const auto& [what, held] :
       {std::pair{R"("pins": [])", R"("pins": [{"vertex": 1, "target": [0, 0]}])"},
        std::pair{R"("seams": false)", R"("seams": true)"},
        std::pair{R"("handles": "")", R"("handles": "points.json")"},
        std::pair{R"("free")", R"("fixed")"}, std::pair{R"("tutte")", R"("planar")"}}) {
    map.claims = free;
    map.claims.replace(free.find(what), std::string(what).size(), held);
    EXPECT_NE(height(drawing_of(map)), height(lying)) << held;
    EXPECT_EQ(height(drawing_of(map, {.alignment = Alignment::Always})), height(lying)) << held;
  }
  map.claims = free;
  const std::string with_grid = drawing_of(map, {.grid = 1.0});
  EXPECT_EQ(with_grid.substr(with_grid.find("viewBox"), 15), height(lying).substr(0, 15));
}

TEST(WriteSvg, ChartsHaveTheirNumbers) {
  MapFile map = random_strip(2, 4, 3);
  map.chart = Eigen::Vector4i(3, 3, 17, 17);
  const std::string text = drawing_of(map);
  EXPECT_EQ(count(text, ">3</text>"), 1u);
  EXPECT_EQ(count(text, ">17</text>"), 1u);
}

TEST(WriteSvg, MarksSeamsConesAndGrid) {
  const TemporaryFolder folder;
  const MapFile file = to_map_file(cube_map(2));
  write_svg(folder.file("a.svg"), file);
  std::string text = content_of(folder.file("a.svg"));
  const auto count = [&](const std::string& piece) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  EXPECT_EQ(count("<circle"), 24u + 1u);  // every copy, and the legend's
  EXPECT_EQ(count("stroke-linecap"), 1u);
  EXPECT_EQ(count("<path"), 48u + 12u + 1u);
  EXPECT_EQ(count("clip-path"), 0u);
  write_svg(folder.file("a.svg"), file, {.grid = 1.0});
  text = content_of(folder.file("a.svg"));
  EXPECT_EQ(count("clip-path=\"url(#layout)\""), 1u);
  EXPECT_EQ(count("grid 1<"), 1u);
  const std::size_t start = text.find("<clipPath");
  const std::string clip = text.substr(start, text.find("</clipPath>") - start);
  EXPECT_EQ(std::count(clip.begin(), clip.end(), 'Z'), 6);  // charts
  for (const double wrong : {-1.0, 1e-6, std::nan("")})
    error_message(ErrorKind::Usage,
                  [&] { write_svg(folder.file("b.svg"), file, {.grid = wrong}); });
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
