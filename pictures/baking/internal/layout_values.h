// The values of a carrier at points of a layout, and at points where its charts are continued.
#pragma once

#include <optional>
#include <vector>

#include "majorant/certify/inverse_map.h"
#include "majorant/pictures/baking/bake.h"
#include "majorant/pictures/baking/chart_continuation.h"
#include "majorant/pictures/baking/internal/layout_pieces.h"

namespace majorant {

// The memory of a task, with the face of its last answer.
struct ValueScratch {
  explicit ValueScratch(int channels) : value(to_size(channels)), sum(value), one(value) {}
  std::vector<float> value, sum, one;
  Index likely = -1;
  bool is_opposed = false;  // a place of the texel is opposed
};

class LayoutValues {
 public:
  // The arguments must outlive this.
  LayoutValues(const InverseMap& layout, const LayoutPieces& pieces, const Correspondence& place_of,
               const SurfaceValues& values)
      : layout_(layout),
        pieces_(pieces),
        place_of_(place_of),
        values_(values),
        continuation_(layout.map().mesh()) {}

  const BezierMap& map() const { return layout_.map(); }
  int channels() const { return values_.channels; }
  const ChartContinuation& continuation() const { return continuation_; }

  // Returns the point of the surface at this point of the layout, or of a continued piece; none if
  // no chart has it. continued: may be null.
  std::optional<SurfacePlace> place_at(const Vector2& uv, const LayoutPiece* continued) const;
  // Returns false, and leaves value unchanged, if no value is known.
  bool value_at(const SurfacePlace& place, std::vector<float>& value, ValueScratch& scratch) const;
  // Sets scratch.value to the mean over those samples (samples^2) of a texel that lie in charts, or
  // in their continuation; to the value at `place` if there are none. Returns false if no value is
  // known.
  bool find_value(const TexelGrid& grid, int x, int y, int samples, const SurfacePlace& place,
                  const LayoutPiece* continued, ValueScratch& scratch) const;

 private:
  const InverseMap& layout_;
  const LayoutPieces& pieces_;
  const Correspondence& place_of_;
  const SurfaceValues& values_;
  ChartContinuation continuation_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
