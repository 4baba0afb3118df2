#include "majorant/io/read_face_weights.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/io/input_file.h"
#include "majorant/io/internal/line_cursor.h"
#include "majorant/parametrization/maps/map_problem.h"

namespace majorant {

Vec read_face_weights(const std::string& path, Index face_count) {
  std::string text = read_whole_file(path);
  require_text(path, text);
  LineCursor cursor(path, text, Continuation::None);
  Vec weights(face_count);
  Index count = 0;
  while (cursor.next_line())
    while (!cursor.at_end_of_line()) {
      const double weight = cursor.next_number("a face weight");
      if (!(weight > 0)) cursor.fail("a face weight must be positive");
      if (!is_usable_weight(weight))
        cursor.fail(fmt::format("a face weight of {:g} leaves {:g}..{:g}; only their ratios matter",
                                weight, 1 / kLargestFactor, kLargestFactor));
      if (count == face_count)
        cursor.fail(fmt::format("more than {} numbers; give one for each face", face_count));
      weights[count++] = weight;
    }
  if (count != face_count)
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {} numbers for {} faces; give one for each",
                                                   path, count, face_count));
  return weights;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
