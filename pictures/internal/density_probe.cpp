#include "majorant/pictures/internal/density_probe.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/quadrature.h"
#include "majorant/framework/error.h"
#include "majorant/maps/distortion.h"

namespace majorant {
namespace {

constexpr int kMaximum = ElementBatch::kMaxSize;

}  // namespace

// The triangles (p0, p1, p2) = ((1, 0), (0, 1), (0, 0)) of a batch, which share no nodes.
DensityProbe::DensityProbe(const EnergySum& energy) {
  if (knows_elements(energy))
    throw Error(ErrorKind::Usage,
                "the density is another on every face and has no scale; take the area");
  Cells faces(kMaximum, 3);
  RowMatrix positions(3 * kMaximum, 2);
  for (Index k = 0; k < kMaximum; ++k) {
    faces.row(k) << 3 * k, 3 * k + 1, 3 * k + 2;
    positions.middleRows(3 * k, 3) << 1, 0, 0, 1, 0, 0;
  }
  RestShapes rest = flat_simplices(positions, faces);
  rest.measure.setOnes();  // so values of the term are those of the density
  const auto space = std::make_shared<const BezierTriangleSpace>(faces, 3 * kMaximum, 1);
  for (const WeightedEnergy& summand : energy)
    summands_.push_back({summand.make(space, rest, {lattice_rule(1)}), summand.weight});
}

double DensityProbe::at(double sigma_max, double sigma_min) const {
  const Vector2 sigma(sigma_max, sigma_min);
  double value = 0;
  evaluate({&sigma, 1}, {&value, 1});
  return value;
}

void DensityProbe::evaluate(std::span<const Vector2> sigma, std::span<double> values) const {
  std::array<Index, kMaximum> elements;
  std::iota(elements.begin(), elements.end(), 0);
  std::array<double, kMaximum> part;
  Vec x = Vec::Zero(6 * kMaximum);
  Workspace workspace;
  for (std::size_t first = 0; first < sigma.size(); first += kMaximum) {
    const std::size_t count = std::min<std::size_t>(kMaximum, sigma.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      x[static_cast<Index>(6 * k)] = sigma[first + k][0];
      x[static_cast<Index>(6 * k + 3)] = sigma[first + k][1];
    }
    const auto out = values.subspan(first, count);
    std::fill(out.begin(), out.end(), 0.0);
    for (const Summand& summand : summands_) {
      summand.term->values(x, {0, {elements.data(), count}}, {}, workspace, part);
      for (std::size_t k = 0; k < count; ++k) out[k] += summand.weight * part[k];
    }
  }
}

void evaluate(Quantity quantity, const DensityProbe& probe, std::span<const Vector2> sigma,
              std::span<double> values) {
  if (quantity == Quantity::Density) return probe.evaluate(sigma, values);
  for (std::size_t k = 0; k < sigma.size(); ++k) {
    const PointDistortion d{sigma[k][0], sigma[k][1]};
    values[k] = quantity == Quantity::Area       ? d.area()
                : quantity == Quantity::Angle    ? d.angle()
                : quantity == Quantity::SigmaMax ? d.sigma_1
                                                 : d.sigma_2;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
