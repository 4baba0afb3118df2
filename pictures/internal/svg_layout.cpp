#include "majorant/pictures/internal/svg_layout.h"

#include <algorithm>
#include <cmath>

#include "majorant/parametrization/maps/bezier_cell.h"

namespace majorant {
namespace {

constexpr double kTallest = 4000.0;
constexpr int kPiecesPerEdge = 4;

// Point and derivative of a Bezier curve at s, by de Casteljau's algorithm.
std::pair<Vector2, Vector2> evaluate_curve(std::vector<Vector2> control, double s) {
  Vector2 derivative = Vector2::Zero();
  const auto degree = static_cast<double>(control.size() - 1);
  while (control.size() > 1) {
    if (control.size() == 2) derivative = degree * (control[1] - control[0]);
    for (std::size_t i = 0; i + 1 < control.size(); ++i) {
      control[i] = (1.0 - s) * control[i] + s * control[i + 1];
    }
    control.pop_back();
  }
  return {control[0], derivative};
}

}  // namespace

SvgLayout::SvgLayout(const MapFile& map) : map_(map) {
  low_ = map.uv.colwise().minCoeff().transpose();
  high_ = map.uv.colwise().maxCoeff().transpose();
  // Halves: the extent of two finite numbers may overflow.
  const Vector2 extent = (0.5 * high_ - 0.5 * low_).cwiseMax(1e-300);
  scale_ = std::min((kWidth - 2 * kMargin) / extent[0], kTallest / extent[1]);
  height_ = scale_ * extent[1] + 2 * kMargin;
  for (int edge = 0; edge < 3; ++edge) edges_[edge] = bezier_edge_points(map.degree, edge);
}

double SvgLayout::stroke_width() const {
  const double area = kWidth * height_ / static_cast<double>(map_.cells.rows());
  return std::clamp(0.02 * std::sqrt(area), 0.05, 1.0);
}

// Differences are halved like the extent.
Vector2 SvgLayout::place(const Vector2& uv) const {
  return {kMargin + scale_ * (0.5 * uv[0] - 0.5 * low_[0]),
          kMargin + scale_ * (0.5 * high_[1] - 0.5 * uv[1])};
}

void SvgLayout::add_number(double value) {
  const auto thousandths = std::llround(1000.0 * value);
  const auto magnitude = std::llabs(thousandths);
  if (thousandths < 0) add("-");
  add("{}", magnitude / 1000);
  const auto rest = magnitude % 1000;
  if (rest == 0) return;
  const std::string digits = fmt::format(".{:03}", rest);
  add("{}", std::string_view(digits).substr(0, digits.find_last_not_of('0') + 1));
}

void SvgLayout::add_point(char separator, const Vector2& point) {
  add("{}", separator);
  add_number(point[0]);
  add(",");
  add_number(point[1]);
}

void SvgLayout::add_edge(const MapFile& other, Index cell, int edge) {
  std::vector<Vector2> control;
  for (const int local : edges_[edge])
    control.push_back(place(Vector2(other.uv.row(other.cells(cell, local)))));
  if (map_.degree > 3) {
    add_hermite_pieces(control);
    return;
  }
  for (std::size_t i = 1; i < control.size(); ++i) {
    add_point(i > 1 ? ' ' : "LQC"[map_.degree - 1], control[i]);
  }
}

// Cubics with the curve's points and derivatives at the ends of equal pieces.
void SvgLayout::add_hermite_pieces(const std::vector<Vector2>& control) {
  constexpr double kThird = 1.0 / (3.0 * kPiecesPerEdge);
  auto [begin, begin_derivative] = evaluate_curve(control, 0.0);
  for (int piece = 1; piece <= kPiecesPerEdge; ++piece) {
    const auto [end, end_derivative] =
        evaluate_curve(control, static_cast<double>(piece) / kPiecesPerEdge);
    add_point('C', begin + kThird * begin_derivative);
    add_point(' ', end - kThird * end_derivative);
    add_point(' ', end);
    begin = end;
    begin_derivative = end_derivative;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
