// Text that names the first few of many places.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Returns " (face 7, 9, ...)" with the first of `count` places, numbered from 1; "" if there are
// none.
std::string place_text(std::string_view of_what, Index count,
                       const std::vector<std::array<Index, 2>>& places);

// The names of a kind of findings: its key in reports, its text for one and for several, and the
// noun of its places.
struct FindingText {
  std::string_view name, one, many, place;
};

// Returns "2 edges split (edge (3, 4), (7, 9))".
std::string described(const FindingText& text, Index count,
                      const std::vector<std::array<Index, 2>>& places);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
