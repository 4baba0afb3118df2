// A colour ramp for scalar values on a white page.
#pragma once

#include <string>

namespace majorant {

// "#rrggbb" for t in 0..1 (clamped): light yellow over orange to dark red, with lightness falling
// evenly in OKLab [Ottosson 2020], so that equal steps of t look equal.
std::string heat_color(double t);

}  // namespace majorant
