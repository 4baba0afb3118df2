// JPEG images, by libjpeg. Only one source file uses this.
#pragma once

#include <string>

#include "majorant/pictures/images/raster.h"

namespace majorant {

// Decodes 1 or 3 channels of 8 bits. Throws the errors of read_image().
Raster decode_jpeg(const std::string& path, const std::string& bytes);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
