#include "majorant/io/internal/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kPlyTypes = {{
    {"char", PlyType::Int8},
    {"uchar", PlyType::UInt8},
    {"short", PlyType::Int16},
    {"ushort", PlyType::UInt16},
    {"int", PlyType::Int32},
    {"uint", PlyType::UInt32},
    {"float", PlyType::Float32},
    {"double", PlyType::Float64},
    {"int8", PlyType::Int8},
    {"uint8", PlyType::UInt8},
    {"int16", PlyType::Int16},
    {"uint16", PlyType::UInt16},
    {"int32", PlyType::Int32},
    {"uint32", PlyType::UInt32},
    {"float32", PlyType::Float32},
    {"float64", PlyType::Float64},
}};

PlyType read_type(TextCursor& cursor) {
  const std::string_view token = cursor.next_token();
  for (const auto& [name, type] : kPlyTypes) {
    if (token == name) return type;
  }
  cursor.fail(fmt::format("{} is no PLY type; correct the header", in_quotes(token)));
}

void read_property(TextCursor& cursor, PlyHeader& header) {
  if (header.elements.empty()) cursor.fail("property before the first element; not a PLY file");
  PlyProperty property;
  TextCursor look_ahead = cursor;
  if (look_ahead.next_token() == "list") {
    cursor.next_token();
    property.list_size_type = read_type(cursor);
    if (*property.list_size_type >= PlyType::Float32) {
      cursor.fail("a list size that is no integer; correct the header");
    }
  }
  property.type = read_type(cursor);
  property.name = cursor.next_token();
  if (property.name.empty()) cursor.fail("property without a name; the header may be truncated");
  header.elements.back().properties.push_back(std::move(property));
}

void read_format(TextCursor& cursor, PlyHeader& header) {
  const std::string_view format = cursor.next_token();
  if (format == "binary_little_endian") {
    header.encoding = PlyEncoding::LittleEndian;
  } else if (format == "binary_big_endian") {
    header.encoding = PlyEncoding::BigEndian;
  } else if (format != "ascii") {
    cursor.fail(fmt::format("{} is no PLY format; use ascii or binary", in_quotes(format)));
  }
}

void read_element(TextCursor& cursor, PlyHeader& header) {
  PlyElement element;
  element.name = cursor.next_token();
  element.count = cursor.next_integer("number of elements");
  if (element.count < 0) cursor.fail("negative number of elements; correct the header");
  for (const PlyElement& other : header.elements) {
    if (other.name == element.name) {
      cursor.fail(fmt::format("element {} twice; correct the header", in_quotes(element.name)));
    }
  }
  header.elements.push_back(std::move(element));
}

// Returns the size of the text up to and including the line "end_header".
std::size_t header_size(const std::string& path, std::string_view content) {
  for (std::size_t at = content.find("\nend_header"); at != std::string_view::npos;
       at = content.find("\nend_header", at + 1)) {
    std::size_t end = at + std::string_view("\nend_header").size();
    while (end < content.size() && (content[end] == ' ' || content[end] == '\r')) ++end;
    if (end < content.size() && content[end] == '\n') return end + 1;
  }
  TextCursor(path, content, TextLines::Plain)
      .fail("no line end_header; not a PLY file, or truncated");
}

}  // namespace

std::size_t ply_type_size(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  const auto found = std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) {
    return std::find(names.begin(), names.end(), p.name) != names.end();
  });
  return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

std::size_t PlyElement::least_size() const {
  std::size_t size = 0;
  for (const PlyProperty& p : properties) size += ply_type_size(p.list_size_type.value_or(p.type));
  return size;
}

PlyHeader read_ply_header(const std::string& path, std::string_view content) {
  PlyHeader header;
  header.size = header_size(path, content);
  std::string text(content.substr(0, header.size));
  require_text(path, text);
  TextCursor cursor(path, text, TextLines::Plain);
  if (!cursor.next_line() || cursor.next_token() != "ply") {
    cursor.fail("the first line is not 'ply'; check that this is a PLY file");
  }
  bool has_format = false;
  while (cursor.next_line()) {
    header.lines = cursor.line();
    const std::string_view keyword = cursor.next_token();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      read_format(cursor, header);
      has_format = true;
    } else if (keyword == "element") {
      read_element(cursor, header);
    } else if (keyword == "property") {
      read_property(cursor, header);
    } else if (keyword != "comment" && keyword != "obj_info") {
      cursor.fail(
          fmt::format("{} is not a PLY header keyword; correct the header", in_quotes(keyword)));
    }
  }
  if (!has_format) cursor.fail("the line 'format' is missing; correct the header");
  return header;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
