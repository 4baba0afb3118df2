// Meshes of curved or straight tetrahedra, hexahedra, wedges, triangles and quads, as files of
// finite element programs have them, with the cells of their boundaries.
//
//   const VolumeMesh mesh = read_volume_mesh("part.msh");      // io/volume_files.h
//   for (const CellBlock& block : mesh.blocks) block.nodes;     // rows of mesh.points
//
// What the nodes of a cell are is said by its type: points that the map takes on a lattice, as in
// most formats, or its control points. Cells of points and edges are kept, and nothing is asked of
// them.
//
// Not for surfaces that are mapped (mesh/surface_mesh.h), nor for cells known to be valid: nothing
// is checked here (check_volume_mesh.h).
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

// The meaning of the nodes of a cell: values of its map on the lattice of its degree, on that of
// the Gauss-Lobatto points (MFEM's), or control points of Bernstein polynomials.
enum class NodeKind { Uniform, GaussLobatto, ControlPoints };

// Serendipity: quads, hexahedra and wedges of degree 2 with nodes at corners and edges alone; the
// map is the one of full degree whose other nodes follow from these.
enum class NodeSet { Full, Serendipity };

struct CellType {
  // Beyond are no tables.
  static constexpr int kMaxDegree = 4;

  CellShape shape = CellShape::Point;
  int degree = 1;
  NodeKind kind = NodeKind::Uniform;
  NodeSet set = NodeSet::Full;

  int node_count() const;
  auto operator<=>(const CellType&) const = default;
};

// "tetrahedra of degree 2".
std::string describe(const CellType& type);

// Cells of one type, in the order of the file.
struct CellBlock {
  CellType type;
  Cells nodes;                        // #C by nodes, in VTK's order: rows of the points
  Cells vertices;                     // #C by corners: what cells share; empty: their first nodes
  std::vector<std::int64_t> numbers;  // #C: the file's, or as its programs count
  std::vector<int> regions;           // #C: entity tag, attribute or reference of the file

  Index size() const { return static_cast<Index>(nodes.rows()); }
  Index vertex(Index cell, int corner) const {
    return vertices.rows() > 0 ? vertices(cell, corner) : nodes(cell, corner);
  }
};

class MeshSource;  // the bytes of the file and where its coordinates stand

struct VolumeMesh {
  std::string file;
  Points3 points;  // #P by 3; 0 where the file has fewer coordinates
  std::vector<CellBlock> blocks;
  std::shared_ptr<const MeshSource> source;

  // The largest dimension of a cell. Cells of it are the mesh; the others are their boundary.
  int dimension() const;
  // True where all points have one z: triangles and quads are cells of the plane then.
  bool is_planar() const;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
