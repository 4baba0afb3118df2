// OpenEXR images, if the library is in the build. Only one source file uses this.
#pragma once

#include <string>
#include <vector>

#include "majorant/pictures/images/raster.h"

namespace majorant {

// Decodes Y, Y A, R G B or R G B A as floats. Throws the errors of read_image().
Raster decode_exr(const std::string& path, const std::string& bytes);
// Encodes 32-bit floats with ZIP. channels: their names, or none. Throws Error(Usage) if OpenEXR
// fails.
std::string encode_exr(const Raster& image, const std::vector<std::string>& channels);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
