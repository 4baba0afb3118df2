// Untrusted texts inside a page for a browser: file names, messages and data never become markup.
//
//   const std::string page = fill_in("<h1>{{title}}</h1>{{data}}",
//                                    {{"title", html_text(text)},
//                                     {"data", script_json({{"faces", 12}})}});
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace majorant {

// Returns the text for HTML, with U+FFFD for invalid UTF-8 and characters that HTML forbids.
std::string html_text(const std::string& text);

// Returns JSON for a <script> element. "<" only occurs in strings, where it is written \u003c.
// Strings may hold any bytes, as above.
std::string script_json(const nlohmann::ordered_json& json);

// Replaces each {{name}} by its value in one pass; values are not searched for names. The page must
// not contain other names.
std::string fill_in(std::string_view page,
                    const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
