#include "majorant/pictures/images/internal/jpeg_file.h"

#include <fmt/format.h>

#include <csetjmp>
#include <cstdio>
// This header uses FILE and must follow cstdio.
#include <jpeglib.h>

#include "majorant/framework/error.h"
#include "majorant/pictures/images/internal/image_limits.h"

namespace majorant {
namespace {

// The limit of scans of a progressive image, each a pass over the whole image. Encoders write about
// ten.
constexpr int kMaxScans = 100;

// A decompressor whose errors jump to `escape`. Warnings, which mean damaged data, are errors, too.
struct Jpeg {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX] = "";

  Jpeg() {
    info.err = jpeg_std_error(&errors);
    info.client_data = this;
    errors.error_exit = fail;
    errors.emit_message = [](j_common_ptr c, int level) {
      if (level < 0) fail(c);
    };
    progress.progress_monitor = [](j_common_ptr c) {
      Jpeg& self = *static_cast<Jpeg*>(c->client_data);
      if (self.info.input_scan_number <= kMaxScans) return;
      std::snprintf(self.message, sizeof self.message, "it has more than %d scans", kMaxScans);
      std::longjmp(self.escape, 1);
    };
  }
  ~Jpeg() { jpeg_destroy_decompress(&info); }
  Jpeg(const Jpeg&) = delete;
  Jpeg& operator=(const Jpeg&) = delete;

  [[noreturn]] static void fail(j_common_ptr c) {
    Jpeg& self = *static_cast<Jpeg*>(c->client_data);
    c->err->format_message(c, self.message);
    std::longjmp(self.escape, 1);
  }

  // Returns false if libjpeg left `work` by a jump. `work` must not hold objects with destructors.
  template <class Work>
  bool run(const Work& work) {
    if (setjmp(escape) != 0) return false;
    work();
    return true;
  }
};

}  // namespace

Raster decode_jpeg(const std::string& path, const std::string& bytes) {
  Jpeg jpeg;
  const auto damaged = [&] {
    return Error(ErrorKind::Unreadable,
                 fmt::format("{}: {}; give a whole JPEG image", path, jpeg.message));
  };
  if (!jpeg.run([&] {
        jpeg_create_decompress(&jpeg.info);
        jpeg.info.progress = &jpeg.progress;
        jpeg_mem_src(&jpeg.info, reinterpret_cast<const unsigned char*>(bytes.data()),
                     static_cast<unsigned long>(bytes.size()));
        jpeg_read_header(&jpeg.info, TRUE);
      }))
    throw damaged();
  if (jpeg.info.jpeg_color_space == JCS_CMYK || jpeg.info.jpeg_color_space == JCS_YCCK)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: CMYK images are not read; convert it to RGB", path));
  const bool is_grey = jpeg.info.jpeg_color_space == JCS_GRAYSCALE;
  const int channels = is_grey ? 1 : 3;
  const auto width = static_cast<long>(jpeg.info.image_width);
  const auto height = static_cast<long>(jpeg.info.image_height);
  // A progressive image also keeps its coefficients, two bytes for each channel.
  require_believable(path, width, height, static_cast<std::size_t>(3 * channels), bytes.size());
  Raster image(static_cast<int>(width), static_cast<int>(height), channels, PixelDepth::Eight);
  if (!jpeg.run([&] {
        jpeg.info.out_color_space = is_grey ? JCS_GRAYSCALE : JCS_RGB;
        jpeg_start_decompress(&jpeg.info);
        while (jpeg.info.output_scanline < jpeg.info.output_height) {
          JSAMPROW row = &image.bytes()[jpeg.info.output_scanline * image.bytes_of_row()];
          jpeg_read_scanlines(&jpeg.info, &row, 1);
        }
        jpeg_finish_decompress(&jpeg.info);
      }))
    throw damaged();
  return image;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
