#include "majorant/maps/measure.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein.h"
#include "majorant/elements/element_space.h"
#include "majorant/elements/singular_values.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/maps/extreme_samples.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// The agreement of rules, relative to the total, distributed over the elements: ten times finer
// than the tolerance of comparisons of energies.
constexpr double kEnergyAgreement = 1e-6;

// Fractions of progress after the energy and after the samples of extremes.
constexpr double kEnergyShare = 0.3, kSampledShare = 0.7;
// Faces of a task of Jacobians, some 0.1 ms.
constexpr Index kTaskFaces = 1024;

// A weighted sum of energies on the same rules.
class Measured {
 public:
  Measured(const EnergySum& energy, const BezierMap& map, const RestShapes& rest,
           const std::vector<Quadrature>& rules)
      : energy_(energy), x_(map.control_points()) {
    require_elements(energy, map.space().element_count());
    for (const WeightedEnergy& e : energy)
      terms_.push_back(e.make(map.shared_space(), rest, rules));
  }
  // Returns values parallel to faces.
  Vec values(RuleId rule, const std::vector<Index>& faces) const {
    Vec sum = Vec::Zero(static_cast<Index>(faces.size()));
    for (std::size_t k = 0; k < terms_.size(); ++k) {
      Vec values = energy_[k].weight * element_values(*terms_[k], {}, rule, faces, x_);
      const Vec& weight = energy_[k].face_weight;
      if (weight.size() > 0) values.array() *= weight(faces).array();
      sum += values;
    }
    return sum;
  }

 private:
  const EnergySum& energy_;
  VecIn x_;
  std::vector<std::shared_ptr<const DensityTerm>> terms_;
};

std::vector<Index> all_faces(const RestShapes& rest) {
  std::vector<Index> faces(to_size(static_cast<Index>(rest.measure.size())));
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

Quadrature single_point(const Barycentric& xi) {
  Quadrature q;
  q.cell = {3};
  q.points = xi.transpose();
  q.weights = Vec::Ones(1);
  return q;
}

// The least and the largest singular value of Jacobians.
struct SigmaRange {
  double least, largest;

  void include(const Eigen::Matrix2d& J) {
    if (is_inside(J)) return;
    const auto [larger, smaller] = singular_values(J);
    largest = std::max(largest, larger);
    least = std::min(least, smaller);
  }

 private:
  // Returns whether bounds show that J is inside: sigma_1 <= |J|, and sigma_2 >= det J / |J| if
  // that is positive.
  bool is_inside(const Eigen::Matrix2d& J) const {
    constexpr double kRounding = 1e-12;      // far above the rounding of all products here
    constexpr double kLeastSquare = 1e-280;  // products have all their digits
    const double square = J.squaredNorm(), norm = std::sqrt(square);
    return square > kLeastSquare && (1 + kRounding) * norm < largest &&
           J.determinant() > std::max(least, 0.0) * norm + kRounding * square;
  }
};

// Returns the range of all faces at one point, joined with `known`.
SigmaRange sigmas_at(const BezierMap& map, const RestShapes& rest, const Barycentric& point,
                     const SigmaRange& known) {
  const Eigen::MatrixX2d g = bernstein_gradients(map.degree(), point);
  const auto faces = static_cast<Index>(rest.measure.size());
  std::vector<SigmaRange> ranges(to_size((faces + kTaskFaces - 1) / kTaskFaces), known);
  parallel_tasks(static_cast<Index>(ranges.size()), [&](Index task, int) {
    const Index last = std::min(faces, (task + 1) * kTaskFaces);
    SigmaRange range = known;
    for (Index f = task * kTaskFaces; f < last; ++f) {
      Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
      for (Index q = 0; q < g.rows(); ++q)
        j += map.control_points().segment<2>(2 * map.space().cells()(f, q)) * g.row(q);
      j *= rest.inverse_of(f);
      range.include(j);
    }
    ranges[task] = range;
  });
  SigmaRange all = known;
  for (const SigmaRange& range : ranges) {
    all.least = std::min(all.least, range.least);
    all.largest = std::max(all.largest, range.largest);
  }
  return all;
}

// Samples at least one point; sets m.cut_short if it is stopped before the others.
void sample_extremes(const BezierMap& map, const RestShapes& rest, const EnergySum& energy,
                     const StopCheck& stop, MapMeasures& m) {
  const std::vector<Barycentric> points = extreme_samples(map.degree());
  std::vector<Quadrature> rules;
  for (const Barycentric& xi : points) rules.push_back(single_point(xi));
  const Measured measured(energy, map, rest, rules);
  const std::vector<Index> faces = all_faces(rest);
  m.sigma_min = std::numeric_limits<double>::infinity();
  m.max_density = -m.sigma_min;
  for (std::size_t k = 0; k < points.size(); ++k) {
    stop.advance(k, points.size());
    m.cut_short = m.cut_short || (k > 0 && stop() != Directive::Continue);
    if (k > 0 && m.cut_short) return;
    const Vec density = measured.values(static_cast<RuleId>(k), faces).cwiseQuotient(rest.measure);
    m.max_density = std::max(m.max_density, density.maxCoeff());
    const SigmaRange range = sigmas_at(map, rest, points[k], {m.sigma_min, m.sigma_max});
    m.sigma_min = range.least;
    m.sigma_max = range.largest;
  }
}

Vec proven_bounds(const BezierMap& map, const RestShapes& rest) {
  return LocalInjectivity(map.shared_space(), 2 * rest.measure, ProofDepth::kFinal)
      .lower_bounds(map.control_points());
}

// Sets value, face_value and, if stopped before these are accurate, cut_short.
void measure_energy(const BezierMap& map, const RestShapes& rest, const EnergySum& energy,
                    const StopCheck& stop, MapMeasures& m) {
  const std::vector<Quadrature> hierarchy = measuring_rules(map.degree());
  const Measured measured(energy, map, rest, hierarchy);
  std::vector<Index> open = all_faces(rest);  // faces whose value a finer rule may change
  Vec values = measured.values(0, open);
  for (std::size_t top = 1; top < hierarchy.size() && !open.empty(); ++top) {
    m.cut_short = stop() != Directive::Continue;
    if (m.cut_short) break;
    Vec finer = values;
    finer(open) = measured.values(static_cast<RuleId>(top), open);
    const double bound =
        kEnergyAgreement * std::abs(finer.sum()) / static_cast<double>(values.size());
    std::erase_if(open, [&](Index f) { return std::abs(finer[f] - values[f]) <= bound; });
    values = finer;
  }
  m.face_value = values.cwiseQuotient(rest.measure);
  m.value = values.sum() / rest.measure.sum();
}

}  // namespace

double mean_density(const BezierMap& map, const RestShapes& rest, const EnergySum& energy,
                    Vec& face_value) {
  MapMeasures m;
  measure_energy(map, rest, energy, {}, m);
  face_value = std::move(m.face_value);
  return m.value;
}

MapMeasures measure_map(const BezierMap& map, const EnergySum& energy, const StopCheck& stop) {
  return measure_normalized(map, 1.0, energy, stop);
}

MapMeasures measure_normalized(const BezierMap& map, double scale, const EnergySum& energy,
                               const StopCheck& stop) {
  MapMeasures m;
  const RestShapes rest = rest_shapes(map.mesh());
  const BezierMap scaled =
      scale == 1 ? map : map.with(map.shared_space(), scale * map.control_points());
  measure_energy(scaled, rest, energy, stop, m);
  sample_extremes(scaled, rest, energy, stop.between(kEnergyShare, kSampledShare), m);
  if (!m.cut_short)
    m.distortion =
        measure_distortion(map.degree(), map.space().cells(), map.control_points(), rest, scale);
  m.min_det = proven_bounds(map, rest);
  const bool interior_ok =
      AngleSums(map.shared_space(), AngleSums::Vertices::Interior, map.shared_seams())
          .check(map.control_points())
          .feasible;
  m.locally_injective = interior_ok && m.min_det.minCoeff() > 0;
  m.min_det *= scale * scale;
  m.seam_residual = seam_residual(map.space(), map.seams(), scaled.control_points());
  const Vec sums = vertex_angle_sums(map.space(), map.control_points());
  for (const Index v : boundary_nodes(map.space(), map.seams())) {
    if (v >= map.space().vertex_count()) continue;
    m.max_boundary_angle = std::max(m.max_boundary_angle, sums[v]);
    if (sums[v] > 2 * std::numbers::pi + AngleSums::kTolerance) ++m.boundary_over_full_turn;
  }
  return m;
}

MapMeasures measures_once_moved(MapMeasures before, const BezierMap& moved,
                                const EnergySum& energy) {
  const Vec now = proven_bounds(moved, rest_shapes(moved.mesh()));
  const Vec& then = before.min_det;
  if (!((now - then).array().abs() <= kEnergyAgreement * then.array().abs()).all())
    return measure_map(moved, energy);
  before.min_det = now;
  return before;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
