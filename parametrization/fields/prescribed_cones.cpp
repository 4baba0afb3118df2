// cross_field_with_cones: checks what is asked for; trivial_connection.h does it.
#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/fields/internal/trivial_connection.h"

namespace majorant {
namespace {

[[noreturn]] void refuse(const SurfaceMesh& mesh, const std::string& what) {
  throw Error(ErrorKind::Usage, fmt::format("{}cones: {}", message_prefix(mesh), what));
}

// Per vertex the quarter turns asked for; 0 at the boundary.
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

}  // namespace

CrossField cross_field_with_cones(const SurfaceMesh& mesh, const std::vector<Cone>& cones) {
  const FieldGeometry geometry(mesh);
  const std::vector<int> turns = checked_quarter_turns(mesh, geometry, cones);
  return cross_field(mesh, geometry, trivial_connection(mesh, geometry, turns));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
