// Pictures of pixels, and the .png files they are kept in.
#pragma once

#include <string>
#include <vector>

#include "majorant/pictures/images/color.h"
#include "majorant/pictures/images/raster.h"

namespace majorant {

struct PixelImage {
  int width = 0, height = 0;
  std::vector<Color> pixels;             // row by row from the top
  std::vector<std::uint8_t> alpha = {};  // of each of them; none: all opaque

  Color& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const Color& at(int x, int y) const { return const_cast<PixelImage*>(this)->at(x, y); }
};

// The bytes of a file, the same for the same pixels. Throws Error(Usage) where libpng fails.
std::string encode_png(const PixelImage& image);

// A PNG of any colours and depths as 8-bit RGB, transparent parts on white. bytes: of the file.
// Throws Error(Unreadable), naming the file, for what is no .png or too large.
PixelImage pixels_of_png(const std::string& path, const std::string& bytes);

// The numbers of a PNG, 1 to 4 channels of 8 or 16 bits; fewer bits, palettes and transparent
// colours as 8 bits a channel. bytes: of the file. Throws as read_image() (image_file.h).
Raster decode_png(const std::string& path, const std::string& bytes);
// 8 or 16 bits; says that colours are sRGB where they are. Throws Error(Usage) for floats, more
// than 4 channels, and where libpng fails.
std::string encode_png(const Raster& image, Transfer transfer);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
