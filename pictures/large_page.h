// Pages of maps that are too large for browsers: a coarser picture, which says so.
//
//   MapPage page;   // page.map = ...
//   const std::string note = write_page_or_coarser("bunny.html", page);
//   if (!note.empty()) std::cout << "bunny.html: " << note << '\n';
//
// A coarser picture has a part of the corners of the map, each at its place on the surface and in
// the layout, and straight triangles between them. It keeps all corners on outlines and seams, of
// cones and held points, of faces with a fault and of faces that are turned over; no other face is
// turned over. Distortions are those of its triangles. Numbers of the report are those of the map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "majorant/pictures/pictures.h"

namespace majorant {

// A page with more data shows a coarser picture. So much data have 470,000 straight faces.
inline constexpr std::size_t kLargestPage = 24'000'000;  // bytes

// Returns the size of the data that a page holds about its map, without facts and marks.
std::size_t page_bytes(const MapPage& page);

// Returns a picture of the map with fewer faces and about so many bytes. Its facts have the member
// `picture`: `faces` of the picture, `map_faces`, `map_degree`. None if the page has no more bytes,
// for comparisons and meshes of quads, and if the corners of the map are no proper surface. Throws
// the errors of write_page().
std::optional<MapPage> coarser_page(const MapPage& page, std::size_t most_bytes = kLargestPage);

// Writes the coarser page, or the page itself if there is none. Returns what a user should know:
// "shows 460,000 of 1,000,000 faces, ...", or that a page of more than kLargestPage is written as
// it is; empty for other pages. MAJORANT_PAGE_BYTES of the environment, for tests, replaces
// kLargestPage.
std::string write_page_or_coarser(const std::string& path, const MapPage& page);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
