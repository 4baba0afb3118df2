// The equations of flattening_strain.h on one surface, for comparing many cuts of it.
//
//   FlatteningSystem system(*mesh);
//   const double strain = FlatteningStrain(system, is_cut).strain();
//
// The unknowns are those of the surface without cuts: its inner vertices and its boundary loops. A
// cut holds chi at 0 along it: the rows and columns of held unknowns become those of the identity,
// and the other rows are those of the cut surface. So all cuts have one pattern, which is ordered
// and analysed once; the extra zeros in the factor cost less than that.
//
// On a planar surface the longest loop is no unknown, since it is part of the outer loop of every
// cut.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

class FlatteningSystem {
 public:
  // mesh: connected; outlives this object. outer: a half-edge that leaves a boundary loop, which is
  // no unknown; -1: the longest loop of a planar surface.
  explicit FlatteningSystem(const SurfaceMesh& mesh, Index outer = -1);

  const SurfaceMesh& mesh() const { return mesh_; }

  // The boundary loops of the cut surface.
  struct Boundary {
    std::vector<std::vector<Index>> loops;  // half-edges that are cut or have no opposite
    std::vector<char> is_held;              // #V: on the outer loop
    std::size_t outer = 0;                  // number of the outer loop
  };
  // Returns the boundary of the cut surface. is_cut: 3 #F flags, both sides of an edge or none.
  // outer: a half-edge that leaves the outer loop, -1: the longest one. None if a loop other than
  // the outer one is no unknown of this system.
  std::optional<Boundary> boundary(const std::vector<char>& is_cut, Index outer) const;

  // A pattern and the solver that has analysed it.
  struct Factor {
    SparsePattern pattern;
    std::unique_ptr<DirectSolver> solver;
  };
  // Factorizes L^T M^-1 L of the surface with that boundary, for solves until the next call. Null
  // if the mesh makes the system singular. Stopped.
  std::shared_ptr<Factor> factorized(const Boundary& boundary, const StopCheck& stop);

  // Returns the unknown at a vertex that is not held; -1 on the loop without an unknown.
  Index unknown(Index vertex) const { return unknown_[vertex]; }
  Index unknowns() const { return static_cast<Index>(load_.size()); }
  const Vec& load() const { return load_; }  // by unknown, of the surface without cuts

 private:
  struct Entry {
    Index number;
    double value;
  };
  // Rows or columns of a sparse matrix, one after the other.
  struct Lists {
    std::vector<std::size_t> begin, end;
    std::vector<Entry> entries;
  };
  // The cotangent Laplacian, with a row for each vertex of the cut surface.
  struct Laplacian {
    Lists rows;
    Vec area;  // by row, relative to the whole surface
  };

  void measure();
  void number_unknowns(Index outer);
  void analyze();
  Laplacian laplacian(const Boundary& boundary) const;
  Lists columns_of(const Lists& rows) const;

  const SurfaceMesh& mesh_;
  Vec sine_;                    // #F: twice the area
  Vec cotangent_;               // 3 #F: of the angle opposite the half-edge
  Vec defect_;                  // #V: angle defects, 0 on a straight boundary
  std::vector<Index> unknown_;  // #V
  Vec load_;
  std::shared_ptr<Factor> factor_;  // null before the first use
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
