// Maps the layout back to the surface: finds all points of a surface that a map takes to a point of
// the plane, proven.
//
//   const InverseMap inverse(map);
//   for (const Preimage& p : inverse.preimages({0.25, 0.5}))   // of a seamless map: all of them
//     std::cout << p.face << ": " << p.barycentric.transpose() << "\n";
//   const Points2 uv = Points2::Random(1000, 2);
//   const InverseMap::Points found = inverse.locate(uv);       // one of each, on all threads
//   const InverseMap::Lists all = inverse.locate_all(uv);
//   // found.face[k] == -1: proven to lie outside of the layout
//
// If a layout does not overlap, every point inside has exactly one preimage and points outside have
// none. A point on an edge that several faces share belongs to the smallest of these faces.
//
// Straight faces are decided exactly. A curved face is cut into pieces on which a linear map A
// straightens it: |I - A J| <= c < 1/2 for all Jacobians J, bounded by control points. There xi ->
// xi + A (uv - f(xi)), followed by the projection onto the piece, contracts. Its fixed point is the
// only preimage, or proves that there is none. Rounding is bounded: points closer to an edge than
// the bound are reported as on the edge.
//
// Not for torn or inconsistent maps: use MapFile and MapProof first. Not for the nearest point of a
// layout: points outside have no preimage.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

struct PlacesOfFaces;

struct Preimage {
  Index face = -1;
  Barycentric barycentric = Barycentric::Zero();  // >= 0, sum 1 to rounding
  // True if the point may lie on an edge of the face: exactly for straight faces, to within
  // rounding for curved ones. It may then be a preimage of points just outside.
  bool on_edge = false;
  // False if det J is not proven positive around the point, so that there may be more preimages or
  // none.
  bool proven = true;
};

class InverseMap {
 public:
  // Keeps a copy of the map. O(#F log #F). Throws InvalidArgument if control points are not finite.
  explicit InverseMap(BezierMap map);

  // Returns all preimages of uv, by ascending faces. A point that faces share appears once, in the
  // smallest of them. O(log #F) and about a microsecond for each face whose control points surround
  // uv. Empty if uv is not finite.
  std::vector<Preimage> preimages(const Vector2& uv) const;

  struct Points {
    std::vector<Index> face;         // #P: -1 without a preimage
    Points3 barycentric;             // #P by 3; 0 without a preimage
    std::vector<bool> is_undecided;  // #P: not proven, or on the border to within rounding
  };
  // Returns the first preimage of every row of uv, #P by 2. Polls `stop` and throws Stopped.
  Points locate(const Points2& uv, const StopCheck& stop = {}) const;

  // All preimages of every row of uv, #P by 2, as preimages() returns them. Those of row k are from
  // begin[k] to begin[k + 1]. Polls `stop` and throws Stopped.
  struct Lists {
    std::vector<Index> begin;  // #P + 1
    std::vector<Preimage> preimages;
  };
  Lists locate_all(const Points2& uv, const StopCheck& stop = {}) const;

  const BezierMap& map() const { return map_; }

 private:
  BezierMap map_;
  std::shared_ptr<const PlacesOfFaces> places_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
