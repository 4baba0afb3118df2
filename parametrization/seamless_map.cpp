#include "majorant/parametrization/seamless_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/parametrization/cut_graph.h"
#include "majorant/parametrization/field_integration.h"
#include "majorant/parametrization/untangle.h"

namespace majorant {
namespace {

BezierMap field_start(const SurfaceMesh& mesh, const SeamlessOptions& options) {
  CrossField field = options.cones.empty() ? smoothest_cross_field(mesh, options.field)
                                           : cross_field_with_cones(mesh, options.cones);
  const std::vector<char> is_cut = cut_graph(mesh, cone_vertices(field));
  comb(mesh, is_cut, field);
  return integrate_field(mesh, is_cut, field);
}

}  // namespace

SeamlessMap make_seamless(const SurfaceMesh& mesh, const SeamlessOptions& options,
                          const RunRecord& record) {
  SeamlessMap out{field_start(mesh, options)};
  const BezierMap& start = out.map;
  MapSpecification spec;
  spec.seams = start.shared_seams();
  spec.rest = flat_triangles(start.mesh().positions(), start.mesh().faces());
  const UntangleResult r = untangle(spec, start.shared_space(), start.control_points(), record);
  fmt::print("inverted {} steps {} left {}\n", 0, r.iterations, r.inverted.size());
  out.untangling_steps = r.iterations;
  out.map = start.with(start.shared_space(), r.x);
  return out;
}

}  // namespace majorant
