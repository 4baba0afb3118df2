// Checks of the arguments of public entries. Each check costs O(n), is made once a call and never
// in an inner loop, and throws InvalidArgument with the caller's words:
//
//   require_given("ProblemBuilder::add: the term", energy);
//   require_size("Problem::expand: y", y0.size(), 3);   // "... has 5 numbers, 3 are needed"
//   require_finite("Problem::expand: y", y0);           // "...: y[2] is nan, finite is needed"
//
// Not for errors in a file, which throw Error with file and line.
#pragma once

#include <cstddef>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/framework/types.h"

namespace majorant {

class Partition;
class StopCheck;

void require_size(std::string_view what, Eigen::Index has, Eigen::Index needs);
// Accepts `needs` numbers or more, such as unknowns that begin with those of a space.
void require_enough(std::string_view what, Eigen::Index has, Eigen::Index needs);
void require_finite(std::string_view what, VecIn numbers);
// Names the row: "row 3 of ... is not finite".
void require_finite_rows(std::string_view what, const Eigen::Ref<const RowMatrix>& rows);
// Requires 0 <= index < count.
void require_index(std::string_view what, Eigen::Index index, Eigen::Index count);
void require_at_least(std::string_view what, double value, double least);
// Throws if a stop check is given for a problem that several processes share: one process would
// obey it and leave the others waiting.
void require_no_stop(std::string_view what, const StopCheck& stop, const Partition& partition);
// Returns a count as an Index. Throws Error(Unsupported) if the count, or the count times the
// numbers of each thing, exceeds the range of Index.
Index counted(std::string_view what, std::size_t count, std::size_t numbers_each = 1);
[[noreturn]] void refuse_null(std::string_view what);

template <class Pointer>
void require_given(std::string_view what, const Pointer& pointer) {
  if (!pointer) refuse_null(what);
}

// Returns the pointer that it checks, for the initializers of members.
template <class Pointer>
Pointer given(std::string_view what, Pointer pointer) {
  require_given(what, pointer);
  return pointer;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
