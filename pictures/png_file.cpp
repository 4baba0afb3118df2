#include "majorant/pictures/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <cstring>

#include "majorant/framework/error.h"
#include "majorant/io/input_file.h"
#include "majorant/io/reading_limit.h"

namespace majorant {
namespace {

constexpr png_uint_32 kLargestImage = 16384;  // on a side, of what is read
static_assert(sizeof(Color) == 3, "rows of pixels are what libpng reads and writes");

// libpng's simplified interface, freed at the end.
struct Png {
  png_image image{};

  Png() { image.version = PNG_IMAGE_VERSION; }
  ~Png() { png_image_free(&image); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
};

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

PixelImage read_png(const std::string& path) {
  Png png;
  const auto fail = [&](const std::string& reason) {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}; give a PNG image", path, reason));
  };
  const std::string bytes = read_whole_file(path);
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0)
    fail(png.image.message);
  if (png.image.width > kLargestImage || png.image.height > kLargestImage)
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
