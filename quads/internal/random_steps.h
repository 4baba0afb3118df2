// Whole numbers at random, the same with every standard library.
//
//   std::mt19937 random(1);
//   const std::int64_t steps = random_between(random, -5, 5);
#pragma once

#include <cstdint>
#include <random>

namespace majorant {

// Evenly from least to most, which differ by less than 2^32 - 1: the upper half of the product of a
// random number with their count, drawn again where its lower half is one of the few that would
// make some results likelier [Lem19].
inline std::int64_t random_between(std::mt19937& random, std::int64_t least, std::int64_t most) {
  const auto count = static_cast<std::uint32_t>(most - least + 1);
  const std::uint32_t excess = (0u - count) % count;
  std::uint64_t product = 0;
  do {
    product = std::uint64_t{random()} * count;
  } while (static_cast<std::uint32_t>(product) < excess);
  return least + static_cast<std::int64_t>(product >> 32);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
