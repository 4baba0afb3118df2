// All public headers of certify/: proofs about results, in floating point first, then in exact
// integers. Questions that are not proven are undecided, never assumed. Including a single header
// instead compiles faster.
//
//   if (check_boundary(map).result == ProofStatus::Proven) write_vtu("map.vtu", to_map_file(map));
//
// * global_injectivity.h: proves from the boundary of an image whether it overlaps itself
// * inverse_map.h: finds the points of a surface that a map takes to a point of the plane
// * map_proof.h: judges a map file: orientation, seams, cuts, the surface, overlaps
// * moved_layout.h: turns, scales and moves a layout, and proves it again
// * stacked_charts.h: charts of a layout that lie exactly on others
//
// Not for the quality of a map: see maps/measure.h.
#pragma once

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/inverse_map.h"
#include "majorant/certify/map_proof.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/certify/stacked_charts.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
