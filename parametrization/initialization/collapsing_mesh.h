// A triangle mesh that removes vertices one by one and restores them in reverse order.
//
//   CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   const auto end = CollapsingMesh::End::Start;
//   const Index h = left.leaving(7);
//   if (left.may_collapse(h, end, 16)) left.collapse(h, end);   // removes vertex 7
//   const CollapsingMesh::Restored back = left.restore();       // restores it
//
// A collapse moves a vertex onto a neighbour. Positions do not change, vertices and faces keep
// their numbers, and removed ones keep their entries, so that undoing is exact. Half-edges are
// those of surface_mesh.h. On closed surfaces with fewer than five vertices nothing may collapse.
//
// decimate() chooses the vertices that are removed, and their order, until few faces are left.
//
//   CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   decimate(left, mesh->positions(), {400, mesh->boundary_flags()});   // the boundary stays
//
// It works in rounds. Every vertex gets its best neighbour to collapse onto, by the distance that
// the surface moves and the flatness of the new triangles. Of the better half of all vertices, in
// the order of that cost, each one is removed unless a neighbour was removed in the same round.
//
// A round visits every vertex once, on all threads, needs no queue, and depends only on the order
// of the vertices.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

class CollapsingMesh {
 public:
  // faces: #F by 3, one fan at every vertex; opposite: 3 #F (surface_mesh.h).
  CollapsingMesh(const Cells& faces, std::vector<Index> opposite, Index vertex_count);

  Index from(Index h) const { return from_[h]; }
  Index to(Index h) const { return from_[next(h)]; }
  Index opposite(Index h) const { return opposite_[h]; }
  // Returns a half-edge that leaves v; on the boundary the one without a face on its right, so that
  // going counterclockwise from it passes all faces of v.
  Index leaving(Index v) const { return leaving_[v]; }
  bool on_boundary(Index v) const { return opposite(leaving(v)) < 0; }
  bool is_ear(Index v) const { return on_boundary(v) && opposite(previous(leaving(v))) < 0; }
  bool is_present(Index v) const { return is_present_[v] != 0; }
  bool has_face(Index f) const { return has_face_[f] != 0; }
  Index vertex_count() const { return static_cast<Index>(leaving_.size()); }
  Index face_slots() const { return static_cast<Index>(has_face_.size()); }
  Index faces_left() const { return faces_left_; }
  Index vertices_left() const { return vertex_count() - static_cast<Index>(gone_.size()); }

  // Calls f(h) for every half-edge that leaves v, counterclockwise.
  template <class F>
  void for_each_leaving(Index v, const F& f) const {
    const Index first = leaving(v);
    Index h = first;
    do {
      f(h);
      h = opposite(previous(h));
    } while (h >= 0 && h != first);
  }
  // Sets `ring` to the neighbours of v, counterclockwise from leaving(v) on; those of a boundary
  // vertex begin and end on the boundary.
  void ring(Index v, std::vector<Index>& ring) const;

  // The end of a half-edge that is removed.
  enum class End { Start, Target };
  // Returns whether the collapse leaves a surface of the same topology, with boundary loops of at
  // least three vertices (the link condition), and at most `most` neighbours at the remaining
  // vertex. False between an inner vertex and one of the boundary: if the image has more than a
  // full turn around the latter, the vertex could not be restored. The method is not const, since
  // it uses buffers of this object.
  bool may_collapse(Index h, End leaves, int most);
  void collapse(Index h, End leaves);

  struct Restored {
    Index vertex, onto;  // the restored vertex, and the one onto which it had collapsed
  };
  // Undoes the last collapse, which must exist.
  Restored restore();
  // Returns the k-th collapse that is not undone, k < vertex_count() - vertices_left().
  Restored collapsed(Index k) const { return {gone_[k].vertex, gone_[k].onto}; }

 private:
  struct Gone {
    Index vertex, onto;
    Index away, back;  // half-edges from vertex to onto and back, -1: none
    Index leaving_onto, leaving_left,
        leaving_right;  // before the collapse, of the vertices of removed faces
  };
  void rename_corners(Index v, Index name);
  void take_out(Index h);
  void put_back(Index h);
  void link(Index a, Index b);

  std::vector<Index> from_, opposite_, leaving_;
  std::vector<char> is_present_, has_face_;
  std::vector<Gone> gone_;
  Index faces_left_;
  std::vector<Index> ring_, other_ring_;  // of may_collapse()
};

// The treatment of vertices with a single face, which could be restored only outside the map.
enum class Ears { Leave, Stay };

struct DecimationGoal {
  Index faces;             // the target; more remain if nothing else may collapse
  std::vector<char> held;  // by vertex: 1 is never removed; empty: none is held
  Ears ears = Ears::Leave;
};

// Collapses vertices down to the goal. positions: #V by 3, any units. Throws Stopped.
void decimate(CollapsingMesh& mesh, const Points3& positions, const DecimationGoal& goal,
              const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
