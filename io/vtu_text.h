// The text that write_vtu() writes, for callers whose files are to appear together (atomic_file.h).
#pragma once

#include <string>
#include <string_view>

#include "majorant/io/io.h"

namespace majorant {

// The tag of the array of claims, around the number of its bytes.
constexpr std::string_view claims_begin() {
  return "<DataArray type=\"UInt8\" Name=\"majorant_claims\" NumberOfTuples=\"";
}
constexpr std::string_view claims_end() { return "\" format=\"ascii\">"; }

// path: for messages. Throws as write_vtu() for maps that cannot be written.
std::string vtu_text(const std::string& path, const MapFile& map, VtuCells cells);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
