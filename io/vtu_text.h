// The text of write_vtu(), for callers whose files must appear together (atomic_file.h).
#pragma once

#include <string>
#include <string_view>

#include "majorant/io/io.h"

namespace majorant {

// Returns the beginning of the tag of the claims, which precedes the number of their bytes.
constexpr std::string_view claims_begin() {
  return "<DataArray type=\"UInt8\" Name=\"majorant_claims\" NumberOfTuples=\"";
}
constexpr std::string_view claims_end() { return "\" format=\"ascii\">"; }

// path: for messages. Throws the errors of write_vtu() for maps that cannot be written.
std::string vtu_text(const std::string& path, const MapFile& map, VtuCells cells);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
