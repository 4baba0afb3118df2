#include "majorant/parametrization/packing/internal/skyline.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace majorant {
namespace {

// The upper side of the placed boxes: steps from left to right.
class Skyline {
 public:
  explicit Skyline(double width) : width_(width), steps_{{0, 0}} {}

  // Returns the lowest place, the leftmost of several; none if the box is too wide, or its top
  // above `most`.
  std::optional<Vector2> place(const Vector2& size,
                               double most = std::numeric_limits<double>::infinity()) {
    std::optional<Vector2> best;
    std::size_t best_step = 0;
    for (std::size_t k = 0; k < steps_.size() && steps_[k].x + size.x() <= width_; ++k) {
      double y = steps_[k].y;
      for (std::size_t l = k + 1; l < steps_.size() && steps_[l].x < steps_[k].x + size.x(); ++l)
        y = std::max(y, steps_[l].y);
      if (best && best->y() <= y) continue;
      best = Vector2(steps_[k].x, y);
      best_step = k;
    }
    if (!best || best->y() + size.y() > most) return {};
    raise(best_step, best->x() + size.x(), best->y() + size.y());
    return best;
  }

 private:
  struct Step {
    double x, y;  // the skyline has height y from x to the next step
  };

  void raise(std::size_t first, double end, double y) {
    std::size_t last = first;  // the step under `end`
    while (last + 1 < steps_.size() && steps_[last + 1].x <= end) ++last;
    const Step rest{end, steps_[last].y};
    steps_[first].y = y;
    const auto begin = steps_.begin() + static_cast<std::ptrdiff_t>(first) + 1;
    const auto kept = steps_.erase(begin, steps_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    if (end < width_) steps_.insert(kept, rest);
  }

  double width_;
  std::vector<Step> steps_;
};

enum class ChartPose { Lying, Upright };

std::optional<Strip> shelves(const PackingJob& job, double width, ChartPose pose) {
  const double gap = job.gap * width;
  std::vector<Skyline> skylines(to_size(job.tiles), Skyline(width + gap));
  Strip strip{std::vector<Pose>(job.charts.size()), 0};
  Vector2 fixed = Vector2::Zero();
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < job.charts.size(); ++k) {
    if (!job.fixed[k]) {
      order.push_back(k);
      // Boxes lie first; upright ones are rotated by a quarter.
      strip.poses[k].quarters = pose == ChartPose::Upright && job.charts[k].quarter_turns > 1;
      continue;
    }
    strip.poses[k].low = *job.fixed[k];
    fixed = fixed.cwiseMax(*job.fixed[k] + job.charts[k].size);
  }
  if (order.size() < job.charts.size()) {
    if (!skylines.front().place(fixed.array() + gap)) return {};
    strip.height = fixed.y();
  }
  const auto size = [&](std::size_t k) {
    return size_after(job.charts[k], strip.poses[k].quarters);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Vector2 p = size(a), q = size(b);
    return p.y() > q.y() || (p.y() == q.y() && p.x() > q.x());
  });
  for (const std::size_t k : order) {
    std::optional<Vector2> place;
    int& tile = strip.poses[k].tile;
    for (; tile + 1 < job.tiles && !place; tile += !place)
      place = skylines[to_size(tile)].place(size(k).array() + gap, width + gap);
    if (!place) place = skylines.back().place(size(k).array() + gap);
    if (!place) return {};
    strip.poses[k].low = *place;
    strip.height = std::max(strip.height, place->y() + size(k).y());
  }
  return strip;
}

}  // namespace

std::optional<Strip> skyline_strip(const PackingJob& job, double width) {
  std::optional<Strip> lying = shelves(job, width, ChartPose::Lying),
                       upright = shelves(job, width, ChartPose::Upright);
  return !lying || (upright && upright->height < lying->height) ? upright : lying;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
