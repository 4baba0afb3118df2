// The verdict on overlaps of a map, in words and in reports, from the proof of its boundary.
//
//   const GlobalInjectivity proof = check_boundary(map);
//   overlap_words(proof, image_of(map));   // "locally injective, overlaps itself near (0.25, 1.5)"
#pragma once

#include <string>

#include "majorant/apps/jobs/report.h"
#include "majorant/certify/global_injectivity.h"

namespace majorant {

// The kind of image that the boundary bounds. CutAtSeams: a map with cones winds around them, so
// the image of the cut surface usually overlaps itself; the requirement is local injectivity.
// Charts: each chart is proven by itself.
enum class ImageOf { Surface, CutAtSeams, Charts };
ImageOf image_of(const BezierMap& map);

// Returns a clause for summaries of a locally injective map: "no overlaps", "locally injective,
// overlaps itself near (u, v)", or the reason why it is not decided.
std::string overlap_words(const GlobalInjectivity& proof, ImageOf image);

// Returns {"globally_injective": true, false or null (not decided), "overlaps": the words}, for a
// map that is as locally injective as `measures` say.
Json overlap_section(const GlobalInjectivity& proof, ImageOf image, const MapMeasures& measures);

// Sets these keys and "boundary" ({"pairs_tested", "pairs_left", "subdivisions", "reason",
// "covered_twice", "contacts", "contacts_complete"}, edges by vertices of the input). proof: of the
// boundary of `map`, or of a map with the same faces.
void add_global_injectivity(Json& measures_section, const BezierMap& map,
                            const MapMeasures& measures, const GlobalInjectivity& proof);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
