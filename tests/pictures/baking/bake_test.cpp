// Tests the contents of texels: positions on the surface for straight and curved layouts, thin
// charts, overlaps, misses.
#include "majorant/pictures/baking/bake.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "counted_stop.h"
#include "majorant/framework/parallel.h"
#include "majorant/pictures/baking/texel_grid.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// A grid of heights `bumpy`, whose layout is its projection to the plane, scaled into the unit
// square.
BezierMap plane_map(int n, int degree) {
  const auto mesh = surface(grid(n, bumpy));
  Vec uv(2 * mesh->vertex_count());
  for (Index v = 0; v < mesh->vertex_count(); ++v)
    uv.segment<2>(2 * v) = Vector2(0.1, 0.2) + 0.7 * mesh->positions().row(v).head<2>().transpose();
  return elevated_to(BezierMap::linear(mesh, uv), degree);
}

BakeOptions floats(int width, int height) {
  BakeOptions options;
  options.width = width;
  options.height = height;
  options.padding = 0;
  options.depth = PixelDepth::Float;
  return options;
}

TEST(Bake, PositionsOfTexelCenters) {
  for (const int degree : {1, 2, 3}) {
    const BezierMap map = degree == 1 ? plane_map(6, 1) : shaken(plane_map(6, degree), 2e-3, 5);
    const auto same = same_places(map.mesh(), map.mesh());
    ASSERT_TRUE(same);
    const BakedImage baked =
        bake(InverseMap(map), floats(64, 48), *same, position_values(map.mesh()));
    EXPECT_EQ(baked.counts.texels, 64 * 48);
    EXPECT_EQ(baked.counts.doubly_covered, 0);
    EXPECT_EQ(baked.counts.undecided, 0);
    EXPECT_EQ(baked.counts.misses, 0);
    EXPECT_EQ(baked.counts.charts, 1);
    EXPECT_EQ(baked.counts.charts_without_texels, 0);
    EXPECT_GT(baked.counts.partly, 50);
    EXPECT_NEAR(static_cast<double>(baked.counts.covered), 0.49 * 64 * 48, 60);
    if (degree > 1) continue;
    const TexelGrid texels(64, 48);
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) {
        const Vector2 at = (texels.center(x, y) - Vector2(0.1, 0.2)) / 0.7;
        if (at.minCoeff() < 0 || at.maxCoeff() > 1) continue;
        for (const int c : {0, 1}) EXPECT_NEAR(baked.image.value(x, y, c), at[c], 1e-6);
      }
  }
}

TEST(Bake, SameForAnyNumberOfThreads) {
  const BezierMap map = shaken(plane_map(5, 2), 2e-3, 6);
  const SurfaceTree tree(map.mesh().positions(), map.mesh().faces());
  BakeOptions options = floats(50, 70);
  options.padding = 3;
  const auto once = [&](int threads, int samples) {
    const ThreadCount count(threads);
    options.samples = samples;  // not more than one: texels around charts are levelled as well
    return bake(InverseMap(map), options, nearest_places(map.mesh(), tree, 1),
                position_values(map.mesh()))
        .image.bytes();
  };
  const auto bytes = [](const std::vector<unsigned char>& all) {
    return std::string(all.begin(), all.end());
  };
  for (const int samples : {1, 2}) EXPECT_EQ(bytes(once(1, samples)), bytes(once(4, samples)));
}

TEST(Bake, ChartsThinnerThanATexelHaveTexels) {
  // Triangles between the centres of two columns, one of them as thin as doubles allow.
  const auto mesh = surface(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  for (const Vector2& across : {Vector2(1e-9, 0), Vector2(1e-16, 0)}) {
    Vec uv(6);
    uv << Vector2(0.26, 0.3), Vector2(0.26, 0.3) + across, Vector2(0.26, 0.8);
    const BezierMap map = BezierMap::linear(mesh, uv);
    const BakedImage baked =
        bake(InverseMap(map), floats(8, 8), *same_places(*mesh, *mesh), position_values(*mesh));
    EXPECT_EQ(baked.counts.covered, 0);
    EXPECT_EQ(baked.counts.charts_without_texels, 0);
    EXPECT_EQ(baked.counts.partly, 5);
    EXPECT_NEAR(baked.image.value(2, 3, 1), (0.5625 - 0.3) / 0.5, 0.02);
  }
}

// A bumpy square, cut at x = 1/2; its halves are separate charts, one of them rotated and smaller.
BezierMap apart(const SurfaceMesh& square) {
  std::vector<char> is_cut(square.opposites().size(), 0);
  const auto is_middle = [&](Index v) { return square.positions()(v, 0) == 0.5; };
  for (Index h = 0; h < square.half_edge_count(); ++h)
    is_cut[to_size(h)] = is_middle(square.from_vertex(h)) && is_middle(square.to_vertex(h));
  const auto mesh = std::make_shared<const SurfaceMesh>(square.cut_along(is_cut, nullptr));
  Vec uv(2 * mesh->vertex_count());
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const bool is_left = mesh->positions()(mesh->faces()(f, 0), 0) +
                             mesh->positions()(mesh->faces()(f, 1), 0) +
                             mesh->positions()(mesh->faces()(f, 2), 0) <
                         1.5;
    for (Index k = 0; k < 3; ++k) {
      const Index v = mesh->faces()(f, k);
      const double x = mesh->positions()(v, 0), y = mesh->positions()(v, 1);
      uv.segment<2>(2 * v) = is_left ? Vector2(0.05 + 0.8 * x, 0.1 + 0.8 * y)
                                     : Vector2(0.95 - 0.35 * y, 0.1 + 0.35 * x);
    }
  }
  return BezierMap::linear(mesh, uv);
}

TEST(Bake, BothSidesOfACutLookAlike) {
  const BezierMap map = apart(*surface(grid(4, flat)));
  BakeOptions options = floats(96, 64);
  options.padding = 1;
  const BakedImage baked = bake(InverseMap(map), options, *same_places(map.mesh(), map.mesh()),
                                position_values(map.mesh()));
  EXPECT_EQ(baked.counts.charts, 2);
  const ColorDecoder decoder(baked.image, Transfer::Linear);
  for (int k = 20; k <= 180; ++k) {  // away from the border, beyond which there is no continuation
    const double y = k / 200.0;
    for (const Vector2& uv :
         {Vector2(0.05 + 0.8 * 0.5, 0.1 + 0.8 * y), Vector2(0.95 - 0.35 * y, 0.1 + 0.35 * 0.5)}) {
      std::array<float, 3> value{};
      sample(baked.image, decoder, uv, Filter::Bilinear, value.data());
      EXPECT_NEAR(value[0], 0.5, 1e-5) << uv.transpose();
      EXPECT_NEAR(value[1], y, 1e-5) << uv.transpose();
    }
  }
}

// The surface beyond a fold leaves the plane of the face before it.
TEST(Bake, BothSidesOfAFoldLookAlike) {
  const BezierMap map =
      apart(*surface(grid(4, [](double x, double) { return std::max(x - 0.5, 0.0); })));
  BakeOptions options = floats(64, 64);
  options.padding = 1;
  const auto same = same_places(map.mesh(), map.mesh());
  const BakedImage baked = bake(InverseMap(map), options, *same, position_values(map.mesh()));
  const ColorDecoder decoder(baked.image, Transfer::Linear);
  for (int k = 20; k <= 180; ++k) {
    const double y = k / 200.0;
    for (const Vector2& uv :
         {Vector2(0.05 + 0.8 * 0.5, 0.1 + 0.8 * y), Vector2(0.95 - 0.35 * y, 0.1 + 0.35 * 0.5)}) {
      std::array<float, 3> value{};
      sample(baked.image, decoder, uv, Filter::Bilinear, value.data());
      EXPECT_NEAR(value[2], 0, 2e-4) << uv.transpose();  // texels are 0.02 and 0.04 wide
    }
  }
  const TexelGrid texels(64, 64);
  const InverseMap layout(map);
  int centers = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (const Preimage& found : layout.preimages(texels.center(x, y))) {
        std::array<float, 3> value{};
        position_values(map.mesh()).at({found.face, found.barycentric}, value.data());
        for (const int c : {0, 1, 2})
          EXPECT_EQ(baked.image.value(x, y, c), value[to_size(c)]) << x << ' ' << y;
        ++centers;
      }
  EXPECT_GT(centers, 1000);
}

// A fold inside both charts that ends at the cut, which no texel around the charts can correct.
// Levelling changes pictures there, but not measurements.
TEST(Bake, FoldsThatEndAtACut) {
  const BezierMap map = apart(*surface(grid(4, flat)));
  const auto same = same_places(map.mesh(), map.mesh());
  SurfaceValues values{
      1, [positions = position_values(map.mesh())](const SurfacePlace& place, float* value) {
        std::array<float, 3> p{};
        positions.at(place, p.data());
        *value = p[1] + std::abs(p[1] - 0.5F);
      }};
  BakeOptions options = floats(64, 64);
  options.padding = 1;
  const auto most_apart = [&](const Raster& image) {
    const ColorDecoder decoder(image, Transfer::Linear);
    float most = 0;
    for (int k = 20; k <= 180; ++k) {
      const double y = k / 200.0;
      float left = 0, right = 0;
      sample(image, decoder, {0.45, 0.1 + 0.8 * y}, Filter::Bilinear, &left);
      sample(image, decoder, {0.95 - 0.35 * y, 0.275}, Filter::Bilinear, &right);
      most = std::max(most, std::abs(left - right));
    }
    return most * 255;  // values from 0.5 to 1.5
  };
  const Raster exact = bake(InverseMap(map), options, *same, values).image;
  values.course = Continuation::Picture;
  const Raster closed = bake(InverseMap(map), options, *same, values).image;
  EXPECT_GT(most_apart(exact), 1);
  EXPECT_LT(most_apart(closed), 1);
  const TexelGrid texels(64, 64);
  const InverseMap layout(map);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (const Preimage& found : layout.preimages(texels.center(x, y))) {
        float value = 0;
        values.at({found.face, found.barycentric}, &value);
        EXPECT_EQ(exact.value(x, y, 0), value);
        EXPECT_LE(std::abs(closed.value(x, y, 0) - value), 3.01 / 255);
      }
}

TEST(Bake, LevellingHasNoUnit) {
  const BezierMap map =
      apart(*surface(grid(4, [](double x, double) { return std::abs(x - 0.5); })));
  BakeOptions options = floats(64, 64);
  options.padding = 1;
  const auto same = same_places(map.mesh(), map.mesh());
  const auto image_in = [&](float unit) {
    SurfaceValues values = position_values(map.mesh());
    values.at = [at = values.at, unit](const SurfacePlace& place, float* value) {
      at(place, value);
      for (int c = 0; c < 3; ++c) value[c] *= unit;
    };
    return bake(InverseMap(map), options, *same, values).image;
  };
  const float unit = 1.0F / 1024;
  const Raster model = image_in(1), small = image_in(unit);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (const int c : {0, 1, 2})
        // the texel has a value
        if (const float value = model.value(x, y, c); !std::isnan(value)) {
          EXPECT_EQ(small.value(x, y, c), unit * value) << x << ' ' << y;
        }
}

TEST(Bake, NumbersOfFacesAreNotContinued) {
  const BezierMap map = apart(*surface(grid(4, flat)));
  BakeOptions options = floats(96, 64);
  options.padding = 2;
  const BakedImage baked =
      bake(InverseMap(map), options, *same_places(map.mesh(), map.mesh()), face_values(map.mesh()));
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 48; ++x) {  // around the left half
      const float face = baked.image.value(x, y, 0);
      if (face < 0) continue;
      EXPECT_EQ(static_cast<int>(face) / 2 % 4 < 2, true) << x << ' ' << y;
    }
}

TEST(Bake, CountsOverlapsAndMisses) {
  const auto mesh = surface(grid(1, flat));  // two faces
  Vec uv(8);
  for (Index v = 0; v < 4; ++v) uv.segment<2>(2 * v) = mesh->positions().row(v).head<2>();
  const Vec flat_uv = uv;
  uv.segment<2>(2 * 1) = Vector2(0.1, 0.8);  // (1, 0) folded over the diagonal
  const BakedImage folded = bake(InverseMap(BezierMap::linear(mesh, uv)), floats(16, 16),
                                 *same_places(*mesh, *mesh), position_values(*mesh));
  EXPECT_GT(folded.counts.doubly_covered, 20);
  const auto far = surface(polygon_mesh({{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}, {{0, 1, 2}}));
  const SurfaceTree tree(far->positions(), far->faces());
  EXPECT_FALSE(same_places(*mesh, *far));
  const BakedImage partial = bake(InverseMap(BezierMap::linear(mesh, flat_uv)), floats(16, 16),
                                  nearest_places(*mesh, tree, 0.05), face_values(*far));
  EXPECT_EQ(partial.counts.covered, 256);
  EXPECT_EQ(partial.counts.doubly_covered, 0);
  EXPECT_NEAR(static_cast<double>(partial.counts.misses), 256 - 36 - 13, 12);
  for (int k = 0; k < 16; ++k) EXPECT_EQ(partial.image.value(k, k, 0), 0);  // filled by padding
}

TEST(Bake, DensityAndStops) {
  const BezierMap map = plane_map(4, 1);
  const TexelDensity density = texel_density(map, 100, 100);
  EXPECT_LE(density.min, density.mean);
  EXPECT_LE(density.mean, density.max);
  EXPECT_NEAR(density.max, 70, 2);  // at a flat part
  EXPECT_THROW(bake(InverseMap(map), floats(64, 64), *same_places(map.mesh(), map.mesh()),
                    position_values(map.mesh()), CountedStop(3).check()),
               Stopped);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
