// Makes the elements of a mesh valid and of good shape, by moving its nodes. Newton's method
// minimizes an energy of each element relative to its target shape, inside the set of meshes whose
// elements are proven to be valid. Invalid elements are untangled first.
//
//   VolumeMesh cells = read_volume_mesh("ball.msh");
//   const VolumeResult result = optimize_volume_mesh(cells, {}, record);
//   if (result.after.is_valid()) cells.points = result.points;      // proven, as doubles
//
// The energy is a mean; elements that would end worse than the worst one of a valid mesh weigh
// more. Tetrahedra, hexahedra, wedges, and triangles and quads of the plane, in one mesh; straight
// or curved. Numbers, order and regions of cells stay.
//
// Not for what only another mesh can mend: no cell is split, flipped or removed, and the surface
// that boundary nodes were made for is known by these nodes alone.
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

// The shape that the elements should have.
enum class VolumeTarget {
  Ideal,    // regular, of the size that the elements around their corners have in the mean
  Initial,  // the affine elements of their corners, where these are not turned around
  Size,     // regular, with edges of the lengths that are given
};

enum class VolumeBoundary {
  Fixed,  // nothing of it moves
  // Planes move in themselves, their edges along themselves, nodes of curved sides alone along the
  // sides around them, where these go into each other without a corner.
  Slide,
  // Only nodes of cells that are not valid move, and of cells that share a side with one, of the
  // boundary or not. Of a mesh that is valid: as Fixed.
  Free,
};

struct VolumeOptions {
  // An energy of the dimension of the mesh (find_volume_energy()); empty: symmetric Dirichlet.
  EnergySum energy;
  VolumeTarget target = VolumeTarget::Ideal;
  // Edge lengths of VolumeTarget::Size: one, or one for each checked cell, in their order.
  std::vector<double> sizes;
  VolumeBoundary boundary = VolumeBoundary::Fixed;
  double tolerance = 1e-6;  // StoppingRules::relative_decrease
};

struct VolumeResult {
  // Converged; MaxIterations, TimeLimit, Interrupted, Stalled: `after` says whether it is valid.
  // Infeasible: some element cannot be valid, or was not made so.
  Status status = Status::Failed;
  std::string message;
  // #P by 3, in the order of the mesh; of a mesh that was not untangled where that ended.
  Points3 points;
  VolumeCheck before, after;         // of the mesh as it was, and with these points
  std::vector<CellName> impossible;  // whose fixed nodes make det J <= 0 somewhere
  Index unknowns = 0, moved_nodes = 0;
  double largest_displacement = 0;         // of a node
  Index held_sides = 0, curved_sides = 0;  // sides that do not move; of Slide: in no plane
  double initial_value = 0, value = 0;     // means of the density; the first after untangling
  int untangling_iterations = 0;

  // True where all elements are proven to be valid at `points`, which may be written then.
  bool is_valid() const { return after.is_valid() && status != Status::Infeasible; }
  // True where the worst element of a valid mesh became visibly worse.
  bool least_fell() const;
};

// The energies of meshes of so many dimensions, 2 or 3, and one of them by its name; null: none.
std::span<const NamedEnergy> volume_energies(int dim);
const NamedEnergy* find_volume_energy(std::string_view name, int dim);

// True where x may be the length of edges: it is positive, and doubles hold x^(2 dim), the square
// of a volume, and its inverse.
bool is_edge_length(double x, int dim);

// The record has the limits, and gets the trace. Throws Error(Unsupported) for surfaces in space,
// serendipity elements, meshes whose sides do not agree or that are turned around as a whole;
// InvalidArgument for sizes that are no is_edge_length(), or not as many as there are cells;
// Stopped before there is anything to be optimized.
VolumeResult optimize_volume_mesh(const VolumeMesh& mesh, const VolumeOptions& options,
                                  RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
