#include "majorant/pictures/images/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/reading_limit.h"
#include "majorant/pictures/images/internal/exr_file.h"
#include "majorant/pictures/images/internal/jpeg_file.h"
#include "majorant/pictures/images/png_file.h"

namespace majorant {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 5> kForeignImages{
    {{".ktx2", "KTX2"}, {".ktx", "KTX"}, {".webp", "WebP"}, {".dds", "DDS"}, {".basis", "Basis"}}};

std::string_view npy_type(PixelDepth depth) {
  constexpr std::array<std::string_view, 3> kTypes{"|u1", "<u2", "<f4"};
  return kTypes[static_cast<std::size_t>(depth)];
}

// In [numpy.lib.format, version 1.0] the header ends at a multiple of 64.
std::string encode_npy(const Raster& image) {
  const std::string shape =
      image.channels() == 1
          ? fmt::format("({}, {})", image.height(), image.width())
          : fmt::format("({}, {}, {})", image.height(), image.width(), image.channels());
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}",
                                   npy_type(image.depth()), shape);
  constexpr std::size_t kPreamble = 10, kAlignment = 64;
  header.append(kAlignment - (kPreamble + header.size() + 1) % kAlignment, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xFF);
  bytes += static_cast<char>(header.size() >> 8);
  bytes.reserve(bytes.size() + header.size() + image.bytes().size());
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(image.bytes().data()), image.bytes().size());
  return bytes;
}

// Returns the text from the value of a header key on, up to its end.
std::string_view npy_value(std::string_view header, std::string_view key, char last) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = header.substr(at + key.size());
  return rest.substr(0, rest.find(last));
}

template <class T>
void fill_rows(const char* data, RowMatrix& rows) {
  for (Index i = 0; i < rows.size(); ++i) {
    T value;
    std::memcpy(&value, data + static_cast<std::size_t>(i) * sizeof value, sizeof value);
    rows.data()[i] = static_cast<double>(value);
  }
}

struct NpyType {
  std::string_view name;
  std::size_t bytes;
  void (*fill)(const char*, RowMatrix&);
};
constexpr std::array<NpyType, 10> kNpyTypes{{{"|u1", 1, fill_rows<std::uint8_t>},
                                             {"|i1", 1, fill_rows<std::int8_t>},
                                             {"<u2", 2, fill_rows<std::uint16_t>},
                                             {"<i2", 2, fill_rows<std::int16_t>},
                                             {"<u4", 4, fill_rows<std::uint32_t>},
                                             {"<i4", 4, fill_rows<std::int32_t>},
                                             {"<u8", 8, fill_rows<std::uint64_t>},
                                             {"<i8", 8, fill_rows<std::int64_t>},
                                             {"<f4", 4, fill_rows<float>},
                                             {"<f8", 8, fill_rows<double>}}};

// Returns the one or two numbers of "(12, 3"; none for other texts.
std::vector<std::size_t> npy_shape(std::string_view text) {
  std::vector<std::size_t> sizes;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (*at == ' ' || *at == '(' || *at == ',' || *at == ':') {
      ++at;
      continue;
    }
    std::size_t size = 0;
    const auto [next, error] = std::from_chars(at, end, size);
    if (error != std::errc()) return {};
    sizes.push_back(size);
    at = next;
  }
  return sizes;
}

}  // namespace

std::vector<std::string> readable_images() {
  std::vector<std::string> names{".png", ".jpg", ".jpeg"};
  if (has_exr()) names.emplace_back(".exr");
  return names;
}

std::vector<std::string> writable_images() {
  std::vector<std::string> names{".png", ".npy"};
  if (has_exr()) names.emplace_back(".exr");
  return names;
}

Raster read_image(const std::string& path, const StopCheck& stop) {
  const std::string format = format_of(path);
  for (const auto& [extension, name] : kForeignImages)
    if (format == extension)
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: {} images are not read; convert it to PNG", path, name));
  if (format == ".exr" && !has_exr())
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: this majorant was built without OpenEXR; convert it to PNG", path));
  if (format == ".png") return decode_png(path, read_whole_file(path, stop));
  if (format == ".jpg" || format == ".jpeg") return decode_jpeg(path, read_whole_file(path, stop));
  if (format == ".exr") return decode_exr(path, read_whole_file(path, stop));
  require_format_name(path, fmt::format("{}", fmt::join(readable_images(), ", ")));
  throw Error(ErrorKind::Unreadable,
              fmt::format("{}: no image that is read, by its name; give one of {}", path,
                          fmt::join(readable_images(), " ")));
}

Raster decode_image(const std::string& name, const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return decode_png(name, bytes);
  if (bytes.starts_with("\xFF\xD8\xFF")) return decode_jpeg(name, bytes);
  if (bytes.starts_with("RIFF"))
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: WebP images are not read; convert it to PNG", name));
  throw Error(ErrorKind::Unreadable, fmt::format("{}: neither PNG nor JPEG", name));
}

std::string encode_image(const std::string& path, const Raster& image, const ImageLabels& labels) {
  const std::string format = format_of(path);
  if (format == ".npy") return encode_npy(image);
  if (format == ".png") return encode_png(image, labels.transfer);
  if (format == ".exr" && has_exr()) return encode_exr(image, labels.channels);
  throw Error(ErrorKind::Usage, fmt::format("{}: cannot write such images; use one of {}", path,
                                            fmt::join(writable_images(), " ")));
}

RowMatrix read_npy_rows(const std::string& path, const StopCheck& stop) {
  const std::string bytes = read_whole_file(path, stop);
  const auto fail = [&](const std::string& reason) {
    return Error(ErrorKind::Unreadable,
                 fmt::format("{}: {}; give a .npy array of numbers, n or n by k", path, reason));
  };
  const std::string_view all = bytes;
  if (all.size() < 12 || all.substr(0, 6) != "\x93NUMPY") throw fail("no array of numpy");
  const bool is_long = all[6] != 1;
  const auto byte = [&](std::size_t at) {
    return static_cast<std::size_t>(static_cast<unsigned char>(all[at]));
  };
  std::size_t length = byte(8) | byte(9) << 8;
  if (is_long) length |= byte(10) << 16 | byte(11) << 24;
  const std::size_t begin = is_long ? 12 : 10;
  if (length > all.size() - begin) throw fail("its header is cut off");
  const std::string_view header = all.substr(begin, length), data = all.substr(begin + length);
  const std::string_view type_text = npy_value(header, "'descr': '", '\'');
  const auto type = std::find_if(kNpyTypes.begin(), kNpyTypes.end(),
                                 [&](const NpyType& t) { return t.name == type_text; });
  if (type == kNpyTypes.end()) throw fail(fmt::format("type {} is not read", in_quotes(type_text)));
  const std::string_view order = npy_value(header, "'fortran_order': ", ',');
  if (order != "False" && order != "True") throw fail("its header has no order");
  const std::vector<std::size_t> shape = npy_shape(npy_value(header, "'shape'", ')'));
  if (shape.empty() || shape.size() > 2 || shape.back() == 0) throw fail("it has another shape");
  const std::size_t columns = shape.size() == 2 ? shape[1] : 1;
  if (shape[0] > data.size() || columns > data.size() ||
      shape[0] * columns * type->bytes != data.size())
    throw fail("its size is not that of its shape");
  ReadingLimit(path).require(bytes.size() + shape[0] * columns * sizeof(double));
  const auto row_count = static_cast<Index>(shape[0]), column_count = static_cast<Index>(columns);
  const bool is_by_columns = order == "True";
  RowMatrix rows =
      is_by_columns ? RowMatrix(column_count, row_count) : RowMatrix(row_count, column_count);
  type->fill(data.data(), rows);
  if (is_by_columns) rows.transposeInPlace();
  return rows;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
