// All public headers of pictures/: what people look at. Pictures promise nothing; numbers that
// others compute with belong into a .vtu (io/io.h). Where one is enough, include that.
//
//   const MapFile map = read_map("bunny.vtu");
//   write_svg("bunny.svg", map);
//   write_png("bunny.png", map);
//
// * write_svg.h: the layout, exact curves, as SVG
// * write_png.h: the layout or the surface as pixels
// * write_page.h: surface and layout as a page for a browser, and the film of a run
// * color_scale.h: colours of quantities, the same in every picture
// * picture_options.h: what all pictures can be told
#pragma once

#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/picture_options.h"
#include "majorant/pictures/write_page.h"
#include "majorant/pictures/write_png.h"
#include "majorant/pictures/write_svg.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
