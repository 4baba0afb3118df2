// Meshes of curved or straight tetrahedra, hexahedra, wedges, triangles and quads, as in files of
// finite element programs, with the cells of their boundaries.
//
//   const VolumeMesh mesh = read_volume_mesh("part.msh");      // io/volume_files.h
//   for (const CellBlock& block : mesh.blocks) block.nodes;     // rows of mesh.points
//
// The type of a cell gives the meaning of its nodes: values of the map on a lattice, as in most
// formats, or control points. Cells of points and edges are kept without any check.
//
// Not for surfaces to be mapped (mesh/surface_mesh.h). Nothing is checked here: check_volume_mesh.h
// does that.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

enum class CellShape { Point, Segment, Triangle, Quad, Tetrahedron, Wedge, Hexahedron };

int dimension(CellShape shape);
int corner_count(CellShape shape);
std::string_view plural_of(CellShape shape);  // "tetrahedra"

// The meaning of the nodes of a cell: values of its map on the lattice of its degree, values at the
// Gauss-Lobatto points (MFEM's), or control points of Bernstein polynomials.
enum class NodeKind { Uniform, GaussLobatto, ControlPoints };

// Serendipity: quads, hexahedra and wedges of degree 2 with nodes at corners and edges alone; the
// map is the one of full degree whose other nodes follow from these.
enum class NodeSet { Full, Serendipity };

struct CellType {
  // The highest degree with tables.
  static constexpr int kMaxDegree = 4;

  CellShape shape = CellShape::Point;
  int degree = 1;
  NodeKind kind = NodeKind::Uniform;
  NodeSet set = NodeSet::Full;

  int node_count() const;
  auto operator<=>(const CellType&) const = default;
};

// Returns "tetrahedra of degree 2".
std::string describe(const CellType& type);

// Cells of one type, in the order of the file.
struct CellBlock {
  CellType type;
  Cells nodes;                        // #C by nodes, in VTK's order: rows of the points
  Cells vertices;                     // #C by corners, shared by cells; empty: the first nodes
  std::vector<std::int64_t> numbers;  // #C: from the file, or counted as its programs do
  std::vector<int> regions;           // #C: entity tag, attribute or reference of the file

  Index size() const { return static_cast<Index>(nodes.rows()); }
  Index vertex(Index cell, int corner) const {
    return vertices.rows() > 0 ? vertices(cell, corner) : nodes(cell, corner);
  }
};

class MeshSource;  // the bytes of the file and the places of its coordinates

struct VolumeMesh {
  std::string file;
  Points3 points;  // #P by 3; 0 where the file has fewer coordinates
  std::vector<CellBlock> blocks;
  std::shared_ptr<const MeshSource> source;

  // Returns the largest dimension of a cell. Cells of that dimension are the mesh; others its
  // boundary.
  int dimension() const;
  // Returns true if all points have one z: triangles and quads are then cells of the plane.
  bool is_planar() const;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
