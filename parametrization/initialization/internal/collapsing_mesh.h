// Triangles that lose vertices one by one and get them back in reverse order.
//
//   CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   const auto end = CollapsingMesh::End::Start;
//   const Index h = left.leaving(7);
//   if (left.may_collapse(h, end, 16)) left.collapse(h, end);   // 7 is gone
//   const CollapsingMesh::Restored back = left.restore();       // and here again
//
// A collapse moves a vertex onto a neighbour: no positions change, vertices and faces keep their
// numbers, and what is gone keeps its entries, so that undoing is exact. Half-edges are those of
// surface_mesh.h. Not for closed surfaces with fewer than five vertices: nothing may collapse
// there.
//
// Decimates a surface: chooses the vertices that leave, and their order, until few faces are left.
//
//   CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   decimate(left, mesh->positions(), {400, mesh->boundary_flags()});   // the boundary stays
//
// In rounds: every vertex is given its best neighbour to collapse onto, by how far the surface
// moves and how flat the new triangles are, and of the better half of them, in the order of that
// cost, all leave that have no neighbour which left in the same round. So a round looks at every
// vertex once, on all threads, needs no queue, and depends on no order but that of the vertices.
// Not for rendering: features are not looked for.
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
  // A half-edge that leaves v; on the boundary the one that has no face on its right, so that
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

  // f(h) for every half-edge that leaves v, counterclockwise.
  template <class F>
  void for_each_leaving(Index v, const F& f) const {
    const Index first = leaving(v);
    Index h = first;
    do {
      f(h);
      h = opposite(previous(h));
    } while (h >= 0 && h != first);
  }
  // Neighbours of v, counterclockwise: from leaving(v) on; those of a boundary vertex begin and end
  // on the boundary. Replaces what `ring` holds.
  void ring(Index v, std::vector<Index>& ring) const;

  // The end of a half-edge that leaves.
  enum class End { Start, Target };
  // Returns whether the result is a surface of the same topology, with boundary loops of three
  // vertices at least (the link condition), and has at most `most` neighbours at the vertex that
  // stays. Never of an inner vertex with one of the boundary: where the image of that has more than
  // a full turn around it, there would be no way back. Not const: it works in memory of this
  // object.
  bool may_collapse(Index h, End leaves, int most);
  void collapse(Index h, End leaves);

  struct Restored {
    Index vertex, onto;  // came back; where it had gone
  };
  // Undoes the last collapse. There must be one.
  Restored restore();
  // The k-th collapse that is not undone, k < vertex_count() - vertices_left().
  Restored collapsed(Index k) const { return {gone_[k].vertex, gone_[k].onto}; }

 private:
  struct Gone {
    Index vertex, onto;
    Index away, back;  // half-edges from the one to the other and back, -1: none
    Index leaving_onto, leaving_left, leaving_right;  // before, of those whose faces are removed
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

// Of vertices with a single face: once they have left, they come back only outside of the map.
enum class Ears { Leave, Stay };

struct DecimationGoal {
  Index faces;             // as few; more where nothing can leave any more
  std::vector<char> held;  // by vertex: 1 stays; empty: none does
  Ears ears = Ears::Leave;
};

// positions: #V by 3, any units. Throws Stopped.
void decimate(CollapsingMesh& mesh, const Points3& positions, const DecimationGoal& goal,
              const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
