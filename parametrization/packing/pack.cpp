#include "majorant/parametrization/packing/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "majorant/certify/map_proof.h"
#include "majorant/certify/proven_distance.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/packing/internal/nesting.h"
#include "majorant/parametrization/packing/internal/packing_job.h"
#include "majorant/parametrization/packing/internal/placements.h"
#include "majorant/parametrization/packing/internal/raster.h"
#include "majorant/parametrization/packing/internal/skyline.h"

namespace majorant {
namespace {

// The smallest distance of two charts, relative to the side, even without padding: a thousandth of
// a pixel, and a billion roundings.
constexpr double kLeastGap = 1e-6;
// Gaps are enlarged by this fraction, far above the effect of rounding and of the rotations of
// attempts(), far below a pixel.
constexpr double kGapMargin = 1e-5;
// The bisections of the skyline: the side is known to about 1e-4, in a fraction of a second for
// 10,000 boxes.
constexpr int kSkylineTries = 14;
// The first width of the skyline, in square roots of the area, and the factor from square to square
// until one holds all charts. Chosen, not tuned.
constexpr double kFirstWidth = 1.5, kSkylineFactor = 1.25;
// The first width of the raster, in sides of the skyline's square, that of nesting, in the better
// side of these two, and the factor of both. Chosen, not tuned.
constexpr double kRasterWidth = 0.9, kNestingWidth = 0.97, kFactor = 1.08;

// Cells of the raster along the side. Tuned by bench/packing.cpp: twice as many gain less than 0.01
// of fill for few charts, and 0.02 to 0.04 for many.
constexpr int kCoarseCells = 1024, kFineCells = 2048;
constexpr std::size_t kFew = 200;
// Upper bound on the charts that are nested, which takes seconds (bench/packing.cpp).
constexpr std::size_t kMostNested = 40;
// Bisections of raster and nesting, after the square is known to within 8 %; the side is then known
// to 0.5 %.
constexpr int kTries = 4;
// Bisections of the raster for more than kMany charts: 1,000 charts are packed in the time of their
// solves.
constexpr int kFewTries = 1;
constexpr std::size_t kMany = 500;

// Fractions of progress of packing: outlines computed, boxes arranged, outlines of cells arranged,
// all attempts made, charts moved. The rest is the proof of their distances.
constexpr double kOutlined = 0.1, kBoxesArranged = 0.2, kRasterArranged = 0.5, kArranged = 0.7,
                 kMoved = 0.9;

// Additional rotations that are tried, radians: each rounds all digits anew, and a chart as large
// as the square stays within the gap's margin (kGapMargin).
constexpr double kNudge = 1e-9;
constexpr int kNudges = 8;

// Tiles in one row of UDIM.
constexpr int kTilesInRow = 10;
constexpr int kFirstTile = 1001;

// Returns uv rotated, before the origin is subtracted.
Vector2 turned(const LayoutMotion& m, const Vector2& uv) {
  return {m.direction.x() * uv.x() + m.direction.y() * uv.y(),
          m.direction.x() * uv.y() - m.direction.y() * uv.x()};
}

// Rotates the motion further, keeping `middle` fixed.
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

// Returns whether the squares have a given size and place.
bool has_tiles(const PackOptions& options) { return options.tiles > 1 || options.side; }

class Packer {
 public:
  // options: of the square within the border. border: in sides of such squares.
  Packer(const std::vector<BezierMap>& charts, const PackOptions& options, double border,
         const StopCheck& stop)
      : charts_(charts),
        options_(options),
        border_(border),
        progress_(stop),
        stop_(stop.silent()),
        least_distance_(charts.size() < 2
                            ? kLeastGap  // one chart has no neighbour
                            : std::max(options.padding_pixels / options.resolution, kLeastGap)),
        freedom_(charts.size(), AllowedRotations::Any) {
    for (std::size_t k = 0; k < options.fixed.size(); ++k)
      if (options.fixed[k]) freedom_[k] = AllowedRotations::None;
  }

  // Packs, and starts over with less freedom for charts whose smallest faces rounding would invert.
  Packing pack() {
    if (!(least_distance_ < 1)) refuse_padding();
    for (;;) {
      const std::vector<AllowedRotations> freedom = freedom_;
      const PackingJob job =
          packing_job(charts_, freedom_, least_distance_ * (1 + kGapMargin),
                      {options_.tiles, options_.up, options_.quarter_turns}, stop_);
      progress_.advance(kOutlined);
      std::vector<Candidate> candidates = options_.side ? fitted(job) : arrange(job);
      progress_.advance(kArranged);
      if (candidates.empty() && options_.side) refuse_side(job);
      if (candidates.empty()) refuse_padding();
      std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return a.placements.side < b.placements.side;
      });
      for (const Candidate& candidate : candidates) {
        if (std::optional<Packing> packing = realized(job, candidate)) return std::move(*packing);
        if (freedom_ != freedom) break;
      }
      // Tiles have no place for charts that cannot be moved.
      const bool is_lost = has_tiles(options_) &&
                           std::count(freedom_.begin(), freedom_.end(), AllowedRotations::None) > 0;
      if (freedom_ == freedom || is_lost)
        throw Error(ErrorKind::Unsupported,
                    "packing: charts cannot be moved apart, because rounding would turn their "
                    "smallest faces over, or those held in place leave no room");
    }
  }

 private:
  [[noreturn]] void refuse_padding() const {
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("packing: no square holds {} that are {:.6g} of its side apart; "
                    "less padding or a higher resolution would do",
                    count_text(static_cast<Index>(charts_.size()), "chart"), least_distance_));
  }

  [[noreturn]] void refuse_side(const PackingJob& job) const {
    const std::vector<Candidate> larger = arrange(job);
    if (larger.empty()) refuse_padding();
    double side = larger.front().placements.side;
    for (const Candidate& candidate : larger) side = std::min(side, candidate.placements.side);
    throw Error(ErrorKind::Unsupported,
                fmt::format("packing: the charts need {:.6g} times the side that is given; a lower "
                            "texel density, more tiles or a higher resolution would do",
                            side * job.unit * (1 + kGapMargin) / *options_.side));
  }

  // Returns whether the charts are too large for squares of this width in any arrangement, by their
  // area or the length of one chart. Rasters of such charts would have an unbounded number of
  // cells.
  static bool are_too_large(const PackingJob& job, double width) {
    const double diagonal = std::numbers::sqrt2 * width;
    return job.area > job.tiles * width * width ||
           std::any_of(job.charts.begin(), job.charts.end(),
                       [&](const ChartOutline& chart) { return chart.size.maxCoeff() > diagonal; });
  }

  // Returns candidates for squares of the given side.
  std::vector<Candidate> fitted(const PackingJob& job) const {
    const double width = *options_.side / job.unit / (1 + kGapMargin / 4);
    if (are_too_large(job, width)) return {};
    const int cells = charts_.size() > kFew ? kFineCells : kCoarseCells;
    std::vector<Candidate> candidates;
    const auto add = [&](PackMethod method, std::optional<Strip> strip) {
      if (strip && strip->height <= width)
        candidates.push_back({method, {std::move(strip->poses), width}});
    };
    add(PackMethod::Skyline, skyline_strip(job, width));
    if (candidates.empty()) add(PackMethod::Raster, raster_strip(job, cells, width));
    if (candidates.empty() && charts_.size() <= kMostNested && charts_.size() > 1)
      add(PackMethod::Nesting, nested_strip(job, width));
    return candidates;
  }

  std::vector<Candidate> arrange(const PackingJob& job) const {
    std::vector<Candidate> candidates;
    const auto add = [&](PackMethod method, std::optional<Placements> found) {
      if (found) candidates.push_back({method, std::move(*found)});
    };
    const auto skyline = [&](double width) { return skyline_strip(job, width); };
    add(PackMethod::Skyline, smallest_square(job, skyline,
                                             {kFirstWidth * std::sqrt(job.area / job.tiles),
                                              kSkylineFactor, kSkylineTries}));
    if (candidates.empty() || options_.effort == PackOptions::Effort::Quick) return candidates;
    progress_.advance(kBoxesArranged);
    const double of_boxes = candidates[0].placements.side;
    const int cells = charts_.size() > kFew ? kFineCells : kCoarseCells;
    const int tries = charts_.size() > kMany ? kFewTries : kTries;
    const auto raster = [&](double width) { return raster_strip(job, cells, width); };
    add(PackMethod::Raster,
        smallest_square(job, raster, {kRasterWidth * of_boxes, kFactor, tries}));
    if (charts_.size() > kMostNested || charts_.size() < 2) return candidates;
    progress_.advance(kRasterArranged);
    const double best = std::min(of_boxes, candidates.back().placements.side);
    const auto nesting = [&](double width) { return nested_strip(job, width); };
    add(PackMethod::Nesting,
        smallest_square(job, nesting, {kNestingWidth * best, kFactor, kTries, best}));
    return candidates;
  }

  // Moves the charts to a candidate's placements. Returns none if the proof fails or a chart cannot
  // be moved, which freedom_ then records.
  std::optional<Packing> realized(const PackingJob& job, const Candidate& candidate) {
    Packing packing;
    packing.method = candidate.method;
    const double side = job.unit * candidate.placements.side * (1 + kGapMargin / 4);
    const StopCheck progress = progress_.between(kArranged, kMoved);
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      progress.advance(k, charts_.size());
      const std::optional<MovedLayout> moved =
          freedom_[k] == AllowedRotations::None
              ? MovedLayout{{charts_[k]}, {}}
              : moved_layout({charts_[k]}, attempts(job, k, candidate.placements.poses[k], side),
                             requirements_of(candidate.placements.poses[k], side), stop_);
      if (!moved) {
        freedom_[k] = freedom_[k] == AllowedRotations::Any ? AllowedRotations::QuarterTurns
                                                           : AllowedRotations::None;
        continue;
      }
      packing.charts.push_back(moved->maps.front());
      packing.placements.push_back(moved->motion);
      packing.tiles.push_back(candidate.placements.poses[k].tile);
    }
    if (packing.charts.size() < charts_.size()) return {};
    if (has_tiles(options_)) {
      packing.side = options_.side.value_or(side);
      packing.border = packing.side * border_;
      packing.origin.setConstant(-packing.border);
    } else {
      frame(packing);
    }
    progress_.advance(kMoved);
    const double relative = job.unit / packing.side;
    const std::set<int> used(packing.tiles.begin(), packing.tiles.end());
    packing.fill = job.area * relative * relative / static_cast<double>(used.size());
    const double needed = least_distance_ * packing.side * (1 + kGapMargin / 2);
    packing.distance = proven_distance(packing.charts, needed, options_.fixed, stop_);
    if (packing.distance < needed) return {};
    return packing;
  }

  // Returns the motion of a chart to its pose, and variants rotated a little about its centre. In
  // tiles, charts are moved away from the border by half the difference between the sides of tile
  // and strip.
  std::vector<LayoutMotion> attempts(const PackingJob& job, std::size_t chart, const Pose& pose,
                                     double side) const {
    const ChartOutline& outline = job.charts[chart];
    const double c = outline.cosine, s = outline.sine;
    const Vector2 directions[4] = {{c, -s}, {-s, -c}, {-c, s}, {s, c}};
    LayoutMotion there{directions[pose.quarters & 3]};
    there.origin = -job.unit * (quarter_turned(-outline.low, pose.quarters, outline.size) +
                                pose.low + job.corner);
    if (has_tiles(options_))
      there.origin -=
          side * (tile_corner(pose.tile) * (1 + 2 * border_) + Vector2::Constant(kGapMargin / 8));
    const auto nodes =
        charts_[chart].control_points().reshaped(2, charts_[chart].space().node_count());
    const Vector2 middle = (nodes.rowwise().minCoeff() + nodes.rowwise().maxCoeff()) / 2;
    std::vector<LayoutMotion> out{there};
    for (int k = 1; k <= kNudges; ++k) out.push_back(turned_further(there, k * kNudge, middle));
    return out;
  }

  // Returns the requirement that the chart stays within the border of its tile.
  LayoutRequirements requirements_of(const Pose& pose, double side) const {
    if (!has_tiles(options_)) return {};
    const Vector2 low = side * (1 + 2 * border_) * tile_corner(pose.tile);
    return {.boxes = {Eigen::AlignedBox2d(low, low + Vector2::Constant(side))}};
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
  const double border_;
  const StopCheck progress_, stop_;  // the second without progress, for steps that may be repeated
  const double least_distance_;      // relative to the side
  std::vector<AllowedRotations> freedom_;
};

}  // namespace

Vector2 tile_corner(int tile) { return {tile % kTilesInRow, tile / kTilesInRow}; }

int udim(int tile) { return kFirstTile + tile; }

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
  if (options.tiles < 1 || options.tiles > kMaxTiles)
    throw InvalidArgument(
        fmt::format("pack: {} tiles, 1 to {} are possible", options.tiles, kMaxTiles));
  if (options.side && (!(*options.side > 0) || !std::isfinite(*options.side)))
    throw InvalidArgument(
        fmt::format("pack: a side of {:g}, more than 0 is needed", *options.side));
  if (has_tiles(options) &&
      std::find(options.fixed.begin(), options.fixed.end(), 1) != options.fixed.end())
    throw InvalidArgument(
        "pack: charts that stay where they are in tiles or a square of given side");
  if (charts.empty()) return {};
  PackOptions within = options;  // of the square inside the border
  // A border of at least kLeastGap keeps charts of adjacent tiles apart.
  const double border = options.tiles > 1
                            ? std::max(options.padding_pixels, kLeastGap * options.resolution)
                            : options.padding_pixels;
  within.resolution -= 2 * border;
  if (!(within.resolution > 0))
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("packing: no square of {:.6g} pixels holds {} in a border of "
                    "{:.6g}; less padding or a higher resolution would do",
                    options.resolution, count_text(static_cast<Index>(charts.size()), "chart"),
                    options.padding_pixels));
  const double part = within.resolution / options.resolution;  // of the side
  if (within.side) *within.side *= part;
  Packing packing = Packer(charts, within, border / within.resolution, stop).pack();
  if (has_tiles(options)) {
    packing.side = options.side.value_or(packing.side / part);
  } else {
    packing.origin.array() -= packing.side * (1 / part - 1) / 2;
    packing.side /= part;
  }
  packing.has_tiles = has_tiles(options);
  packing.fill *= part * part;
  return packing;
}

double side_of_shelves(const std::vector<Vector2>& boxes, const PackOptions& options) {
  const double part = 1 - 2 * options.padding_pixels / options.resolution;
  if (!(part > 0)) return std::numeric_limits<double>::infinity();
  PackingJob job;
  job.gap = options.padding_pixels / options.resolution / part;
  for (const Vector2& size : boxes) {
    ChartOutline& chart = job.charts.emplace_back();
    chart.size = size;
    job.area += size.prod();
  }
  job.fixed.resize(boxes.size());
  const auto shelves = [&](double width) { return skyline_strip(job, width); };
  const std::optional<Placements> square = smallest_square(
      job, shelves, {kFirstWidth * std::sqrt(job.area), kSkylineFactor, kSkylineTries});
  return square ? square->side / part : std::numeric_limits<double>::infinity();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
