#include "majorant/maps/distortion.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/quadrature.h"
#include "majorant/elements/singular_values.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/parallel.h"
#include "majorant/maps/extreme_samples.h"
#include "majorant/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// The largest relative difference of the integrals of sigma_1 / sigma_2, and of the squared
// stretch, over a face between the last two rules. Reports are read to three or four digits, and
// the finer rule is some 50 times more accurate.
constexpr double kDistortionAgreement = 1e-3;
// Faces that are measured together: their tables fit into a core's cache.
constexpr Index kBlock = 32;

// Derivatives of the basis at the points of a rule: by xi0, followed by those by xi1.
struct GradientTable {
  Eigen::MatrixXd gradients;  // 2 #P by nodes
  Eigen::RowVectorXd weights;

  GradientTable(int degree, const Points3& points, const Vec& all_weights)
      : gradients(2 * points.rows(), control_point_count(degree)),
        weights(all_weights.transpose()) {
    for (Index l = 0; l < points.rows(); ++l) {
      const Eigen::MatrixX2d g = bernstein_gradients(degree, points.row(l).transpose());
      gradients.row(l) = g.col(0);
      gradients.row(points.rows() + l) = g.col(1);
    }
  }
};

// Singular values at points (rows) of faces (columns).
struct Sigmas {
  Eigen::ArrayXXd first, second;
};

// Means over faces (columns) of sigma_1, sigma_2, their product, their quotient, the squared
// stretch.
using Means = Eigen::Array<double, 5, Eigen::Dynamic>;

Means means(const Eigen::RowVectorXd& weights, const Eigen::Ref<const Eigen::ArrayXXd>& first,
            const Eigen::Ref<const Eigen::ArrayXXd>& second) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Eigen::ArrayXXd angle = (second > 0).select(first / second, kInfinity);
  const Eigen::ArrayXXd square =
      (second > 0).select(0.5 * (first.square().inverse() + second.square().inverse()), kInfinity);
  Means m(5, first.cols());
  m.row(0) = weights * first.matrix();
  m.row(1) = weights * second.matrix();
  m.row(2) = weights * (first * second).matrix();
  m.row(3) = weights * angle.matrix();
  m.row(4) = weights * square.matrix();
  return m;
}

bool agree(const Means& coarse, const Means& fine, Index column) {
  for (const Index row : {3, 4}) {
    const double bound = kDistortionAgreement * fine(row, column);
    if (std::abs(fine(row, column) - coarse(row, column)) > bound) return false;
  }
  return true;  // also for infinite values
}

Points3 lattice(int degree) {
  const std::vector<Barycentric> samples = extreme_samples(degree);
  Points3 points(static_cast<Index>(samples.size()), 3);
  for (std::size_t l = 0; l < samples.size(); ++l) points.row(static_cast<Index>(l)) = samples[l];
  return points;
}

class Measurement {
 public:
  Measurement(int degree, const Cells& cells, VecIn x, const RestShapes& rest, double scale)
      : cells_(cells), x_(x), rest_(rest), scale_(scale) {
    if (degree > 1) make_tables(degree);
    out_.faces.resize(cells.rows(), Eigen::NoChange);
    out_.area = rest.measure;
    for (Index f = 0; f < cells.rows(); ++f)
      if (!(rest.measure[f] > 0) || !rest.inverse.row(f).allFinite()) out_.area[f] = 0;
    out_.samples.resize(to_size(points() * static_cast<Index>(cells_.rows())));
  }

  MapDistortion run() {
    const auto faces = static_cast<Index>(cells_.rows());
    parallel_for((faces + kBlock - 1) / kBlock, 1, [&](Index block) {
      measure(block * kBlock, std::min((block + 1) * kBlock, faces));
    });
    std::erase_if(out_.samples, [](const auto& sample) {
      return sample.weight == 0 || std::isnan(sample.at.sigma_2);
    });
    return std::move(out_);
  }

 private:
  void make_tables(int degree) {
    std::vector<Quadrature> rules{radon_rule()};
    for (const int pieces : {2, 4, 8, 16}) rules.push_back(composite_rule(radon_rule(), pieces));
    for (const Quadrature& rule : rules) tables_.emplace_back(degree, rule.points, rule.weights);
    extremes_.emplace_back(degree, lattice(degree), Vec());
  }

  // Returns the number of points of a face that keep samples.
  Index points() const {
    return tables_.empty() ? 1 : static_cast<Index>(tables_.front().weights.size());
  }

  void measure(Index first, Index end) {
    if (!tables_.empty()) return measure_curved(first, end - first);
    for (Index f = first; f < end; ++f) measure_affine(f);
  }

  void measure_affine(Index f) {
    const auto corner = [&](Index k) { return x_.segment<2>(2 * cells_(f, k)); };
    Eigen::Matrix2d steps;
    steps << corner(0) - corner(2), corner(1) - corner(2);
    const PointDistortion d = distortion_of(scale_ * steps * rest_.inverse_of(f));
    const double l2 = d.stretch_l2();
    keep_face(f, {d.sigma_1, d.sigma_2, d.area(), d.angle(), l2 * l2}, d.sigma_2);
    out_.samples[f] = {d, out_.area[f]};
  }

  Sigmas sigmas(const GradientTable& table, const std::vector<Index>& faces) const {
    const auto count = static_cast<Index>(faces.size());
    Eigen::MatrixXd x(cells_.cols(), 2 * count);
    for (Index b = 0; b < count; ++b)
      for (Index k = 0; k < cells_.cols(); ++k)
        x.block<1, 2>(k, 2 * b) = x_.segment<2>(2 * cells_(faces[b], k)).transpose();
    const Eigen::MatrixXd d = table.gradients * x;
    const Eigen::Index size = table.gradients.rows() / 2;
    Eigen::ArrayXXd sum(size, count), turn(size, count), difference(size, count),
        shear(size, count);  // of the entries of J: a + d, c - b, a - d, c + b
    for (Index b = 0; b < count; ++b) {
      const Eigen::Matrix2d m = scale_ * rest_.inverse_of(faces[b]);
      const auto u0 = d.col(2 * b).head(size), u1 = d.col(2 * b).tail(size),
                 v0 = d.col(2 * b + 1).head(size), v1 = d.col(2 * b + 1).tail(size);
      sum.col(b) = m(0, 0) * u0 + m(1, 0) * u1 + m(0, 1) * v0 + m(1, 1) * v1;
      difference.col(b) = m(0, 0) * u0 + m(1, 0) * u1 - m(0, 1) * v0 - m(1, 1) * v1;
      turn.col(b) = m(0, 0) * v0 + m(1, 0) * v1 - m(0, 1) * u0 - m(1, 1) * u1;
      shear.col(b) = m(0, 0) * v0 + m(1, 0) * v1 + m(0, 1) * u0 + m(1, 1) * u1;
    }
    const Eigen::ArrayXXd alpha = 0.5 * (sum.square() + turn.square()).sqrt(),
                          beta = 0.5 * (difference.square() + shear.square()).sqrt();
    return {alpha + beta, alpha - beta};
  }

  void measure_curved(Index first, Index count) {
    std::vector<Index> faces(to_size(count));
    for (Index b = 0; b < count; ++b) faces[b] = first + b;
    Eigen::ArrayXd least = Eigen::ArrayXd::Constant(count, std::numeric_limits<double>::infinity());
    for (const GradientTable& table : extremes_)
      least = sigmas(table, faces).second.colwise().minCoeff().transpose();
    Means coarse;
    for (std::size_t level = 0; level < tables_.size() && !faces.empty(); ++level) {
      const Sigmas s = sigmas(tables_[level], faces);
      const Means fine = means(tables_[level].weights, s.first, s.second);
      if (level == 0) keep_samples(first, s);
      std::vector<Index> open;
      std::vector<Index> columns;
      for (std::size_t b = 0; b < faces.size(); ++b) {
        const auto column = static_cast<Index>(b);
        double& smallest = least[faces[b] - first];
        smallest = std::min(smallest, s.second.col(column).minCoeff());
        keep_face(faces[b], fine.col(column), smallest);
        if (level > 0 && agree(coarse, fine, column)) continue;
        open.push_back(faces[b]);
        columns.push_back(column);
      }
      coarse = fine(Eigen::all, columns);
      faces = std::move(open);
    }
  }

  void keep_face(Index face, const Eigen::Array<double, 5, 1>& mean, double smallest) {
    auto row = out_.faces.row(face);
    if (out_.area[face] == 0) {
      row.setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    row << mean[0], mean[1], mean[2], mean[3], std::sqrt(mean[4]),
        smallest > 0 ? 1 / smallest : std::numeric_limits<double>::infinity();
  }

  void keep_samples(Index first, const Sigmas& s) {
    for (Index b = 0; b < s.first.cols(); ++b)
      for (Index l = 0; l < points(); ++l)
        out_.samples[(first + b) * points() + l] = {
            {s.first(l, b), s.second(l, b)}, tables_.front().weights[l] * out_.area[first + b]};
  }

  const Cells& cells_;
  VecIn x_;
  const RestShapes& rest_;
  double scale_;
  std::vector<GradientTable> tables_;    // by level; empty for affine maps
  std::vector<GradientTable> extremes_;  // one; empty for affine maps
  MapDistortion out_;
};

struct Weighed {
  double value, weight;
};

// Returns a number that grows with the value, from its sign, its exponent and the first 8 bits of
// its mantissa.
std::int64_t bucket_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t ordered = bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
  return static_cast<std::int64_t>(ordered >> 44);
}

// Returns for each weight in `targets`, which ascend, the smallest value with at least that weight
// at or below it. Values are counted into buckets first, and only the relevant buckets are sorted.
std::array<double, kPercentiles.size()> percentiles(
    const std::vector<Weighed>& values, const std::array<double, kPercentiles.size()>& targets) {
  std::vector<std::int64_t> bucket(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) bucket[k] = bucket_of(values[k].value);
  const auto [least, most] = std::minmax_element(bucket.begin(), bucket.end());
  const std::int64_t lowest = *least;
  std::vector<double> weight(static_cast<std::size_t>(*most - lowest + 1), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k)
    weight[static_cast<std::size_t>(bucket[k] - lowest)] += values[k].weight;
  std::array<double, kPercentiles.size()> found{};
  double before = 0;
  std::size_t p = 0;
  for (std::size_t b = 0; b < weight.size() && p < targets.size(); before += weight[b++]) {
    const bool is_last = b + 1 == weight.size();
    if (before + weight[b] < targets[p] && !is_last) continue;
    std::vector<Weighed> inside;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (bucket[k] - lowest == static_cast<std::int64_t>(b)) inside.push_back(values[k]);
    std::sort(inside.begin(), inside.end(),
              [](const Weighed& x, const Weighed& y) { return x.value < y.value; });
    double below = before;
    for (const Weighed& v : inside) {
      below += v.weight;
      while (p < targets.size() && below >= targets[p]) found[p++] = v.value;
    }
    // The rounding remainder belongs to the next value; at the end, to the last one.
    while (is_last && p < targets.size()) found[p++] = inside.back().value;
  }
  return found;
}

template <class Quantity>
Spread spread(const std::vector<const MapDistortion*>& parts, Index column,
              const Quantity& quantity) {
  Spread s;
  double total = 0;
  std::vector<Weighed> values;
  for (const MapDistortion* part : parts) {
    for (const auto& sample : part->samples) values.push_back({quantity(sample.at), sample.weight});
    for (Index f = 0; f < part->area.size(); ++f)
      if (part->area[f] > 0) s.mean += part->area[f] * part->faces(f, column);
    total += part->area.sum();
  }
  if (values.empty()) return s;
  s.mean /= total;
  std::array<double, kPercentiles.size()> targets;
  for (std::size_t p = 0; p < targets.size(); ++p) targets[p] = total * kPercentiles[p] / 100;
  s.percentile = percentiles(values, targets);
  return s;
}

}  // namespace

PointDistortion distortion_of(const Eigen::Matrix2d& J) {
  const auto [larger, smaller] = singular_values(J);
  return {larger, smaller};
}

MapDistortion measure_distortion(int degree, const Cells& cells, VecIn x, const RestShapes& rest,
                                 double scale) {
  const int nodes = (degree + 1) * (degree + 2) / 2;
  if (degree < 1 || cells.cols() != nodes || cells.rows() != rest.measure.size())
    throw InvalidArgument(
        fmt::format("measure_distortion: degree {}, cells of {} nodes, {} cells, "
                    "{} rest shapes",
                    degree, cells.cols(), cells.rows(), rest.measure.size()));
  for (const Index node : cells.reshaped())
    require_index("measure_distortion: node", node, x.size() / 2);
  if (!(scale > 0) || !std::isfinite(scale))
    throw InvalidArgument(fmt::format("measure_distortion: the scale is {:g}", scale));
  return Measurement(degree, cells, x, rest, scale).run();
}

MapDistortion measure_distortion(const BezierMap& map, double scale) {
  return measure_distortion(map.degree(), map.space().cells(), map.control_points(),
                            rest_shapes(map.mesh()), scale);
}

DistortionSummary summary(const std::vector<const MapDistortion*>& parts) {
  DistortionSummary s;
  s.sigma_1 = spread(parts, 0, [](const PointDistortion& d) { return d.sigma_1; });
  s.sigma_2 = spread(parts, 1, [](const PointDistortion& d) { return d.sigma_2; });
  s.area = spread(parts, 2, [](const PointDistortion& d) { return d.area(); });
  s.angle = spread(parts, 3, [](const PointDistortion& d) { return d.angle(); });
  double square = 0, total = 0;
  for (const MapDistortion* part : parts)
    for (Index f = 0; f < part->area.size(); ++f) {
      if (!(part->area[f] > 0)) continue;
      const double l2 = part->faces(f, 4);
      square += part->area[f] * l2 * l2;
      total += part->area[f];
      s.stretch_linf = std::max(s.stretch_linf, part->faces(f, 5));
    }
  if (total > 0) s.stretch_l2 = std::sqrt(square / total);
  return s;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
