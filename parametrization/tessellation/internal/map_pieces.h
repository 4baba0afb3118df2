// The cells of a map cut into straight-sided pieces, for formats without curves.
//
//   MapPieces pieces(file, corner_mesh(file, ""), 1);   // every cell is one piece
//   pieces.split({12, 0, 1});   // edge 01 of cell 12 at the middle, on both sides
//
// Points of pieces lie on the flat triangle in space and on the map in the plane. They are numbered
// twice, like the corners of an OBJ: `v` in space, `vt` in the plane. An edge is split on all its
// sides at once. Sides with the same two v share the new v, and sides that share their control
// points share the new vt. So pieces fit together without T-junctions: in space everywhere, also
// along cuts and slits, and in the plane where the map is continuous.
#pragma once

#include <array>
#include <vector>

#include "majorant/maps/corner_mesh.h"
#include "majorant/maps/map_file.h"
#include "majorant/parametrization/tessellation/internal/map_edges.h"

namespace majorant {

class MapPieces {
 public:
  struct Point {
    Index v, vt;
    Index node;  // on the surface: the same on all sides of an edge, where v may differ
    Vector3 xi;  // barycentric coordinates in the cell; exact zeros on the cell's edges
  };
  struct Piece {
    std::array<int, 3> corners;  // points of its cell, counterclockwise in the cell
    int depth = 0;               // number of halvings
  };
  // An edge of a piece of `cell`, between points i and j of that cell.
  struct Edge {
    Index cell;
    int i, j;
  };

  // coarse: corner_mesh of `map`; its triangles are called cells here and keep their order. Its
  // vertices may be those of an input that has a vertex of the map several times. Starts with
  // refine x refine pieces a cell, from a regular lattice whose points are evaluated at multiples
  // of 1 / refine. The map must outlive this object. Throws Error(Usage) if refine < 1 or the
  // result needs more than 2^31 points.
  MapPieces(const MapFile& map, CornerMesh coarse, int refine);

  Index cell_count() const { return static_cast<Index>(cells_.size()); }
  Index map_cell(Index cell) const;  // its number in the map
  const std::vector<Point>& points(Index cell) const { return of(cell).points; }
  const std::vector<Piece>& pieces(Index cell) const { return of(cell).pieces; }
  // Positions by v, texture coordinates by vt. The first ones are those of the coarse mesh.
  const std::vector<Vector3>& positions() const { return positions_; }
  const std::vector<Vector2>& texcoords() const { return texcoords_; }
  const Vector2& uv(Index cell, int point) const;
  const Vector3& position(Index cell, int point) const;

  // Returns the cell's edge (0: corners 0 to 1, 1, 2) on which a piece's edge lies, -1: inside.
  int cell_edge(const Edge& edge) const;
  // Returns the edge as seen from every cell that has it, `edge` itself first. Ends correspond.
  std::vector<Edge> sides(const Edge& edge) const;
  // Returns the number of cells that are joined in the plane along that edge, with the cell itself.
  int plane_sides(Index cell, int cell_edge) const;
  // Returns a number for that edge in the plane, the same for all cells that are joined there.
  Index plane_edge(Index cell, int cell_edge) const;
  // Returns the uv of each side's midpoint, where split() puts the new point.
  std::vector<Vector2> middles(const std::vector<Edge>& sides) const;

  // Halves the pieces on all sides of the edge.
  void split(const Edge& edge);
  // Replaces the common edge of two pieces of a cell by the other diagonal. pieces: their numbers.
  // corners: those of the pieces afterwards.
  void flip(Index cell, std::array<int, 2> pieces,
            const std::array<std::array<int, 3>, 2>& corners);

 private:
  struct Cell {
    std::vector<Point> points;  // corners first
    std::vector<Piece> pieces;
  };

  const Cell& of(Index cell) const { return cells_[cell]; }
  void fill_lattice(int refine);
  Edge seen_from(const MapEdges::Side& other, const Edge& edge) const;
  Vector2 evaluate(Index cell, const Vector3& xi) const;
  Vector3 flat_point(Index cell, const Vector3& xi) const;

  const MapFile& map_;
  CornerMesh coarse_;
  MapEdges edges_;  // of the cells
  Index next_node_;
  std::vector<Cell> cells_;
  std::vector<Vector3> positions_;
  std::vector<Vector2> texcoords_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
