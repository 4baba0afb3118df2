// Newton's method on one vertex of a planar map at a time, with all others fixed.
//
//   const CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   VertexDescent descent(left, mesh->positions(), options.map.energy, start);
//   descent.measure_all();
//   if (descent.has_area_margin(7)) descent.improve(7, 2);
//
// At every accepted position of a vertex its triangles are counterclockwise beyond rounding and the
// energy is lower, so that a map without inverted triangles never gets any. The triangles are those
// that a CollapsingMesh has left, measured against their shapes in space.
//
// A copy works on the same map with its own buffers: one copy a thread. Two threads may improve,
// measure or restore vertices at the same time if these are not neighbours.
//
// A vertex is restored to a map at a position where its triangles are positive.
//
//     const auto back = mesh.restore();
//     descent.measure_star(back.vertex);
//     if (put_back(mesh, positions, descent, back)) descent.improve(back.vertex, 4);
#pragma once

#include <memory>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/parametrization/initialization/collapsing_mesh.h"

namespace majorant {

class alignas(64) VertexDescent {  // copies in no common line of a cache
 public:
  // Refers to mesh, positions (#V by 3) and uv (2 numbers per vertex, in the units of positions),
  // which outlive this object. Throws InvalidArgument for energies of other than planar maps and
  // for energies with data of single faces.
  VertexDescent(const CollapsingMesh& mesh, const Points3& positions, const EnergySum& energy,
                Vec& uv);

  // Set factors of the energy, 1 by default: by face slot, or by vertex, where a face has the mean
  // of its corners.
  void weigh_faces(const Vec& weight) { map_->face_weight = weight; }
  void weigh_vertices(const Vec& weight) { map_->vertex_weight = weight; }
  double weight_of(Index face) const;

  // Take the current shapes of all faces, or of those around v, as rest shapes.
  void measure_all();
  void measure_star(Index v);

  bool has_area_margin(Index v);
  // Returns the mean of the energy over the faces around v: its integral divided by their area.
  double mean_energy(Index v);
  // Takes at most `steps` Newton steps. Returns the mean energy of the star afterwards.
  double improve(Index v, int steps);
  // Improves a boundary vertex that put_back_within() has just restored: it stays inside the edge
  // that had closed behind it, at half of its distance or more.
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

  struct Map {  // shared by all copies
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

// Restores a vertex inside the map. Its position is the mean of its neighbours by mean value
// coordinates of the star in space [Flo03]. A boundary vertex is placed by the similarity that fits
// the unfolded star best.
//
// If a triangle of the star has no margin of area there, the vertex moves towards the vertex that
// it had collapsed onto until all have one. Old triangles stay positive, and new ones are positive
// if it lies between them. Returns false if doubles have no such point.
bool put_back(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
              const CollapsingMesh::Restored& back);
// Restores a vertex so that the image of the map grows nowhere and an injective map stays
// injective: boundary vertices come back inside the edge that closed behind them, close to it. They
// must not have been ears (Ears::Stay).
bool put_back_within(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
                     const CollapsingMesh::Restored& back);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
