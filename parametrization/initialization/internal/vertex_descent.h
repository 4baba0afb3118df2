// Newton's method on one vertex of a planar map at a time, all others at rest.
//
//   const CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   VertexDescent descent(left, mesh->positions(), options.map.energy, start);
//   descent.measure_all();
//   if (descent.has_area_margin(7)) descent.improve(7, 2);
//
// Every accepted place of a vertex has the triangles around it counterclockwise beyond rounding
// and lowers the energy, so that a map without inverted triangles never gets any. The triangles are
// those that a CollapsingMesh has left, measured against themselves in space.
//
// A copy works on the same map, in memory of its own: one for each thread. Two threads may improve,
// measure or put back vertices that are no neighbours at the same time.
//
// The place of a vertex that comes back to a map: always one that leaves its triangles positive.
//
//     const auto back = mesh.restore();
//     descent.measure_star(back.vertex);
//     if (put_back(mesh, positions, descent, back)) descent.improve(back.vertex, 4);
#pragma once

#include <memory>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/parametrization/initialization/internal/collapsing_mesh.h"

namespace majorant {

class alignas(64) VertexDescent {  // copies in no common line of a cache
 public:
  // mesh, positions (#V by 3) and uv (2 numbers per vertex) outlive this and are what it works on;
  // uv in the units of positions. Throws InvalidArgument for energies of other than planar
  // maps, and for those that know single faces.
  VertexDescent(const CollapsingMesh& mesh, const Points3& positions, const EnergySum& energy,
                Vec& uv);

  // Factors of the energy, 1 as long as nobody says: by face slot, or by vertex, a face having the
  // mean of its corners.
  void weigh_faces(const Vec& weight) { map_->face_weight = weight; }
  void weigh_vertices(const Vec& weight) { map_->vertex_weight = weight; }
  double weight_of(Index face) const;

  // The shapes of all faces, or of those around v, are what they are now.
  void measure_all();
  void measure_star(Index v);

  bool has_area_margin(Index v);
  // The mean of the energy over the faces around v: its integral, divided by their area.
  double mean_energy(Index v);
  // At most `steps` Newton steps. Returns the mean energy of the star afterwards.
  double improve(Index v, int steps);
  // The same of a boundary vertex that put_back_within() has just put back: it stays inside of the
  // edge that had closed behind it, at half of its distance at least.
  double improve_within(Index v, int steps);

  Vector2 place(Index v) const { return map_->uv.segment<2>(2 * v); }
  void put(Index v, const Vector2& p) { map_->uv.segment<2>(2 * v) = p; }

 private:
  // Gradients of the hat functions of corners 0 and 1 in the frame of flat_triangles(), corner 0 on
  // its first axis as seen from corner 2: (g0x, g0y) and (0, g1y); area times face weight.
  struct Shape {
    double g0x, g0y, g1y, weight;
  };
  void measure(Index face);
  void gather(Index v);
  template <class F>
  double improve(Index v, int steps, const F& is_allowed);
  StarModel model(const Vector2& p) const;

  struct Map {  // that all copies work on
    const CollapsingMesh& mesh;
    const Points3& positions;
    Vec& uv;
    std::vector<std::shared_ptr<const DensityTerm>> terms;
    std::vector<double> term_weight;
    Vec face_weight, vertex_weight;
    std::vector<Shape> shape;
  };

  std::shared_ptr<Map> map_;
  std::vector<double> rows_;  // StarViews one after the other
  int count_ = 0;
  double star_weight_ = 0;
};

// From the neighbours in the map: the mean of them by mean value coordinates of the star in space
// [Flo03], of a boundary vertex the similarity that fits the unfolded star best; where that leaves
// a triangle of the star without room, a point so near to the vertex that it had collapsed onto
// that all have some: the triangles that were there before are positive, and the new ones are when
// it lies between them. False where doubles have no such point.
bool put_back(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
              const CollapsingMesh::Restored& back);
// Does the same so that the image of the map grows nowhere, and an injective one stays injective:
// boundary vertices come back inside of the edge that closed behind them, close to it. They must
// not have been ears (Ears::Stay).
bool put_back_within(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
                     const CollapsingMesh::Restored& back);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
