#include "majorant/pictures/turned_over.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "majorant/framework/parallel.h"
#include "majorant/maps/extreme_samples.h"
#include "majorant/pictures/internal/bezier_image.h"

namespace majorant {

std::vector<Index> turned_over_cells(const MapFile& map) {
  constexpr Index kPiece = 64;
  const BezierImage image(map, 1);
  const std::vector<Barycentric> points = extreme_samples(map.degree);
  std::vector<char> is_over(to_size(static_cast<Index>(map.cells.rows())));
  parallel_for(static_cast<Index>(is_over.size()), kPiece, [&](Index cell) {
    is_over[to_size(cell)] = std::any_of(points.begin(), points.end(), [&](const Barycentric& xi) {
      const BezierImage::Point point = image.at(cell, xi);
      const double sigma = point.distortion.sigma_2;
      return std::isfinite(sigma) ? !(sigma > 0) : point.determinant < 0;
    });
  });
  std::vector<Index> cells;
  for (std::size_t cell = 0; cell < is_over.size(); ++cell)
    if (is_over[cell]) cells.push_back(static_cast<Index>(cell));
  return cells;
}

std::vector<Index> cells_without_area(const MapFile& map) {
  const BezierImage image(map, 1);
  std::vector<Index> cells;
  for (Index cell = 0; cell < map.cells.rows(); ++cell)
    if (!std::isfinite(image.at(cell, Barycentric::Constant(1.0 / 3)).distortion.sigma_2))
      cells.push_back(cell);
  return cells;
}

std::string turned_over_words(std::size_t count) {
  return fmt::format("{} triangle{} turned over", count, count == 1 ? "" : "s");
}

std::string without_area_words(std::size_t count) {
  return count == 1 ? "1 face has no area" : fmt::format("{} faces have no area", count);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
