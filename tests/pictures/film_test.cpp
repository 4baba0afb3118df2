#include <gtest/gtest.h>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/pictures/pictures.h"

namespace majorant {
namespace {

// Returns a map of one triangle whose third corner is at (0, height).
BezierMap triangle_map(double height) {
  PolygonMesh polygons;
  polygons.positions = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
  polygons.polygons = {{0, 1, 2}};
  const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(polygons));
  Vec uv(6);
  uv << 0, 0, 1, 0, 0, height;
  return BezierMap::linear(mesh, uv);
}

constexpr std::size_t kFrameBytes = 6 * 8;  // of the triangle at degree 2

// Shows iterations first to last to the film, with maps as high as their iteration. Returns the
// number of maps that it requested.
int show(Film& film, int first, int last) {
  const MapObserver watcher = film.watcher();
  const BezierMap map = triangle_map(1);
  int made = 0;
  for (int iteration = first; iteration <= last; ++iteration) {
    TraceEntry row;
    row.record.iteration = iteration;
    row.energy = 100 - iteration;
    const auto made_map = [&] {
      ++made;
      return triangle_map(1 + iteration);
    };
    EXPECT_EQ(watcher(row, {map.shared_space(), map.control_points(), made_map}),
              Directive::Continue);
  }
  return made;
}

std::vector<int> iterations_of(const std::vector<PageSnapshot>& frames) {
  std::vector<int> iterations;
  for (const PageSnapshot& frame : frames) iterations.push_back(frame.iteration);
  return iterations;
}

TEST(Film, TakesEveryKthMapAndTheResult) {
  Film film(3, 2);
  EXPECT_EQ(show(film, 0, 7), 3);  // other maps are not made
  const auto frames = film.frames({triangle_map(20).elevated(), 7, 5});
  EXPECT_EQ(iterations_of(frames), (std::vector<int>{0, 3, 6, 7}));
  EXPECT_EQ(film.count(7), frames.size());
  for (const PageSnapshot& frame : frames) EXPECT_EQ(frame.uv.rows(), 6);  // elevated
  EXPECT_EQ(frames[1].degree, 1);
  EXPECT_EQ(frames[1].energy, 97);
  EXPECT_EQ(frames[1].uv(2, 1), 4);
  EXPECT_EQ(frames[3].degree, 2);
  EXPECT_EQ(frames[3].uv(2, 1), 20);
}

TEST(Film, TheResultReplacesTheFrameOfItsIteration) {
  Film film(2, 2);
  show(film, 0, 4);
  const auto frames = film.frames({triangle_map(20).elevated(), 4, 5});
  EXPECT_EQ(iterations_of(frames), (std::vector<int>{0, 2, 4}));
  EXPECT_EQ(frames.back().uv(2, 1), 20);
  EXPECT_EQ(film.count(4), 3u);
}

TEST(Film, ForgetsEverySecondFrameWhenFull) {
  Film film(1, 2, 4 * kFrameBytes);
  show(film, 0, 3);
  EXPECT_EQ(film.every(), 1);
  show(film, 4, 4);
  EXPECT_EQ(film.every(), 2);
  show(film, 5, 20);
  EXPECT_EQ(film.every(), 8);
  EXPECT_EQ(iterations_of(film.frames({triangle_map(1).elevated(), 20, 0})),
            (std::vector<int>{0, 8, 16, 20}));
}

TEST(Film, StartsThatWereSeenAreNotTakenAgain) {
  Film film(1, 2);
  show(film, 0, 3);
  EXPECT_EQ(show(film, 3, 4), 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
