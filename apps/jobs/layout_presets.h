// Defaults of layout options for a use: `--preset`, `preset=`.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace majorant {

struct LayoutPreset {
  std::string_view name;
  std::optional<double> max_stretch;  // none: the stretch that follows from the number of charts
  bool is_one_chart;                  // one chart per piece; else as many as max_stretch needs
  double fill;                        // least fill; 0: charts are not divided to fill the square
  double padding, resolution;         // pixels
  std::optional<int> uv_set = std::nullopt;  // set that receives the layout; none: the first
};

inline constexpr std::array<LayoutPreset, 4> kLayoutPresets{{
    {"paint", 1.01, false, 0, 8, 4096},
    {"lightmap", 1.03, false, 0.6, 2, 512, 1},
    {"game", 1.01, false, 0.6, 4, 2048},
    {"single", std::nullopt, true, 0, 4, 1024},
}};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
