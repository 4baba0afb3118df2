// All public headers of certify/: proofs about results, in floating point first, then in exact
// integers. What is not proven is undecided, never assumed. Where one is enough, include that.
//
//   if (check_boundary(map).result == ProofStatus::Proven) write_vtu("map.vtu", to_map_file(map));
//
// * global_injectivity.h: whether an image overlaps itself, from its boundary
// * inverse_map.h: the points of a surface that a map takes to a point of the plane
// * map_proof.h: a file as it is: orientation, seams, cuts, the surface, overlaps
// * moved_layout.h: layouts that are turned, scaled and moved, proven where they end up
// * stacked_charts.h: charts of a layout that lie exactly on others
//
// Not for how good a map is: maps/measure.h.
#pragma once

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/inverse_map.h"
#include "majorant/certify/map_proof.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/certify/stacked_charts.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
