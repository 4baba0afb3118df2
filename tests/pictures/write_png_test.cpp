#include <random>

#include "io/io_test_helpers.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/atomic_file.h"
#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/images/png_file.h"
#include "majorant/pictures/internal/bezier_image.h"
#include "majorant/pictures/internal/letters.h"
#include "majorant/pictures/pictures.h"
#include "singular_values.h"

namespace majorant {
namespace {

PixelImage picture_of(const MapFile& map, const PngOptions& options) {
  const TemporaryFolder folder;
  write_png(folder.file("a.png"), map, options);
  return pixels_of_png("a.png", content_of(folder.file("a.png")));
}

// The unit square in the plane z = 0, mapped by uv = (2 x, y / 2): areas stay, lengths do not.
MapFile square_map() {
  MapFile map;
  map.points = Points3{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  map.uv = Points2{{0, 0}, {2, 0}, {2, 0.5}, {0, 0.5}};
  map.cells = Cells{{0, 1, 2}, {0, 2, 3}};
  map.input_vertex = Eigen::Vector4i(0, 1, 2, 3);
  map.input_face = Eigen::Vector2i(0, 1);
  map.claims = R"({"energy": "symmetric-dirichlet"})";
  return map;
}

TEST(WritePng, HeatIsTheScaleAtThatValue) {
  PngOptions options;
  options.width = options.height = 200;
  for (const auto& [quantity, value] : {std::pair{Quantity::Density, 8.5},
                                        {Quantity::Area, 1.0},
                                        {Quantity::Angle, 4.0},
                                        {Quantity::SigmaMax, 2.0},
                                        {Quantity::SigmaMin, 0.5}}) {
    options.quantity = quantity;
    const ColorScale scale = color_scale(quantity, {{symmetric_dirichlet(), 1.0}});
    EXPECT_EQ(picture_of(square_map(), options).at(100, 70), scale.color(value))
        << quantity_name(quantity);
  }
  options.view = Vector3(0, 0, 1);  // light along the normal does not change the colour
  EXPECT_EQ(picture_of(square_map(), options).at(100, 70),
            color_scale(Quantity::SigmaMin, {}).color(0.5));
  options.quantity = Quantity::Density;
  options.view.reset();
  MapFile scaled = square_map();  // normalized files are measured in the units of the run
  scaled.uv /= 4;
  scaled.claims =
      R"({"energy": "symmetric-dirichlet", "normalized": {"origin": [0, 0], "size": 4}})";
  const auto count = [](const PixelImage& image, const Color& color) {
    return std::count(image.pixels.begin(), image.pixels.end(), color);
  };
  // The layout is a sixteenth of the unit square, which is drawn around it.
  const Color there = color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}}).color(8.5);
  EXPECT_GT(count(picture_of(scaled, options), there), 400);
  scaled.uv.col(0) *= -1;
  const PixelImage flipped = picture_of(scaled, options);
  EXPECT_EQ(count(flipped, there), 0);
  EXPECT_GT(count(flipped, kFlippedColor), 400);
}

// The second triangle is mapped onto the first one, mirrored, and hides it.
TEST(WritePng, TurnedOverTrianglesAreSeen) {
  MapFile map = square_map();
  map.uv.row(3) << 2, 0;
  const auto count = [](const PixelImage& image) {
    return std::count(image.pixels.begin(), image.pixels.end(), kFlippedColor);
  };
  PngOptions options;
  options.width = options.height = 200;
  for (const bool has_energy : {true, false}) {
    if (!has_energy) map.claims.clear();
    options.view.reset();
    EXPECT_GT(count(picture_of(map, options)), 2000) << has_energy;  // half of 196 x 49
    options.view = Vector3(0, 0, 1);
    EXPECT_GT(count(picture_of(map, options)), 10000) << has_energy;  // half of the square
    EXPECT_EQ(count(picture_of(square_map(), options)), 0);
  }
}

TEST(WritePng, TheCameraIsAsDocumented) {
  PngOptions options;
  options.width = 400;
  options.height = 215;
  options.view = Vector3(0, 0, 3);
  const Color paper{255, 255, 255};
  const double side = 0.96 * 215;  // the largest that fits
  const auto is_paper = [&](const PixelImage& image, double x, double y) {
    return image.at(static_cast<int>(200 + x), static_cast<int>(107.5 - y)) == paper;
  };
  PixelImage image = picture_of(square_map(), options);
  for (const double way : {-0.5, 0.5}) {
    EXPECT_FALSE(is_paper(image, way * (side - 4), 0));
    EXPECT_TRUE(is_paper(image, way * (side + 4), 0));
    EXPECT_FALSE(is_paper(image, 0, way * (side - 4)));
    EXPECT_TRUE(is_paper(image, 0, way * (side + 3)));
  }
  options.view = Vector3(std::sqrt(3.0), 0, 1);  // from the right the square is half as wide
  image = picture_of(square_map(), options);
  EXPECT_FALSE(is_paper(image, 0.25 * side - 3, 0));
  EXPECT_TRUE(is_paper(image, 0.25 * side + 3, 0));
}

TEST(WritePng, TheSilhouetteIsInTheMiddle) {
  MapFile map = square_map();  // a line along x = y seen from the front, far behind it below
  map.points = Points3{{0, 0, 0}, {1, 1, 0}, {1, 1, -40}, {0, 0, -40}};
  PngOptions options;
  options.width = options.height = 100;
  for (const Vector3& view : {Vector3(1, 0, 0), Vector3(3, 1, 2), Vector3(-1, 5, 0.5)}) {
    options.view = view;
    const PixelImage image = picture_of(map, options);
    int left = 100, right = 0, top = 100, bottom = 0;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x) {
        if (image.at(x, y) == Color{255, 255, 255}) continue;
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
    EXPECT_NEAR(left + right, 99, 1) << view.transpose();
    EXPECT_NEAR(top + bottom, 99, 1) << view.transpose();
    EXPECT_NEAR(std::max(right - left, bottom - top), 95, 1) << view.transpose();
  }
}

TEST(WritePng, NearHidesFar) {
  MapFile map = square_map();  // two triangles at one position, the second one below
  map.points = Points3{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}};
  map.uv = Points2{{0, 0}, {1, 0}, {0, 1}, {0, 0}, {3, 0}, {0, 3}};
  map.cells = Cells{{0, 1, 2}, {3, 4, 5}};
  map.input_vertex = Eigen::VectorXi::LinSpaced(6, 0, 5);
  PngOptions options;
  options.width = options.height = 300;
  options.quantity = Quantity::SigmaMax;
  const ColorScale scale = color_scale(Quantity::SigmaMax, {});
  for (const auto& [eye, value] : {std::pair{1.0, 1.0}, {-1.0, 3.0}}) {
    options.view = Vector3(0, 0, eye);
    EXPECT_EQ(picture_of(map, options).at(150, 150), scale.color(value)) << eye;
  }
}

// Expects equality up to a few codes: the pixel is beside the centre of an image pixel.
void expect_near(const Color& found, const Color& required) {
  for (const auto& [a, b] : {std::pair{found.red, required.red},
                             {found.green, required.green},
                             {found.blue, required.blue}})
    EXPECT_NEAR(a, b, 6);
}

// A cut below the edge of a table, behind a face that is seen at a grazing angle and narrower than
// a pixel: the line along it has the usual width.
TEST(WritePng, CutsHaveTheirFullWidth) {
  MapFile map;
  map.points.resize(10, 3);
  map.uv.resize(10, 2);
  const std::array<Vector2, 5> profile{Vector2(-1, 0), Vector2(0, 0), Vector2(0.001, -0.005),
                                       Vector2(0.001, -0.005), Vector2(-0.5, -1)};
  for (Index k = 0; k < 5; ++k)
    for (Index side = 0; side < 2; ++side) {
      map.points.row(2 * k + side) << side, profile[k].x(), profile[k].y();
      map.uv.row(2 * k + side) << side, k;
    }
  map.cells = Cells{{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}, {6, 7, 9}, {6, 9, 8}};
  map.input_vertex = Eigen::VectorXi::LinSpaced(10, 0, 9);
  map.input_face = Eigen::VectorXi::LinSpaced(6, 0, 5);
  map.claims = R"({"energy": "symmetric-dirichlet"})";
  PngOptions options;
  options.view = Vector3(0, 0, 1);
  options.quantity = Quantity::Area;
  options.width = options.height = 300;
  options.legends = Legends::Left;
  const PixelImage image = picture_of(map, options);
  for (int x = 20; x < 280; ++x) {
    int least = 255;
    for (int y = 0; y < 30; ++y) least = std::min(least, int{image.at(x, y).green});
    EXPECT_LT(least, 100) << x;
  }
}

TEST(WritePng, ImagesLieOnTheSquareOfTheLayout) {
  const PixelImage quarters{2, 2, {{250, 0, 0}, {0, 250, 0}, {0, 0, 250}, {250, 250, 0}}};
  MapFile map = square_map();
  map.uv = map.points.leftCols(2);
  PngOptions options;
  options.width = options.height = 200;
  options.image = encode_png(quarters);
  const PixelImage image = picture_of(map, options);
  for (const auto& [x, y, k] : {std::tuple{51, 51, 0}, {148, 51, 1}, {51, 148, 2}, {148, 148, 3}})
    expect_near(image.at(x, y), quarters.pixels[static_cast<std::size_t>(k)]);
  // Layouts in the unit square keep their position in it; for others the square is around the
  // image.
  map.uv *= 0.5;
  expect_near(picture_of(map, options).at(148, 51), quarters.pixels[1]);
  for (const char* claims : {R"({"normalized": {"origin": [0, 0], "size": 2}})", ""}) {
    map.claims = claims;
    expect_near(picture_of(map, options).at(51, 148), quarters.pixels[2]);
    expect_near(picture_of(map, options).at(148, 51), {255, 255, 255});
    map.uv.array() += 3;  // repeated outside the unit square
    expect_near(picture_of(map, options).at(100, 100), quarters.pixels[2]);
    map.uv.array() -= 3;
  }
  options.image = "no image";
  expect_contains(error_message(ErrorKind::Unreadable, [&] { picture_of(map, options); }),
                  {"the image: ", "give a PNG image"});
}

TEST(WritePng, SquaresAreOnMultiplesOfTheirSide) {
  MapFile map = square_map();
  map.uv = 40 * map.points.leftCols(2);  // squares of a 40th of the side: 1
  PngOptions options;
  options.width = options.height = 430;  // 40 squares fill 96 % of the width
  options.view = Vector3(0, 0, 1);
  const PixelImage image = picture_of(map, options);
  const double square = 0.96 * 430 / 40;
  int agree = 0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      const Color c = image.at(static_cast<int>(215 + (i - 19.5) * square),
                               static_cast<int>(215 - (j - 19.5) * square));
      agree += ((i + j) % 2 == 0) == (c.red > 160) ? 1 : 0;
    }
  EXPECT_EQ(agree, 1600);
}

// A grid of a layout is drawn as in SVG, of a surface on the positions of the map: lines are at
// multiples.
TEST(WritePng, GridsAreOnLayoutsAndSurfaces) {
  PngOptions options;  // 1000 by 800
  const Color line{20, 50, 122};
  const auto count = [&](const PixelImage& image) {
    return std::count(image.pixels.begin(), image.pixels.end(), line);
  };
  for (const bool is_surface : {false, true}) {
    if (is_surface) options.view = Vector3(0, 0, 1);
    options.grid.reset();
    EXPECT_EQ(count(picture_of(square_map(), options)), 0);
    options.grid = 0.5;
    const PixelImage image = picture_of(square_map(), options);
    EXPECT_GT(count(image), 700) << is_surface;  // three lines of 2 by 245 pixels for a layout
    if (!is_surface) continue;
    // u = 2 x: lines are at every quarter of the side, and their width is a twelfth of that.
    const double side = 0.96 * 800, left = (1000 - side) / 2;
    EXPECT_EQ(image.at(static_cast<int>(left + side / 4), 150), line);
    EXPECT_NE(image.at(static_cast<int>(left + side / 8), 150), line);
    EXPECT_NE(image.at(static_cast<int>(left + side / 4 + side / 4 / 18), 150), line);
  }
  options.grid = 1e-6;
  expect_contains(error_message(ErrorKind::Usage, [&] { picture_of(square_map(), options); }),
                  {"cannot be drawn"});
}

TEST(WritePng, SquaresAreAsManyAsRequested) {
  MapFile map = square_map();
  map.uv = map.points.leftCols(2);
  PngOptions options;
  options.width = options.height = 430;
  options.view = Vector3(0, 0, 1);
  options.squares = 5;
  const double square = 0.96 * 430 / 5;
  for (const char* claims : {"", R"({"energy": "symmetric-dirichlet"})"}) {
    map.claims = claims;
    const PixelImage image = picture_of(map, options);
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) {
        const Color c = image.at(static_cast<int>(215 + (i - 2) * square),
                                 static_cast<int>(215 - (j - 2) * square));
        EXPECT_EQ((i + j) % 2 == 0, c.red > 160) << i << " " << j;
      }
    map.uv.array() += 3.37;  // around a layout that was not made for the unit square
  }
  options.squares = 0;
  expect_contains(error_message(ErrorKind::Usage, [&] { picture_of(map, options); }),
                  {"give 1 or more"});
}

TEST(WritePng, CurvedCellsAreEvaluatedExactly) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int degree = 1; degree <= 8; ++degree) {
    const MapFile map = random_strip(degree, 3, 7);
    const BezierImage image(map, 2);
    for (int k = 0; k < 20; ++k) {
      Barycentric xi(unit(random), unit(random), 0);
      if (xi.sum() > 1) xi = Barycentric(1 - xi[0], 1 - xi[1], 0);
      xi[2] = 1 - xi[0] - xi[1];
      const Index cell = k % 3;
      Points3 at(1, 3);
      at << xi.transpose();
      const Eigen::MatrixXd b = bernstein_values(degree, at);
      Vector2 uv = Vector2::Zero();
      for (Index l = 0; l < b.cols(); ++l) uv += b(0, l) * Vector2(map.uv.row(map.cells(cell, l)));
      EXPECT_LT((image.uv(cell, xi) - uv).norm(), 1e-12);
      // Singular values by differences in an orthonormal frame of the cell.
      const auto corner = [&](Index c) { return Vector3(map.points.row(map.cells(cell, c))); };
      const Vector3 e = corner(0) - corner(2), f = corner(1) - corner(2);
      Eigen::Matrix<double, 3, 2> edges;
      edges << e, f;
      const double h = 1e-6;
      Eigen::Matrix2d d;
      d << (image.uv(cell, xi + Vector3(h, 0, -h)) - image.uv(cell, xi - Vector3(h, 0, -h))) /
               (2 * h),
          (image.uv(cell, xi + Vector3(0, h, -h)) - image.uv(cell, xi - Vector3(0, h, -h))) /
              (2 * h);
      const Eigen::Matrix<double, 2, 3> J =
          2 * d * (edges.transpose() * edges).inverse() * edges.transpose();
      const Eigen::VectorXd sigma = test::singular_values(J);
      const PointDistortion found = image.at(cell, xi).distortion;
      EXPECT_NEAR(found.sigma_1, sigma[0], 1e-5 * sigma[0]) << degree;
      EXPECT_NEAR(std::abs(found.sigma_2), sigma[1], 1e-5 * sigma[0]) << degree;
    }
  }
}

TEST(WritePng, BytesDoNotDependOnThreads) {
  const TemporaryFolder folder;
  const MapFile map = random_strip(3, 40, 7);
  PngOptions options;
  options.width = 300;
  options.height = 200;
  for (const bool surface : {false, true}) {
    if (surface) options.view = Vector3(1, 2, 3);
    options.quantity = Quantity::Angle;
    std::vector<std::string> files;
    for (const int threads : {1, 2, 5}) {
      const ThreadCount count(threads);
      write_png(folder.file("a.png"), map, options);
      files.push_back(content_of(folder.file("a.png")));
    }
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], files[2]);
  }
}

TEST(WritePng, RefusesInvalidRequests) {
  const auto refused = [](const PngOptions& options) {
    return error_message(ErrorKind::Usage, [&] { picture_of(square_map(), options); });
  };
  PngOptions options;
  options.width = 8193;
  EXPECT_EQ(refused(options), "a picture of 8193 x 800 pixels: sides are 16 to 8192");
  options = {};
  for (const Vector3& view : {Vector3(0, 0, 0), Vector3(1, std::nan(""), 0)}) {
    options.view = view;
    expect_contains(refused(options), {"give the direction to the eye"});
  }
  options = {};
  options.quantity = Quantity::Area;
  options.image = "any";
  expect_contains(refused(options), {"choose one"});
  options = {};
  MapFile map = square_map();
  map.claims.clear();
  options.quantity = Quantity::Density;
  error_message(ErrorKind::Usage, [&] { picture_of(map, options); });
  map.uv(0, 0) = std::nan("");
  error_message(ErrorKind::Invalid, [&] { picture_of(map, {}); });
}

// A drawn layout has the content of the SVG at the same positions, for example a handle with its
// target.
TEST(WritePng, LayoutsAreDrawnAsInSvg) {
  MapFile map = square_map();
  PngOptions options;
  options.width = 1000;
  options.height = 700;
  const auto is_near = [](const Color& a, const Color& b) {
    return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue) < 60;
  };
  options.points = {{.vertex = 1, .target = Vector2(1, 0.25), .hold = PagePoint::Hold::Handle}};
  const PixelImage image = picture_of(map, options);
  const Color orange{213, 94, 0};
  // Legends take 130 + 40, the layout 245 of the 530 above: from 142.5 on.
  EXPECT_TRUE(is_near(image.at(990, 387), orange));  // the handle's dot
  EXPECT_TRUE(is_near(image.at(500, 273), orange));  // the ring around its target
  EXPECT_TRUE(is_near(image.at(745, 326), orange));  // the line between them
  EXPECT_FALSE(is_near(image.at(745, 200), orange));
  EXPECT_TRUE(is_near(image.at(250, 327), {51, 51, 51}) ||
              is_near(image.at(250, 326), {51, 51, 51}) ||
              is_near(image.at(250, 325), {51, 51, 51}));  // the edge between the two cells
}

// A picture of twice the size is the same: lines and letters scale with it.
TEST(WritePng, LettersGrowWithTheSize) {
  PngOptions options;
  options.width = 500;
  options.height = 400;
  const PixelImage small = picture_of(square_map(), options);
  options.width *= 4;
  options.height *= 4;
  const PixelImage large = picture_of(square_map(), options);
  double difference = 0;
  int ink = 0;
  for (int y = 340; y < 400; ++y)
    for (int x = 0; x < 500; ++x) {
      int sum = 0;
      for (int k = 0; k < 16; ++k) sum += large.at(4 * x + k % 4, 4 * y + k / 4).green;
      difference += std::abs(sum / 16 - small.at(x, y).green);
      ink += small.at(x, y).green < 128 ? 1 : 0;
    }
  EXPECT_GT(ink, 300);
  EXPECT_LT(difference / (60 * 500), 4);
}

// Lines of legends that are wider than the picture are broken; the picture has room for them.
TEST(WritePng, LegendsStayInThePicture) {
  MapFile map = square_map();
  map.uv(3, 1) = 0.56;  // densities 8.5 and 7.8
  PngOptions options;
  options.color_range = ColorRange{8, 8.2};
  options.quantity = Quantity::Density;
  for (const bool surface : {false, true}) {
    if (surface) options.view = Vector3(0, 0, 1);
    const PixelImage image = picture_of(map, options);
    const auto inked = [&](int first, int last) {
      std::vector<int> rows;
      for (int y = 500; y < 800; ++y)
        for (int x = first; x < last; ++x)
          if (image.at(x, y).green < 128) {
            rows.push_back(y);
            break;
          }
      return rows;
    };
    EXPECT_TRUE(inked(994, 1000).empty()) << surface;
    // Two complete lines of the note below the labels of the bar.
    const std::vector<int> note = inked(10, 300);
    EXPECT_LT(note.back(), 797) << surface;
    int lines = 0;
    for (std::size_t k = 1; k < note.size(); ++k) lines += note[k] > note[k - 1] + 1 ? 1 : 0;
    EXPECT_GE(lines, 4) << surface;
    options.height = 100;
    expect_contains(error_message(ErrorKind::Usage, [&] { picture_of(map, options); }),
                    {"a sheet 100 px high: its legends are ", "or leave the legends out"});
    options.legends = Legends::Left;
    const PixelImage bare = picture_of(map, options);
    EXPECT_EQ(bare.height, 100);
    options.legends = Legends::Drawn;
    options.height = 800;
  }
}

TEST(WritePng, TransparentPicturesHaveNoPaper) {
  const TemporaryFolder folder;
  PngOptions options;
  options.width = options.height = 200;
  for (const bool surface : {false, true}) {
    if (surface) options.view = Vector3(0, 0, 1);
    options.paper = Paper::White;
    const PixelImage white = picture_of(square_map(), options);
    options.paper = Paper::None;
    write_png(folder.file("a.png"), square_map(), options);
    const std::string bytes = content_of(folder.file("a.png"));
    EXPECT_EQ(bytes[25], 6);  // colours with opacity
    const PixelImage on_white = pixels_of_png("a.png", bytes);
    double difference = 0;  // libpng mixes partly covered pixels in linear light
    for (std::size_t k = 0; k < white.pixels.size(); ++k)
      difference += std::abs(white.pixels[k].green - on_white.pixels[k].green);
    EXPECT_LT(difference / static_cast<double>(white.pixels.size()), 2);
  }
}

TEST(Letters, HaveOutlinesAndQuestionMarksForOthers) {
  for (char c = '!'; c <= '~'; ++c) {
    const Path path = text_outline({&c, 1});
    EXPECT_GT(path.points.size(), 3u) << c;
    EXPECT_EQ(path.verbs.back(), Path::Verb::Close) << c;
    for (const Vector2& p : path.points) {
      EXPECT_LT(std::abs(p.y() + 0.35), 0.7) << c;
      EXPECT_LT(std::abs(p.x() - 0.4), 0.7) << c;
    }
  }
  EXPECT_EQ(text_outline("\xc3").points, text_outline("?").points);
  EXPECT_EQ(text_outline(" ").points.size(), 0u);
  EXPECT_NEAR(text_width("ab"), text_width("a") + text_width("b"), 1e-12);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
