#include "majorant/parametrization/packing/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/parametrization/packing/internal/arrangement.h"
#include "majorant/parametrization/packing/internal/chart_motion.h"
#include "majorant/parametrization/packing/internal/layout_unit.h"
#include "majorant/parametrization/packing/internal/skyline.h"
#include "majorant/parametrization/packing/proven_distance.h"

namespace majorant {
namespace {

// Charts do not touch, whatever padding was asked for: as a part of the side. Origin: a thousandth
// of a pixel, and a billion roundings.
constexpr double kLeastGap = 1e-6;
// Gaps are made larger than asked for by this. Origin: far above what rounding and the turns of
// moved_chart() take, far below a pixel.
constexpr double kGapMargin = 1e-5;
// Curves are followed by polygons this close, as a part of the square root of the charts' area.
// Origin: a twentieth of 4 pixels in 1024.
constexpr double kReach = 2e-4;
// Origin: the side to within 1e-4 or so, and a fraction of a second for 10,000 boxes.
constexpr int kSkylineTries = 14;

struct Candidate {
  PackMethod method;
  Arrangement arrangement;
};

class Packer {
 public:
  Packer(const std::vector<BezierMap>& charts, const PackOptions& options, const StopCheck& stop)
      : charts_(charts),
        options_(options),
        stop_(stop),
        unit_(layout_unit(charts)),
        least_distance_(std::max(options.padding_pixels / options.resolution, kLeastGap)),
        held_(options.fixed.empty() ? std::vector<char>(charts.size(), 0) : options.fixed) {}

  // Charts that rounding lets be nowhere but where they are make it start over with them held.
  Packing pack() {
    for (;;) {
      const std::vector<char> held = held_;
      const PackingJob job = make_job();
      std::vector<Candidate> candidates = arrange(job);
      if (candidates.empty())
        throw Error(ErrorKind::Unsupported,
                    fmt::format("packing: no square holds {} charts that are {} of its side apart; "
                                "less padding or a higher resolution would do",
                                charts_.size(), least_distance_));
      std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return a.arrangement.side < b.arrangement.side;
      });
      for (const Candidate& candidate : candidates) {
        if (std::optional<Packing> packing = realized(job, candidate)) return std::move(*packing);
        if (held_ != held) break;
      }
      if (held_ == held)
        throw Error(ErrorKind::Unsupported,
                    "packing: charts cannot be moved apart, because rounding would turn their "
                    "smallest faces over, or those held in place leave no room");
    }
  }

 private:
  PackingJob make_job() {
    PackingJob job;
    job.stop = stop_;
    job.gap = least_distance_ * (1 + kGapMargin);
    area_ = 0;
    for (const BezierMap& chart : charts_) area_ += chart_area(chart, unit_);
    const double reach = kReach * std::sqrt(area_);
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      stop_.poll();
      job.parcels.push_back(
          parcel_of(charts_[k], unit_, reach, held_[k] ? Turn::None : Turn::Tightest));
    }
    corner_ = Vector2::Constant(std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < charts_.size(); ++k)
      if (held_[k]) corner_ = corner_.cwiseMin(job.parcels[k].low);
    if (!corner_.allFinite()) corner_.setZero();
    job.fixed.resize(charts_.size());
    for (std::size_t k = 0; k < charts_.size(); ++k)
      if (held_[k]) job.fixed[k] = job.parcels[k].low - corner_;
    return job;
  }

  std::vector<Candidate> arrange(const PackingJob& job) const {
    std::vector<Candidate> candidates;
    const auto add = [&](PackMethod method, std::optional<Arrangement> found) {
      if (found) candidates.push_back({method, std::move(*found)});
    };
    add(PackMethod::Skyline,
        smallest_square(
            job, [&](double width) { return skyline_strip(job, width); }, kSkylineTries));
    return candidates;
  }

  // None where the proof fails, or a chart does not bear to be moved: held_ says so.
  std::optional<Packing> realized(const PackingJob& job, const Candidate& candidate) {
    Packing packing;
    packing.method = candidate.method;
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      if (held_[k]) {
        packing.charts.push_back(charts_[k]);
        packing.placements.push_back({});
        continue;
      }
      const Placement there = placement_of(job.parcels[k], candidate.arrangement.spots[k]);
      if (std::optional<MovedChart> moved = moved_chart(charts_[k], there, stop_)) {
        packing.charts.push_back(std::move(moved->map));
        packing.placements.push_back(moved->placement);
      } else {
        held_[k] = 1;
        packing.charts.push_back(charts_[k]);
      }
    }
    if (packing.placements.size() < charts_.size()) return {};
    frame(packing);
    const double needed = least_distance_ * packing.side * (1 + kGapMargin / 2);
    packing.distance = proven_distance(packing.charts, needed, options_.fixed, stop_);
    if (packing.distance < needed) return {};
    return packing;
  }

  Placement placement_of(const Parcel& parcel, const Spot& spot) const {
    Placement p;
    const double c = parcel.cosine, s = parcel.sine;
    const std::pair<double, double> turns[4] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
    std::tie(p.cosine, p.sine) = turns[spot.quarters & 3];
    // Where the origin of the turned chart comes to lie.
    p.translation =
        unit_ * (quarter_turned(-parcel.low, spot.quarters, parcel.size) + spot.low + corner_);
    return p;
  }

  void frame(Packing& packing) const {
    Vector2 low = packing.charts[0].control_points().head<2>(), high = low;
    for (const BezierMap& chart : packing.charts) {
      const auto nodes = chart.control_points().reshaped(2, chart.space().node_count());
      low = low.cwiseMin(nodes.rowwise().minCoeff());
      high = high.cwiseMax(nodes.rowwise().maxCoeff());
    }
    packing.origin = low;
    packing.side = (high - low).maxCoeff();
    packing.fill = area_ * (unit_ / packing.side) * (unit_ / packing.side);
  }

  const std::vector<BezierMap>& charts_;
  const PackOptions& options_;
  const StopCheck& stop_;
  const double unit_;
  const double least_distance_;  // as a part of the side
  std::vector<char> held_;  // stay: the fixed ones, and those that rounding lets be nowhere else
  double area_ = 0;         // of the charts, and
  Vector2 corner_;          // of the square, in units
};

}  // namespace

std::string_view name_of(PackMethod method) {
  constexpr std::string_view kNames[] = {"skyline", "raster", "nesting"};
  return kNames[static_cast<std::size_t>(method)];
}

Packing pack(const std::vector<BezierMap>& charts, const PackOptions& options,
             const StopCheck& stop) {
  if (!(options.padding_pixels >= 0) || !std::isfinite(options.padding_pixels) ||
      !(options.resolution > 0))
    throw std::invalid_argument("pack: padding must not be negative, resolution be positive");
  if (!options.fixed.empty() && options.fixed.size() != charts.size())
    throw std::invalid_argument("pack: one flag a chart");
  if (charts.empty()) return {};
  return Packer(charts, options, stop).pack();
}

}  // namespace majorant
