// Reads numbers of either byte order from binary data in memory, with every access checked.
// Used by binary PLY and STL and by the arrays of VTU.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"

namespace majorant {

enum class ByteOrder { Little, Big };

// Returns the T stored at bytes[0 .. sizeof(T)).
template <class T>
T load_bytes(const char* bytes, ByteOrder order) {
  constexpr bool kMachineIsLittle = std::endian::native == std::endian::little;
  if ((order == ByteOrder::Little) == kMachineIsLittle) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

class ByteCursor {
 public:
  // `file` is for messages. `bytes` must outlive the cursor.
  ByteCursor(const std::string& file, std::string_view bytes, ByteOrder order)
      : file_(file), bytes_(bytes), order_(order) {}

  std::size_t remaining() const { return bytes_.size(); }

  // Returns the next T. Throws Error(Unreadable) at the end of the data.
  template <class T>
  T next() {
    require(sizeof(T));
    const T value = load_bytes<T>(bytes_.data(), order_);
    bytes_.remove_prefix(sizeof(T));
    return value;
  }

  // Skips `count` bytes. Throws Error(Unreadable) if there are fewer.
  void skip(std::size_t count) {
    require(count);
    bytes_.remove_prefix(count);
  }

 private:
  void require(std::size_t count) const {
    if (count > bytes_.size()) {
      throw Error(ErrorKind::Unreadable,
                  file_ + ": binary data end too early; the file is truncated");
    }
  }

  const std::string& file_;
  std::string_view bytes_;
  ByteOrder order_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
