#include "majorant/parametrization/packing/internal/chart_motion.h"

#include <cmath>
#include <utility>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/parametrization/injectivity/internal/exact_positivity.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// Turns that are tried in addition, in radians. Origin: each rounds all digits anew, and a chart as
// large as the square stays within the gap's margin (kGapMargin, pack.cpp).
constexpr double kNudge = 1e-9;
constexpr int kNudges = 8;

// As the placement says, in extended precision, rounded once.
BezierMap placed(const BezierMap& chart, const Placement& p) {
  using Real = long double;
  Vec x = chart.control_points();
  for (Index k = 0; k < x.size(); k += 2) {
    const Real u = x[k], v = x[k + 1];
    x[k] = static_cast<double>(Real(p.cosine) * u - Real(p.sine) * v + Real(p.translation.x()));
    x[k + 1] = static_cast<double>(Real(p.sine) * u + Real(p.cosine) * v + Real(p.translation.y()));
  }
  return chart.with(chart.shared_space(), std::move(x));
}

Vector2 turned(const Placement& p, const Vector2& uv) {
  return {p.cosine * uv.x() - p.sine * uv.y(), p.sine * uv.x() + p.cosine * uv.y()};
}

// Turned further about the middle of the chart.
Placement nudged(const Placement& p, double angle, const Vector2& middle) {
  Placement more;
  more.cosine = p.cosine * std::cos(angle) - p.sine * std::sin(angle);
  more.sine = p.sine * std::cos(angle) + p.cosine * std::sin(angle);
  more.translation = p.translation + turned(p, middle) - turned(more, middle);
  return more;
}

}  // namespace

bool has_positive_determinants(const BezierMap& map, const StopCheck& stop) {
  const RestShapes rest = rest_shapes(map.mesh());
  const Vec bounds = LocalInjectivity(map.shared_space(), 2 * rest.measure, ProofDepth::kFinal)
                         .lower_bounds(map.control_points());
  const Points2 nodes = map.control_points().reshaped<Eigen::RowMajor>(map.space().node_count(), 2);
  for (Index f = 0; f < bounds.size(); ++f)
    if (!(bounds[f] > 0) &&
        exact_positivity(nodes(map.space().cells().row(f), Eigen::all), stop).result !=
            Positivity::Certified)
      return false;
  return true;
}

std::optional<MovedChart> moved_chart(const BezierMap& chart, const Placement& placement,
                                      const StopCheck& stop) {
  const auto nodes = chart.control_points().reshaped(2, chart.space().node_count());
  const Vector2 middle = (nodes.rowwise().minCoeff() + nodes.rowwise().maxCoeff()) / 2;
  for (int k = 0; k <= kNudges; ++k) {
    stop.poll();
    const Placement p = k == 0 ? placement : nudged(placement, k * kNudge, middle);
    BezierMap map = placed(chart, p);
    if (has_positive_determinants(map, stop)) return MovedChart{std::move(map), p};
  }
  return {};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
