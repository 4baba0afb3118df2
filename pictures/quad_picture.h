// Pictures of quad meshes from one side, with their patches, irregular vertices and edges on
// features.
//
//   QuadPicture picture;
//   picture.title = "spot.obj";
//   picture.quads = polygons;
//   write_svg("quads.svg", picture);
//   write_page("quads.html", page_of(picture));
//
// The view is first_view() (first_view.h) and the camera that of write_png() (pictures.h). Quads
// are painted from the farthest to the nearest, by their centroids; if no edge is on a border,
// those that face away are left out. A page shows them in 3D. Its layout has the patches as
// rectangles of unit squares side by side, coloured by the deviation of angles from 90 degrees.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

struct QuadPicture {
  std::string title;
  PolygonMesh quads;  // a surface of quads only
  // By quad: its patch, a rectangle whose quads follow each other row by row. Empty: one grey.
  std::vector<Index> patch_of = {};
  std::vector<std::array<Index, 2>> feature_edges = {};  // edges of the quads
};

// Writes a drawing of 1000 by 800. Throws Error(Usage) if the file cannot be written.
void write_svg(const std::string& path, const QuadPicture& picture);
void write_png(const std::string& path, const QuadPicture& picture);
std::string svg_text(const QuadPicture& picture);

// Returns a page with two triangles for each quad. Charts are the patches, cones the irregular
// vertices, seams the edges on features. The command `quads` in `facts` tells the page that
// triangles are halves of quads.
MapPage page_of(const QuadPicture& picture);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
