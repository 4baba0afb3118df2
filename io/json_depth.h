// Limits the depth of JSON. Parsers and copies of parsed values recurse, so that a text of brackets
// could overflow the stack. Files are tested before they are parsed.
//
//   require_shallow_json("pins.json", text);
//   const auto document = nlohmann::json::parse(text);
#pragma once

#include <string>
#include <string_view>

namespace majorant {

// Levels of lists and objects. majorant's formats need four, comments of other programs some more;
// the stack of a recursive parser holds it. Chosen, not tuned.
inline constexpr int kMaxJsonDepth = 64;

// Throws Error(Unreadable, "what: ... nested too deeply ...") beyond kMaxJsonDepth levels; judges
// nothing else. `what`: the file, or the part of it that holds the text.
void require_shallow_json(const std::string& what, std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
