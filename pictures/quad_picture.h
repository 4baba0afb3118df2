// Pictures of meshes of quads: what they look like from one side, with the patches they fall into,
// their irregular vertices and the edges that cover features.
//
//   QuadPicture picture;
//   picture.title = "spot.obj";
//   picture.quads = polygons;
//   write_svg("quads.svg", picture);
//   write_page("quads.html", page_of(picture));
//
// Seen from first_view() (first_view.h) by the camera of write_png() (pictures.h). Quads are
// painted one over the other, the farthest first, by their centroids; where no edge is on a border
// those that face away are left out. A page has them in 3D, and as layout their patches as
// rectangles of unit squares, side by side, coloured by how far angles are from 90 degrees.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

struct QuadPicture {
  std::string title;
  PolygonMesh quads;  // a surface of quads alone
  // By quad: its patch, a rectangle of quads which follow each other row by row. Empty: one grey.
  std::vector<Index> patch_of = {};
  std::vector<std::array<Index, 2>> feature_edges = {};  // edges of the quads
};

// 1000 by 800. Throws Error(Usage) where the file cannot be written.
void write_svg(const std::string& path, const QuadPicture& picture);
void write_png(const std::string& path, const QuadPicture& picture);
std::string svg_text(const QuadPicture& picture);

// Two triangles for each quad; charts are the patches, cones the irregular vertices, the seam those
// edges that cover features. The page knows by `facts`, of the command `quads`, that halves are no
// faces.
MapPage page_of(const QuadPicture& picture);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
