// JPEG images, by libjpeg; seen by one source file.
#pragma once

#include <string>

#include "majorant/pictures/images/raster.h"

namespace majorant {

// 1 or 3 channels of 8 bits. Throws as read_image().
Raster decode_jpeg(const std::string& path, const std::string& bytes);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
