// Lines that name the first few of many places.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// " (face 7, 9, ...)" of the first of `count` places, numbers from 1; nothing where there are none.
std::string place_text(std::string_view of_what, Index count,
                       const std::vector<std::array<Index, 2>>& places);

// The words for a kind of findings: what reports call it, what one and what several of them are,
// and what their places are.
struct FindingText {
  std::string_view name, one, many, place;
};

// "2 edges split (edge (3, 4), (7, 9))".
std::string described(const FindingText& text, Index count,
                      const std::vector<std::array<Index, 2>>& places);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
