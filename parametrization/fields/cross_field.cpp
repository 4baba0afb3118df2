#include "majorant/parametrization/fields/cross_field.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/internal/aligned_edges.h"
#include "majorant/parametrization/fields/internal/cone_cleanup.h"
#include "majorant/parametrization/fields/internal/cone_descent.h"
#include "majorant/parametrization/fields/internal/field_connection.h"
#include "majorant/parametrization/fields/internal/field_geometry.h"
#include "majorant/parametrization/fields/internal/principal_directions.h"
#include "majorant/parametrization/fields/internal/smoothest_directions.h"
#include "majorant/parametrization/fields/internal/trivial_connection.h"

namespace majorant {
namespace {

void require_valid(const SurfaceMesh& mesh, const CrossFieldOptions& options) {
  if (!(options.curvature_weight >= 0) || !std::isfinite(options.curvature_weight))
    throw InvalidArgument("smoothest_cross_field: curvature_weight must be >= 0");
  if (!(options.cone_cost >= 0) || !std::isfinite(options.cone_cost))
    throw InvalidArgument("smoothest_cross_field: cone_cost must be >= 0");
  if (options.least_quarter_turns < 1 || options.least_quarter_turns > 4)
    throw InvalidArgument("smoothest_cross_field: least_quarter_turns must be 1 to 4");
  if (!options.aligned.empty() && options.aligned.size() != to_size(mesh.half_edge_count()))
    throw InvalidArgument("smoothest_cross_field: aligned must have 3 #F entries");
}

[[noreturn]] void refuse(const SurfaceMesh& mesh, const std::string& reason) {
  throw Error(ErrorKind::Usage, fmt::format("{}cones: {}", message_prefix(mesh), reason));
}

// Returns the quarter turns of all vertices; 0 at the boundary.
std::vector<int> checked_quarter_turns(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                       const std::vector<Cone>& cones) {
  std::vector<int> turns(to_size(mesh.vertex_count()), 4);
  for (std::size_t v = 0; v < turns.size(); ++v)
    if (geometry.is_boundary[v]) turns[v] = 0;
  std::vector<char> seen(turns.size(), 0);
  for (const Cone& cone : cones) {
    const Index v = cone.vertex;
    if (v < 0 || v >= mesh.vertex_count())
      refuse(mesh, fmt::format("there is no vertex {} (counting from 0)", v));
    const Index name = mesh.input_vertex(v);  // from 0, as files of cones do
    if (geometry.is_boundary[v])
      refuse(mesh, fmt::format("vertex {} lies on the boundary, where angles are free", name));
    if (seen[v]) refuse(mesh, fmt::format("vertex {} is given twice", name));
    if (cone.quarter_turns < 1)
      refuse(mesh, fmt::format("vertex {} has {} quarter turns, must have at least 1", name,
                               cone.quarter_turns));
    // Angles of a map are below 180 degrees.
    const int faces = geometry.valence[v];
    if (cone.quarter_turns >= 2 * faces)
      refuse(mesh, fmt::format("vertex {} has {} quarter turns, but its {} faces hold at most {}; "
                               "refine the mesh there",
                               name, cone.quarter_turns, faces, 2 * faces - 1));
    seen[v] = 1;
    turns[v] = cone.quarter_turns;
  }
  const Index chi = mesh.topology().euler_characteristic();
  long long sum = 0;
  for (const int q : turns) sum += 4 - q;
  if (mesh.boundary_loops().empty() && sum != 4 * chi)
    refuse(mesh, fmt::format("the sum of 4 - quarter turns is {}, must be {} on a closed surface "
                             "of Euler characteristic {}",
                             sum, 4 * chi, chi));
  return turns;
}

// A field whose cones are cleaned up but whose branches are not yet relaxed to them.
struct ConedField {
  FieldConnection field;
  Vec hold;      // #F: how strongly each keeps its direction, as Relaxation has it
  bool is_free;  // follows neither curvature nor edges
};

ConedField coned_field(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                       const CrossFieldOptions& options) {
  const Vec fixed = fixed_angles(mesh, geometry, options.aligned);
  const double pull = options.curvature_weight * options.curvature_weight;
  const std::vector<std::complex<double>> curvature = principal_directions(mesh, geometry);
  const std::vector<std::complex<double>> z =
      smoothest_directions(mesh, geometry, fixed, curvature, pull, options.stop);
  const Vec mass = geometry.face_area / mesh.area();
  Vec angle(mesh.face_count()), hold(mesh.face_count());
  std::vector<char> is_fixed(to_size(mesh.face_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    is_fixed[f] = fixed[f] != kNotAligned;
    angle[f] = z[f] == std::complex<double>(0) ? 0.0 : std::arg(z[f]) / 4;
    if (is_fixed[f]) angle[f] = fixed[f];
    hold[f] = is_fixed[f] ? std::numeric_limits<double>::infinity()
                          : pull * mass[f] * std::abs(curvature[f]);
  }
  FieldConnection field = nearest_matching(mesh, geometry, angle);
  options.stop.poll();
  AlignedSectors sectors;
  if (!options.aligned.empty())
    sectors = aligned_sectors(mesh, geometry, options.aligned, fixed, field.rotation);
  optimize_cones(mesh, geometry, is_fixed, std::move(sectors), options.least_quarter_turns, field);
  options.stop.poll();
  const bool is_free = pull == 0 && (fixed.array() == kNotAligned).all();
  if (is_free) lower_cone_energy(mesh, geometry, options, field);
  return {std::move(field), std::move(hold), is_free};
}

}  // namespace

CrossField smoothest_cross_field(const SurfaceMesh& mesh, const CrossFieldOptions& options) {
  require_valid(mesh, options);
  const FieldGeometry geometry(mesh);
  auto [field, hold, is_free] = coned_field(mesh, geometry, options);
  if (is_free)
    relax_and_round_turning(mesh, geometry, field);
  else
    Relaxation(mesh, geometry, hold).apply(field.angle, field.rotation);
  return cross_field(mesh, geometry, field);
}

std::vector<Index> smoothest_field_cones(const SurfaceMesh& mesh,
                                         const CrossFieldOptions& options) {
  require_valid(mesh, options);
  const FieldGeometry geometry(mesh);
  const std::vector<int> turns = coned_field(mesh, geometry, options).field.quarter_turns;
  std::vector<Index> cones;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!geometry.is_boundary[v] && turns[v] != 4) cones.push_back(v);
  return cones;
}

std::vector<Index> cone_vertices(const CrossField& field) {
  std::vector<Index> cones;
  for (std::size_t v = 0; v < field.quarter_turns.size(); ++v)
    if (field.quarter_turns[v] != 0 && field.quarter_turns[v] != 4)
      cones.push_back(static_cast<Index>(v));
  return cones;
}

CrossField cross_field_with_cones(const SurfaceMesh& mesh, const std::vector<Cone>& cones) {
  const FieldGeometry geometry(mesh);
  const std::vector<int> turns = checked_quarter_turns(mesh, geometry, cones);
  return cross_field(mesh, geometry, trivial_connection(mesh, geometry, turns));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
