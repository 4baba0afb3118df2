#include "majorant/pictures/images/raster.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

constexpr float kLargest[] = {255, 65535};  // codes by PixelDepth
constexpr int kNowhere = -1;

bool is_alpha(int channel, int channels) {
  return (channels == 2 || channels == 4) && channel == channels - 1;
}

// Returns the column or row of the image for a position that may lie beyond it.
int wrapped(double index, int size, Wrap wrap) {
  if (wrap == Wrap::Clamp) return static_cast<int>(std::clamp(index, 0.0, size - 1.0));
  const int period = wrap == Wrap::Mirror ? 2 * size : size;
  const double rest = std::fmod(index, period);
  const int place = std::min(static_cast<int>(rest < 0 ? rest + period : rest), period - 1);
  return place < size ? place : period - 1 - place;
}

// Finds for every column of a row the nearest column, given the squared distances along the
// columns, `of_column` (infinite: none). It is the lower envelope of parabolas [Felzenszwalb and
// Huttenlocher, Distance Transforms of Sampled Functions, 2012].
class NearestInRow {
 public:
  explicit NearestInRow(int width) : vertex_(to_size(width)), from_(to_size(width) + 1) {}

  // nearest: #columns; kNowhere if all are infinite.
  void find(const std::vector<double>& of_column, std::vector<int>& nearest) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    for (std::size_t q = 0; q < of_column.size(); ++q) {
      if (of_column[q] == kFar) continue;
      double start = -kFar;
      for (; count > 0; --count) {
        const auto v = static_cast<std::size_t>(vertex_[count - 1]);
        const auto x = static_cast<double>(q), y = static_cast<double>(v);
        start = (of_column[q] + x * x - of_column[v] - y * y) / (2 * (x - y));
        if (start > from_[count - 1]) break;
      }
      vertex_[count] = static_cast<int>(q);
      from_[count] = count == 0 ? -kFar : start;
      ++count;
    }
    std::size_t k = 0;
    for (std::size_t q = 0; q < nearest.size(); ++q) {
      while (k + 1 < count && from_[k + 1] < static_cast<double>(q)) ++k;
      nearest[q] = count == 0 ? kNowhere : vertex_[k];
    }
  }

 private:
  std::vector<int> vertex_;
  std::vector<double> from_;
};

// Returns for every pixel the row of the nearest pixel with a value in its column; kNowhere if
// there is none.
std::vector<int> nearest_rows(const std::vector<Texel>& texels, std::size_t width,
                              std::size_t height) {
  std::vector<int> rows(texels.size());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t place = y * width + x;
      rows[place] = has_value(texels[place]) ? static_cast<int>(y)
                    : y > 0                  ? rows[place - width]
                                             : kNowhere;
    }
  for (std::size_t y = height - 1; y-- > 0;)
    for (std::size_t x = 0; x < width; ++x) {
      const int here = static_cast<int>(y);
      int& row = rows[y * width + x];
      const int below = rows[(y + 1) * width + x];
      if (below != kNowhere && (row == kNowhere || std::abs(below - here) < std::abs(here - row)))
        row = below;
    }
  return rows;
}

}  // namespace

Raster::Raster(int width, int height, int channels, PixelDepth depth)
    : width_(width), height_(height), channels_(channels), depth_(depth) {
  if (width < 1 || height < 1 || channels < 1)
    throw InvalidArgument("Raster: width, height and channels are at least 1");
  bytes_.resize(bytes_of_row() * static_cast<std::size_t>(height));
}

std::size_t Raster::bytes_of_channel() const {
  return depth_ == PixelDepth::Eight ? 1 : depth_ == PixelDepth::Sixteen ? 2 : sizeof(float);
}

std::size_t Raster::bytes_of_row() const {
  return bytes_of_channel() * static_cast<std::size_t>(width_) *
         static_cast<std::size_t>(channels_);
}

std::size_t Raster::place(int x, int y, int channel) const {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
          static_cast<std::size_t>(x)) *
             static_cast<std::size_t>(channels_) +
         static_cast<std::size_t>(channel);
}

unsigned Raster::code(int x, int y, int channel) const {
  const std::size_t at = place(x, y, channel);
  if (depth_ == PixelDepth::Eight) return bytes_[at];
  std::uint16_t code = 0;
  std::memcpy(&code, &bytes_[2 * at], sizeof code);
  return code;
}

float Raster::value(int x, int y, int channel) const {
  if (depth_ != PixelDepth::Float)
    return static_cast<float>(code(x, y, channel)) / kLargest[static_cast<std::size_t>(depth_)];
  float value = 0;
  std::memcpy(&value, &bytes_[sizeof value * place(x, y, channel)], sizeof value);
  return value;
}

void Raster::set(int x, int y, int channel, float value) {
  const std::size_t at = place(x, y, channel);
  if (depth_ == PixelDepth::Float) {
    std::memcpy(&bytes_[sizeof value * at], &value, sizeof value);
    return;
  }
  const float largest = kLargest[static_cast<std::size_t>(depth_)];
  const float scaled = value > 0 ? std::min(value, 1.0F) * largest : 0.0F;
  const auto code = static_cast<std::uint16_t>(std::lround(scaled));
  if (depth_ == PixelDepth::Eight)
    bytes_[at] = static_cast<unsigned char>(code);
  else
    std::memcpy(&bytes_[2 * at], &code, sizeof code);
}

void Raster::copy_pixel(int to_x, int to_y, int from_x, int from_y) {
  const std::size_t size = bytes_of_channel() * static_cast<std::size_t>(channels_);
  std::memcpy(&bytes_[bytes_of_channel() * place(to_x, to_y, 0)],
              &bytes_[bytes_of_channel() * place(from_x, from_y, 0)], size);
}

ColorDecoder::ColorDecoder(const Raster& raster, Transfer transfer)
    : has_alpha_(is_alpha(raster.channels() - 1, raster.channels())) {
  if (raster.depth() == PixelDepth::Float || transfer == Transfer::Linear) return;
  const float largest = kLargest[static_cast<std::size_t>(raster.depth())];
  for (float code = 0; code <= largest; ++code)
    table_.push_back(transfer == Transfer::Srgb ? srgb_to_linear(code / largest)
                                                : 2 * code / largest - 1);
}

float ColorDecoder::operator()(const Raster& raster, int x, int y, int channel) const {
  if (table_.empty() || (has_alpha_ && channel == raster.channels() - 1))
    return raster.value(x, y, channel);
  return table_[raster.code(x, y, channel)];
}

float encoded(float value, Transfer transfer, int channel, int channels) {
  if (transfer == Transfer::Linear || is_alpha(channel, channels)) return value;
  return transfer == Transfer::Srgb ? linear_to_srgb(value) : (value + 1) / 2;
}

void sample(const Raster& raster, const ColorDecoder& decoder, const Vector2& uv, Filter filter,
            float* value, const Wraps& wraps) {
  const double x = uv.x() * raster.width(), y = (1 - uv.y()) * raster.height();
  if (filter == Filter::Nearest) {
    const int column = wrapped(std::floor(x), raster.width(), wraps.u);
    const int row = wrapped(std::floor(y), raster.height(), wraps.v);
    for (int c = 0; c < raster.channels(); ++c) value[c] = decoder(raster, column, row, c);
    return;
  }
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const auto s = static_cast<float>(x - 0.5 - left), t = static_cast<float>(y - 0.5 - top);
  const int x0 = wrapped(left, raster.width(), wraps.u);
  const int x1 = wrapped(left + 1, raster.width(), wraps.u);
  const int y0 = wrapped(top, raster.height(), wraps.v);
  const int y1 = wrapped(top + 1, raster.height(), wraps.v);
  for (int c = 0; c < raster.channels(); ++c) {
    const float above = (1 - s) * decoder(raster, x0, y0, c) + s * decoder(raster, x1, y0, c);
    const float below = (1 - s) * decoder(raster, x0, y1, c) + s * decoder(raster, x1, y1, c);
    value[c] = (1 - t) * above + t * below;
  }
}

void fill_from_nearest(Raster& raster, const std::vector<Texel>& texels, int padding,
                       const StopCheck& stop) {
  const int width = raster.width(), height = raster.height();
  const std::vector<int> rows = nearest_rows(texels, to_size(width), to_size(height));
  const double reach = static_cast<double>(padding) * padding;
  constexpr Index kRowsOfTask = 16;
  parallel_tasks((height + kRowsOfTask - 1) / kRowsOfTask, [&](Index task, int) {
    stop.poll();
    NearestInRow in_row(width);
    std::vector<double> squares(to_size(width));
    std::vector<int> nearest(to_size(width));
    const int last = std::min(height, static_cast<int>((task + 1) * kRowsOfTask));
    for (int y = static_cast<int>(task * kRowsOfTask); y < last; ++y) {
      const std::size_t first = to_size(y) * to_size(width);
      for (std::size_t x = 0; x < squares.size(); ++x) {
        const double away = rows[first + x] - y;
        squares[x] =
            rows[first + x] == kNowhere ? std::numeric_limits<double>::infinity() : away * away;
      }
      in_row.find(squares, nearest);
      for (int x = 0; x < width; ++x) {
        const Texel texel = texels[first + to_size(x)];
        const int column = nearest[to_size(x)];
        if (has_value(texel) || column == kNowhere) continue;
        const double across = column - x;
        if (texel == Texel::Miss || across * across + squares[to_size(column)] <= reach)
          raster.copy_pixel(x, y, column, rows[first + to_size(column)]);
      }
    }
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
