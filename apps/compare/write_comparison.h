// A comparison as a table for other programs and as a page for people.
#pragma once

#include <string>

#include "apps/compare/comparison.h"

namespace majorant {

// One line per iteration (0 = the start) of each method, under the header
//     method,iteration,seconds,energy,gradient_norm,step,min_det
// Numbers have the fewest digits that read back to the same double (inf, -inf and nan by name);
// names are quoted as in RFC 4180 where they need it. Lines end with \n.
// Throws Error(Usage) if the file cannot be written.
void write_comparison_csv(const std::string& path, const Comparison& comparison);

// One self-contained page, without any other resource: the excess of the energy over the best of
// all runs (or the energy itself) over iterations and over seconds, and the table of
// comparison_table.h. Texts may hold any bytes; what is not UTF-8 is shown as U+FFFD.
// A run of more than 2000 points is drawn with at most 2000: the start, the end, and points at even
// steps and at even ratios of their number; its line of the table is made from all of them.
// The output depends on nothing but the comparison. Throws Error(Usage) if the file cannot be
// written.
void write_comparison_html(const std::string& path, const Comparison& comparison);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
