#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/solve/free_scale.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "majorant/parametrization/solve/pin_homotopy.h"

namespace majorant {
namespace {

// The largest distance from the plane of a planar mesh, relative to the mesh's size.
constexpr double kFlat = kTenDigits;
// Steps towards the targets, such that a right angle is turned by 9 degrees at a time. Chosen.
constexpr int kDeformSteps = 10;

}  // namespace

BezierMap planar_map(std::shared_ptr<const SurfaceMesh> mesh) {
  require_given("planar_map: the mesh", mesh);
  const Points3& p = mesh->positions();
  const double size = extent(p);
  for (Index v = 0; v < mesh->vertex_count(); ++v)
    if (!(std::abs(p(v, 2) - p(0, 2)) <= kFlat * size))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}vertex {} is off the plane z = {:g}; deform needs a planar mesh",
                              message_prefix(*mesh), user_vertex(*mesh, v), p(0, 2)));
  Vec twice_area(mesh->face_count());
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const Eigen::RowVector2d a = p.row(mesh->faces()(f, 0)).head<2>();
    const Eigen::RowVector2d b = p.row(mesh->faces()(f, 1)).head<2>() - a;
    const Eigen::RowVector2d c = p.row(mesh->faces()(f, 2)).head<2>() - a;
    twice_area[f] = cross(b, c);
  }
  const double side = twice_area.sum() < 0 ? -1 : 1;
  for (Index f = 0; f < mesh->face_count(); ++f)
    if (!(side * twice_area[f] > 0))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}face {} is inverted in the plane; repair the mesh",
                              message_prefix(*mesh), user_face(*mesh, f)));
  Vec uv(2 * mesh->vertex_count());
  for (Index v = 0; v < mesh->vertex_count(); ++v) uv.segment<2>(2 * v) << side * p(v, 0), p(v, 1);
  return BezierMap::linear(std::move(mesh), std::move(uv));
}

ParametrizationResult deform(const BezierMap& start, const ParametrizationOptions& options,
                             RunRecord& record) {
  ParametrizationOptions resolved = options;
  resolved.map = with_targets(start, options.map);
  require_scale(resolved.map, start);
  if (resolved.map.handles.empty() && resolved.map.pins.empty())
    return parametrize(start, resolved, record);
  require_no_contradiction(start, resolved.map);
  const PinSolver solver = pin_solver(record);
  PinHomotopy way(start, resolved.map, resolved.solve, solver, record);
  way.walk(kDeformSteps, resolved.map.handle_weight);
  if (!resolved.map.pins.empty() && !way.hold()) way.refuse();
  return parametrize(way.map(), resolved, record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
