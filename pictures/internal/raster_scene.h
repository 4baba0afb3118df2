// The triangles of a picture: of the surface seen from a direction, or of the layout.
#pragma once

#include <functional>
#include <vector>

#include "majorant/maps/map_file.h"
#include "majorant/pictures/internal/rasterizer.h"

namespace majorant {

// The light of faces seen edge-on (pictures.h).
inline constexpr double kDarkest = 0.72;

// Returns the triangles of the surface seen from `view` (pictures.h describes the camera), one per
// cell, followed by those of lines along cut edges. The width of a line does not depend on which of
// its faces is visible.
std::vector<RasterTriangle> surface_triangles(const MapFile& map, const Vector3& view,
                                              PixelSize size);

// Returns the triangles of the layout: cells cut until their chords are a fraction of a pixel from
// the curves. scale: pixels per unit of uv; place: maps the plane to pixels.
std::vector<RasterTriangle> layout_triangles(const MapFile& map, double scale,
                                             const std::function<Vector2(const Vector2&)>& place);

// Normals interpolated between those of corners, which are area-weighted means of the faces around
// them.
class SmoothNormals {
 public:
  explicit SmoothNormals(const MapFile& map);
  Vector3 at(Index cell, const Barycentric& xi) const;  // a unit vector, or 0

 private:
  Points3 normals_;  // 3 #F, cell by cell
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
