#include "majorant/parametrization/packing/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "majorant/certify/proven_distance.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/packing/internal/nesting.h"
#include "majorant/parametrization/packing/internal/packing_job.h"
#include "majorant/parametrization/packing/internal/placements.h"
#include "majorant/parametrization/packing/internal/raster.h"
#include "majorant/parametrization/packing/internal/skyline.h"

namespace majorant {
namespace {

// Charts do not touch, whatever padding was asked for: as a part of the side. A thousandth
// of a pixel, and a billion roundings.
constexpr double kLeastGap = 1e-6;
// Gaps are made larger than asked for by this. Far above what rounding and the turns of
// attempts() take, far below a pixel.
constexpr double kGapMargin = 1e-5;
// The side to within 1e-4 or so, and a fraction of a second for 10,000 boxes.
constexpr int kSkylineTries = 14;
// First width of the skyline, in roots of the area, and the factor from square to square until one
// holds all. Chosen, not tuned.
constexpr double kFirstWidth = 1.5, kSkylineFactor = 1.25;
// First width and factor of the raster, in sides that the skyline found, and of nesting, in the
// best side of these two. Chosen, not tuned.
constexpr double kRasterWidth = 0.9, kNestingWidth = 0.97, kFactor = 1.08;

// Cells of the raster along the side. Measured by bench/packing.cpp, twice as many gain less than
// 0.01 of fill for few charts, and 0.02 to 0.04 for many.
constexpr int kCoarseCells = 1024, kFineCells = 2048;
constexpr std::size_t kFew = 200;
// More than these are not nested. Measured by bench/packing.cpp, seconds.
constexpr std::size_t kMostNested = 40;
// The tries of raster and nesting, after the square is known to within 8 %. The side to 0.5 %.
constexpr int kTries = 4;
// The tries of the raster where charts are more than kMany. 1,000 charts are packed in the time
// that their solves take.
constexpr int kFewTries = 1;
constexpr std::size_t kMany = 500;

// Turns that are tried in addition, in radians: each rounds all digits anew, and a chart as large
// as the square stays within the gap's margin (kGapMargin).
constexpr double kNudge = 1e-9;
constexpr int kNudges = 8;

// uv before it is moved by the origin.
Vector2 turned(const LayoutMotion& m, const Vector2& uv) {
  return {m.direction.x() * uv.x() + m.direction.y() * uv.y(),
          m.direction.x() * uv.y() - m.direction.y() * uv.x()};
}

// `middle` stays where it is.
LayoutMotion turned_further(const LayoutMotion& m, double angle, const Vector2& middle) {
  LayoutMotion more;
  const double cosine = m.direction.x(), sine = -m.direction.y();
  more.direction = {cosine * std::cos(angle) - sine * std::sin(angle),
                    -(sine * std::cos(angle) + cosine * std::sin(angle))};
  more.origin = -(-m.origin + turned(m, middle) - turned(more, middle));
  return more;
}

struct Candidate {
  PackMethod method;
  Placements placements;
};

// Along the side of the square that the border surrounds.
double inner_pixels(const PackOptions& options) {
  return options.resolution - 2 * options.padding_pixels;
}

// The border, as wide as the padding, around the square.
void add_border(const PackOptions& options, Packing& packing) {
  const double inner = packing.side;
  packing.side *= options.resolution / inner_pixels(options);
  packing.origin.array() -= (packing.side - inner) / 2;
  packing.fill *= (inner / packing.side) * (inner / packing.side);
}

class Packer {
 public:
  Packer(const std::vector<BezierMap>& charts, const PackOptions& options, const StopCheck& stop)
      : charts_(charts),
        options_(options),
        stop_(stop),
        least_distance_(charts.size() < 2
                            ? kLeastGap  // one chart has no neighbour
                            : std::max(options.padding_pixels / inner_pixels(options), kLeastGap)),
        freedom_(charts.size(), AllowedRotations::Any) {
    for (std::size_t k = 0; k < options.fixed.size(); ++k)
      if (options.fixed[k]) freedom_[k] = AllowedRotations::None;
  }

  // Starts over with less freedom for charts whose smallest faces rounding turns over.
  Packing pack() {
    if (!(least_distance_ < 1)) refuse_padding();
    for (;;) {
      const std::vector<AllowedRotations> freedom = freedom_;
      const PackingJob job =
          packing_job(charts_, freedom_, least_distance_ * (1 + kGapMargin), stop_);
      std::vector<Candidate> candidates = arrange(job);
      if (candidates.empty()) refuse_padding();
      std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return a.placements.side < b.placements.side;
      });
      for (const Candidate& candidate : candidates) {
        if (std::optional<Packing> packing = realized(job, candidate)) return std::move(*packing);
        if (freedom_ != freedom) break;
      }
      if (freedom_ == freedom)
        throw Error(ErrorKind::Unsupported,
                    "packing: charts cannot be moved apart, because rounding would turn their "
                    "smallest faces over, or those held in place leave no room");
    }
  }

 private:
  [[noreturn]] void refuse_padding() const {
    throw Error(ErrorKind::Unsupported,
                fmt::format("packing: no square holds {} charts that are {:.6g} of its side apart; "
                            "less padding or a higher resolution would do",
                            charts_.size(), least_distance_));
  }

  std::vector<Candidate> arrange(const PackingJob& job) const {
    std::vector<Candidate> candidates;
    const auto add = [&](PackMethod method, std::optional<Placements> found) {
      if (found) candidates.push_back({method, std::move(*found)});
    };
    const auto skyline = [&](double width) { return skyline_strip(job, width); };
    add(PackMethod::Skyline,
        smallest_square(job, skyline,
                        {kFirstWidth * std::sqrt(job.area), kSkylineFactor, kSkylineTries}));
    if (candidates.empty()) return candidates;
    const double of_boxes = candidates[0].placements.side;
    const int cells = charts_.size() > kFew ? kFineCells : kCoarseCells;
    const int tries = charts_.size() > kMany ? kFewTries : kTries;
    const auto raster = [&](double width) { return raster_strip(job, cells, width); };
    add(PackMethod::Raster,
        smallest_square(job, raster, {kRasterWidth * of_boxes, kFactor, tries}));
    if (charts_.size() > kMostNested || charts_.size() < 2) return candidates;
    const double best = std::min(of_boxes, candidates.back().placements.side);
    const auto nesting = [&](double width) { return nested_strip(job, width); };
    add(PackMethod::Nesting,
        smallest_square(job, nesting, {kNestingWidth * best, kFactor, kTries, best}));
    return candidates;
  }

  // None where the proof fails, or a chart does not bear to be moved: freedom_ says so then.
  std::optional<Packing> realized(const PackingJob& job, const Candidate& candidate) {
    Packing packing;
    packing.method = candidate.method;
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      const std::optional<MovedLayout> moved =
          freedom_[k] == AllowedRotations::None
              ? MovedLayout{{charts_[k]}, {}}
              : moved_layout({charts_[k]}, attempts(job, k, candidate.placements.poses[k]), {},
                             stop_);
      if (!moved) {
        freedom_[k] = freedom_[k] == AllowedRotations::Any ? AllowedRotations::QuarterTurns
                                                           : AllowedRotations::None;
        continue;
      }
      packing.charts.push_back(moved->maps.front());
      packing.placements.push_back(moved->motion);
    }
    if (packing.charts.size() < charts_.size()) return {};
    frame(packing);
    const double relative = job.unit / packing.side;
    packing.fill = job.area * relative * relative;
    const double needed = least_distance_ * packing.side * (1 + kGapMargin / 2);
    packing.distance = proven_distance(packing.charts, needed, options_.fixed, stop_);
    if (packing.distance < needed) return {};
    return packing;
  }

  // The motion to its pose, and turned a little further about the middle of the chart.
  std::vector<LayoutMotion> attempts(const PackingJob& job, std::size_t chart,
                                     const Pose& pose) const {
    const ChartOutline& outline = job.charts[chart];
    const double c = outline.cosine, s = outline.sine;
    const Vector2 directions[4] = {{c, -s}, {-s, -c}, {-c, s}, {s, c}};
    LayoutMotion there{directions[pose.quarters & 3]};
    // The place of the origin of the turned chart.
    there.origin = -job.unit * (quarter_turned(-outline.low, pose.quarters, outline.size) +
                                pose.low + job.corner);
    const auto nodes =
        charts_[chart].control_points().reshaped(2, charts_[chart].space().node_count());
    const Vector2 middle = (nodes.rowwise().minCoeff() + nodes.rowwise().maxCoeff()) / 2;
    std::vector<LayoutMotion> out{there};
    for (int k = 1; k <= kNudges; ++k) out.push_back(turned_further(there, k * kNudge, middle));
    return out;
  }

  static void frame(Packing& packing) {
    Vector2 low = packing.charts[0].control_points().head<2>(), high = low;
    for (const BezierMap& chart : packing.charts) {
      const auto nodes = chart.control_points().reshaped(2, chart.space().node_count());
      low = low.cwiseMin(nodes.rowwise().minCoeff());
      high = high.cwiseMax(nodes.rowwise().maxCoeff());
    }
    packing.origin = low;
    packing.side = (high - low).maxCoeff();
  }

  const std::vector<BezierMap>& charts_;
  const PackOptions& options_;
  const StopCheck& stop_;
  const double least_distance_;  // as a part of the side
  std::vector<AllowedRotations> freedom_;
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
    throw InvalidArgument(
        fmt::format("pack: padding_pixels is {:g}, at least 0 is needed, resolution "
                    "{:g}, more than 0",
                    options.padding_pixels, options.resolution));
  if (!options.fixed.empty() && options.fixed.size() != charts.size())
    throw InvalidArgument(
        fmt::format("pack: {} flags for {} charts", options.fixed.size(), charts.size()));
  if (charts.empty()) return {};
  if (!(inner_pixels(options) > 0))
    throw Error(ErrorKind::Unsupported,
                fmt::format("packing: a border of {:.6g} pixels leaves nothing of {:.6g}; less "
                            "padding or a higher resolution would do",
                            options.padding_pixels, options.resolution));
  Packing packing = Packer(charts, options, stop).pack();
  add_border(options, packing);
  return packing;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
