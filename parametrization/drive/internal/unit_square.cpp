#include "majorant/parametrization/drive/internal/unit_square.h"

#include <cmath>

namespace majorant {

std::optional<InUnitSquare> into_unit_square(const BezierMap& map, const EnergySum& energy,
                                             const StopCheck& stop) {
  const auto nodes = map.control_points().reshaped(2, map.space().node_count());
  const Vector2 low = nodes.rowwise().minCoeff(), high = nodes.rowwise().maxCoeff();
  const double side = (high - low).maxCoeff();
  for (const double size : {side, std::exp2(std::ceil(std::log2(side)))}) {
    Vec x = (nodes.colwise() - low).reshaped();
    x /= size;
    BezierMap moved = map.with(map.shared_space(), std::move(x));
    MapMeasures measures = measure_normalized(moved, size, energy, stop);
    if (measures.locally_injective)
      return InUnitSquare{std::move(moved), low, size, std::move(measures)};
  }
  return {};
}

}  // namespace majorant
