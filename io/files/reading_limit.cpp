#include "majorant/io/files/reading_limit.h"

#include <fmt/format.h>

#include <cstdlib>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/available_memory.h"

namespace majorant {
namespace {

std::string megabytes(std::size_t bytes) {
  return fmt::format("{:.3g} MB", static_cast<double>(bytes) / 1e6);
}

}  // namespace

std::optional<std::size_t> reading_memory() {
  if (const char* override_bytes = std::getenv("MAJORANT_READING_BYTES"))
    return std::strtoull(override_bytes, nullptr, 10);
  return free_memory();
}

ReadingLimit::ReadingLimit(std::string file)
    : file_(std::move(file)),
      free_(reading_memory().value_or(std::numeric_limits<std::size_t>::max())) {}

void ReadingLimit::require(std::size_t bytes) const {
  if (bytes > free_)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: reading it takes more than {}, and {} of memory are free; use a "
                            "smaller mesh, or raise the memory limit",
                            file_, megabytes(bytes), megabytes(free_)));
}

void ReadingLimit::require_unpacked(std::size_t bytes, std::size_t compressed) const {
  if (bytes > kOnTop && (bytes - kOnTop) / kMaxExpansion > compressed)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: {} of it stand for more than {}, no mesh is compressed like that; "
                            "if you trust the file, decompress it before",
                            file_, megabytes(compressed), megabytes(bytes)));
  require(bytes);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
