// The header of a PLY file: its elements and their layout. For read_ply.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace majorant {

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };
enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

std::size_t ply_type_size(PlyType type);  // bytes

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Int32;          // type of the value, or of the items of a list
  std::optional<PlyType> list_size_type;  // set for lists; an integer type
};

struct PlyElement {
  std::string name;
  long long count = 0;  // as announced; check it against the size of the file
  std::vector<PlyProperty> properties;

  // Returns the position of the first property with one of these names; -1 if there is none.
  int find(std::initializer_list<std::string_view> names) const;
  std::size_t least_size() const;  // size of a binary record with empty lists
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  // size of the header in bytes
  long lines = 0;        // lines of the header
};

// Reads the header at the start of `content`. Throws Error(Unreadable) for anything else.
PlyHeader read_ply_header(const std::string& path, std::string_view content);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
