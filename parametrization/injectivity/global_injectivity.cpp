#include "majorant/parametrization/injectivity/global_injectivity.h"

#include "majorant/parametrization/injectivity/internal/check_layout.h"

namespace majorant {

GlobalInjectivity check_boundary(const BezierMap& map, const InjectivityOptions& options) {
  return check_layout(boundary_loops(map), options);
}

}  // namespace majorant
