#include "majorant/pictures/baking/seam_levelling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "majorant/framework/sparse_spd.h"

namespace majorant {
namespace {

// The weight of a texel's change, which keeps texels that hardly affect a reading.
constexpr double kLeast = 1e-3;
// The tolerance of readings outside of the range of their texels, as a part of that range; curved
// values are rounded off by less. A quarter of a step of 8 bits of the whole range is added.
// Results stay within this distance of the whole range.
constexpr double kOutside = 0.5;
constexpr double kQuarterOfStep = 0.25 / 255;
// In codes: the allowed difference of both sides, below 1 since points between readings may differ
// more; the largest difference that is closed; the largest change of a kept texel, which is hardly
// visible.
constexpr double kMaxDifference = 0.5, kClosable = 2.5, kMaxChange = 3;
// The cost of a texel's change relative to that of a difference along a texel's length. It is
// small, so that differences reach kMaxDifference.
constexpr double kStay = 1.0 / 128;
// The largest number of sweeps over texels; the largest change per sweep in codes, which lets
// neighbours change, too; and the change at which sweeps end.
constexpr int kMaxSweeps = 400;
constexpr double kMaxSweepChange = 1, kLeastMove = 0.002;
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

constexpr double kCodes = 255;

// Conversions between values of a channel and visible codes.
class Shown {
 public:
  Shown(Transfer seen, double range, int channel, int channels)
      : is_srgb_(seen == Transfer::Srgb && encoded(0.25F, seen, channel, channels) != 0.25F),
        scale_(kCodes / range) {}

  double code(double value) const {
    return scale_ * (is_srgb_ ? linear_to_srgb(static_cast<float>(value)) : value);
  }
  double value(double code) const {
    return is_srgb_ ? srgb_to_linear(static_cast<float>(code / scale_)) : code / scale_;
  }
  // Returns the derivative of code().
  double slope(double value) const {
    constexpr double kLinearUpTo = 0.0031308;  // IEC 61966-2-1
    if (!is_srgb_) return scale_;
    return scale_ * (value <= kLinearUpTo ? 12.92 : 1.055 / 2.4 * std::pow(value, 1 / 2.4 - 1));
  }

 private:
  bool is_srgb_;
  double scale_;
};

// The readings of one channel on both sides, and the texels that they depend on.
class Closing {
 public:
  Closing(const std::vector<SeamReading>& seams, const std::vector<std::size_t>& texels)
      : seams_(seams), first_(texels.size() + 1, 0), place_(seams.size()) {
    const auto number = [&](std::size_t texel) {
      return static_cast<std::size_t>(std::lower_bound(texels.begin(), texels.end(), texel) -
                                      texels.begin());
    };
    std::vector<std::pair<std::size_t, Use>> uses;
    for (std::size_t s = 0; s < seams.size(); ++s) {
      const std::size_t own = uses.size();
      for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t k = 0; k < 4; ++k) {
          const std::size_t t = place_[s][4 * side + k] = number(seams[s].sides[side].texels[k]);
          auto use = uses.begin() + static_cast<std::ptrdiff_t>(own);
          while (use != uses.end() && use->first != t) ++use;  // both sides may read it
          if (use == uses.end()) use = uses.insert(use, {t, Use{s, {0, 0}}});
          use->second.weight[side] += seams[s].sides[side].weights[k];
        }
    }
    for (const auto& [t, use] : uses) ++first_[t + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    uses_.resize(uses.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& [t, use] : uses) uses_[next[t]++] = use;
  }

  // codes: of the texels; each changes by at most `most`. targets: the surface's values on the
  // sides.
  enum class Steps { Any, Whole };
  void run(std::vector<double>& codes, const std::vector<double>& most, const Vec& here,
           const Vec& there, const Shown& shown, Steps steps, const StopCheck& stop) {
    shown_ = &shown;
    steps_ = steps;
    most_ = &most;
    before_ = codes;
    value_.resize(codes.size());
    for (std::size_t t = 0; t < codes.size(); ++t) value_[t] = shown.value(codes[t]);
    read_.assign(seams_.size(), {0, 0});
    target_.resize(seams_.size());
    counts_.resize(seams_.size());
    for (std::size_t s = 0; s < seams_.size(); ++s) {
      for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t k = 0; k < 4; ++k)
          read_[s][side] += seams_[s].sides[side].weights[k] * value_[place_[s][4 * side + k]];
      const auto row = static_cast<Index>(s);
      target_[s] = shown.code(here[row]) - shown.code(there[row]);
      counts_[s] = std::abs(error(s, read_[s])) <= kClosable;
    }
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
      stop.poll();
      double moved = 0;
      for (const std::size_t t : texels_of_excess()) moved = std::max(moved, relax(t, codes[t]));
      if (moved <= kLeastMove) return;
    }
  }

 private:
  using Sides = std::array<double, 2>;
  struct Use {
    std::size_t seam;
    Sides weight;
  };

  double error(std::size_t seam, const Sides& read) const {
    return shown_->code(read[0]) - shown_->code(read[1]) - target_[seam];
  }
  static double excess(double error) {
    return std::copysign(std::max(std::abs(error) - kMaxDifference, 0.0), error);
  }

  // Returns the texels of readings whose difference is too large, ascending.
  std::vector<std::size_t> texels_of_excess() const {
    std::vector<std::size_t> found;
    for (std::size_t s = 0; s < seams_.size(); ++s)
      if (counts_[s] && excess(error(s, read_[s])) != 0)
        found.insert(found.end(), place_[s].begin(), place_[s].end());
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  template <class Visit>
  void for_uses(std::size_t texel, const Visit& visit) const {
    for (std::size_t i = first_[texel]; i < first_[texel + 1]; ++i)
      if (counts_[uses_[i].seam]) visit(uses_[i].seam, uses_[i].weight);
  }

  static Sides raised(Sides read, const Sides& weight, double by) {
    for (std::size_t side = 0; side < 2; ++side) read[side] += weight[side] * by;
    return read;
  }

  // Returns the part of the objective that depends on this texel, at a code of it.
  double objective(std::size_t texel, double code) const {
    const double by = shown_->value(code) - value_[texel];
    double sum = kStay * (code - before_[texel]) * (code - before_[texel]);
    for_uses(texel, [&](std::size_t s, const Sides& weight) {
      const double beyond = excess(error(s, raised(read_[s], weight, by)));
      sum += seams_[s].length * beyond * beyond;
    });
    return sum;
  }

  // Does a Newton step for one texel if that lowers the objective. Returns the change.
  double relax(std::size_t texel, double& code) {
    double descent = kStay * (before_[texel] - code), curvature = kStay;
    const double slope_here = shown_->slope(value_[texel]);
    for_uses(texel, [&](std::size_t s, const Sides& weight) {
      const double beyond = excess(error(s, read_[s]));
      if (beyond == 0) return;
      const double slope =
          (weight[0] * shown_->slope(read_[s][0]) - weight[1] * shown_->slope(read_[s][1])) /
          slope_here;
      descent -= seams_[s].length * beyond * slope;
      curvature += seams_[s].length * slope * slope;
    });
    const double most = (*most_)[texel];
    const double step = std::clamp(descent / curvature, -kMaxSweepChange, kMaxSweepChange);
    double moved = std::clamp(code + step, before_[texel] - most, before_[texel] + most);
    if (steps_ == Steps::Whole) moved = std::clamp(std::round(moved), 0.0, kCodes);
    if (moved == code || !(objective(texel, moved) < objective(texel, code))) return 0;
    const double by = std::abs(moved - code), value = shown_->value(moved);
    for_uses(texel, [&](std::size_t s, const Sides& weight) {
      read_[s] = raised(read_[s], weight, value - value_[texel]);
    });
    value_[texel] = value;
    code = moved;
    return by;
  }

  const std::vector<SeamReading>& seams_;
  std::vector<std::size_t> first_;                 // by texel: first index into uses_
  std::vector<Use> uses_;                          // of texels
  std::vector<std::array<std::size_t, 8>> place_;  // texels by seam, consecutive
  const Shown* shown_ = nullptr;
  Steps steps_ = Steps::Any;
  const std::vector<double>* most_ = nullptr;
  std::vector<double> value_, before_;  // by texel: current value and first code
  std::vector<Sides> read_;             // by seam
  std::vector<double> target_;
  std::vector<char> counts_;
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
    Vec misread = value;  // readings minus targets, which the free texels must balance
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

void close_seams(Raster& raster, Transfer transfer, Transfer seen,
                 const std::vector<std::size_t>& kept, const std::vector<SeamReading>& seams,
                 const RowMatrix& here, const RowMatrix& there, const StopCheck& stop) {
  std::vector<std::size_t> texels;
  for (const SeamReading& seam : seams)
    for (const FilterReading& side : seam.sides)
      texels.insert(texels.end(), side.texels.begin(), side.texels.end());
  std::sort(texels.begin(), texels.end());
  texels.erase(std::unique(texels.begin(), texels.end()), texels.end());
  if (texels.empty()) return;
  std::vector<double> most;
  for (const std::size_t t : texels)
    most.push_back(std::binary_search(kept.begin(), kept.end(), t) ? kMaxChange : kCodes);
  const ColorDecoder decoder(raster, transfer);
  const bool is_whole = raster.depth() == PixelDepth::Eight && transfer == seen;
  const bool has_unit = raster.depth() != PixelDepth::Float || seen == Transfer::Srgb;
  Closing closing(seams, texels);
  std::vector<double> codes(texels.size()), before;
  const auto width = to_size(raster.width());
  const auto column = [&](std::size_t t) { return static_cast<int>(texels[t] % width); };
  const auto row = [&](std::size_t t) { return static_cast<int>(texels[t] / width); };
  for (int c = 0; c < raster.channels(); ++c) {
    const double range = has_unit ? 1 : here.col(c).maxCoeff() - here.col(c).minCoeff();
    if (!(range > 0)) continue;
    const Shown shown(seen, range, c, raster.channels());
    for (std::size_t t = 0; t < texels.size(); ++t)
      codes[t] = is_whole ? raster.code(column(t), row(t), c)
                          : shown.code(decoder(raster, column(t), row(t), c));
    before = codes;
    closing.run(codes, most, here.col(c), there.col(c), shown,
                is_whole ? Closing::Steps::Whole : Closing::Steps::Any, stop);
    for (std::size_t t = 0; t < texels.size(); ++t) {
      if (codes[t] == before[t]) continue;
      const auto value = static_cast<float>(shown.value(codes[t]));
      raster.set(column(t), row(t), c,
                 raster.depth() == PixelDepth::Float
                     ? value
                     : encoded(value, transfer, c, raster.channels()));
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
