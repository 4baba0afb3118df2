// OpenEXR images of the Python module, loaded from _exr.so.
#include "exr_part.h"
#include "loaded_symbol.h"
#include "majorant/pictures/images/image_file.h"
#include "majorant/pictures/images/internal/exr_file.h"

namespace majorant {
namespace {

const python::ExrPart& exr_part() {
  static const auto part =
      python::loaded_symbol<const python::ExrPart*>({"_exr.so", "OpenEXR", true}, "majorant_part");
  return *part;
}

}  // namespace

bool has_exr() { return true; }

Raster decode_exr(const std::string& path, const std::string& bytes) {
  return exr_part().decode(path, bytes);
}

std::string encode_exr(const Raster& image, const std::vector<std::string>& channels) {
  return exr_part().encode(image, channels);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
