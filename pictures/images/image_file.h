// Reads and writes image files, the sources and results of baking.
//
//   const Raster image = read_image("wood.jpg");
//   const std::string bytes = encode_image("out.png", image, {});
//
//     .png   8 and 16 bits a channel, 1 to 4 channels; palettes and transparent colours as colours
//     .jpg   read only; grey and colour
//     .exr   OpenEXR, 32-bit floats, if the library was built with it
//     .npy   an array of numpy, float32 or the codes of integer depths; height by width by channels
//
// Sizes in headers are checked against the size of the file and the free memory before anything is
// unpacked.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/pictures/images/raster.h"

namespace majorant {

inline constexpr int kLargestImage = 16384;  // pixels per side, for reading

bool has_exr();  // whether this build supports OpenEXR
// These return the extensions that this build supports, for messages: ".png", ...
std::vector<std::string> readable_images();
std::vector<std::string> writable_images();

// Throws Error(Unreadable) for other files, and for damaged, truncated or too large ones;
// Error(Unsupported) for known formats without a reader (KTX2, WebP, EXR without the library), for
// CMYK, and if memory is short; Stopped.
Raster read_image(const std::string& path, const StopCheck& stop = {});

// Decodes the bytes of a PNG or JPEG, recognized by their content. name: for messages.
Raster decode_image(const std::string& name, const std::string& bytes);

struct ImageLabels {
  Transfer transfer = Transfer::Linear;  // a PNG records Srgb
  std::vector<std::string> channels;     // for EXR; empty: Y, Y A, R G B, R G B A
};
// Returns the bytes of a file; equal pixels give equal bytes. Throws Error(Usage) if the format
// cannot hold such an image.
std::string encode_image(const std::string& path, const Raster& image, const ImageLabels& labels);

// Returns the rows of a .npy file, n or n by k, integer or float. Throws Error(Unreadable);
// Stopped.
RowMatrix read_npy_rows(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
