// Visits the strings in a JSON text, in order, without building a document.
//
//   visit_strings(R"({"buffers": [{"uri": "a.bin"}]})", [](std::string_view place, auto& value) {
//     return !(place == "buffers/uri" && value == "a.bin");   // false: stops
//   });
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace majorant {

// place: the keys that lead to the value, without lists; if there are more than three, the first
// three and "/...". Returns whether to continue.
using VisitString = std::function<bool(std::string_view place, const std::string& value)>;

// Stops at malformed or truncated text.
void visit_strings(std::string_view json, const VisitString& visit);

// A JSON text in which strings that begin with "data:" are cut off there. Such data can be nearly
// all of a file, and are skipped at the speed of memory.
class JsonWithoutData {
 public:
  // Adds the next bytes of the text.
  void append(std::string_view block);
  std::string take() { return std::move(text_); }

 private:
  // These take text up to data, or data up to their end. Both return the rest of the block.
  std::string_view behind_text(std::string_view block);
  std::string_view behind_data(std::string_view block);
  void count_backslashes(std::string_view more);

  std::string text_;
  bool is_in_data_ = false;
  std::size_t backslashes_ = 0;  // at the end of the data so far
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
