// Pixel images and .png files.
#pragma once

#include <string>
#include <vector>

#include "majorant/pictures/images/color.h"
#include "majorant/pictures/images/raster.h"

namespace majorant {

struct PixelImage {
  int width = 0, height = 0;
  std::vector<Color> pixels;             // row by row from the top
  std::vector<std::uint8_t> alpha = {};  // of each pixel; empty: all opaque

  Color& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const Color& at(int x, int y) const { return const_cast<PixelImage*>(this)->at(x, y); }
};

// Returns the bytes of a file; equal pixels give equal bytes. Throws Error(Usage) if libpng fails.
std::string encode_png(const PixelImage& image);

// Returns a PNG of any colour type and depth as 8-bit RGB, with transparent parts on white. bytes:
// of the file. Throws Error(Unreadable), naming the file, if it is not a .png or too large.
PixelImage pixels_of_png(const std::string& path, const std::string& bytes);

// Returns the numbers of a PNG, 1 to 4 channels of 8 or 16 bits. Fewer bits, palettes and
// transparent colours become 8 bits a channel. bytes: of the file. Throws the errors of
// read_image() (image_file.h).
Raster decode_png(const std::string& path, const std::string& bytes);
// Encodes 8 or 16 bits, and records if colours are sRGB. Throws Error(Usage) for floats, for more
// than 4 channels, and if libpng fails.
std::string encode_png(const Raster& image, Transfer transfer);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
