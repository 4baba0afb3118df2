#include "majorant/pictures/internal/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "majorant/framework/error.h"
#include "majorant/pictures/internal/claimed_energy.h"

namespace majorant {
namespace {

constexpr double kSlack = 1e-6;

}  // namespace

ColorScale picture_scale(const MapFile& map, Quantity quantity,
                         const std::optional<ColorRange>& range) {
  const ColorScale fixed = color_scale(quantity, claimed_energy(map).sum);
  if (!range) return fixed;
  try {
    return fixed.with_range(range->low, range->high);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("the color range: {}", e.what()));
  }
}

void ValueSummary::add(const ColorScale& scale, double value) {
  const double slack = kSlack * (scale.high() - scale.low());  // densities are rounded
  smallest = std::min(smallest, value);
  largest = std::max(largest, value);
  ++count;
  below += value < scale.low() - slack ? 1 : 0;
  above += value <= scale.high() + slack ? 0 : 1;
}

void ValueSummary::add(const ValueSummary& other) {
  smallest = std::min(smallest, other.smallest);
  largest = std::max(largest, other.largest);
  count += other.count;
  below += other.below;
  above += other.above;
}

Legend make_legend(const MapFile& map, const ColorScale& scale, const ValueSummary& values,
                   const std::string& parts) {
  Legend legend{scale, scale.label(), "", values.below > 0, values.above > 0};
  if (const std::string energy = claimed_energy(map).name;
      scale.label() == quantity_name(Quantity::Density))
    legend.title = fmt::format("{} density", energy);
  legend.title += fmt::format(", degree {}", map.degree);
  legend.note = fmt::format("isometry {:.4g}", scale.neutral());
  if (values.count > 0)
    legend.note +=
        fmt::format("; smallest {:.4g}, largest {:.4g}", values.smallest, values.largest);
  for (const auto& [count, where, end] :
       {std::tuple{values.below, "below", scale.low()}, {values.above, "above", scale.high()}})
    if (count > 0)
      legend.note += fmt::format("; {} of {} {} {} {:.4g}", count, values.count, parts, where, end);
  return legend;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
