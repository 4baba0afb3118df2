// Random integers, the same with every standard library.
//
//   std::mt19937 random(1);
//   const std::int64_t steps = random_between(random, -5, 5);
#pragma once

#include <cstdint>
#include <random>

namespace majorant {

// Returns a uniform integer from least to most, which differ by less than 2^32 - 1. It is the upper
// half of the product of a random number and the size of the range; numbers whose lower half would
// bias the result are drawn again [Lem19].
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
