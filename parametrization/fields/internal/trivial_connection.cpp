#include "majorant/parametrization/fields/internal/trivial_connection.h"

#include <cmath>

#include "majorant/parametrization/fields/internal/cone_potential.h"
#include "majorant/parametrization/fields/internal/homology_generators.h"

namespace majorant {
namespace {

// Of the energy of a loop; rounding shall not turn the field: far above rounding, far below
// what a turn changes.
constexpr double kLeastTurnGain = 1e-9;
// Over the loops; a few suffice: a bound; chosen, not tuned.
constexpr int kMostLoopSweeps = 100;

}  // namespace

FieldConnection trivial_connection(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                   const std::vector<int>& quarter_turns) {
  const TurningLoops loops(mesh, geometry);
  FieldConnection field{Vec::Zero(mesh.face_count()),
                        ConePotential(mesh, geometry, quarter_turns).rotations(), quarter_turns};
  const auto branch_beyond = [&](Index h) {
    return field.angle[face_of(h)] + geometry.transport[h] + field.rotation[h];
  };
  for (const Index h : loops.face_tree())
    field.angle[face_of(mesh.opposite(h))] = std::remainder(branch_beyond(h), 4 * kQuarter);
  // Where the tree does not pass, the branches that meet may differ, up to quarter turns.
  Vec gaps(static_cast<Index>(loops.loops().size()));
  for (Index k = 0; k < gaps.size(); ++k) {
    const Index h = loops.loops()[k];
    gaps[k] = std::remainder(field.angle[face_of(mesh.opposite(h))] - branch_beyond(h), kQuarter);
  }
  field.rotation += loops.close(gaps);
  relax_and_round_turning(mesh, geometry, field);
  return field;
}

// The energy is a quadratic function of the numbers of quarter turns around the loops. With
// relaxed forms f_k, one for every loop, the change by n quarter turns around loop k is
//   n (pi / 2) <rotation, f_k> + 1/2 (n pi / 2)^2 <f_k, f_k>;
// n is the best integer, loop after loop until none changes.
void relax_and_round_turning(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                             FieldConnection& field) {
  const Relaxation relaxation(mesh, geometry, Vec::Zero(mesh.face_count()));
  relaxation.apply(field.angle, field.rotation);
  const TurningLoops loops(mesh, geometry);
  const auto count = static_cast<Index>(loops.loops().size());
  std::vector<FieldConnection> forms;
  for (Index k = 0; k < count; ++k) {
    forms.push_back({Vec::Zero(mesh.face_count()), loops.close(Vec::Unit(count, k)), {}});
    relaxation.apply(forms.back().angle, forms.back().rotation);
  }
  bool changed = count > 0;
  for (int sweep = 0; changed && sweep < kMostLoopSweeps; ++sweep) {
    changed = false;
    for (const FieldConnection& form : forms) {
      // Both half-edges of every edge are counted, on both sides of the quotient.
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
