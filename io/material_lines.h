// Lines of a material library (.mtl) of Wavefront that name images: `map_Kd -o 1 1 wood.png`.
//
//   if (const std::optional<MaterialImage> image = material_image("bump -bm 0.5 my scratches.png"))
//     image->name;   // my scratches.png
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace majorant {

// The first word of a line, and the rest, without space around them.
std::pair<std::string_view, std::string_view> split_keyword(std::string_view line);

// Returns whether lines that begin with this word name an image: map_ and anything, bump, norm,
// disp, decal, refl.
bool is_image_keyword(std::string_view word);

struct MaterialImage {
  struct Option {
    std::string_view name;                 // -mm
    std::vector<std::string_view> values;  // 0 1
  };
  std::string_view keyword;  // map_Kd
  std::vector<Option> options;
  std::string name;  // relative to the folder of the library; \ is /
};

// None where the line names no image. The name is what follows the options and their values, with
// blanks in it.
std::optional<MaterialImage> material_image(std::string_view line);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
