// The surface of a file's cells and the cuts of the map on it, decided from points and uv alone.
//
//   const CutMap cut(file, path);
//   cut.surface();                       // closed along cuts: one vertex per vertex of the input
//   if (cut.differs(12)) cut.fit(12);    // the two sides of an edge, up to a quarter turn
//   const BezierMap map = cut.map_cut_along(cut.cuts());
//
// Files hold points and say which cells share them. An edge whose sides have different uv is a cut,
// whatever the file claims. For a seamless map (mesh/seams.h), rotations and cones follow from
// that.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "majorant/maps/map_file.h"

namespace majorant {

class CutMap {
 public:
  // Points with equal input_vertex are one vertex; if the file lacks it, points at exactly the same
  // place. Faces are in the order of the file's cells; input_face() is the number of the cell,
  // input_vertex() that of the file. `file` must outlive this; `name` is for messages. Cells that
  // form no proper surface are opened where repair() opens them (mesh/repair.h). These are edges
  // with more than two cells or two that disagree, vertices where sheets touch, and cells listed
  // twice. Throws Error(Unreadable) if copies of a vertex are at different places.
  CutMap(const MapFile& file, std::string name);

  const SurfaceMesh& surface() const { return *surface_; }

  // Returns whether the two sides of a half-edge have different uv; false at the boundary of the
  // surface.
  bool differs(Index half_edge) const { return differs_[half_edge]; }
  // Returns whether the sides share no control points in the file (at degree 1: not both corners),
  // even if uv is equal. Files mark cuts in this way.
  bool is_unshared(Index half_edge) const { return is_unshared_[half_edge]; }
  // 3 #F flags: half-edges that differ.
  const std::vector<char>& cuts() const { return differs_; }

  // The fit of a side to the opposite side, turned by i^turns and translated. The residual is the
  // largest difference of a coordinate of a control point, in uv units, after both sides were moved
  // to begin at 0.
  struct Fit {
    int turns = 0;
    double mismatch = 0;
  };
  Fit fit(Index half_edge) const;
  // Return the diagonal of the bounding box of the cells' uv, and the mean length of the cells'
  // edges in uv.
  double diagonal() const;
  double mean_length() const;

  // Return the ends of a half-edge as vertices of the input, and as words: "edge (12, 13)".
  std::array<Index, 2> input_edge(Index half_edge) const;
  std::string place(Index half_edge) const;

  // Returns the map of the surface cut along these half-edges (3 #F flags, both sides), which must
  // include all that differ. The cut surface may have several pieces.
  BezierMap map_cut_along(const std::vector<char>& is_cut) const;
  // Returns the map with seams along all edges that differ or are unshared. Turns are the best fit;
  // cones have the number of quarter turns that is nearest to the sum of their angles. Residuals,
  // angles and orientation are not judged. Throws Error(Invalid) naming the edge if a mismatch
  // exceeds kSeamTolerance (seams.h) of the mean length.
  BezierMap map_with_seams() const;

 private:
  Index point(Index half_edge, std::size_t i) const;
  Index opposite_point(Index half_edge, std::size_t i) const;

  const MapFile& file_;
  std::string name_;
  std::shared_ptr<const SurfaceMesh> surface_;
  std::size_t edge_points_;  // n + 1
  std::vector<char> differs_, is_unshared_;
};

// Returns whether the file gives the vertex of the input for every corner of a cell.
bool knows_vertices(const MapFile& file);
// Returns a number for every point of a file that does not know its vertices. Points at exactly the
// same place get the same number: that of the (first) vertex in `known` at this place, if any.
Eigen::VectorXi number_by_place(const Points3& points, const PolygonMesh& known);

// Returns whether the file holds a vertex of the input several times, so that its map is cut.
bool is_cut(const MapFile& file);
// Returns the cut edges of a file that is to be written, by their vertices in the input, each as
// often as the cells have it unshared. Shared points decide, not uv, so that sides that differ by
// mistake are no cut. Throws the errors of CutMap.
std::vector<std::array<Index, 2>> unshared_edges(const MapFile& file, const std::string& name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
