// The surface that the cells of a file make, and where the map on it is cut: decided from points
// and uv alone.
//
//   const CutMap cut(file, path);
//   cut.surface();                       // closed along cuts: one vertex per vertex of the input
//   if (cut.differs(12)) cut.fit(12);    // the two sides of an edge, up to a quarter turn
//   const BezierMap map = cut.map_cut_along(cut.cuts());
//
// Files hold points and who shares them; an edge whose two sides have other uv is a cut whatever
// the file says of it. Of a seamless map (mesh/seams.h) rotations and cones follow.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "majorant/maps/map_file.h"

namespace majorant {

class CutMap {
 public:
  // Points of equal input_vertex are one vertex; where the file does not know it, points at exactly
  // the same place. Faces are in the order of the file's cells, input_face() is a cell's number,
  // input_vertex() that of the file. `file` must outlive this; `name` is for messages.
  // Cells that are no proper surface are one all the same, open where repair() opens it
  // (mesh/repair.h): edges with more than two cells or two that disagree, vertices where sheets
  // touch, cells given twice. Throws Error(Unreadable) when copies of a vertex are at different
  // places.
  CutMap(const MapFile& file, std::string name);

  const SurfaceMesh& surface() const { return *surface_; }

  // Returns whether the two sides of a half-edge have different uv; false at the boundary of the
  // surface.
  bool differs(Index half_edge) const { return differs_[half_edge]; }
  // Returns whether they share no control points in the file (at degree 1: not both corners), be uv
  // equal or not: files mark cuts so.
  bool is_unshared(Index half_edge) const { return is_unshared_[half_edge]; }
  // 3 #F flags: half-edges that differ.
  const std::vector<char>& cuts() const { return differs_; }

  // The fit of a side by i^turns times the opposite one plus a translation: the largest difference
  // of a coordinate of a control point, both sides moved such that they begin at 0, in uv units.
  struct Fit {
    int turns = 0;
    double mismatch = 0;
  };
  Fit fit(Index half_edge) const;
  // The diagonal of the bounding box of the cells' uv; mean length in uv of the edges of the cells.
  double diagonal() const;
  double mean_length() const;

  // The ends of a half-edge as vertices of the input, and as words: "edge (12, 13)".
  std::array<Index, 2> input_edge(Index half_edge) const;
  std::string place(Index half_edge) const;

  // The map of the surface cut along these half-edges (3 #F flags, both sides), which include all
  // that differ. With several pieces it is a map of all of them.
  BezierMap map_cut_along(const std::vector<char>& is_cut) const;
  // Returns the same map with seams along all edges that differ or are unshared: turns are the ones
  // that fit best, cones have the nearest number of quarter turns to the sum of their angles.
  // Neither residual nor angles nor orientation are judged. Throws Error(Invalid) naming the edge
  // when a mismatch exceeds kSeamTolerance (seams.h) of the mean length.
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

// Returns whether the file says which vertex of the input every corner of a cell is.
bool knows_vertices(const MapFile& file);
// For files that do not know them: returns a number for every point, equal for points at exactly
// the same place; where `known` has a vertex of a polygon it is the (first) number of that vertex.
Eigen::VectorXi number_by_place(const Points3& points, const PolygonMesh& known);

// Returns whether the file holds a vertex of the input several times: whether its map is cut.
bool is_cut(const MapFile& file);
// Returns the edges of the input, by their vertices, along which a file that is to be written is
// cut, each as often as the cells have it unshared. Shared points decide, not uv: what lies apart
// by mistake is no cut. Throws as CutMap.
std::vector<std::array<Index, 2>> unshared_edges(const MapFile& file, const std::string& name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
