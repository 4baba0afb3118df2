#include "majorant/parametrization/packing/internal/arrangement.h"

#include <algorithm>
#include <cmath>

namespace majorant {

std::optional<Arrangement> smallest_square(const PackingJob& job, const StripPacker& strip,
                                           int tries) {
  // Origin: from a fill of 1 to one of 1e-5, beyond which the gaps fill the square.
  constexpr double kGrowth = 1.25;
  constexpr int kMostGrowths = 26;
  double area = 0, low = 0;
  for (std::size_t k = 0; k < job.parcels.size(); ++k) {
    const Parcel& parcel = job.parcels[k];
    area += parcel.area;
    const Vector2 corner = job.fixed[k] ? Vector2(*job.fixed[k] + parcel.size) : parcel.size;
    low = std::max(low, job.fixed[k] ? corner.maxCoeff() : corner.minCoeff());
  }
  low = std::max(low, std::sqrt(area));

  std::optional<Arrangement> best;
  const auto fits = [&](double side) {
    job.stop.poll();
    std::optional<Strip> packed = strip(side);
    if (!packed || packed->height > side) return false;
    if (!best || side < best->side) best = Arrangement{std::move(packed->spots), side};
    return true;
  };
  double high = low;
  for (int k = 0; !fits(high); ++k, high *= kGrowth) {
    if (k == kMostGrowths) return {};
    low = high;
  }
  for (int k = 0; k < tries && low < high; ++k) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? high : low) = middle;
  }
  return best;
}

}  // namespace majorant
