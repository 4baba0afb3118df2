// Images of numbers, the sources and results of baking.
//
//   Raster image(640, 480, 3, PixelDepth::Eight);
//   image.set(0, 0, 2, 1.0F);                      // the top left pixel, its third channel
//   const float blue = image.value(0, 0, 2);       // 1
//   const ColorDecoder decoder(image, Transfer::Srgb);
//   float color[3];
//   sample(image, decoder, {0.5, 0.5}, Filter::Bilinear, color);   // in linear light
//
// The square of a texture is [0, 1]^2, u to the right and v upwards as in OBJ. Pixel (x, y), rows
// from the top as in PNG, has its centre at u = (x + 1/2) / width, v = 1 - (y + 1/2) / height.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/io/files/srgb.h"

namespace majorant {

// The representation of a channel: 0 to 1 in steps of 1/255 or 1/65535, or any float.
enum class PixelDepth { Eight, Sixteen, Float };
// Srgb: integer codes of IEC 61966-2-1; alpha is never encoded. Signed: -1 to 1 stored as 0 to 1,
// for directions. Linear: plain numbers.
enum class Transfer { Linear, Srgb, Signed };
enum class Filter { Nearest, Bilinear };
// The texture beyond its square: copies, the border pixels, or copies of which every second one is
// mirrored.
enum class Wrap { Repeat, Clamp, Mirror };
struct Wraps {
  Wrap u = Wrap::Repeat, v = Wrap::Repeat;
};

class Raster {
 public:
  // All values are 0. channels: 1 to 4 for pictures, where alpha is the last one of 2 and 4; any
  // number for arrays. Throws InvalidArgument for sizes below 1.
  Raster(int width, int height, int channels, PixelDepth depth);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  PixelDepth depth() const { return depth_; }

  float value(int x, int y, int channel) const;
  // Integer depths round to nearest; values below 0 and NaN give 0, values above 1 give 1.
  void set(int x, int y, int channel, float value);
  // Returns the integer code of a channel.
  unsigned code(int x, int y, int channel) const;
  void copy_pixel(int to_x, int to_y, int from_x, int from_y);

  // Returns rows from the top, channels interleaved, in the machine's byte order.
  std::vector<unsigned char>& bytes() { return bytes_; }
  const std::vector<unsigned char>& bytes() const { return bytes_; }
  std::size_t bytes_of_channel() const;
  std::size_t bytes_of_row() const;

 private:
  std::size_t place(int x, int y, int channel) const;  // in channels

  int width_, height_, channels_;
  PixelDepth depth_;
  std::vector<unsigned char> bytes_;
};

// Decodes the numbers of a raster by their transfer, with a table for integers.
class ColorDecoder {
 public:
  ColorDecoder(const Raster& raster, Transfer transfer);
  float operator()(const Raster& raster, int x, int y, int channel) const;

 private:
  bool has_alpha_;
  std::vector<float> table_;  // by code; empty: identity
};

// Returns the value in the encoding of a raster.
float encoded(float value, Transfer transfer, int channel, int channels);

// Interpolates all channels at uv.
void sample(const Raster& raster, const ColorDecoder& decoder, const Vector2& uv, Filter filter,
            float* value, const Wraps& wraps = {});

// The content of a pixel.
enum class Texel : std::uint8_t {
  Empty,
  Centre,  // its centre lies in a chart
  Part,    // a part of it lies in a chart, but not its centre
  Margin,  // outside of charts, but filters read it at points of a chart
  Miss     // lies in a chart, but no value was found
};

inline bool has_value(Texel texel) { return texel != Texel::Empty && texel != Texel::Miss; }

// Fills every Empty pixel within `padding` (distances between centres) from the nearest pixel with
// a value, and every Miss at any distance. Polls `stop`. texels: by pixel, row by row. O(#pixels).
void fill_from_nearest(Raster& raster, const std::vector<Texel>& texels, int padding,
                       const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
