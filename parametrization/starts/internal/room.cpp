#include "majorant/parametrization/starts/internal/room.h"

#include <algorithm>
#include <limits>

#include "majorant/mesh/internal/exact_predicates.h"

namespace majorant {
namespace {

// Height of a triangle, in units of the rounding of the largest coordinate. Origin: three points
// that are rounded twice each, by half of it along both axes.
constexpr double kLeastHeight = 8;

}  // namespace

Index faces_without_room(const Cells& faces, const Vec& uv) {
  const double least =
      kLeastHeight * std::numeric_limits<double>::epsilon() * uv.cwiseAbs().maxCoeff();
  Index count = 0;
  for (Index f = 0; f < static_cast<Index>(faces.rows()); ++f) {
    const Vector2 a = uv.segment<2>(2 * faces(f, 0)), b = uv.segment<2>(2 * faces(f, 1)),
                  c = uv.segment<2>(2 * faces(f, 2));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!(cross(b - a, c - a) > least * longest) || orientation(a, b, c) <= 0) ++count;
  }
  return count;
}

}  // namespace majorant
