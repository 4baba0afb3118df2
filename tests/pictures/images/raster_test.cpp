// Tests pixels, colours, filters and padding.
#include "majorant/pictures/images/raster.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace majorant {
namespace {

TEST(Raster, IntegersAreRoundedAndBounded) {
  Raster raster(2, 1, 1, PixelDepth::Eight);
  raster.set(0, 0, 0, 0.5F);
  EXPECT_EQ(raster.code(0, 0, 0), 128U);
  raster.set(0, 0, 0, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(raster.code(0, 0, 0), 0U);
  raster.set(1, 0, 0, 7);
  EXPECT_EQ(raster.code(1, 0, 0), 255U);
}

TEST(Raster, EveryCodeOfSrgbComesBack) {
  for (const PixelDepth depth : {PixelDepth::Eight, PixelDepth::Sixteen}) {
    const int codes = depth == PixelDepth::Eight ? 256 : 65536;
    Raster raster(codes, 1, 1, depth), back(codes, 1, 1, depth);
    for (int k = 0; k < codes; ++k)
      raster.set(k, 0, 0, static_cast<float>(k) / static_cast<float>(codes - 1));
    const ColorDecoder decoder(raster, Transfer::Srgb);
    for (int k = 0; k < codes; ++k) {
      back.set(k, 0, 0, encoded(decoder(raster, k, 0, 0), Transfer::Srgb, 0, 1));
      ASSERT_EQ(back.code(k, 0, 0), static_cast<unsigned>(k));
    }
  }
}

TEST(Raster, ColorsAreMixedInLinearLightAndAlphaAsItIs) {
  Raster raster(2, 1, 2, PixelDepth::Eight);
  for (const int c : {0, 1}) raster.set(1, 0, c, 1);
  float value[2];
  sample(raster, ColorDecoder(raster, Transfer::Srgb), {0.5, 0.5}, Filter::Bilinear, value);
  EXPECT_NEAR(encoded(value[0], Transfer::Srgb, 0, 2), 0.7354, 1e-4);
  EXPECT_NEAR(encoded(value[1], Transfer::Srgb, 1, 2), 0.5, 1e-6);
  sample(raster, ColorDecoder(raster, Transfer::Linear), {0.5, 0.5}, Filter::Bilinear, value);
  EXPECT_NEAR(value[0], 0.5, 1e-6);
}

TEST(Raster, BeyondTheSquareItRepeatsClampsOrMirrorsEachWay) {
  Raster raster(4, 2, 1, PixelDepth::Float);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) raster.set(x, y, 0, static_cast<float>(10 * y + x));
  const ColorDecoder decoder(raster, Transfer::Linear);
  const auto at = [&](double u, double v, Wrap along_u, Wrap along_v, Filter filter) {
    float value = -1;
    sample(raster, decoder, {u, v}, filter, &value, {along_u, along_v});
    return value;
  };
  for (const Filter filter : {Filter::Nearest, Filter::Bilinear}) {
    for (const double whole : {-2.0, 4.0}) {
      EXPECT_EQ(at(whole + 0.375, 0.75, Wrap::Mirror, Wrap::Repeat, filter), 1);
      EXPECT_EQ(at(whole + 1.375, 0.75, Wrap::Mirror, Wrap::Repeat, filter), 2);
      EXPECT_EQ(at(whole + 1.375, 1.25, Wrap::Repeat, Wrap::Mirror, filter), 1);
    }
    EXPECT_EQ(at(-3, 0.75, Wrap::Clamp, Wrap::Repeat, filter), 0);
    EXPECT_EQ(at(7, 0.75, Wrap::Clamp, Wrap::Repeat, filter), 3);
    EXPECT_EQ(at(0.375, 9, Wrap::Repeat, Wrap::Clamp, filter), 1);
    EXPECT_EQ(at(0.375, -9, Wrap::Repeat, Wrap::Clamp, filter), 11);
  }
  EXPECT_EQ(at(1, 0.75, Wrap::Repeat, Wrap::Repeat, Filter::Bilinear), 1.5);
  EXPECT_EQ(at(1, 0.75, Wrap::Clamp, Wrap::Repeat, Filter::Bilinear), 3);
  EXPECT_EQ(at(1, 0.75, Wrap::Mirror, Wrap::Repeat, Filter::Bilinear), 3);
}

TEST(Raster, TexelsHaveTheirCentersAtHalfAndRepeat) {
  Raster raster(4, 2, 1, PixelDepth::Float);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) raster.set(x, y, 0, static_cast<float>(10 * y + x));
  const ColorDecoder decoder(raster, Transfer::Linear);
  for (const Filter filter : {Filter::Nearest, Filter::Bilinear})
    for (const double around : {-1.0, 0.0, 2.0}) {
      float value = -1;
      sample(raster, decoder, {0.375 + around, 0.75 + around}, filter, &value);
      EXPECT_EQ(value, 1);  // the upper row has large v
      sample(raster, decoder, {0.875 + around, 0.25 + around}, filter, &value);
      EXPECT_EQ(value, 13);
    }
  float value = -1;
  sample(raster, decoder, {0.5, 0.5}, Filter::Bilinear, &value);
  EXPECT_EQ(value, 6.5F);
}

TEST(Raster, PaddingIsFromTheNearest) {
  constexpr int kWidth = 40, kHeight = 30, kPadding = 5;
  std::mt19937 random(4);
  std::vector<Texel> texels(kWidth * kHeight, Texel::Empty);
  Raster raster(kWidth, kHeight, 1, PixelDepth::Float);
  for (int k = 0; k < 12; ++k) {
    const int x = static_cast<int>(random() % kWidth), y = static_cast<int>(random() % kHeight);
    texels[static_cast<std::size_t>(y * kWidth + x)] = k % 2 ? Texel::Centre : Texel::Part;
    raster.set(x, y, 0, static_cast<float>(y * kWidth + x + 1));
  }
  texels[0] = Texel::Miss;
  raster.set(0, 0, 0, 0);
  fill_from_nearest(raster, texels, kPadding);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      int least = std::numeric_limits<int>::max();
      for (int b = 0; b < kHeight; ++b)
        for (int a = 0; a < kWidth; ++a) {
          const Texel texel = texels[static_cast<std::size_t>(b * kWidth + a)];
          if (texel == Texel::Centre || texel == Texel::Part)
            least = std::min(least, (a - x) * (a - x) + (b - y) * (b - y));
        }
      const int from = static_cast<int>(raster.value(x, y, 0)) - 1;
      const bool is_filled = least <= kPadding * kPadding || (x == 0 && y == 0);
      ASSERT_EQ(from >= 0, is_filled) << x << ' ' << y;
      if (!is_filled) continue;
      const int a = from % kWidth - x, b = from / kWidth - y;
      EXPECT_EQ(a * a + b * b, least) << x << ' ' << y;
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
