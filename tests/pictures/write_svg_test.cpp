#include "majorant/pictures/write_svg.h"

#include <algorithm>

#include "io/cube_map.h"
#include "io/io_test_helpers.h"
#include "majorant/io/internal/xml_tree.h"
#include "majorant/pictures/internal/heat_color.h"

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

TEST(HeatColor, RunsFromLightToDark) {
  const auto brightness = [](double t) {
    const unsigned long rgb = std::stoul(heat_color(t).substr(1), nullptr, 16);
    return 0.2126 * static_cast<double>(rgb >> 16) + 0.7152 * static_cast<double>(rgb >> 8 & 255) +
           0.0722 * static_cast<double>(rgb & 255);
  };
  for (int i = 0; i < 20; ++i) EXPECT_GT(brightness(i / 20.0), brightness((i + 1) / 20.0)) << i;
  EXPECT_EQ(heat_color(-1.0), heat_color(0.0));
  EXPECT_EQ(heat_color(7.0), heat_color(1.0));
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
