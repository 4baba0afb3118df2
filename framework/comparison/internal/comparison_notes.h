// The notes of a comparison: problems that a reader should look into, as sentences.
#pragma once

#include <vector>

#include "majorant/framework/comparison/internal/race.h"

namespace majorant {

// Adds to the notes of the runs, and sets their distances.
// manifolds: where unknowns lie on some; null elsewhere.
void compare_ends(std::vector<FinishedRun>& runs, const ManifoldProblem* manifolds,
                  bool compares_points);
// Derivatives that disagree with finite differences at y, a point of the problem; where: its name.
std::vector<std::string> derivative_notes(const Problem& problem, const Vec& y,
                                          const std::string& where);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
