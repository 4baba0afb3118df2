#include "majorant/elements/internal/element_check.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

// The tolerance of numbers that are computed without error bounds; a wrong description differs by
// whole numbers. Chosen, not tuned.
constexpr double kPartitionTolerance = 1e-9;

[[noreturn]] void refuse(const BernsteinElement& element, const std::string& what) {
  throw InvalidArgument(fmt::format("{}: {}", element.name, what));
}

bool same_factor(const BernsteinElement& element, int a, int b) {
  const int count = element.coordinate_count();
  return a >= 0 && b >= 0 && a < count && b < count && a != b &&
         element.factor_of(a) == element.factor_of(b);
}

void check_derivatives(const BernsteinElement& element) {
  int dim = 0;
  for (const int corners : element.factors) {
    if (corners < 2) refuse(element, fmt::format("a factor of {} corners, at least 2", corners));
    dim += corners - 1;
  }
  if (dim < 2 || dim > 3)
    refuse(element, fmt::format("a cell of {} dimensions, 2 or 3 are possible", dim));
  if (element.dim() != dim)
    refuse(element, fmt::format("{} derivatives for {} dimensions", element.dim(), dim));
  for (const auto& [plus, minus] : element.derivatives)
    if (!same_factor(element, plus, minus))
      refuse(element, fmt::format("a derivative by coordinates {} and {}, not two of one factor",
                                  plus, minus));
}

// Checks that a child has every coordinate of the parent once, at a place of its factor, with the
// midpoint in place of the end that it lost.
void check_child(const BernsteinElement& element, std::vector<int> slots, int lost) {
  bool sound = static_cast<int>(slots.size()) == element.coordinate_count() &&
               std::find(slots.begin(), slots.end(), lost) == slots.end();
  std::replace(slots.begin(), slots.end(), EdgeBisection::kMidpoint, lost);
  for (std::size_t k = 0; k < slots.size() && sound; ++k) {
    const int place = static_cast<int>(k);
    sound = slots[k] == place || same_factor(element, slots[k], place);
  }
  std::sort(slots.begin(), slots.end());
  sound = sound && std::adjacent_find(slots.begin(), slots.end()) == slots.end();
  if (!sound)
    refuse(element, fmt::format("a child of a bisection without {} is not made of the others and "
                                "the midpoint, each at its factor",
                                lost));
}

void check_bisections(const BernsteinElement& element) {
  if (element.bisections.empty()) refuse(element, "no bisections");
  for (const EdgeBisection& step : element.bisections) {
    if (!same_factor(element, step.a, step.b))
      refuse(element,
             fmt::format("a bisection between coordinates {} and {}, not two of one factor", step.a,
                         step.b));
    check_child(element, step.first, step.b);
    check_child(element, step.second, step.a);
  }
}

// Returns the determinant by the closed formulas, which are exact for small integers.
double determinant(const Eigen::MatrixXd& j) {
  return j.rows() == 2 ? Eigen::Matrix2d(j).determinant() : Eigen::Matrix3d(j).determinant();
}

Eigen::MatrixXd zeros(const BernsteinElement& element) {
  return Eigen::MatrixXd::Zero(element.dim(), element.dim());
}

// Checks `degree` times the affine map with these values at homogeneous coordinates of 1, one
// column each. All its control points are integers.
void check_affine(const BernsteinElement& element, const DetCoefficients& det,
                  const Eigen::MatrixXd& values, std::string_view map) {
  const BernsteinBasis nodes = element.basis(element.degrees());
  std::vector<double> c;
  for (int k = 0; k < nodes.count(); ++k)
    for (const auto& row : values.rowwise()) {
      c.push_back(0);
      for (Index q = 0; q < row.size(); ++q) c.back() += row[q] * nodes.exponents(k)[q];
    }
  Eigen::MatrixXd j = zeros(element);
  for (int d = 0; d < element.dim(); ++d) {
    const auto [plus, minus] = element.derivatives[d];
    j.col(d) = element.degree * (values.col(plus) - values.col(minus));
  }
  const double expected = determinant(j);
  if (expected == 0)
    refuse(element, fmt::format("det J of the {} is 0, its derivatives are dependent", map));
  std::vector<double> out(to_size(det.count())), error(out.size());
  det.at_with_error(c.data(), out.data(), error.data());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (!(std::abs(out[k] - expected) <= error[k]))
      refuse(element, fmt::format("det J of the {} is {}, but its Bernstein coefficient {} is {}",
                                  map, expected, k, out[k]));
}

using Coordinates = std::vector<double>;  // homogeneous

double value(const BernsteinBasis& basis, int k, const Coordinates& x) {
  double value = basis.weight(k);
  for (std::size_t q = 0; q < x.size(); ++q) value *= std::pow(x[q], basis.exponents(k)[q]);
  return value;
}

// Requires that all coordinates are positive.
double derivative(const BernsteinBasis& basis, int k, const Coordinates& x, int by) {
  const auto q = to_size(by);
  return value(basis, k, x) * basis.exponents(k)[q] / x[q];
}

// Checks a map with random integers as control points at a point inside.
void check_curved(const BernsteinElement& element, const DetCoefficients& det) {
  Coordinates x;
  for (const int corners : element.factors)
    for (int k = 1; k <= corners; ++k) x.push_back(2.0 * k / (corners * (corners + 1)));
  const BernsteinBasis nodes = element.basis(element.degrees());
  std::minstd_rand random;
  std::vector<double> c;
  Eigen::MatrixXd j = zeros(element);
  for (int k = 0; k < nodes.count(); ++k)
    for (int row = 0; row < element.dim(); ++row) {
      c.push_back(static_cast<double>(random() % 16));
      for (int d = 0; d < element.dim(); ++d) {
        const auto [plus, minus] = element.derivatives[d];
        j(row, d) += c.back() * (derivative(nodes, k, x, plus) - derivative(nodes, k, x, minus));
      }
    }
  std::vector<double> out(to_size(det.count())), error(out.size());
  det.at_with_error(c.data(), out.data(), error.data());
  double sum = 0, size = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double term = out[k] * value(det.basis(), static_cast<int>(k), x);
    sum += term;
    size += std::abs(term);
  }
  const double expected = determinant(j);
  if (!(std::abs(sum - expected) <= kPartitionTolerance * size))
    refuse(element, fmt::format("det J of a curved map is {} where its Bernstein form gives {}",
                                expected, sum));
}

}  // namespace

void check_description(const BernsteinElement& element) {
  if (element.degree < 1 || element.degree > element.max_degree)
    refuse(element, fmt::format("degree must be 1..{}, is {}", element.max_degree, element.degree));
  check_derivatives(element);
  check_bisections(element);
  const BernsteinBasis nodes = element.basis(element.degrees());
  for (int k = 0; k < element.corner_count(); ++k)
    if (!nodes.is_corner(k))
      refuse(element, fmt::format("node {} is no corner, the first {} must be corners", k,
                                  element.corner_count()));
}

void check_determinants(const BernsteinElement& element, const DetCoefficients& det) {
  Eigen::MatrixXd identity = Eigen::MatrixXd::Zero(element.dim(), element.coordinate_count());
  for (int d = 0; d < element.dim(); ++d) identity(d, element.derivatives[d][0]) = 1;
  check_affine(element, det, identity, "identity");
  Eigen::Matrix3d
      shear;  // any regular one of small integers, in the plane its first 2 by 2 entries
  shear << 2, 1, 0, -1, 3, 1, 0, 1, 2;
  check_affine(element, det, shear.topLeftCorner(element.dim(), element.dim()) * identity,
               "affine map");
  check_curved(element, det);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
