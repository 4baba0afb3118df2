#include "majorant/parametrization/baking/seam_levelling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "majorant/framework/sparse_spd.h"

namespace majorant {
namespace {

// Of texels that hardly a reading has a part of: they stay.
constexpr double kLeast = 1e-3;
// How far a value lies outside of the range of its texels, in that range: where a filter rounds off
// what bends, less. Beside it, of the range of all values, a quarter of a step of 8 bits. What is
// set lies no farther outside of the range of all.
constexpr double kOutside = 0.5;
constexpr double kQuarterOfStep = 0.25 / 255;
// Readings between two polls.
constexpr std::size_t kBlock = 4096;

struct Range {
  Vec least, most;
  explicit Range(Index channels)
      : least(Vec::Constant(channels, std::numeric_limits<double>::infinity())), most(-least) {}
  void add(const Vec& value) {
    least = least.cwiseMin(value);
    most = most.cwiseMax(value);
  }
};

}  // namespace

bool reading_at(const Raster& raster, const Vector2& uv, FilterReading& reading) {
  const double x = uv.x() * raster.width() - 0.5, y = (1 - uv.y()) * raster.height() - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  if (!(left >= 0 && top >= 0 && left + 1 < raster.width() && top + 1 < raster.height()))
    return false;
  const std::size_t row = to_size(raster.width());
  const std::size_t first = static_cast<std::size_t>(top) * row + static_cast<std::size_t>(left);
  const double s = x - left, t = y - top;
  reading.texels = {first, first + 1, first + row, first + row + 1};
  reading.weights = {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
  return true;
}

void level_seams(Raster& raster, Transfer transfer, const std::vector<std::size_t>& free,
                 const std::vector<FilterReading>& readings, const RowMatrix& values,
                 const StopCheck& stop) {
  const ColorDecoder decoder(raster, transfer);
  const Index channels = raster.channels();
  const auto column = [&](std::size_t texel) {
    return static_cast<int>(texel % to_size(raster.width()));
  };
  const auto row = [&](std::size_t texel) {
    return static_cast<int>(texel / to_size(raster.width()));
  };
  const auto color = [&](std::size_t texel) {
    Vec value(channels);
    for (Index c = 0; c < channels; ++c)
      value[c] = decoder(raster, column(texel), row(texel), static_cast<int>(c));
    return value;
  };
  const auto unknown = [&](std::size_t texel) {
    const auto found = std::lower_bound(free.begin(), free.end(), texel);
    return found == free.end() || *found != texel ? Index{-1}
                                                  : static_cast<Index>(found - free.begin());
  };
  const auto size = static_cast<Index>(free.size());
  std::vector<SparseSpd::Entry> entries;
  RowMatrix rhs = RowMatrix::Zero(size, channels);
  for (Index i = 0; i < size; ++i) entries.push_back({i, i, kLeast});
  if (readings.empty()) return;
  const Vec step = kQuarterOfStep * (values.colwise().maxCoeff() - values.colwise().minCoeff());
  Range all(channels);
  for (std::size_t r = 0; r < readings.size(); ++r) {
    if (r % kBlock == 0) stop.poll();
    const FilterReading& reading = readings[r];
    const Vec value = values.row(static_cast<Index>(r)).transpose();
    Range here(channels);
    Vec misread = value;  // by this the free texels are to be raised
    std::array<Index, 4> place{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec texel = color(reading.texels[k]);
      here.add(texel);
      misread -= reading.weights[k] * texel;
      place[k] = unknown(reading.texels[k]);
    }
    const Vec slack = kOutside * (here.most - here.least) + step;
    if (!((value - here.least + slack).minCoeff() >= 0 &&
          (here.most + slack - value).minCoeff() >= 0))
      continue;
    all.add(here.least);
    all.add(here.most);
    all.add(value);
    for (std::size_t k = 0; k < 4; ++k) {
      if (place[k] < 0) continue;
      const double weight = reading.length * reading.weights[k];
      rhs.row(place[k]) += weight * misread.transpose();
      for (std::size_t l = 0; l <= k; ++l)
        if (place[l] >= 0) entries.push_back({place[k], place[l], weight * reading.weights[l]});
    }
  }
  if (rhs.isZero(0)) return;
  stop.poll();
  const SparseSpd normal_equations(size, 1, entries, "texels around charts cannot be levelled");
  const Vec beyond = kOutside * (all.most - all.least);
  for (Index c = 0; c < channels; ++c) {
    stop.poll();
    const Vec raised = normal_equations.solve(rhs.col(c));
    for (Index i = 0; i < size; ++i) {
      if (raised[i] == 0) continue;
      const std::size_t texel = free[to_size(i)];
      const int x = column(texel), y = row(texel), channel = static_cast<int>(c);
      const double value = std::clamp(decoder(raster, x, y, channel) + raised[i],
                                      all.least[c] - beyond[c], all.most[c] + beyond[c]);
      raster.set(x, y, channel,
                 raster.depth() == PixelDepth::Float
                     ? static_cast<float>(value)
                     : encoded(static_cast<float>(value), transfer, channel, raster.channels()));
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
