#include "majorant/io/vtu_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <type_traits>

#include "majorant/framework/error.h"
#include "majorant/framework/types.h"
#include "majorant/io/base64.h"
#include "majorant/io/files/inflate.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

using DataEncoding = VtuArrays::DataEncoding;

[[noreturn]] void refuse_file(const std::string& file, std::string_view problem) {
  throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", file, problem));
}

// Calls visit(T{}) with the C++ type of a VTK type name; false if the name is unknown.
template <class Visitor>
bool with_type(std::string_view name, Visitor&& visit) {
  if (name == "Float64") return visit(double{}), true;
  if (name == "Float32") return visit(float{}), true;
  if (name == "Int64" || name == "vtkIdType") return visit(std::int64_t{}), true;
  if (name == "UInt64") return visit(std::uint64_t{}), true;
  if (name == "Int32") return visit(std::int32_t{}), true;
  if (name == "UInt32") return visit(std::uint32_t{}), true;
  if (name == "Int16") return visit(std::int16_t{}), true;
  if (name == "UInt16") return visit(std::uint16_t{}), true;
  if (name == "Int8") return visit(std::int8_t{}), true;
  if (name == "UInt8") return visit(std::uint8_t{}), true;
  return false;
}

bool is_xml_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

// Base64 without surrounding space and, in a copy, without inner space.
class Compacted {
 public:
  explicit Compacted(std::string_view text) : text_(text) {
    while (!text_.empty() && is_xml_space(text_.front())) text_.remove_prefix(1);
    while (!text_.empty() && is_xml_space(text_.back())) text_.remove_suffix(1);
    if (std::none_of(text_.begin(), text_.end(), is_xml_space)) return;
    std::remove_copy_if(text_.begin(), text_.end(), std::back_inserter(copy_), is_xml_space);
    text_ = copy_;
  }
  Compacted(const Compacted&) = delete;
  Compacted& operator=(const Compacted&) = delete;

  std::string_view text() const { return text_; }

 private:
  std::string copy_;
  std::string_view text_;
};

std::size_t encoded_size(DataEncoding encoding, std::size_t bytes) {
  return encoding == DataEncoding::Raw ? bytes : base64_length(bytes);
}

}  // namespace

VtuArrays::VtuArrays(const std::string& file, std::string& content, const StopCheck& stop)
    : file_(file), stop_(stop), limit_(file), compressed_(content.size()) {
  const std::size_t tag = content.find("<AppendedData");
  if (tag == std::string::npos) return;
  const std::size_t tag_end = content.find('>', tag);
  const std::size_t close = content.rfind("</AppendedData>");
  if (tag_end == std::string::npos || close == std::string::npos || close < tag_end) {
    refuse_file(file_, "AppendedData is not closed; the file is truncated");
  }
  const std::string start_tag = content.substr(tag, tag_end - tag) + "/>";
  appended_encoding_ = parse_xml(file_, start_tag).attribute("encoding", "raw");
  const std::size_t begin = content.find_first_not_of(" \t\r\n", tag_end + 1);
  if (content[begin] != '_') refuse_file(file_, "AppendedData does not begin with '_'");
  appended_ = content.substr(begin + 1, close - begin - 1);
  content.erase(tag, close + std::string_view("</AppendedData>").size() - tag);
}

void VtuArrays::configure(const XmlElement& root) {
  const std::string_view compressor = root.attribute("compressor");
  is_compressed_ = compressor == "vtkZLibDataCompressor";
  if (!compressor.empty() && !is_compressed_) {
    refuse_file(file_,
                fmt::format("arrays compressed by {} are not supported; save the file without "
                            "compression, or with zlib's",
                            in_quotes(compressor)));
  }
  const std::string_view order = root.attribute("byte_order", "LittleEndian");
  const std::string_view header = root.attribute("header_type", "UInt32");
  if (order != "LittleEndian" && order != "BigEndian") refuse_file(file_, "unknown byte_order");
  if (header != "UInt32" && header != "UInt64") refuse_file(file_, "unknown header_type");
  order_ = order == "BigEndian" ? ByteOrder::Big : ByteOrder::Little;
  header_size_ = header == "UInt64" ? 8 : 4;
}

void VtuArrays::fail(const XmlElement& array, std::string_view problem) const {
  refuse_file(file_, fmt::format("array {}: {}", in_quotes(array.attribute("Name", "?")), problem));
}

// Returns the number of bytes of an array, which precedes it.
std::size_t VtuArrays::length(std::string_view header) const {
  return header_size_ == 8 ? load_bytes<std::uint64_t>(header.data(), order_)
                           : load_bytes<std::uint32_t>(header.data(), order_);
}

std::string VtuArrays::raw_bytes(const XmlElement& array, std::string_view data) const {
  if (data.size() < header_size_ || length(data) > data.size() - header_size_) {
    fail(array, "the data end too early; the file is truncated");
  }
  return std::string(data.substr(header_size_, length(data)));
}

// Header and data are one base64 stream, or two if the header ends with padding.
std::string VtuArrays::encoded_bytes(const XmlElement& array, std::string_view text) const {
  const auto decode = [&](std::size_t characters) {
    if (characters > text.size()) fail(array, "the data end too early; the file is truncated");
    auto decoded = decode_base64(text.substr(0, characters));
    if (!decoded || decoded->size() < header_size_) fail(array, "the base64 data are damaged");
    return std::move(*decoded);
  };
  const std::size_t header_characters = base64_length(header_size_);
  const std::string header = decode(header_characters);
  const std::size_t size = length(header);
  if (size > text.size()) fail(array, "the data end too early; the file is truncated");
  const bool separate = header.size() == header_size_;
  std::string all = decode(separate ? header_characters + base64_length(size)
                                    : base64_length(header_size_ + size));
  if (all.size() < header_size_ + size) fail(array, "the base64 data are damaged");
  all.resize(header_size_ + size);
  all.erase(0, header_size_);
  return all;
}

// Returns the first `count` bytes that `data` encode.
std::string VtuArrays::part(const XmlElement& array, std::string_view data, DataEncoding encoding,
                            std::size_t count) const {
  const std::size_t size = encoded_size(encoding, count);
  if (count > data.size() || size > data.size()) {
    fail(array, "the data end too early; the file is truncated");
  }
  data = data.substr(0, size);
  if (encoding == DataEncoding::Raw) return std::string(data);
  auto decoded = decode_base64(data);
  if (!decoded || decoded->size() < count) fail(array, "the base64 data are damaged");
  decoded->resize(count);
  return std::move(*decoded);
}

// The header has the number of blocks, the size of each, the size of a smaller last one (0: none),
// then the compressed size of each. Header and blocks are encoded separately.
std::string VtuArrays::compressed_bytes(const XmlElement& array, std::string_view data,
                                        DataEncoding encoding) const {
  const auto number = [this](const std::string& header, std::size_t k) {
    return length(std::string_view(header).substr(k * header_size_));
  };
  const std::size_t blocks = number(part(array, data, encoding, header_size_), 0);
  if (blocks == 0) return {};
  if (blocks > data.size()) fail(array, "the data end too early; the file is truncated");
  const std::string header = part(array, data, encoding, (3 + blocks) * header_size_);
  data.remove_prefix(encoded_size(encoding, header.size()));
  std::size_t total = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    if (number(header, 3 + k) > data.size() - total) fail(array, "a size is damaged");
    total += number(header, 3 + k);
  }
  const std::string compressed = part(array, data, encoding, total);
  std::string bytes;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    stop_.poll();
    const bool is_smaller = k + 1 == blocks && number(header, 2) != 0;
    const std::string_view block =
        std::string_view(compressed).substr(begin, number(header, 3 + k));
    const std::size_t size = number(header, is_smaller ? 2 : 1);
    if (!can_stand_for(block, size)) fail(array, "a size is damaged");
    unpacked_ += size;
    limit_.require_unpacked(unpacked_, compressed_);
    if (!append_inflated(block, size, bytes)) fail(array, "the compressed data are damaged");
    begin += block.size();
  }
  return bytes;
}

std::string VtuArrays::bytes(const XmlElement& array) const {
  const std::string_view format = array.attribute("format");
  const auto decode = [&](std::string_view data, DataEncoding encoding) {
    if (is_compressed_) return compressed_bytes(array, data, encoding);
    return encoding == DataEncoding::Raw ? raw_bytes(array, data) : encoded_bytes(array, data);
  };
  if (format == "binary") return decode(Compacted(array.text).text(), DataEncoding::Base64);
  if (format != "appended") fail(array, fmt::format("unknown format {}", in_quotes(format)));
  const std::string_view text = array.attribute("offset");
  std::size_t offset = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), offset);
  if (code != std::errc() || stop != text.data() + text.size() || offset > appended_.size()) {
    fail(array, "its offset lies outside of AppendedData; the file is truncated");
  }
  const std::string_view data = std::string_view(appended_).substr(offset);
  if (appended_encoding_ == "raw") return decode(data, DataEncoding::Raw);
  if (appended_encoding_ != "base64") fail(array, "unknown encoding of AppendedData");
  return decode(data, DataEncoding::Base64);
}

template <class T>
std::vector<T> VtuArrays::values(const XmlElement& array) const {
  std::vector<T> result;
  if (array.attribute("format", "ascii") == "ascii") {
    const std::string name = fmt::format("{}: array {}", file_, array.attribute("Name", "?"));
    TextCursor cursor(name, array.text, TextLines::Plain, stop_);
    while (cursor.next_line()) {
      while (!cursor.at_end_of_line()) {
        if constexpr (std::is_same_v<T, double>) {
          const double value = cursor.next_number("value");
          const bool is_float = array.attribute("type") == "Float32";
          result.push_back(is_float ? double(static_cast<float>(value)) : value);
          if (!std::isfinite(result.back())) fail(array, "a value is not finite");
        } else {
          result.push_back(cursor.next_integer("value"));
        }
      }
    }
    return result;
  }
  const bool known = with_type(array.attribute("type"), [&](auto sample) {
    using Stored = decltype(sample);
    if (std::is_integral_v<T> && !std::is_integral_v<Stored>) fail(array, "integers are needed");
    const std::string data = bytes(array);
    if (data.size() % sizeof(Stored) != 0) fail(array, "its size is no multiple of the type's");
    limit_.require(data.size() + data.size() / sizeof(Stored) * sizeof(T));
    result.resize(data.size() / sizeof(Stored));
    for (std::size_t first = 0; first < result.size(); first += StopCheck::kPeriod) {
      stop_.poll();
      const std::size_t last = std::min(result.size(), first + StopCheck::kPeriod);
      for (std::size_t i = first; i < last; ++i)
        result[i] = static_cast<T>(load_bytes<Stored>(data.data() + i * sizeof(Stored), order_));
      if constexpr (std::is_same_v<T, double>)
        if (!Eigen::Map<const Vec>(result.data() + first, static_cast<Index>(last - first))
                 .allFinite())
          fail(array, "a value is not finite");
    }
  });
  if (!known) fail(array, fmt::format("unknown type {}", in_quotes(array.attribute("type"))));
  return result;
}

std::vector<double> VtuArrays::doubles(const XmlElement& array) const {
  return values<double>(array);
}

std::vector<long long> VtuArrays::integers(const XmlElement& array) const {
  return values<long long>(array);
}

std::string VtuArrays::string(const XmlElement& array) const {
  const bool is_string = array.attribute("type") == "String";
  std::string text;
  if (is_string && array.attribute("format", "ascii") != "ascii") {
    text = bytes(array);
  } else {
    for (const long long code : values<long long>(array)) {  // signed or unsigned characters
      if (code < -128 || code > 255) fail(array, "a character code is out of range");
      text += static_cast<char>(static_cast<unsigned char>(code));
    }
  }
  const std::size_t end = text.find('\0');
  if (is_string && end == std::string::npos) {
    fail(array, "the string is not terminated; truncated");
  }
  return text.substr(0, end);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
