#include "majorant/io/json_depth.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"

namespace majorant {

void require_shallow_json(const std::string& what, std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (in_string) {
      if (c == '\\') ++k;  // skips the escaped character
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == ']' || c == '}') --depth;
    if ((c == '[' || c == '{') && ++depth > kMaxJsonDepth)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: JSON nested too deeply (more than {} levels); damaged file",
                              what, kMaxJsonDepth));
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
