// Tests which texels are changed by how much so that the two sides of a cut look alike, and which
// cuts stay.
#include "majorant/pictures/baking/seam_levelling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace majorant {
namespace {

// A grey image with one seam: one side is between the centres of texels (1, 1) and (2, 2), the
// other between those of (5, 5) and (6, 6).
class TwoSides : public ::testing::Test {
 protected:
  TwoSides() {
    EXPECT_TRUE(reading_at(image_, {2.0 / 8, 1 - 2.0 / 8}, seam_.sides[0]));
    EXPECT_TRUE(reading_at(image_, {6.0 / 8, 1 - 6.0 / 8}, seam_.sides[1]));
    for (const FilterReading& side : seam_.sides)
      kept_.insert(kept_.end(), side.texels.begin(), side.texels.end());
    std::sort(kept_.begin(), kept_.end());
  }

  void fill(int codes_above, int codes_below) {
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        image_.set(x, y, 0, static_cast<float>(y < 4 ? codes_above : codes_below) / 255);
  }
  double read(int side) const {
    const FilterReading& one = seam_.sides[to_size(side)];
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
      sum += one.weights[k] * image_.code(static_cast<int>(one.texels[k] % 8),
                                          static_cast<int>(one.texels[k] / 8), 0);
    return sum;
  }
  void close(double here, double there) {
    close_seams(image_, Transfer::Linear, Transfer::Linear, kept_, {seam_},
                RowMatrix::Constant(1, 1, here / 255), RowMatrix::Constant(1, 1, there / 255));
  }

  Raster image_{8, 8, 1, PixelDepth::Eight};
  SeamReading seam_;
  std::vector<std::size_t> kept_;
};

TEST_F(TwoSides, AreBroughtTogether) {
  fill(100, 102);
  const Raster before = image_;
  close(101, 101);
  EXPECT_LE(std::abs(read(0) - read(1)), 1);
  EXPECT_GE(read(0), 100);
  EXPECT_LE(read(1), 102);
  int moved = 0;
  for (std::size_t texel = 0; texel < 64; ++texel) {
    const int x = static_cast<int>(texel % 8), y = static_cast<int>(texel / 8);
    const int by = static_cast<int>(image_.code(x, y, 0)) - static_cast<int>(before.code(x, y, 0));
    EXPECT_LE(std::abs(by), 1);
    if (!std::binary_search(kept_.begin(), kept_.end(), texel)) {
      EXPECT_EQ(by, 0);
    }
    moved += by != 0;
  }
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, 8);
}

TEST_F(TwoSides, StayWhereTheSurfaceDiffersItself) {
  fill(100, 102);
  const Raster before = image_;
  close(150, 152);
  EXPECT_EQ(image_.bytes(), before.bytes());
  close(152, 150);  // a difference of 4 codes is not one of filtering
  EXPECT_EQ(image_.bytes(), before.bytes());
}

TEST_F(TwoSides, StayWhereTheyAreFarApart) {
  fill(100, 120);
  const Raster before = image_;
  close(110, 110);
  EXPECT_EQ(image_.bytes(), before.bytes());
}

// The derivative of light by the code is small for dark colours.
TEST_F(TwoSides, AreComparedInSrgbCodes) {
  image_ = Raster(8, 8, 1, PixelDepth::Float);
  for (const float code : {10.0F, 200.0F}) {
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        image_.set(x, y, 0, srgb_to_linear((y < 4 ? code : code + 2) / 255));
    const RowMatrix middle = RowMatrix::Constant(1, 1, srgb_to_linear((code + 1) / 255));
    close_seams(image_, Transfer::Linear, Transfer::Srgb, kept_, {seam_}, middle, middle);
    const float above = 255 * linear_to_srgb(image_.value(1, 1, 0));
    const float below = 255 * linear_to_srgb(image_.value(5, 5, 0));
    EXPECT_LT(std::abs(below - above), 0.75F) << code;
    EXPECT_GT(std::abs(below - above), 0.45F) << code;
  }
}

// Both sides may read the same texel, whose change then hardly affects their difference.
TEST(CloseSeams, MayShareTexels) {
  Raster image(4, 4, 1, PixelDepth::Eight);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) image.set(x, y, 0, (100.0F + 2 * static_cast<float>(x)) / 255);
  SeamReading seam;
  ASSERT_TRUE(reading_at(image, {0.375, 0.5}, seam.sides[0]));
  ASSERT_TRUE(reading_at(image, {0.625, 0.5}, seam.sides[1]));
  const auto difference = [&] {
    double sum = 0;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < 4; ++k)
        sum += (side == 0 ? 1 : -1) * seam.sides[side].weights[k] *
               image.code(static_cast<int>(seam.sides[side].texels[k] % 4),
                          static_cast<int>(seam.sides[side].texels[k] / 4), 0);
    return sum;
  };
  EXPECT_EQ(difference(), -2);
  close_seams(image, Transfer::Linear, Transfer::Linear, {}, {seam}, RowMatrix::Constant(1, 1, 0.5),
              RowMatrix::Constant(1, 1, 0.5));
  EXPECT_LE(std::abs(difference()), 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
