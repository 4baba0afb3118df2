// A colour of screens and picture files, 8 bits a channel.
//
//   const Color orange{230, 120, 20};
//   const std::string text = orange.hex();  // "#e67814"
#pragma once

#include <cstdint>
#include <string>

namespace majorant {

struct Color {  // sRGB
  std::uint8_t red = 0, green = 0, blue = 0;
  std::string hex() const;  // returns "#rrggbb"
  bool operator==(const Color&) const = default;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
