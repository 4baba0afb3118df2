// The places of a layout's parts in a vector drawing, and their text: shared by what write_svg
// draws. See write_svg.h for the conventions.
#pragma once

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

class SvgLayout {
 public:
  static constexpr double kWidth = 1000.0;
  static constexpr double kMargin = 10.0;

  // The map must outlive it.
  explicit SvgLayout(const MapFile& map);

  const MapFile& map() const { return map_; }
  double height() const { return height_; }  // of the layout with margins
  // Corners of the bounding box and half the larger side of it, uv units: the extent of two finite
  // numbers may overflow.
  const Vector2& low() const { return low_; }
  const Vector2& high() const { return high_; }
  double half_size() const { return (0.5 * high_ - 0.5 * low_).maxCoeff(); }
  // A twentieth of the typical cell, thin lines at most.
  double stroke_width() const;

  // In drawing units, the v axis up.
  Vector2 place(const Vector2& uv) const;
  Vector2 place(Index point) const { return place(Vector2(map_.uv.row(point))); }

  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
  }
  // Three decimals of a drawing of 1000: 6 digits. No trailing zeros, no -0.
  void add_number(double value);
  void add_point(char separator, const Vector2& point);
  // The path from where the pen is, the start of edge 0 (01), 1 (12) or 2 (20), along that edge.
  void add_edge(Index cell, int edge) { add_edge(map_, cell, edge); }
  // The same of another map of the same degree in the same plane.
  void add_edge(const MapFile& other, Index cell, int edge);
  std::string text() const { return fmt::to_string(buffer_); }

 private:
  void add_hermite_pieces(const std::vector<Vector2>& control);

  const MapFile& map_;
  Vector2 low_, high_;
  double scale_ = 1.0;  // drawing units per half uv unit
  double height_ = 0.0;
  std::array<std::vector<int>, 3> edges_;  // local control points
  fmt::memory_buffer buffer_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
