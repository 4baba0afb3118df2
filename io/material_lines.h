// Lines of a Wavefront material library (.mtl) that name images: `map_Kd -o 1 1 wood.png`.
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

// Returns the first word of a line, and the rest without surrounding space.
std::pair<std::string_view, std::string_view> split_keyword(std::string_view line);

// Returns whether lines with this first word name an image: map_*, bump, norm, disp, decal, refl.
bool is_image_keyword(std::string_view word);

struct MaterialImage {
  struct Option {
    std::string_view name;                 // -mm
    std::vector<std::string_view> values;  // 0 1
  };
  std::string_view keyword;  // map_Kd
  std::vector<Option> options;
  std::string name;  // relative to the folder of the library, with slashes
};

// Returns none if the line names no image. The name is the text after the options, and may contain
// blanks.
std::optional<MaterialImage> material_image(std::string_view line);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
