// A picture of triangles in space from one side, without perspective, painted from back to front: a
// cut through a volume mesh with marks over it.
//
//   SpacePicture picture;
//   picture.title = "part.msh: 2 of 384 elements are not valid";
//   const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 0, 1);
//   picture.triangles.push_back({{a, b, c}, Color{200, 200, 200}});
//   write_space_png("part.png", picture);
//
// Not for triangles that pierce each other, which painting order cannot show.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/pictures/color_scale.h"

namespace majorant {

struct SpaceTriangle {
  std::array<Vector3, 3> corners;
  Color color;  // if it faces the eye; darker at steeper angles
  // Flags: whether the side from a corner to the next one is drawn.
  std::array<bool, 3> has_edge{};
};

// A mark over all triangles.
struct SpaceMark {
  std::vector<std::array<Vector3, 2>> lines;
  Vector3 at;  // of the text
  std::string text;
};

struct SpacePicture {
  std::string title;
  Vector3 eye = Vector3(1, 0.7, 0.6);  // direction to the eye; z points up, or y if seen from above
  std::vector<SpaceTriangle> triangles;
  std::vector<SpaceMark> marks;
  // The colours below the picture from left to right, their quantity, and names of positions on
  // them, 0 to 1.
  std::string legend;
  std::vector<Color> colors;
  std::vector<std::pair<double, std::string>> ticks;
};

// Writes 1000 by 800 pixels. Throws Error(Unwritable).
void write_space_png(const std::string& path, const SpacePicture& picture,
                     const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
