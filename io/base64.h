// Base64 (RFC 4648) for the inline arrays of VTU.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace majorant {

// Appends the encoding of `bytes`, padded, without line breaks.
void append_base64(std::string_view bytes, std::string& text);

// Returns the number of characters that encode `bytes` bytes.
constexpr std::size_t base64_length(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

// Decodes `text`, whose length must be a multiple of 4. Padding may also end groups in the middle,
// in concatenated streams. Returns nothing if a character or the length is wrong.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
