// Limits of sizes in image headers.
#pragma once

#include <fmt/format.h>

#include <string>

#include "majorant/framework/error.h"
#include "majorant/io/files/reading_limit.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant {

// Call it before memory is allocated. bytes: of an unpacked pixel; compressed: of the file. Throws
// Error(Unreadable) for a size that is not positive, too large, or more than the file can expand
// to; Error(Unsupported) if memory is short.
inline void require_believable(const std::string& path, long width, long height, std::size_t bytes,
                               std::size_t compressed) {
  const auto fail = [&](const char* reason) {
    return Error(ErrorKind::Unreadable,
                 fmt::format("{}: {} x {} pixels {}", path, width, height, reason));
  };
  if (width < 1 || height < 1) throw fail("are no image");
  if (width > kLargestImage || height > kLargestImage)
    throw fail(fmt::format("are more than {} on a side", kLargestImage).c_str());
  const std::size_t unpacked =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * bytes;
  if (unpacked > ReadingLimit::kOnTop &&
      (unpacked - ReadingLimit::kOnTop) / ReadingLimit::kMaxExpansion > compressed)
    throw fail("are more than a file of its size holds; it is damaged or forged");
  ReadingLimit(path).require(unpacked + compressed);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
