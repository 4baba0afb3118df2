// The texts in a JSON text, in their order, without a document being made of it.
//
//   visit_strings(R"({"buffers": [{"uri": "a.bin"}]})", [](std::string_view place, auto& value) {
//     return !(place == "buffers/uri" && value == "a.bin");   // false: that is enough
//   });
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace majorant {

// place: the keys down to the value, lists left out; of values more than three deep the first three
// keys and "/...". Returns whether the visit goes on.
using VisitString = std::function<bool(std::string_view place, const std::string& value)>;

// Ends where the text is broken or ends too early.
void visit_strings(std::string_view json, const VisitString& visit);

// A JSON text whose texts that begin with "data:" end there: what follows can be nearly all of a
// file, and is passed over at the speed of memory.
class JsonWithoutData {
 public:
  // Adds the next bytes of the text.
  void append(std::string_view block);
  std::string take() { return std::move(text_); }

 private:
  // Both return what follows the part of the block that they took: up to data, up to their end.
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
