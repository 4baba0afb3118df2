// OpenEXR images, where the library was built with it; seen by one source file.
#pragma once

#include <string>
#include <vector>

#include "majorant/pictures/images/raster.h"

namespace majorant {

// Y, Y A, R G B or R G B A as floats. Throws as read_image().
Raster decode_exr(const std::string& path, const std::string& bytes);
// 32 bit floats, ZIP. channels: their names, or none. Throws Error(Usage) where OpenEXR fails.
std::string encode_exr(const Raster& image, const std::vector<std::string>& channels);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
