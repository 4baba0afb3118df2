// The largest depth of JSON. Parsers and copies of parsed values recurse, so a text of brackets
// alone ends a process that believes it; files are asked before they are parsed.
//
//   require_shallow_json("pins.json", text);
//   const auto document = nlohmann::json::parse(text);
#pragma once

#include <string>
#include <string_view>

namespace majorant {

// Levels of lists and objects: what majorant reads needs four, comments of other programs some
// more. A recursive parser's stack holds it; chosen, not tuned.
inline constexpr int kMaxJsonDepth = 64;

// Throws Error(Unreadable, "what: ... nested too deeply ...") for more levels than kMaxJsonDepth;
// judges nothing else. `what` begins the message: the file, or the part of it that holds the text.
void require_shallow_json(const std::string& what, std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
