#include "majorant/pictures/internal/legend.h"

#include <fmt/format.h>

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
    throw Error(e.kind(), fmt::format("--color-range: {}", e.what()));
  }
}

Legend make_legend(const MapFile& map, const ColorScale& scale, VecIn values,
                   const std::string& parts) {
  const double slack = kSlack * (scale.high() - scale.low());  // densities are rounded
  const Index below = (values.array() < scale.low() - slack).count();
  const Index above = values.size() - (values.array() <= scale.high() + slack).count();
  const std::string energy = claimed_energy(map).name;
  Legend legend{scale, "", "", below > 0, above > 0};
  legend.title =
      fmt::format("{}, degree {}", scale.label() == "density" ? energy + " density" : scale.label(),
                  map.degree);
  legend.note = fmt::format("isometry {:.4g}; smallest {:.4g}, largest {:.4g}", scale.neutral(),
                            values.minCoeff(), values.maxCoeff());
  if (below > 0)
    legend.note +=
        fmt::format("; {} of {} {} below {:.4g}", below, values.size(), parts, scale.low());
  if (above > 0)
    legend.note +=
        fmt::format("; {} of {} {} above {:.4g}", above, values.size(), parts, scale.high());
  return legend;
}

}  // namespace majorant
