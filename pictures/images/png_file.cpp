#include "majorant/pictures/images/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/files/reading_limit.h"
#include "majorant/pictures/images/image_file.h"
#include "majorant/pictures/images/internal/image_limits.h"

namespace majorant {
namespace {

static_assert(sizeof(Color) == 3, "rows of pixels are what libpng reads and writes");

// libpng's simplified interface, freed at the end.
struct Png {
  png_image image{};

  Png() { image.version = PNG_IMAGE_VERSION; }
  ~Png() { png_image_free(&image); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
};

// Callbacks and state for libpng's low-level interface: the rest of the input, or the output, and
// the reason of a failure. Failed calls return to the caller of run().
struct PngCalls {
  std::string_view rest;
  std::string written;
  char message[96] = "";

  static PngCalls& of(png_structp png) { return *static_cast<PngCalls*>(png_get_error_ptr(png)); }
  [[noreturn]] static void fail(png_structp png, png_const_charp reason) {
    std::snprintf(of(png).message, sizeof message, "%s", reason);
    png_longjmp(png, 1);
  }
  static void read(png_structp png, png_bytep data, std::size_t size) {
    std::string_view& rest = of(png).rest;
    if (size > rest.size()) png_error(png, "the file is truncated");
    std::memcpy(data, rest.data(), size);
    rest.remove_prefix(size);
  }
  static void write(png_structp png, png_bytep data, std::size_t size) {
    try {
      of(png).written.append(reinterpret_cast<const char*>(data), size);
    } catch (const std::bad_alloc&) {
      png_error(png, "out of memory");
    }
  }
};

// Returns false if libpng left `work` by a jump. `work` must not hold objects with destructors.
template <class Work>
bool run(png_structp png, const Work& work) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  work();
  return true;
}

void ignore_warning(png_structp, png_const_charp) {}

// A decompressor with its image information.
struct PngReader {
  png_structp png;
  png_infop info;

  explicit PngReader(PngCalls& calls)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &calls, PngCalls::fail, ignore_warning)),
        info(png ? png_create_info_struct(png) : nullptr) {
    if (!info) throw std::bad_alloc();
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

struct PngWriter {
  png_structp png;
  png_infop info;

  explicit PngWriter(PngCalls& calls)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &calls, PngCalls::fail, ignore_warning)),
        info(png ? png_create_info_struct(png) : nullptr) {
    if (!info) throw std::bad_alloc();
  }
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
};

std::vector<png_bytep> rows_of(Raster& image) {
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height(); ++y)
    rows.push_back(&image.bytes()[static_cast<std::size_t>(y) * image.bytes_of_row()]);
  return rows;
}

}  // namespace

std::string encode_png(const PixelImage& image) {
  Png png;
  png.image.width = static_cast<png_uint_32>(image.width);
  png.image.height = static_cast<png_uint_32>(image.height);
  const bool is_opaque = image.alpha.empty();
  png.image.format = is_opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> channels;
  for (std::size_t k = 0; k < image.alpha.size(); ++k) {
    const Color& c = image.pixels[k];
    channels.insert(channels.end(), {c.red, c.green, c.blue, image.alpha[k]});
  }
  const void* rows = image.pixels.data();
  if (!is_opaque) rows = channels.data();
  const auto write = [&](void* memory, png_alloc_size_t& size) {
    if (png_image_write_to_memory(&png.image, memory, &size, 0, rows, 0, nullptr) == 0)
      throw Error(ErrorKind::Usage, fmt::format("cannot make a picture of {} x {} pixels: {}",
                                                image.width, image.height, png.image.message));
  };
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::string bytes(size, '\0');
  write(bytes.data(), size);
  bytes.resize(size);
  return bytes;
}

PixelImage pixels_of_png(const std::string& path, const std::string& bytes) {
  Png png;
  const auto fail = [&](const std::string& reason) {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}; give a PNG image", path, reason));
  };
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0)
    fail(png.image.message);
  constexpr png_uint_32 kMaximum = kLargestImage;
  if (png.image.width > kMaximum || png.image.height > kMaximum)
    fail(fmt::format("{} x {} pixels are more than {} on a side", png.image.width, png.image.height,
                     kLargestImage));
  png.image.format = PNG_FORMAT_RGB;
  PixelImage image;
  image.width = static_cast<int>(png.image.width);
  image.height = static_cast<int>(png.image.height);
  const std::size_t pixels = static_cast<std::size_t>(png.image.width) * png.image.height;
  ReadingLimit(path).require(pixels * sizeof(Color));
  image.pixels.resize(pixels);
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&png.image, &white, image.pixels.data(), 0, nullptr) == 0)
    fail(png.image.message);
  return image;
}

Raster decode_png(const std::string& path, const std::string& bytes) {
  PngCalls calls{bytes, {}};
  const PngReader reader(calls);
  const auto damaged = [&] {
    return Error(ErrorKind::Unreadable,
                 fmt::format("{}: {}; give a whole PNG image", path, calls.message));
  };
  if (!run(reader.png, [&] {
        png_set_read_fn(reader.png, nullptr, PngCalls::read);
        png_set_user_limits(reader.png, kLargestImage, kLargestImage);
        png_read_info(reader.png, reader.info);
        png_set_expand(reader.png);
        png_set_swap(reader.png);  // for 16 bits
        png_set_interlace_handling(reader.png);
        png_read_update_info(reader.png, reader.info);
      }))
    throw damaged();
  const long width = png_get_image_width(reader.png, reader.info);
  const long height = png_get_image_height(reader.png, reader.info);
  const int channels = png_get_channels(reader.png, reader.info);
  const PixelDepth depth =
      png_get_bit_depth(reader.png, reader.info) == 16 ? PixelDepth::Sixteen : PixelDepth::Eight;
  require_believable(
      path, width, height,
      png_get_rowbytes(reader.png, reader.info) / static_cast<std::size_t>(std::max(1L, width)),
      bytes.size());
  Raster image(static_cast<int>(width), static_cast<int>(height), channels, depth);
  std::vector<png_bytep> rows = rows_of(image);
  if (!run(reader.png, [&] {
        png_read_image(reader.png, rows.data());
        png_read_end(reader.png, nullptr);
      }))
    throw damaged();
  return image;
}

std::string encode_png(const Raster& image, Transfer transfer) {
  constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                            PNG_COLOR_TYPE_RGB_ALPHA};
  constexpr int kMaxChannels = 4;
  if (image.depth() == PixelDepth::Float || image.channels() > kMaxChannels)
    throw Error(ErrorKind::Usage,
                "a PNG holds 1 to 4 channels of 8 or 16 bits; write .npy or .exr");
  PngCalls calls;
  const PngWriter writer(calls);
  const bool is_wide = image.depth() == PixelDepth::Sixteen;
  if (!run(writer.png, [&] {
        png_set_write_fn(writer.png, nullptr, PngCalls::write, nullptr);
        png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width()),
                     static_cast<png_uint_32>(image.height()), is_wide ? 16 : 8,
                     kTypes[image.channels() - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                     PNG_FILTER_TYPE_BASE);
        if (transfer == Transfer::Srgb)
          png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
        png_write_info(writer.png, writer.info);
        if (is_wide) png_set_swap(writer.png);
        for (int y = 0; y < image.height(); ++y)
          png_write_row(writer.png,
                        &image.bytes()[static_cast<std::size_t>(y) * image.bytes_of_row()]);
        png_write_end(writer.png, nullptr);
      }))
    throw Error(ErrorKind::Usage, fmt::format("cannot make a picture of {} x {} pixels: {}",
                                              image.width(), image.height(), calls.message));
  return std::move(calls.written);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
