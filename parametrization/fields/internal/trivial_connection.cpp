#include "majorant/parametrization/fields/internal/trivial_connection.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "majorant/parametrization/fields/internal/cone_potential.h"
#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {
namespace {

// Generators of the first homology of a surface: the independent loops whose turning the cones do
// not determine. There are two for every handle and one for every boundary loop but one; none on
// spheres and disks.
//
// The tree-cotree decomposition [EW05] finds them: a spanning tree of the faces crosses some edges;
// a spanning tree of the vertices (the boundary counted as one vertex) runs along others. Each
// remaining edge closes one loop of faces.
class HomologyGenerators {
 public:
  HomologyGenerators(const SurfaceMesh& mesh, const FieldGeometry& geometry);

  // Returns the half-edges of the tree of faces, rooted at face 0, each from a known face into a
  // new one.
  const std::vector<Index>& face_tree() const { return face_tree_; }
  // Returns one half-edge of every edge that is in no tree: the loops.
  const std::vector<Index>& loops() const { return loops_; }
  // Extends values on the edges of loops() to all edges (3 #F): 0 across the tree of faces, and
  // adding up to 0 around every interior vertex. Opposite half-edges have opposite values.
  Vec close(const Vec& loop_values) const;

 private:
  void grow_face_tree();
  void grow_vertex_tree(const FieldGeometry& geometry);

  const SurfaceMesh& mesh_;
  std::vector<char> used_;  // 3 #F: edges of a tree
  std::vector<Index> face_tree_, loops_;
  std::vector<Index> vertex_tree_;  // half-edges into new vertices, from the root on
};

HomologyGenerators::HomologyGenerators(const SurfaceMesh& mesh, const FieldGeometry& geometry)
    : mesh_(mesh), used_(to_size(mesh.half_edge_count()), 0) {
  grow_face_tree();
  grow_vertex_tree(geometry);
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (mesh_.opposite(h) > h && !used_[h]) loops_.push_back(h);
}

void HomologyGenerators::grow_face_tree() {
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

void HomologyGenerators::grow_vertex_tree(const FieldGeometry& geometry) {
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

Vec HomologyGenerators::close(const Vec& loop_values) const {
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
  // Vertices are handled from the leaves on: the edge towards the root is the last one at its
  // vertex.
  for (std::size_t k = vertex_tree_.size(); k-- > 0;)
    set(vertex_tree_[k], -around[mesh_.to_vertex(vertex_tree_[k])]);
  return form;
}

// The least decrease for which the field turns, relative to the energy of a loop: far above
// rounding, far below the effect of a turn.
constexpr double kLeastTurnGain = 1e-9;
// Upper bound on sweeps over the loops; a few suffice. Chosen, not tuned.
constexpr int kMaxLoopSweeps = 100;

}  // namespace

FieldConnection trivial_connection(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                   const std::vector<int>& quarter_turns) {
  const HomologyGenerators loops(mesh, geometry);
  FieldConnection field{
      Vec::Zero(mesh.face_count()),
      ConePotential(mesh, geometry, quarter_turns, ConeEnergy::Rotation).rotations(),
      quarter_turns};
  const auto branch_beyond = [&](Index h) {
    return field.angle[face_of(h)] + geometry.transport[h] + field.rotation[h];
  };
  for (const Index h : loops.face_tree())
    field.angle[face_of(mesh.opposite(h))] = std::remainder(branch_beyond(h), 4 * kQuarter);
  // At edges that the tree does not cross, the branches that meet may differ, up to quarter turns.
  Vec gaps(static_cast<Index>(loops.loops().size()));
  for (Index k = 0; k < gaps.size(); ++k) {
    const Index h = loops.loops()[k];
    gaps[k] = std::remainder(field.angle[face_of(mesh.opposite(h))] - branch_beyond(h), kQuarter);
  }
  field.rotation += loops.close(gaps);
  relax_and_round_turning(mesh, geometry, field);
  return field;
}

// The energy is a quadratic function of the numbers of quarter turns around the loops. With relaxed
// forms f_k, one for every loop, n quarter turns around loop k change it by
//   n (pi / 2) <rotation, f_k> + 1/2 (n pi / 2)^2 <f_k, f_k>;
// The best integer n is applied loop after loop until none changes.
void relax_and_round_turning(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                             FieldConnection& field) {
  const Relaxation relaxation(mesh, geometry, Vec::Zero(mesh.face_count()));
  relaxation.apply(field.angle, field.rotation);
  const HomologyGenerators loops(mesh, geometry);
  const auto count = static_cast<Index>(loops.loops().size());
  std::vector<FieldConnection> forms;
  for (Index k = 0; k < count; ++k) {
    forms.push_back({Vec::Zero(mesh.face_count()), loops.close(Vec::Unit(count, k)), {}});
    relaxation.apply(forms.back().angle, forms.back().rotation);
  }
  bool changed = count > 0;
  for (int sweep = 0; changed && sweep < kMaxLoopSweeps; ++sweep) {
    changed = false;
    for (const FieldConnection& form : forms) {
      // Numerator and denominator both count both half-edges of every edge.
      const Vec weighted = geometry.weight.cwiseProduct(form.rotation);
      const double size = weighted.dot(form.rotation);
      const double best = -weighted.dot(field.rotation) / (kQuarter * size);
      const double turns = std::round(best * (1 - kLeastTurnGain));
      if (turns == 0) continue;
      field.angle += turns * kQuarter * form.angle;
      field.rotation += turns * kQuarter * form.rotation;
      changed = true;
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
