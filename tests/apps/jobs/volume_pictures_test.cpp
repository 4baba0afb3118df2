// Pictures of volume meshes can be stopped at any time.
#include "majorant/apps/jobs/volume_pictures.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "counted_stop.h"

namespace majorant {
namespace {

// Returns this number of separate tetrahedra.
VolumeMesh apart(Index count) {
  VolumeMesh mesh;
  mesh.points.resize(4 * count, 3);
  CellBlock& block = mesh.blocks.emplace_back();
  block.type = {CellShape::Tetrahedron, 1};
  block.nodes.resize(count, 4);
  for (Index k = 0; k < count; ++k) {
    mesh.points.middleRows(4 * k, 4) << 0, 0, 2 * k, 1, 0, 2 * k, 0, 1, 2 * k, 0, 0, 2 * k + 1;
    for (Index c = 0; c < 4; ++c) block.nodes(k, c) = 4 * k + c;
    block.numbers.push_back(k);
    block.regions.push_back(0);
  }
  return mesh;
}

TEST(VolumePictures, EndWhereTheyAreStopped) {
  const Index count = 1500;
  const VolumeMesh mesh = apart(count);
  const VolumeCheck check = check_volume_mesh(mesh);
  const CountedStop counted;
  const SpacePicture picture = picture_of_elements(mesh, check, 3, counted.check());
  EXPECT_GE(counted.polls(), count);
  EXPECT_EQ(picture.triangles.size(), 4u * static_cast<std::size_t>(count));
  for (const long last : {1L, 700L, counted.polls() - 1})
    EXPECT_THROW(picture_of_elements(mesh, check, 3, CountedStop(last).check()), Stopped) << last;
  const auto path = std::filesystem::temp_directory_path() /
                    ("majorant_stopped_" + std::to_string(::getpid()) + ".png");
  EXPECT_THROW(write_space_png(path, picture, CountedStop(2).check()), Stopped);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
