// OKLab [Ottosson 2020]: a space in which distances are about what differences look like.
#pragma once

#include <Eigen/Core>

#include "majorant/pictures/color_scale.h"

namespace majorant {

// Lightness 0 to 1, then green to red and blue to yellow, about -0.4 to 0.4.
using Oklab = Eigen::Vector3d;

// Linear light (red, green, blue), inside 0 to 1 where a screen can show it.
Eigen::Vector3d to_linear(const Oklab& lab);
// Rounded, and clamped to what a screen can show.
Color to_srgb(const Oklab& lab);
Oklab to_oklab(Color color);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
