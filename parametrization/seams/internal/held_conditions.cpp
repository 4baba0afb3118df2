#include "majorant/parametrization/seams/internal/held_conditions.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>
#include <utility>

namespace majorant {
namespace {

// The fraction of the diagonal of G that is added to it: far below the worth of a condition, far
// above the rounding of G, whose rows are nearly equal for neighbouring conditions.
constexpr double kRegularization = 1e-9;

}  // namespace

HeldConditions::HeldConditions(Eigen::MatrixXd responses, const Vec& values)
    : place_(static_cast<std::size_t>(values.size())), held_(static_cast<Index>(values.size())) {
  const Vec scale = responses.diagonal().cwiseSqrt().cwiseInverse();
  responses = (scale.asDiagonal() * responses * scale.asDiagonal()).eval();
  responses.diagonal().array() += kRegularization;
  precision_ = scale.asDiagonal() *
               Eigen::MatrixXd(responses.ldlt().solve(Eigen::MatrixXd::Identity(held_, held_))) *
               scale.asDiagonal();
  force_ = precision_ * values;
  std::iota(place_.begin(), place_.end(), 0);
}

std::vector<Index> HeldConditions::places_of(const std::vector<Index>& rows) const {
  std::vector<Index> places;
  for (const Index row : rows) places.push_back(place_[row]);
  return places;
}

double HeldConditions::added_strain(const std::vector<Index>& rows) const {
  const std::vector<Index> places = places_of(rows);
  const Vec x = force_(places);
  return x.dot(precision_(places, places).ldlt().solve(x));
}

void HeldConditions::release(const std::vector<Index>& rows) {
  const std::vector<Index> places = places_of(rows);
  const Eigen::MatrixXd columns = precision_(Eigen::seqN(0, held_), places);
  const auto block = Eigen::MatrixXd(precision_(places, places)).ldlt();
  force_.head(held_) -= columns * block.solve(Vec(force_(places)));
  precision_.topLeftCorner(held_, held_) -= columns * block.solve(columns.transpose());
  for (const Index row : rows) drop(row);
}

// Moves the last held row to the place of this one.
void HeldConditions::drop(Index row) {
  const Index place = place_[row], last = --held_;
  const auto moved = std::find(place_.begin(), place_.end(), last);
  precision_.row(place).swap(precision_.row(last));
  precision_.col(place).swap(precision_.col(last));
  std::swap(force_[place], force_[last]);
  std::swap(*moved, place_[row]);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
