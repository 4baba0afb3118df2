// The verdict on overlaps of a map, in words and in reports: the proof from its boundary.
//
//   const GlobalInjectivity proof = check_boundary(map);
//   overlap_words(proof, image_of(map));   // "locally injective, overlaps itself near (0.25, 1.5)"
#pragma once

#include <string>

#include "majorant/apps/jobs/report.h"
#include "majorant/certify/global_injectivity.h"

namespace majorant {

// The image whose boundary it is. CutAtSeams: a map with cones winds around them, and the image of
// the surface cut open at the seams overlaps itself as a rule; what was asked for is that it does
// so nowhere locally. Charts: each of them is proven by itself, and none was put aside.
enum class ImageOf { Surface, CutAtSeams, Charts };
ImageOf image_of(const BezierMap& map);

// One clause for lines that sum up, of a map that is locally injective: "no overlaps", "locally
// injective, overlaps itself near (u, v)", or why that is not decided.
std::string overlap_words(const GlobalInjectivity& proof, ImageOf image);

// {"globally_injective": true, false or null (not decided), "overlaps": the words, of a map that is
// as locally injective as it was measured to be}.
Json overlap_section(const GlobalInjectivity& proof, ImageOf image, const MapMeasures& measures);

// Sets these and "boundary" ({"pairs_tested", "pairs_left", "subdivisions", "reason",
// "covered_twice", "contacts", "contacts_complete"}, edges by vertices of the input). proof: of the
// boundary of `map` or of a map with the same faces.
void add_global_injectivity(Json& measures_section, const BezierMap& map,
                            const MapMeasures& measures, const GlobalInjectivity& proof);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
