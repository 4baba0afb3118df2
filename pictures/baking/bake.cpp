#include "majorant/pictures/baking/bake.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/parallel.h"
#include "majorant/maps/distortion.h"
#include "majorant/pictures/baking/internal/baked_borders.h"
#include "majorant/pictures/baking/internal/layout_pieces.h"
#include "majorant/pictures/baking/internal/layout_values.h"
#include "majorant/pictures/baking/internal/position_at.h"
#include "majorant/pictures/baking/internal/texel_coverage.h"

namespace majorant {
namespace {

// The progress reported once texels have values, seams are levelled, and gaps filled.
constexpr double kCoveredShare = 0.9, kLevelledShare = 0.94, kFilledShare = 0.97;

class Baker {
 public:
  Baker(const InverseMap& layout, const BakeOptions& options, const Correspondence& place_of,
        const SurfaceValues& values)
      : layout_(layout),
        options_(options),
        values_(values),
        pieces_(layout.map(), TexelGrid(options.width, options.height)),
        layout_values_(layout, pieces_, place_of, values),
        chart_of_(face_components(layout.map().mesh().opposites())),
        baked_{{options.width, options.height},
               options.transfer,
               options.transfer == Transfer::Srgb ? Transfer::Srgb : values.seen,
               std::vector<Texel>(to_size(options.width) * to_size(options.height), Texel::Empty),
               std::vector<std::vector<AroundTexel>>(to_size(band_count(options.height))),
               {options.width, options.height, values.channels, options.depth}} {
    const Index charts =
        chart_of_.empty() ? 0 : *std::max_element(chart_of_.begin(), chart_of_.end()) + 1;
    has_texel_ = std::vector<std::atomic<char>>(to_size(charts));
  }

  BakedImage run(const StopCheck& stop) {
    const BakeCounts counts = find_values(stop);
    if (has_margin() && options_.samples == 1) level_borders(layout_values_, stop, baked_);
    stop.advance(kLevelledShare);
    fill_from_nearest(baked_.image, baked_.texels, options_.padding, stop);
    stop.advance(kFilledShare);
    if (has_margin() && values_.course == Continuation::Picture)
      close_cuts(layout_values_, stop, baked_);
    return {std::move(baked_.image), counts};
  }

 private:
  BakeCounts find_values(const StopCheck& stop) {
    const int bands = band_count(options_.height);
    std::vector<BakeCounts> counts(to_size(bands));
    std::atomic<Index> done = 0;
    const StopCheck covering = stop.between(0, kCoveredShare);
    parallel_tasks(bands, [&](Index band, int) {
      stop.poll();
      bake_band(static_cast<int>(band), counts[to_size(band)], stop);
      covering.advance(to_size(++done), to_size(bands));
    });
    BakeCounts all;
    for (const BakeCounts& c : counts) {
      all.covered += c.covered;
      all.doubly_covered += c.doubly_covered;
      all.undecided += c.undecided;
      all.partly += c.partly;
      all.misses += c.misses;
      all.opposed += c.opposed;
    }
    all.texels = static_cast<long>(baked_.texels.size());
    all.charts = static_cast<Index>(has_texel_.size());
    for (const auto& has : has_texel_) all.charts_without_texels += has ? 0 : 1;
    return all;
  }

  void bake_band(int index, BakeCounts& counts, const StopCheck& stop) {
    TexelBand band = covered_band(layout_, baked_.grid, pieces_, index, has_margin(), counts, stop);
    ValueScratch scratch(values_.channels);
    for (int y = band.top(); y < band.bottom(); ++y) {
      stop.poll();
      for (int x = 0; x < options_.width; ++x) write(x, y, band, counts, scratch);
    }
  }

  bool has_margin() const {
    return options_.padding > 0 && values_.course != Continuation::OfFaces;
  }

  void write(int x, int y, TexelBand& band, BakeCounts& counts, ValueScratch& scratch) {
    const CoveredTexel& covered = band.at(x, y);
    Texel texel = covered.texel;
    std::vector<float>& value = scratch.value;
    std::fill(value.begin(), value.end(), values_.background);
    scratch.is_opposed = false;
    const LayoutPiece* const beyond = beyond_border(x, y, band);
    if (texel == Texel::Margin && beyond == nullptr) texel = Texel::Empty;
    const bool is_covered = texel == Texel::Centre || texel == Texel::Part;
    if (is_covered) {
      counts.partly += texel == Texel::Part ? 1 : 0;
      has_texel_[to_size(chart_of(covered.place.face))].store(1, std::memory_order_relaxed);
    }
    if (texel != Texel::Empty && !layout_values_.find_value(baked_.grid, x, y, options_.samples,
                                                            covered.place, beyond, scratch)) {
      texel = is_covered ? Texel::Miss : Texel::Empty;
      counts.misses += is_covered ? 1 : 0;
    }
    counts.opposed += is_covered && scratch.is_opposed ? 1 : 0;
    baked_.texels[to_size(y) * to_size(options_.width) + to_size(x)] = texel;
    if (has_margin() && beyond != nullptr && has_value(texel)) remember(x, y, *beyond);
    const bool is_encoded = options_.depth != PixelDepth::Float && has_value(texel);
    for (int c = 0; c < values_.channels; ++c)
      baked_.image.set(x, y, c,
                       is_encoded
                           ? encoded(value[to_size(c)], options_.transfer, c, values_.channels)
                           : value[to_size(c)]);
  }

  Index chart_of(Index face) const { return chart_of_[to_size(face)]; }

  // Returns the piece whose continuation beyond the border of its chart a texel shows; null if the
  // texel has its centre in a chart, or no centre of its chart around it.
  const LayoutPiece* beyond_border(int x, int y, TexelBand& band) const {
    const CoveredTexel& covered = band.at(x, y);
    if (covered.beside == nullptr || values_.course == Continuation::OfFaces) return nullptr;
    const bool is_wide = band.has_center_beside(x, y, chart_of(covered.place.face),
                                                [&](Index face) { return chart_of(face); });
    return is_wide ? covered.beside : nullptr;
  }

  void remember(int x, int y, const LayoutPiece& beyond) {
    if (const auto place = layout_values_.place_at(baked_.grid.center(x, y), &beyond))
      baked_.around[to_size(y / kBandRows)].push_back(
          {to_size(y) * to_size(options_.width) + to_size(x),
           position_at(layout_.map().mesh(), *place)});
  }

  const InverseMap& layout_;
  const BakeOptions& options_;
  const SurfaceValues& values_;
  LayoutPieces pieces_;
  LayoutValues layout_values_;
  std::vector<Index> chart_of_;               // by face
  std::vector<std::atomic<char>> has_texel_;  // by chart
  BakedTexels baked_;
};

}  // namespace

bool is_in_unit_square(const BezierMap& map) {
  return map.control_points().minCoeff() >= 0 && map.control_points().maxCoeff() <= 1;
}

BakedImage bake(const InverseMap& layout, const BakeOptions& options,
                const Correspondence& place_of, const SurfaceValues& values,
                const StopCheck& stop) {
  return Baker(layout, options, place_of, values).run(stop);
}

TexelDensity texel_density(const BezierMap& map, int width, int height) {
  const MapDistortion measured = measure_distortion(map);
  const auto area_column = std::distance(
      kFaceDistortionNames.begin(),
      std::find(kFaceDistortionNames.begin(), kFaceDistortionNames.end(), "area_distortion"));
  const double texels = static_cast<double>(width) * height;
  TexelDensity density{std::numeric_limits<double>::infinity(), 0, 0};
  double area = 0;
  for (Index f = 0; f < measured.area.size(); ++f) {
    const double here = std::sqrt(std::abs(measured.faces(f, area_column)) * texels);
    if (!(measured.area[f] > 0) || !std::isfinite(here)) continue;
    density.min = std::min(density.min, here);
    density.max = std::max(density.max, here);
    density.mean += measured.area[f] * here;
    area += measured.area[f];
  }
  if (!(area > 0)) return {};
  density.mean /= area;
  return density;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
