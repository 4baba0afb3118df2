#include "majorant/framework/argument_check.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "majorant/framework/partition.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

void require_size(std::string_view what, Eigen::Index has, Eigen::Index needs) {
  if (has != needs)
    throw InvalidArgument(fmt::format("{} has {} numbers, {} are needed", what, has, needs));
}

void require_enough(std::string_view what, Eigen::Index has, Eigen::Index needs) {
  if (has < needs) require_size(what, has, needs);
}

void require_finite(std::string_view what, VecIn numbers) {
  if (numbers.allFinite()) return;
  Eigen::Index k = 0;
  while (std::isfinite(numbers[k])) ++k;
  throw InvalidArgument(fmt::format("{}[{}] is {}, finite is needed", what, k, numbers[k]));
}

void require_finite_rows(std::string_view what, const Eigen::Ref<const RowMatrix>& rows) {
  if (rows.allFinite()) return;
  Eigen::Index k = 0;
  while (rows.row(k).allFinite()) ++k;
  throw InvalidArgument(fmt::format("row {} of {} is not finite", k, what));
}

void require_index(std::string_view what, Eigen::Index index, Eigen::Index count) {
  if (index < 0 || index >= count)
    throw InvalidArgument(fmt::format("{} {} does not exist, there are {}", what, index, count));
}

void require_at_least(std::string_view what, double value, double least) {
  if (!(value >= least))
    throw InvalidArgument(fmt::format("{} is {:g}, at least {:g} is needed", what, value, least));
}

void require_no_stop(std::string_view what, const StopCheck& stop, const Partition& partition) {
  if (partition.ranks().count() > 1 && stop.may_stop())
    throw InvalidArgument(
        fmt::format("{} may stop this rank and leave the others waiting; let the observer of rank "
                    "0 say when to stop",
                    what));
}

Index counted(std::string_view what, std::size_t count, std::size_t numbers_each) {
  const std::size_t most = static_cast<std::size_t>(std::numeric_limits<Index>::max());
  if (count > most / numbers_each)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: {} are more than the {} that integers count; use fewer elements "
                            "or a lower degree, or divide the problem between processes",
                            what, count, most / numbers_each));
  return static_cast<Index>(count);
}

void refuse_null(std::string_view what) { throw InvalidArgument(fmt::format("{} is null", what)); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
