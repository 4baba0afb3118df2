#include "majorant/parametrization/fields/internal/homology_generators.h"

#include <cstddef>

namespace majorant {
TurningLoops::TurningLoops(const SurfaceMesh& mesh, const FieldGeometry& geometry)
    : mesh_(mesh), used_(to_size(mesh.half_edge_count()), 0) {
  grow_face_tree();
  grow_vertex_tree(geometry);
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (mesh_.opposite(h) > h && !used_[h]) loops_.push_back(h);
}

void TurningLoops::grow_face_tree() {
  std::vector<char> seen(to_size(mesh_.face_count()), 0);
  std::vector<Index> queue{0};
  seen[0] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (Index h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
      const Index o = mesh_.opposite(h);
      if (o < 0 || seen[face_of(o)]) continue;
      seen[face_of(o)] = used_[h] = used_[o] = 1;
      face_tree_.push_back(h);
      queue.push_back(face_of(o));
    }
}

void TurningLoops::grow_vertex_tree(const FieldGeometry& geometry) {
  std::vector<std::vector<Index>> leaving(to_size(mesh_.vertex_count()));
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (mesh_.opposite(h) >= 0 && !used_[h]) leaving[mesh_.from_vertex(h)].push_back(h);
  std::vector<char> seen = geometry.is_boundary;
  std::vector<Index> queue;
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (seen[v]) queue.push_back(v);
  if (queue.empty()) {
    queue.push_back(0);
    seen[0] = 1;
  }
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const Index h : leaving[queue[next]]) {
      const Index v = mesh_.to_vertex(h);
      if (seen[v]) continue;
      seen[v] = used_[h] = used_[mesh_.opposite(h)] = 1;
      vertex_tree_.push_back(h);
      queue.push_back(v);
    }
}

Vec TurningLoops::close(const Vec& loop_values) const {
  Vec form = Vec::Zero(mesh_.half_edge_count());
  Vec around = Vec::Zero(mesh_.vertex_count());  // sum over the half-edges that enter
  const auto set = [&](Index h, double value) {
    form[h] = value;
    form[mesh_.opposite(h)] = -value;
    around[mesh_.to_vertex(h)] += value;
    around[mesh_.from_vertex(h)] -= value;
  };
  for (std::size_t k = 0; k < loops_.size(); ++k)
    set(loops_[k], loop_values[static_cast<Index>(k)]);
  // From the leaves: the edge to the root is the last one at its vertex.
  for (std::size_t k = vertex_tree_.size(); k-- > 0;)
    set(vertex_tree_[k], -around[mesh_.to_vertex(vertex_tree_[k])]);
  return form;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
