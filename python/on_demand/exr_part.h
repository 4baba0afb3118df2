// The content of _exr.so, which the module loads on demand. It exports one symbol, `majorant_part`.
#pragma once

#include <string>
#include <vector>

#include "majorant/pictures/images/raster.h"

namespace majorant::python {

struct ExrPart {
  Raster (*decode)(const std::string& path, const std::string& bytes);
  std::string (*encode)(const Raster& image, const std::vector<std::string>& channels);
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
