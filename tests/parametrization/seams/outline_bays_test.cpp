// Reflex corners of outlines.
#include "majorant/parametrization/seams/internal/outline_bays.h"

#include <numeric>

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

struct Outline {
  Vec uv;
  std::vector<Index> loop;
};

// Returns the outline of a polygon with ten edges on each side.
Outline outline_of(const std::vector<Vector2>& corners) {
  Outline out;
  std::vector<double> uv;
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (int i = 0; i < 10; ++i) {
      const Vector2 p = corners[k] + 0.1 * i * (corners[(k + 1) % corners.size()] - corners[k]);
      uv.insert(uv.end(), {p.x(), p.y()});
    }
  out.uv = Eigen::Map<const Vec>(uv.data(), static_cast<Eigen::Index>(uv.size()));
  out.loop.resize(uv.size() / 2);
  std::iota(out.loop.begin(), out.loop.end(), 0);
  return out;
}

TEST(OutlineBays, AreaIsSigned) {
  Outline square = outline_of({{0, 0}, {3, 0}, {3, 2}, {0, 2}});
  EXPECT_NEAR(enclosed_area(square.uv, square.loop), 6, 1e-12);
  std::reverse(square.loop.begin(), square.loop.end());
  EXPECT_NEAR(enclosed_area(square.uv, square.loop), -6, 1e-12);
}

TEST(OutlineBays, EndAtInnerCorners) {
  const Outline square = outline_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  EXPECT_TRUE(bay_bottoms(square.uv, square.loop).empty());
  const Outline l = outline_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  EXPECT_EQ(bay_bottoms(l.uv, l.loop), std::vector<Index>{30});
  // A notch is deeper than a dent; a small wave is not a bay.
  const Outline two = outline_of({{0, 0},
                                  {4, 0},
                                  {4, 4},
                                  {3, 4},
                                  {2.5, 1},
                                  {2, 4},
                                  {1.2, 4},
                                  {1, 3.2},
                                  {0.8, 4},
                                  {0, 4},
                                  {0.05, 2}});
  EXPECT_EQ(bay_bottoms(two.uv, two.loop), (std::vector<Index>{40, 70}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
