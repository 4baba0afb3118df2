#include "majorant/io/base64.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

#include "majorant/framework/parallel.h"
#include "majorant/framework/types.h"

namespace majorant {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kInvalid = 255,
                       kNoValue = 192;  // kNoValue: a mask of bits that no value has
constexpr std::size_t kGroups = std::size_t{1}
                                << 14;  // groups of 4 characters in a task, about 30 us

constexpr std::array<std::uint8_t, 256> decoding_table() {
  std::array<std::uint8_t, 256> table{};
  for (auto& entry : table) entry = kInvalid;
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
    table[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return table;
}

constexpr std::array<std::uint8_t, 256> kValues = decoding_table();

}  // namespace

void append_base64(std::string_view bytes, std::string& text) {
  const std::size_t before = text.size(), whole = bytes.size() / 3;
  text.resize(before + base64_length(bytes.size()), '=');
  char* const out = text.data() + before;
  const auto byte = [&](std::size_t i) {
    return std::uint32_t{static_cast<unsigned char>(bytes[i])};
  };
  const auto groups = static_cast<Index>((whole + kGroups - 1) / kGroups);
  parallel_tasks(groups, [&](Index task, int) {
    const std::size_t first = to_size(task) * kGroups, last = std::min(whole, first + kGroups);
    for (std::size_t g = first; g < last; ++g) {
      const std::uint32_t group = byte(3 * g) << 16 | byte(3 * g + 1) << 8 | byte(3 * g + 2);
      for (std::size_t k = 0; k < 4; ++k) out[4 * g + k] = kAlphabet[group >> (18 - 6 * k) & 63u];
    }
  });
  const std::size_t left = bytes.size() - 3 * whole;
  if (left == 0) return;
  const std::uint32_t group = byte(3 * whole) << 16 | (left == 2 ? byte(3 * whole + 1) << 8 : 0u);
  for (std::size_t k = 0; k <= left; ++k)
    out[4 * whole + k] = kAlphabet[group >> (18 - 6 * k) & 63u];
}

std::optional<std::string> decode_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  const std::size_t count = text.size() / 4;
  std::string bytes(3 * count, '\0');
  const auto value = [&](std::size_t i) { return kValues[static_cast<unsigned char>(text[i])]; };
  std::atomic<std::size_t> first_odd = count;  // first group that is padded or damaged
  parallel_tasks(static_cast<Index>((count + kGroups - 1) / kGroups), [&](Index task, int) {
    const std::size_t first = to_size(task) * kGroups, last = std::min(count, first + kGroups);
    for (std::size_t g = first; g < last; ++g) {
      const std::uint8_t a = value(4 * g), b = value(4 * g + 1), c = value(4 * g + 2),
                         d = value(4 * g + 3);
      if (((a | b | c | d) & kNoValue) != 0) {
        std::size_t odd = first_odd;
        while (g < odd && !first_odd.compare_exchange_weak(odd, g)) {
        }
        return;
      }
      bytes[3 * g] = static_cast<char>(a << 2 | b >> 4);
      bytes[3 * g + 1] = static_cast<char>(b << 4 | c >> 2);
      bytes[3 * g + 2] = static_cast<char>(c << 6 | d);
    }
  });
  // After this, groups are decoded one by one, since padded groups are shorter.
  bytes.resize(3 * first_odd);
  for (std::size_t i = 4 * first_odd; i < text.size(); i += 4) {
    const std::size_t padding = text[i + 3] != '=' ? 0u : text[i + 2] != '=' ? 1u : 2u;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint8_t bits = k >= 4 - padding ? std::uint8_t{0} : value(i + k);
      if (bits == kInvalid) return std::nullopt;
      group = group << 6 | bits;
    }
    for (std::size_t k = 0; k < 3 - padding; ++k)
      bytes += static_cast<char>(group >> (16 - 8 * k) & 255u);
  }
  return bytes;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
