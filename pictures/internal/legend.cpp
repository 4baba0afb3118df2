#include "majorant/pictures/internal/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/layout_scale.h"
#include "majorant/maps/extreme_samples.h"
#include "majorant/pictures/internal/bezier_image.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/density_probe.h"

namespace majorant {
namespace {

constexpr double kSlack = 1e-6;
// Faces that are evaluated together, so that their values fit into a core's cache.
constexpr Index kBlock = 64;

struct Extremes {
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
};

// Returns the clause of legends about the sampling of values inside of faces.
std::string sampling_words(int degree) {
  const std::size_t points = extreme_samples(degree).size();
  return points == 1 ? "" : fmt::format(" ({} points a face)", points);
}

// Returns none if no face counts.
std::optional<Extremes> extremes_of(const MapFile& map, Quantity quantity,
                                    const ClaimedEnergy& energy) {
  const BezierImage image(map, layout_scale(map));
  const DensityProbe probe(quantity == Quantity::Density ? energy.sum : EnergySum());
  const std::vector<Barycentric> points = extreme_samples(map.degree);
  const auto faces = static_cast<Index>(map.cells.rows());
  std::vector<Extremes> blocks(to_size(faces / kBlock + 1));
  parallel_for(static_cast<Index>(blocks.size()), 1, [&](Index block) {
    std::vector<Vector2> sigma;
    for (Index f = block * kBlock; f < std::min(faces, (block + 1) * kBlock); ++f)
      for (const Barycentric& xi : points)
        if (const PointDistortion d = image.at(f, xi).distortion; d.sigma_2 > 0)
          sigma.emplace_back(d.sigma_1, d.sigma_2);
    std::vector<double> values(sigma.size());
    evaluate(quantity, probe, sigma, values);
    for (const double value : values) {
      blocks[block].smallest = std::min(blocks[block].smallest, value);
      blocks[block].largest = std::max(blocks[block].largest, value);
    }
  });
  Extremes all;
  for (const Extremes& e : blocks) {
    all.smallest = std::min(all.smallest, e.smallest);
    all.largest = std::max(all.largest, e.largest);
  }
  return all.smallest <= all.largest ? std::optional(all) : std::nullopt;
}

}  // namespace

ColorScale picture_scale(const ClaimedEnergy& energy, Quantity quantity,
                         const std::optional<ColorRange>& range) {
  const ColorScale fixed = color_scale(quantity, energy.sum);
  if (!range) return fixed;
  try {
    return fixed.with_range(range->low, range->high);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("the color range: {}", e.what()));
  }
}

void ValueSummary::add(const ColorScale& scale, double value) {
  const double slack = kSlack * (scale.high() - scale.low());  // densities are rounded
  ++count;
  below += value < scale.low() - slack ? 1 : 0;
  above += value <= scale.high() + slack ? 0 : 1;
}

void ValueSummary::add(const ValueSummary& other) {
  count += other.count;
  below += other.below;
  above += other.above;
}

std::string extremes_clause(const MapFile& map, Quantity quantity, const ClaimedEnergy& energy) {
  const std::optional<Extremes> e = extremes_of(map, quantity, energy);
  const bool is_finite = e && std::isfinite(e->smallest) && std::isfinite(e->largest);
  if (!is_finite) return {};  // no face counts, or uv overflows
  return fmt::format("; smallest {:.4g}, largest {:.4g}{}", e->smallest, e->largest,
                     sampling_words(map.degree));
}

std::string beyond_clauses(const ColorScale& scale, const ValueSummary& values,
                           const std::string& parts) {
  std::string text;
  for (const auto& [count, where, end] :
       {std::tuple{values.below, "below", scale.low()}, {values.above, "above", scale.high()}})
    if (count > 0)
      text += fmt::format("; {} of {} {} {} {:.4g}", count, values.count, parts, where, end);
  return text;
}

Legend scale_legend(Quantity quantity, const ColorScale& scale, const ClaimedEnergy& energy) {
  Legend legend{scale, scale.label(), fmt::format("isometry {:.4g}", scale.neutral())};
  if (quantity == Quantity::Density) legend.title = fmt::format("{} density", energy.name);
  return legend;
}

Legend make_legend(const MapFile& map, Quantity quantity, const ColorScale& scale) {
  const ClaimedEnergy energy = claimed_energy(map);
  Legend legend = scale_legend(quantity, scale, energy);
  legend.title += fmt::format(", degree {}", map.degree);
  legend.note += extremes_clause(map, quantity, energy);
  return legend;
}

Legend with_values(const Legend& legend, const ValueSummary& values, const std::string& parts) {
  Legend result = legend;
  result.goes_below = values.below > 0;
  result.goes_above = values.above > 0;
  result.note += beyond_clauses(legend.scale, values, parts);
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
