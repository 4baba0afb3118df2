// Combing: branches are renamed along a tree of faces, so that branch 0 of each face is matched
// with branch 0 of its parent. The remaining turns are those of the field around loops of the
// tree's complement. They are 0 except across the cut if the cut surface is a disk without cones.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

void comb(const SurfaceMesh& mesh, const std::vector<char>& is_cut, CrossField& field) {
  if (is_cut.size() != to_size(mesh.half_edge_count()) || field.turns.size() != is_cut.size())
    throw InvalidArgument("comb: is_cut and field.turns must have 3 #F entries");
  const auto turn = [&](Index f, int quarters) {  // renames branch `quarters` of f to branch 0
    field.angle[f] = std::remainder(field.angle[f] + quarters * kQuarter, 4 * kQuarter);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index o = mesh.opposite(h);
      if (o < 0) continue;
      field.turns[h] = (field.turns[h] - quarters + 8) % 4;
      field.turns[o] = (4 - field.turns[h]) % 4;
    }
  };
  std::vector<char> seen(to_size(mesh.face_count()), 0);
  for (Index start = 0; start < mesh.face_count(); ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    std::vector<Index> queue{start};
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (Index h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
        const Index o = mesh.opposite(h);
        if (o < 0 || is_cut[h] || seen[face_of(o)]) continue;
        seen[face_of(o)] = 1;
        queue.push_back(face_of(o));
        turn(face_of(o), -field.turns[h]);
      }
  }
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0 && !is_cut[h] && field.turns[h] != 0)
      throw Error(ErrorKind::Usage,
                  fmt::format("{}edge ({}, {}): the field cannot be combed, the cut surface has "
                              "a cone inside or is not simply connected",
                              message_prefix(mesh), user_vertex(mesh, mesh.from_vertex(h)),
                              user_vertex(mesh, mesh.to_vertex(h))));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
