// Checks that public entries make of their arguments before they use them. Each costs O(n), once a
// call and never in an inner loop, and throws InvalidArgument with the words of the caller:
//
//   require_given("ProblemBuilder::add: the term", energy);
//   require_size("Problem::expand: y", y0.size(), 3);   // "... has 5 numbers, 3 are needed"
//   require_finite("Problem::expand: y", y0);           // "...: y[2] is nan, finite is needed"
//
// Not for what a file says, which is Error with file and line.
#pragma once

#include <cstddef>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/framework/types.h"

namespace majorant {

class Partition;
class StopCheck;

void require_size(std::string_view what, Eigen::Index has, Eigen::Index needs);
// Accepts as many or more: unknowns that begin with those of a space, say.
void require_enough(std::string_view what, Eigen::Index has, Eigen::Index needs);
void require_finite(std::string_view what, VecIn numbers);
// Names the row: "row 3 of ... is not finite".
void require_finite_rows(std::string_view what, const Eigen::Ref<const RowMatrix>& rows);
// 0 <= index < count.
void require_index(std::string_view what, Eigen::Index index, Eigen::Index count);
void require_at_least(std::string_view what, double value, double least);
// Where several processes share a problem, a check that one of them obeys would leave the others
// waiting.
void require_no_stop(std::string_view what, const StopCheck& stop, const Partition& partition);
// A count of many things, of some numbers each. Throws Error(Unsupported) where there are more of
// them, or of their numbers, than an Index counts.
Index counted(std::string_view what, std::size_t count, std::size_t numbers_each = 1);
[[noreturn]] void refuse_null(std::string_view what);

template <class Pointer>
void require_given(std::string_view what, const Pointer& pointer) {
  if (!pointer) refuse_null(what);
}

// A pointer that is used where it is checked: initializers of members.
template <class Pointer>
Pointer given(std::string_view what, Pointer pointer) {
  require_given(what, pointer);
  return pointer;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
