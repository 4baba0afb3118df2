// The equations of flattening_strain.h on one surface, for all the cuts that are compared on it.
//
//   FlatteningSystem system(*mesh);
//   const double strain = FlatteningStrain(system, is_cut).strain();
//
// The unknowns are those of the surface without cuts: its vertices inside, and its boundary loops.
// A cut holds chi at 0 along it: the rows and columns of held unknowns become those of the
// identity, and the rest is as if the surface were cut open. So all cuts have one pattern, which is
// ordered and analysed once; the zeros that the factor keeps cost less than that.
//
// Of a planar surface the longest loop is no unknown, as it is part of the outer loop of its cuts.
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
  // mesh: connected; outlives this. outer: a half-edge that leaves a boundary loop, which is no
  // unknown; -1: the longest loop of a planar surface.
  explicit FlatteningSystem(const SurfaceMesh& mesh, Index outer = -1);

  const SurfaceMesh& mesh() const { return mesh_; }

  // The loops of the surface cut open.
  struct Boundary {
    std::vector<std::vector<Index>> loops;  // half-edges that are cut or have no opposite
    std::vector<char> is_held;              // #V: on the outer loop
    std::size_t outer = 0;                  // number of the outer loop
  };
  // is_cut: 3 #F flags, both sides of an edge or none. outer: a half-edge that leaves the outer
  // loop, -1: the longest one. None where a loop that is not the outer one is no unknown here.
  std::optional<Boundary> boundary(const std::vector<char>& is_cut, Index outer) const;

  // A pattern, and the solver that has analysed it.
  struct Factor {
    SparsePattern pattern;
    std::unique_ptr<DirectSolver> solver;
  };
  // Factorizes L^T M^-1 L of the surface with that boundary, for solves until the next call; null
  // where the mesh spoils the system. Stopped.
  std::shared_ptr<Factor> factorized(const Boundary& boundary, const StopCheck& stop);

  // The unknown at a vertex that is not held; -1 on the loop that is none.
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
  // The cotangent Laplacian: a row for each vertex of the surface cut open.
  struct Laplacian {
    Lists rows;
    Vec area;  // of rows, those of the whole surface are 1
  };

  void measure();
  void number_unknowns(Index outer);
  void analyze();
  Laplacian laplacian(const Boundary& boundary) const;
  Lists columns_of(const Lists& rows) const;

  const SurfaceMesh& mesh_;
  Vec sine_;                    // #F: twice the area
  Vec cotangent_;               // 3 #F: of the angle opposite the half-edge
  Vec defect_;                  // #V: angle defects, of a straight boundary 0
  std::vector<Index> unknown_;  // #V
  Vec load_;
  std::shared_ptr<Factor> factor_;  // null before the first use
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
