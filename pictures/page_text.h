// Texts of anybody inside a page for a browser: file names, messages and data never become markup.
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

// The text as it is shown in HTML, U+FFFD for what is not UTF-8 or not allowed there.
std::string html_text(const std::string& text);

// JSON for a <script> element: "<" occurs in strings only, and there it may be written \u003c.
// Strings may hold any bytes, as above.
std::string script_json(const nlohmann::ordered_json& json);

// Puts the values into their {{name}}, in one pass: a value is never searched for names. The page
// must not name others.
std::string fill_in(std::string_view page,
                    const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
