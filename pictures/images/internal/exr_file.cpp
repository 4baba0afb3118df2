#include "majorant/pictures/images/internal/exr_file.h"

#include "majorant/framework/error.h"
#include "majorant/pictures/images/image_file.h"

#ifdef MAJORANT_HAS_OPENEXR

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "majorant/pictures/images/internal/image_limits.h"

namespace majorant {
namespace {

class MemoryInput final : public Imf::IStream {
 public:
  MemoryInput(const std::string& name, const std::string& bytes)
      : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char c[], int n) override {
    if (n < 0 || static_cast<std::size_t>(n) > bytes_.size() - at_)
      throw std::runtime_error("the file is truncated");
    std::memcpy(c, bytes_.data() + at_, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t pos) override {
    if (pos > bytes_.size()) throw std::runtime_error("the file is truncated");
    at_ = pos;
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

class MemoryOutput final : public Imf::OStream {
 public:
  MemoryOutput() : OStream("image") {}
  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    bytes.resize(std::max(bytes.size(), at_ + count));
    std::memcpy(bytes.data() + at_, c, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t pos) override { at_ = pos; }

  std::string bytes;

 private:
  std::size_t at_ = 0;
};

std::vector<std::string> usual_channels(int count) {
  switch (count) {
    case 1:
      return {"Y"};
    case 2:
      return {"Y", "A"};
    case 3:
      return {"R", "G", "B"};
    default:
      return {"R", "G", "B", "A"};
  }
}

// Returns a frame for rows of floats; the first pixel has these coordinates.
Imf::FrameBuffer frame(Raster& image, const std::vector<std::string>& channels, int left, int top) {
  Imf::FrameBuffer buffer;
  const std::size_t pixel = sizeof(float) * static_cast<std::size_t>(image.channels());
  char* const origin = reinterpret_cast<char*>(image.bytes().data()) -
                       static_cast<std::ptrdiff_t>(pixel) * left -
                       static_cast<std::ptrdiff_t>(image.bytes_of_row()) * top;
  for (std::size_t c = 0; c < channels.size(); ++c)
    buffer.insert(channels[c],
                  Imf::Slice(Imf::FLOAT, origin + sizeof(float) * c, pixel, image.bytes_of_row()));
  return buffer;
}

Raster decode(const std::string& path, const std::string& bytes) {
  MemoryInput stream(path, bytes);
  Imf::InputFile file(stream, 0);
  const Imath::Box2i window = file.header().dataWindow();
  const Imf::ChannelList& found = file.header().channels();
  const auto has = [&](const char* name) {
    const Imf::Channel* const channel = found.findChannel(name);
    return channel && channel->xSampling == 1 && channel->ySampling == 1;
  };
  const bool is_color = has("R") && has("G") && has("B");
  if (!is_color && !has("Y"))
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: has no channels R G B, or Y, at full resolution; convert it", path));
  const int count = (is_color ? 3 : 1) + (has("A") ? 1 : 0);
  const long width = static_cast<long>(window.max.x) - window.min.x + 1;
  const long height = static_cast<long>(window.max.y) - window.min.y + 1;
  require_believable(path, width, height, sizeof(float) * static_cast<std::size_t>(count),
                     bytes.size());
  Raster image(static_cast<int>(width), static_cast<int>(height), count, PixelDepth::Float);
  file.setFrameBuffer(frame(image, usual_channels(count), window.min.x, window.min.y));
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

bool has_exr() { return true; }

Raster decode_exr(const std::string& path, const std::string& bytes) {
  try {
    return decode(path, bytes);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: {}; give a whole OpenEXR image", path, e.what()));
  }
}

std::string encode_exr(const Raster& image, const std::vector<std::string>& channels) {
  const std::vector<std::string> names =
      channels.empty() ? usual_channels(image.channels()) : channels;
  try {
    Imf::Header header(image.width(), image.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& name : names) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    MemoryOutput stream;
    {
      Imf::OutputFile file(stream, header, 0);
      // OpenEXR reads output through non-const pointers.
      file.setFrameBuffer(frame(const_cast<Raster&>(image), names, 0, 0));
      file.writePixels(image.height());
    }
    return std::move(stream.bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(ErrorKind::Usage, fmt::format("cannot make an OpenEXR image: {}", e.what()));
  }
}

}  // namespace majorant

#else

namespace majorant {

bool has_exr() { return false; }

Raster decode_exr(const std::string& path, const std::string&) {
  throw Error(ErrorKind::Unsupported, path + ": this majorant was built without OpenEXR");
}

std::string encode_exr(const Raster&, const std::vector<std::string>&) {
  throw Error(ErrorKind::Usage, "this majorant was built without OpenEXR");
}

}  // namespace majorant

#endif

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
