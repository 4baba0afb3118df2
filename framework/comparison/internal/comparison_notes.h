// The notes of a comparison: problems that a reader should look into, as sentences.
#pragma once

#include <vector>

#include "majorant/framework/comparison/internal/race.h"

namespace majorant {

// Adds notes that compare the ends of the runs, and sets the distances of the runs. manifolds:
// those of the unknowns, or null.
void compare_ends(std::vector<FinishedRun>& runs, const ManifoldProblem* manifolds,
                  bool compares_points);
// Returns notes on derivatives that disagree with finite differences at y, a point of the problem.
// where: the name of that point.
std::vector<std::string> derivative_notes(const Problem& problem, const Vec& y,
                                          const std::string& where);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
