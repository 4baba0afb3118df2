#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/cube_map.h"
#include "io/io_test_helpers.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/io/xml_tree.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/internal/letters.h"
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

// Returns the texts of the paths, in order: d="...".
std::vector<std::string> paths_of(const std::string& text, const std::string& begin = "<path") {
  std::vector<std::string> paths;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t from = text.find(" d=\"", at) + 4;
    paths.push_back(text.substr(from, text.find('"', from) - from));
  }
  return paths;
}

// Returns the number of parts of a path.
std::size_t parts_of(const std::string& path) { return count(path, "M") + count(path, "m"); }

// Returns the commands of a path, each with its number of arguments.
std::vector<std::pair<char, int>> verbs_of(const std::string& path) {
  std::vector<std::pair<char, int>> verbs;
  bool is_in_number = false;
  for (const char c : path) {
    const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (is_letter) verbs.emplace_back(c, 0);
    const bool begins = c == '-' || (c != ' ' && !is_letter && !is_in_number);
    if (begins) ++verbs.back().second;
    is_in_number = c != ' ' && !is_letter;
  }
  return verbs;
}

TEST(WriteSvg, OnePartPerCellWithItsCurves) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 8; ++degree) {
    const MapFile map = random_strip(degree, 6, 3);
    write_svg(folder.file("a.svg"), map);
    write_svg(folder.file("b.svg"), map);
    const std::string text = content_of(folder.file("a.svg"));
    EXPECT_EQ(text, content_of(folder.file("b.svg")));
    EXPECT_EQ(parse_xml("a.svg", text).name, "svg");
    std::size_t cells = 0;  // paths that are filled and stroked
    for (std::size_t at = text.find("<path fill"); at != std::string::npos;
         at = text.find("<path fill", at + 1)) {
      const std::string path = text.substr(at, text.find("/>", at) - at);
      if (count(path, "stroke=") > 0) cells += parts_of(path.substr(path.find(" d=")));
    }
    EXPECT_EQ(cells, 6u);
    const auto verbs = verbs_of(paths_of(text)[0]);
    ASSERT_GE(verbs.size(), 3u);
    EXPECT_EQ(verbs[0], (std::pair{'M', 2}));
    EXPECT_EQ(verbs[1], degree == 1   ? (std::pair{'l', 4})
                        : degree == 2 ? (std::pair{'q', 12})
                        : degree == 3 ? (std::pair{'c', 18})
                                      : (std::pair{'c', 72}));
    EXPECT_EQ(verbs[2], (std::pair{'z', 0}));
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
  EXPECT_NE(text.find("d=\"M10 500l980 0-980-490z\""), std::string::npos) << text;
}

TEST(WriteSvg, ChartsHaveOutlinesInTheirColours) {
  const TemporaryFolder folder;
  MapFile map = random_strip(2, 4, 3);  // a strip: each cell shares an edge with the next one
  const auto drawn = [&] {
    write_svg(folder.file("a.svg"), map);
    return content_of(folder.file("a.svg"));
  };
  const std::string plain = drawn();
  map.chart = Eigen::Vector4i(3, 3, 3, 3);
  EXPECT_EQ(drawn(), plain);
  map.chart = Eigen::Vector4i(0, 0, 1, 1);
  const std::string text = drawn();
  const std::vector<std::string> outlines = paths_of(text, "<path stroke=");
  ASSERT_EQ(outlines.size(), 2u);
  EXPECT_EQ(parts_of(outlines[0]), 4u);  // the edges of two cells without their common edge, twice
  map.distortion.resize(0);
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

// Two triangles; the first has the density `first`.
MapFile two_triangles(double first) {
  MapFile map = random_strip(1, 2, 3);
  map.uv << 0, 0, 2, 0, 0, 1, 2, 1;
  map.distortion = Vec::Constant(2, first);
  map.distortion[1] = 5;
  map.claims = R"({"energy": "symmetric-dirichlet", "pins": [], "seams": false,
                   "boundary": "free", "init": "tutte", "options": {"handles": ""}})";
  return map;
}

// Reverses the corners of a cell, which must have no neighbours.
void turn_over(MapFile& map, Index cell) {
  const Index count = map.points.rows();
  map.points.conservativeResize(count + 3, 3);
  map.uv.conservativeResize(count + 3, 2);
  for (Index k = 0; k < 3; ++k) {
    map.points.row(count + k) = map.points.row(map.cells(cell, k));
    map.uv.row(count + k) = map.uv.row(map.cells(cell, (3 - k) % 3));
  }
  map.input_vertex.conservativeResize(count + 3);
  map.input_vertex.tail(3) = map.input_vertex(map.cells.row(cell));
  map.cells.row(cell) << count, count + 1, count + 2;
}

std::string drawing_of(const MapFile& map, const SvgOptions& options = {}) {
  const TemporaryFolder folder;
  write_svg(folder.file("a.svg"), map, options);
  return content_of(folder.file("a.svg"));
}

// Returns the colours of the cells whose edges are drawn, in the order of the paths.
std::vector<std::string> fills(const std::string& text) {
  std::vector<std::string> result;
  for (std::size_t at = text.find("<path fill=\"#"); at != std::string::npos;
       at = text.find("<path fill=\"#", at + 1)) {
    const std::string path = text.substr(at, text.find("/>", at) - at);
    if (count(path, "stroke=") > 0)
      result.insert(result.end(), parts_of(path.substr(path.find(" d="))), path.substr(12, 7));
  }
  return result;
}

TEST(WriteSvg, ADensityHasOneColourInAllMaps) {
  const ColorScale scale = color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}});
  for (const double first : {4.0, 4.003, 12.0, 39.0, 400.0}) {
    const std::string text = drawing_of(two_triangles(first));
    EXPECT_EQ(fills(text), (std::vector{scale.color(first).hex(), scale.color(5).hex()}));
    expect_contains(text, {">symmetric-dirichlet density, degree 1<", ">isometry 4; smallest ",
                           ">4</text>", ">40</text>", "<rect width=\"1000\""});
    EXPECT_EQ(count(text, "1 of 2 triangle means above 40</text>"), first > 40 ? 1u : 0u);
    // with a pointed end
    EXPECT_EQ(count(text, "<path") - fills(text).size(), first > 40 ? 79u : 78u);
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
  map.face_distortion.row(1) << 3, -1, -2, 9, 9, 9;
  turn_over(map, 1);
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
  map.face_distortion.resize(0, 6);  // measured if the file has no values
  EXPECT_EQ(fills(drawing_of(map, {.quantity = Quantity::Area})).size(), 2u);
  map.distortion.resize(0);
  expect_contains(
      error_message(ErrorKind::Usage, [&] { drawing_of(map, {.quantity = Quantity::Density}); }),
      {"no density"});
}

// Inverted triangles are magenta, above all others, also in grey drawings; the legend counts them,
// and means do not.
TEST(WriteSvg, TurnedOverTrianglesAreSeen) {
  MapFile map = two_triangles(400);
  turn_over(map, 0);
  std::string text = drawing_of(map);
  const ColorScale scale = color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}});
  EXPECT_EQ(fills(text), (std::vector{scale.color(5).hex(), kFlippedColor.hex()}));
  expect_contains(text, {">1 triangle turned over, not counted in the numbers above</text>",
                         "; 1 triangle turned over"});
  EXPECT_EQ(count(text, "triangle means above"), 0u);
  map.claims.clear();
  text = drawing_of(map);
  EXPECT_EQ(fills(text), (std::vector<std::string>{"#dddddd", kFlippedColor.hex()}));
  expect_contains(text, {">1 triangle turned over</text>"});
  EXPECT_EQ(count(drawing_of(two_triangles(5)), "turned over"), 0u);
}

// The legend has the extremes of the whole map, as in reports, and not those of the drawn means.
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

TEST(WriteSvg, GridsOfTheirOwnAreRound) {
  const double sizes[] = {1, 1.7, 3, 4.2, 9.9};
  // 16 to 40 squares along the side
  const char* const spacings[] = {"0.05", "0.05", "0.1", "0.2", "0.5"};
  for (std::size_t k = 0; k < 5; ++k) {
    MapFile map = two_triangles(4);
    map.uv *= sizes[k] / (map.uv.colwise().maxCoeff() - map.uv.colwise().minCoeff()).maxCoeff();
    const std::string text = drawing_of(map, {.grid = 0.0});
    const std::size_t at = text.find(">grid ");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(text.substr(at + 6, text.find('<', at) - at - 6), spacings[k]) << sizes[k];
  }
}

TEST(WriteSvg, TheUnitSquareIsAroundLayoutsMadeForIt) {
  const std::string square = "<path stroke=\"#787878\" stroke-width=\"1.2\" d=\"M10 990l980 0";
  MapFile map = two_triangles(4);
  map.uv *= 0.25;
  const std::string claims = map.claims;
  EXPECT_EQ(count(drawing_of(map), "#787878"), 0u);  // other programs make no layouts for a square
  for (const std::string& made_for_it :
       {std::string(), R"({"normalized": {"origin": [0, 0], "size": 2}, )" + claims.substr(1)}) {
    map.claims = made_for_it;
    EXPECT_EQ(count(drawing_of(map), square), 1u) << made_for_it;
    map.uv.array() += 0.75;  // the layout leaves the square
    EXPECT_EQ(count(drawing_of(map), "#787878"), 0u) << made_for_it;
    map.uv.array() -= 0.75;
  }
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
  EXPECT_EQ(count("<circle"), 24u + 1u);  // every copy, and the one of the legend
  EXPECT_EQ(count("stroke-linecap"), 1u);
  EXPECT_EQ(count("<path"), 1u + 12u + 1u);  // cells, seams, and the one of the legend
  EXPECT_EQ(count("clip-path"), 0u);
  write_svg(folder.file("a.svg"), file, {.grid = 1.0});
  text = content_of(folder.file("a.svg"));
  EXPECT_EQ(count("clip-path=\"url(#layout)\""), 1u);
  EXPECT_EQ(count(">grid 1</text>"), 1u);
  const std::size_t start = text.find("<clipPath");
  const std::string clip = text.substr(start, text.find("</clipPath>") - start);
  EXPECT_EQ(std::count(clip.begin(), clip.end(), 'z'), 6);  // one closed part per chart
  for (const double wrong : {-1.0, 1e-6, std::nan("")})
    error_message(ErrorKind::Usage,
                  [&] { write_svg(folder.file("b.svg"), file, {.grid = wrong}); });
}

// A grid layout of degree 1 with 2 side^2 triangles.
MapFile grid_map(Index side) {
  MapFile map;
  const Index points = (side + 1) * (side + 1);
  map.points = Points3::Zero(points, 3);
  for (Index p = 0; p < points; ++p)
    map.points.row(p) << p % (side + 1) + 0.3 * std::sin(1.7 * p), p / (side + 1), 0;
  map.uv = map.points.leftCols(2);
  map.cells.resize(2 * side * side, 3);
  for (Index c = 0; c < side * side; ++c) {
    const Index p = c / side * (side + 1) + c % side;
    map.cells.row(2 * c) << p, p + 1, p + side + 2;
    map.cells.row(2 * c + 1) << p, p + side + 2, p + side + 1;
  }
  map.input_vertex = Eigen::VectorXi::LinSpaced(points, 0, points - 1);
  map.input_face = Eigen::VectorXi::LinSpaced(2 * side * side, 0, 2 * side * side - 1);
  return map;
}

TEST(WriteSvg, ManyTrianglesTakeFewBytes) {
  MapFile map = grid_map(64);
  map.distortion = Vec::LinSpaced(map.cells.rows(), 4, 40);
  map.claims = R"({"energy": "symmetric-dirichlet"})";
  const std::string text = svg_text(map);
  EXPECT_LT(text.size(), 46u * static_cast<std::size_t>(map.cells.rows()));
  EXPECT_EQ(fills(text).size(), static_cast<std::size_t>(map.cells.rows()));
}

// Numbers are relative to written ones, so that rounding errors do not add up.
TEST(WriteSvg, RoundingDoesNotAddUp) {
  const MapFile map = grid_map(20);
  const std::string path = paths_of(svg_text(map))[0];
  Vector2 pen(0, 0), start(0, 0);
  std::vector<Vector2> starts;
  std::size_t at = 0;
  const auto number = [&] {
    while (path[at] == ' ') ++at;
    std::size_t length = 0;
    const double value = std::stod(path.substr(at), &length);
    at += length;
    return value;
  };
  while (at < path.size()) {
    const char verb = path[at++];
    if (verb == 'z') pen = start;
    while (at < path.size() && !std::isalpha(static_cast<unsigned char>(path[at]))) {
      const double x = number(), y = number();
      pen = verb == 'M' ? Vector2(x, y) : Vector2(pen + Vector2(x, y));
      if (verb == 'M' || verb == 'm') starts.push_back(start = pen);
    }
  }
  ASSERT_EQ(starts.size(), static_cast<std::size_t>(map.cells.rows()));
  const Vector2 low = map.uv.colwise().minCoeff(), high = map.uv.colwise().maxCoeff();
  const double scale = 980 / (high - low).maxCoeff();
  for (Index c = 0; c < map.cells.rows(); ++c) {
    const Vector2 uv = map.uv.row(map.cells(c, 0));
    const Vector2 place(10 + scale * (uv.x() - low.x()), 10 + scale * (high.y() - uv.y()));
    EXPECT_LT((starts[static_cast<std::size_t>(c)] - place).cwiseAbs().maxCoeff(), 0.00051) << c;
  }
}

TEST(WriteSvg, NamesItsMapAndHasPaperOnRequest) {
  const std::string text = drawing_of(two_triangles(5));
  expect_contains(text, {"<title>Layout of a surface in the plane</title>",
                         "<desc>2 triangles of degree 1, coloured by symmetric-dirichlet density",
                         "role=\"img\""});
  EXPECT_EQ(count(text, "<rect"), 1u);
  EXPECT_EQ(count(drawing_of(two_triangles(5), {.paper = Paper::None}), "<rect"), 0u);
}

// Letters keep their size, so that they are relatively larger on a smaller sheet; long lines are
// broken.
TEST(WriteSvg, SheetsOfAnySize) {
  const MapFile map = two_triangles(400);
  for (const int width : {300, 700, 1000, 2000}) {
    const std::string text = drawing_of(map, {.size = SheetSize{width, 600}});
    expect_contains(text,
                    {fmt::format("width=\"{0}\" height=\"600\" viewBox=\"0 0 {0} 600\"", width),
                     "font-size=\"24\"", ">4</text>", ">40</text>"});
    const std::size_t lines = count(text, "font-size=\"20\"");
    if (width >= 700) {
      EXPECT_EQ(lines, width >= 1000 ? 1u : 2u) << width;
    } else if (width == 300) {
      EXPECT_GE(lines, 4u);  // clauses are broken as well
    }
    const std::string path = paths_of(text)[0];  // the first cell begins 10 from the left
    EXPECT_LT(std::stod(path.substr(1)), width);
    EXPECT_EQ(parse_xml("a.svg", text).name, "svg");
  }
  EXPECT_LT(count(drawing_of(map, {.size = SheetSize{250, 600}}), "text-anchor"),
            count(drawing_of(map), "text-anchor"));  // no room for ticks
  expect_contains(error_message(ErrorKind::Usage,
                                [&] {
                                  drawing_of(map, {.size = SheetSize{8, 600}});
                                }),
                  {"a sheet of 8 x 600 px: sides are 16 to 8192"});
  expect_contains(error_message(ErrorKind::Usage,
                                [&] {
                                  drawing_of(map, {.size = SheetSize{700, 100}});
                                }),
                  {"a sheet 100 px high: its legends are 156 px high; take one of 196 or more, or "
                   "leave the legends out"});
}

// A line of text on a sheet, and its largest extent with a reader's font.
struct WrittenLine {
  double left, right, foot;
  std::string text;
};

std::vector<WrittenLine> written_lines(const std::string& drawing) {
  constexpr double kWidest = 1.15;  // width of a reader's letters relative to ours
  std::vector<WrittenLine> lines;
  for (std::size_t at = drawing.find("<text"); at != std::string::npos;
       at = drawing.find("<text", at + 1)) {
    const std::string tag = drawing.substr(at, drawing.find("</text>", at) - at);
    const auto number = [&](const std::string& name) {
      return std::stod(tag.substr(tag.find(" " + name + "=\"") + name.size() + 3));
    };
    const std::string text = tag.substr(tag.find('>') + 1);
    const double width = kWidest * number("font-size") * text_width(text);
    const double left = number("x") - (count(tag, "middle") > 0 ? width / 2 : 0);
    lines.push_back({left, left + width, number("y"), text});
  }
  return lines;
}

// No text is cut off or overlaps another line, on sheets of any width; if a sheet is too narrow,
// the message names the least width.
TEST(WriteSvg, LegendsStayOnTheSheet) {
  MapFile map = two_triangles(400);
  map.claims.replace(map.claims.find("symmetric-dirichlet"), 19,
                     "symmetric-dirichlet + 0.125*symmetric-arap + 1e-05*arap");
  const std::string printed =
      "symmetric-dirichlet + 0.125*symmetric-arap + 1e-05*arap density, degree 1";
  for (const int width : {0, 1000, 700, 350, 240}) {
    SvgOptions options{.grid = 0.123456, .color_range = ColorRange{4.875, 12345.5}};
    if (width > 0) options.size = SheetSize{width, 900};
    const std::string text = drawing_of(map, options);
    const double side = width > 0 ? width : 1000;
    std::string all, tight;
    std::vector<WrittenLine> lines = written_lines(text);
    for (const WrittenLine& line : lines) {
      EXPECT_GE(line.left, -1e-3) << line.text;
      EXPECT_LE(line.right, side + 1e-3) << line.text;
      all += line.text + " ";
      tight += line.text;
      for (const WrittenLine& other : lines)
        EXPECT_TRUE(&line == &other || std::abs(line.foot - other.foot) > 20 ||
                    line.right <= other.left || other.right <= line.left)
            << line.text << other.text;
    }
    std::erase(tight, ' ');
    std::string bare = printed;
    std::erase(bare, ' ');
    EXPECT_NE(tight.find(bare), std::string::npos) << all;
    expect_contains(all, {"isometry 4", "grid 0.123456"});
    EXPECT_EQ(all.find("1e- 05"), std::string::npos);
  }
  const std::string refused = error_message(ErrorKind::Usage, [&] {
    drawing_of(map, {.size = SheetSize{120, 900}});
  });
  expect_contains(refused, {"a sheet 120 px wide: its legends are ", "or leave the legends out"});
  const int least = std::stoi(refused.substr(refused.find("take one of ") + 12));
  drawing_of(map, {.size = SheetSize{least, 900}});
  error_message(ErrorKind::Usage, [&] { drawing_of(map, {.size = SheetSize{least - 1, 900}}); });
}

TEST(WriteSvg, WithoutLegendsTheSheetHasNoRoomForThem) {
  const MapFile map = two_triangles(400);
  const std::string text = drawing_of(map, {.grid = 0.5, .legends = Legends::Left});
  expect_contains(text, {"viewBox=\"0 0 1000 510\"", "coloured by symmetric-dirichlet"});
  EXPECT_EQ(count(text, "<text"), 0u);
  EXPECT_EQ(fills(text), fills(drawing_of(map)));
  drawing_of(map, {.size = SheetSize{60, 60}, .legends = Legends::Left});
}

TEST(WriteSvg, WithoutEdgesTheOutlineStays) {
  const MapFile map = grid_map(4);
  const std::string text = drawing_of(map, {.edges = CellEdges::Left});
  EXPECT_EQ(count(text, "fill=\"#dddddd\" stroke=\"#dddddd\""), 1u);
  const std::vector<std::string> outline = paths_of(text, "<path stroke=\"#333333\"");
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_EQ(parts_of(outline[0]), 1u);
}

TEST(WriteSvg, HandlesAndPinsHaveTheirTargets) {
  const std::vector<PagePoint> points{
      {.vertex = 1, .target = Vector2(1.5, 0.5), .hold = PagePoint::Hold::Handle},
      {.vertex = 2, .target = Vector2(0, 1), .hold = PagePoint::Hold::Pin}};
  MapFile map = two_triangles(5);
  map.input_vertex = Eigen::Vector4i(0, 1, 2, 3);
  const std::string text = drawing_of(map, {.points = points});
  expect_contains(text, {">1 pin</text>", ">1 handle, targets</text>"});
  EXPECT_EQ(count(text, "<circle"), 3u + 3u);  // two points and a target, and those of the legend
  expect_contains(text, {"<circle cx=\"745\" cy=\"255\" r=\"8\" stroke=\"#d55e00\""});
  // Parts outside of the layout are visible as well.
  const std::string wide = drawing_of(
      map, {.points = {{.vertex = 1, .target = Vector2(4, 0), .hold = PagePoint::Hold::Handle}}});
  expect_contains(wide, {"<circle cx=\"990\""});
}

TEST(WriteSvg, TheScaffoldIsClippedToTheDrawing) {
  MapFile around = two_triangles(4);
  around.uv *= 3;
  const std::string text = drawing_of(two_triangles(4), {.scaffold = around});
  expect_contains(text,
                  {"<clipPath id=\"drawing\"><path d=\"M0 0l1000 0 0 510-1000 0z\"/></clipPath>",
                   "<g clip-path=\"url(#drawing)\">", ">space around</text>"});
  EXPECT_EQ(count(text, "<svg"), 1u);
}

TEST(WriteSvg, RingsAreWhereTheLayoutMeetsItself) {
  MapFile map = grid_map(4);  // a strip that is bent back over its beginning
  const std::string plain = drawing_of(map);
  EXPECT_EQ(count(plain, "overlaps itself"), 0u);
  EXPECT_EQ(count(plain, "<circle"), 0u);
  for (Index p = 0; p < map.uv.rows(); ++p) {
    const double angle = 1.75 * map.points(p, 0), radius = 3 + 0.3 * map.points(p, 1);
    map.uv.row(p) << -radius * std::sin(-angle), radius * std::cos(angle);
  }
  map.uv.col(0) *= -1;
  const std::string text = drawing_of(map);
  EXPECT_EQ(count(text, "overlaps itself near ("), 2u);  // in legend and description
  EXPECT_GT(count(text, "stroke=\"#e6007a\""), 2u);
  map.cone = Eigen::VectorXi::Zero(map.points.rows());
  map.cone[0] = 3;  // usual for images of maps with cones
  EXPECT_EQ(count(drawing_of(map), "overlaps itself"), 0u);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
