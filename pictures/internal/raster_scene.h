// The triangles of a picture: those of the surface from a direction, or of the layout.
#pragma once

#include <functional>
#include <vector>

#include "majorant/maps/map_file.h"
#include "majorant/pictures/internal/rasterizer.h"

namespace majorant {

// The light of what is seen edge-on (pictures.h).
inline constexpr double kDarkest = 0.72;

// The triangles of the surface seen from `view` (pictures.h has the camera), one a cell, and then
// those of lines along edges that the map cuts (faces on both sides on the surface, not in the
// plane): as wide whichever of the faces beside them is seen.
std::vector<RasterTriangle> surface_triangles(const MapFile& map, const Vector3& view,
                                              PixelSize size);

// The triangles of the layout: cells cut until their chords are a fraction of a pixel from the
// curves. scale: pixels a unit of uv; place: the pixels of a point of the plane.
std::vector<RasterTriangle> layout_triangles(const MapFile& map, double scale,
                                             const std::function<Vector2(const Vector2&)>& place);

// Interpolated between those of corners, which are means of the faces around them by area.
class SmoothNormals {
 public:
  explicit SmoothNormals(const MapFile& map);
  Vector3 at(Index cell, const Barycentric& xi) const;  // of length 1, or 0

 private:
  Points3 normals_;  // 3 #F, cell by cell
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
