// Writes a comparison as a table for other programs and as a page.
#pragma once

#include <string>

#include "majorant/framework/comparison/comparison.h"

namespace majorant {

// These write comparison_points_csv() and comparison_rows_csv() as files. They throw Error(Usage)
// if the file cannot be written.
void write_comparison_csv(const std::string& path, const Comparison& comparison);
void write_comparison_rows(const std::string& path, const Comparison& comparison);

// Returns, or writes, one self-contained page. It plots the excess of the energy over the best of
// all runs (or the energy itself) against iterations and against seconds, and has the table of
// comparison_table.h. Texts may hold any bytes; invalid UTF-8 is shown as U+FFFD. A run of more
// than 2000 points is drawn with at most 2000: the start, the end, and points at even steps and at
// even ratios of their number; its line of the table uses all points. The output depends only on
// the comparison. The second function throws Error(Usage) if the file cannot be written.
std::string comparison_page(const Comparison& comparison);
void write_comparison_html(const std::string& path, const Comparison& comparison);

// Returns the table of that page and the text below it, for notebooks.
std::string comparison_html_table(const Comparison& comparison);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
