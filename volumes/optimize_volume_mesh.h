// Makes the elements of a mesh valid and of good shape, by moving its nodes. Newton's method
// minimizes an energy of each element relative to its target shape, inside the set of meshes whose
// elements are proven to be valid. Invalid elements are untangled first.
//
//   VolumeMesh cells = read_volume_mesh("ball.msh");
//   const VolumeResult result = optimize_volume_mesh(cells, {}, record);
//   if (result.after.is_valid()) cells.points = result.points;      // proven, as doubles
//
// The energy is a mean; elements that would end worse than the worst one of a valid mesh get larger
// weights. A mesh may contain tetrahedra, hexahedra and wedges, or triangles and quads of the
// plane, straight or curved. Numbers, order and regions of cells stay.
//
// Not for defects that need another mesh: no cell is split, flipped or removed. The surface for
// which boundary nodes were made is known by these nodes alone.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/framework/run_record.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// The target shape of the elements.
enum class VolumeTarget {
  Ideal,    // regular, with the mean size of the elements around their corners
  Initial,  // the affine elements of their initial corners, if these are not turned around
  Size,     // regular, with edges of the given lengths
};

enum class VolumeBoundary {
  Fixed,  // no boundary node moves
  // Nodes move within planes, along edges of planes, and, if all their sides are curved and join
  // without a corner, along these sides.
  Slide,
  // Only nodes of invalid cells, and of cells that share a side with one, move, on the boundary or
  // not. For a valid mesh as Fixed.
  Free,
};

struct VolumeOptions {
  // An energy of the mesh's dimension (find_volume_energy()); empty: symmetric Dirichlet.
  EnergySum energy;
  VolumeTarget target = VolumeTarget::Ideal;
  // Edge lengths of VolumeTarget::Size: one for all cells, or one for each checked cell, in their
  // order.
  std::vector<double> sizes;
  VolumeBoundary boundary = VolumeBoundary::Fixed;
  double tolerance = 1e-6;  // StoppingRules::relative_decrease
};

struct VolumeResult {
  // Converged, MaxIterations, TimeLimit, Interrupted, Stalled: `after` tells whether the mesh is
  // valid. Infeasible: some element cannot be valid, or was not made valid.
  Status status = Status::Failed;
  std::string message;
  // #P by 3, in the order of the mesh; if untangling failed, its last points.
  Points3 points;
  VolumeCheck before, after;         // of the initial mesh, and with these points
  std::vector<CellName> impossible;  // cells with det J <= 0 somewhere because of fixed nodes
  Index unknowns = 0, moved_nodes = 0;
  double largest_displacement = 0;         // of a node
  Index held_sides = 0, curved_sides = 0;  // sides that do not move; under Slide: of these, in no
                                           // plane
  double initial_value = 0, value = 0;     // mean densities; initial_value: after untangling
  int untangling_iterations = 0;

  // Returns true if all elements are proven valid at `points`, which may then be written.
  bool is_valid() const { return after.is_valid() && status != Status::Infeasible; }
  // Returns true if the worst element of a valid mesh became visibly worse.
  bool least_fell() const;
};

// The energies of meshes of dimension 2 or 3, and the energy with a given name (null: none).
std::span<const NamedEnergy> volume_energies(int dim);
const NamedEnergy* find_volume_energy(std::string_view name, int dim);

// Returns true if x can be the length of edges: it is positive, and x^(2 dim), the square of a
// volume, and its inverse are normal doubles.
bool is_edge_length(double x, int dim);

// The record holds the limits and receives the trace. Throws Error(Unsupported) for surfaces in
// space, serendipity elements, and meshes whose sides do not agree or that are turned around as a
// whole. Throws InvalidArgument for sizes that are no is_edge_length(), or whose number does not
// fit. Throws Stopped before there is anything to optimize.
VolumeResult optimize_volume_mesh(const VolumeMesh& mesh, const VolumeOptions& options,
                                  RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
