// Files of images as numbers: what is baked from and into.
//
//   const Raster image = read_image("wood.jpg");
//   const std::string bytes = encode_image("out.png", image, {});
//
//     .png   8 and 16 bits a channel, 1 to 4 channels; palettes and transparent colours as colours
//     .jpg   read only; grey and colour
//     .exr   OpenEXR, 32 bit floats, where the library was built with it
//     .npy   an array of numpy, float32 or the codes of integer depths; height by width by channels
//
// Sizes that a header claims are believed only as far as the file could hold them and memory has
// room, before anything is unpacked.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/pictures/images/raster.h"

namespace majorant {

inline constexpr int kLargestImage = 16384;  // pixels on a side, of what is read

bool has_exr();  // whether this build reads and writes OpenEXR
// Of this build, for messages: ".png", ...
std::vector<std::string> readable_images();
std::vector<std::string> writable_images();

// Throws Error(Unreadable) for what is no such image, damaged, truncated or too large;
// Error(Unsupported) naming the format for those that are known and not read (KTX2, WebP, EXR where
// it was left out), for CMYK, and for more than memory has; Stopped.
Raster read_image(const std::string& path, const StopCheck& stop = {});

// The same of the bytes of a PNG or JPEG, which say themselves what they are. name: for messages.
Raster decode_image(const std::string& name, const std::string& bytes);

struct ImageLabels {
  Transfer transfer = Transfer::Linear;  // PNG says so where it is Srgb
  std::vector<std::string> channels;     // of EXR; empty: Y, Y A, R G B, R G B A
};
// The bytes of a file, the same for the same pixels. Throws Error(Usage) where the format does not
// hold such an image.
std::string encode_image(const std::string& path, const Raster& image, const ImageLabels& labels);

// Numbers of a .npy file, n or n by k, integer or float, as rows. Throws Error(Unreadable);
// Stopped.
RowMatrix read_npy_rows(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
