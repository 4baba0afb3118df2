#include "majorant/pictures/color_scale.h"

#include "expected_error.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/pictures/internal/density_probe.h"

namespace majorant {
namespace {

std::vector<ColorScale> fixed_scales() {
  std::vector<ColorScale> scales;
  for (const Quantity quantity : kQuantities)
    scales.push_back(color_scale(quantity, {{symmetric_dirichlet(), 1.0}}));
  return scales;
}

TEST(ColorScale, EqualStepsLookEqual) {
  constexpr int kStep = 15;  // of 255 codes, so that rounding to 8 bits is small
  for (const ColorScale& scale : fixed_scales()) {
    double least = 1e9, most = 0;
    for (std::size_t k = 0; k + kStep < ColorScale::kColors; k += kStep) {
      // A step across the middle is shorter, since it cuts the corner between the two arms.
      if (scale.shape() == ColorScale::Shape::Diverging && k < 128 && k + kStep > 127) continue;
      const double step =
          (to_oklab(scale.colors()[k + kStep]) - to_oklab(scale.colors()[k])).norm();
      least = std::min(least, step);
      most = std::max(most, step);
    }
    EXPECT_LT(most, 1.08 * least) << scale.label();
    EXPECT_GT(least, 0.03) << scale.label();
  }
}

TEST(ColorScale, IsometryIsNeutralAndLightnessFallsFromThere) {
  for (const ColorScale& scale : fixed_scales()) {
    const double middle = scale.position(scale.neutral());
    EXPECT_EQ(middle, scale.shape() == ColorScale::Shape::Sequential ? 0.0 : 0.5);
    const Oklab neutral = to_oklab(scale.color(scale.neutral()));
    EXPECT_LT(neutral.tail<2>().norm(), 0.02) << scale.label();
    EXPECT_NEAR(neutral[0], 0.93, 0.01) << scale.label();
    for (double t = middle; t + 0.05 <= 1; t += 0.05)
      EXPECT_GT(to_oklab(scale.color_at(t))[0], to_oklab(scale.color_at(t + 0.05))[0]);
    for (double t = middle; t - 0.05 >= 0; t -= 0.05)
      EXPECT_GT(to_oklab(scale.color_at(t))[0], to_oklab(scale.color_at(t - 0.05))[0]);
  }
}

TEST(ColorScale, PositionsAreMonotoneAndInverted) {
  for (const ColorScale& scale : fixed_scales()) {
    EXPECT_EQ(scale.position(scale.low()), 0);
    EXPECT_EQ(scale.position(scale.high()), 1);
    for (int k = 0; k <= 100; ++k)
      EXPECT_NEAR(scale.position(scale.value(k / 100.0)), k / 100.0, 1e-12);
    double last = -1;
    for (double v = 0.9 * scale.low(); v < 1.1 * scale.high(); v *= 1.01) {
      EXPECT_GE(scale.position(v), last);
      last = scale.position(v);
    }
    for (const double v : {-1e300, -1.0, 0.0}) EXPECT_EQ(scale.position(v), 0);
    for (const double v : {1e300, std::numeric_limits<double>::infinity(), std::nan("")})
      EXPECT_EQ(scale.position(v), 1);
  }
  const ColorScale area = color_scale(Quantity::Area, {});
  EXPECT_NEAR(area.position(0.5), 1 / 3.0, 1e-12);
  EXPECT_NEAR(area.position(8 / 2.0), 5 / 6.0, 1e-12);
  EXPECT_NEAR(color_scale(Quantity::Angle, {}).position(2), 1 / 3.0, 1e-12);
}

TEST(ColorScale, DensitiesStartAtTheirIsometry) {
  for (const NamedEnergy& energy : named_energies()) {
    const ColorScale scale = color_scale(Quantity::Density, {{energy.make, 0.5}});
    const DensityProbe probe({{energy.make, 0.5}});
    EXPECT_EQ(scale.low(), probe.at(1, 1)) << energy.name;
    EXPECT_EQ(scale.position(probe.at(1, 1)), 0) << energy.name;
    EXPECT_NEAR(scale.position(probe.at(2, 1)), std::log(2) / std::log(17), 1e-12) << energy.name;
  }
  const ColorScale sum = color_scale(
      Quantity::Density, {{symmetric_dirichlet(), 1.0}, {find_energy("mips")->make, 0.5}});
  EXPECT_EQ(sum.low(), 5);
  EXPECT_NEAR(color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}}).high(), 40, 1e-9);
}

TEST(ColorScale, TicksAreEvenAndIncludeTheEnds) {
  const auto labels = [](const ColorScale& scale) {
    std::string all;
    for (const ColorScale::Tick& tick : scale.ticks()) {
      all += (all.empty() ? "" : " ") + tick.label;
      EXPECT_EQ(tick.position, scale.position(tick.value));
    }
    return all;
  };
  EXPECT_EQ(labels(color_scale(Quantity::Area, {})), "1/8 1/4 1/2 1 2 4 8");
  EXPECT_EQ(labels(color_scale(Quantity::SigmaMin, {})), "1/4 1/2 1 2 4");
  EXPECT_EQ(labels(color_scale(Quantity::Angle, {})), "1 2 4 8");
  const ColorScale density = color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}});
  EXPECT_EQ(labels(density), "4 6 8 15 25 40");
  EXPECT_EQ(labels(density.with_range(4, 4.01)), "4 4.002 4.004 4.006 4.008 4.01");
  EXPECT_EQ(labels(color_scale(Quantity::Area, {}).with_range(0.7, 1.2)), "0.7 0.8 0.95 1 1.1 1.2");
  for (const NamedEnergy& energy : named_energies()) {
    const auto ticks = color_scale(Quantity::Density, {{energy.make, 1.0}}).ticks();
    for (std::size_t k = 1; k < ticks.size(); ++k)
      EXPECT_GT(ticks[k].position, ticks[k - 1].position + 0.07) << energy.name;
  }
}

TEST(ColorScale, RefusesRangesWithoutTheIsometry) {
  const ColorScale area = color_scale(Quantity::Area, {});
  EXPECT_EQ(error_message(ErrorKind::Usage, [&] { area.with_range(1, 8); }),
            "a range of colours from 1 to 8: area distortion is 1 at isometry, which has to be "
            "inside");
  const ColorScale angle = color_scale(Quantity::Angle, {});
  EXPECT_EQ(error_message(ErrorKind::Usage, [&] { angle.with_range(0.5, 8); }),
            "a range of colours from 0.5: angle distortion is 1 at isometry and never below; "
            "start there");
  error_message(ErrorKind::Usage, [&] { angle.with_range(8, 8); });
  error_message(ErrorKind::Usage, [&] { angle.with_range(1, std::nan("")); });
  error_message(ErrorKind::Usage, [&] { color_scale(Quantity::Density, {}); });
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
