// The texts in a JSON text, in their order, without a document being made of it.
//
//   visit_strings(R"({"buffers": [{"uri": "a.bin"}]})", [](std::string_view place, auto& value) {
//     return !(place == "buffers/uri" && value == "a.bin");   // false: that is enough
//   });
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace majorant {

// place: the keys down to the value, lists left out; of values more than three deep the first three
// keys and "/...". Returns whether the visit goes on.
using VisitString = std::function<bool(std::string_view place, const std::string& value)>;

// Ends where the text is broken or ends too early. Texts that begin with "data:" are visited
// without what follows, which can be nearly all of a file and is passed over at the speed of
// memory.
void visit_strings(std::string_view json, const VisitString& visit);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
