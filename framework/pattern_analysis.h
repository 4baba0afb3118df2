// The direct solver's analysis of a pattern, which needs no values. It can be made before the
// solver exists, also on another thread.
//
//   const SparsePattern& pattern = problem.pattern();      // outlives the analysis, where it is
//   auto analysis = std::make_shared<PatternAnalysis>(pattern, Ordering::Automatic);
//   const auto solver = make_direct_solver({.analysis = analysis});
//   solver->analyze(pattern);                              // takes it
//
// Not for a second solver: the first matching solver takes the analysis.
#pragma once

#include <memory>

#include "majorant/framework/linear_solver.h"

namespace majorant {

class PatternAnalysis {
 public:
  // Orders the pattern and finds the structure of the factor. Throws std::bad_alloc.
  PatternAnalysis(const SparsePattern& pattern, Ordering ordering);
  ~PatternAnalysis();
  PatternAnalysis(const PatternAnalysis&) = delete;
  PatternAnalysis& operator=(const PatternAnalysis&) = delete;

  struct Parts;  // of the direct solver
  // Returns the analysis once, if `pattern` is the analysed object; else null.
  std::shared_ptr<Parts> take(const SparsePattern& pattern, Ordering ordering);

 private:
  const SparsePattern* pattern_;
  Ordering ordering_;
  std::shared_ptr<Parts> parts_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
