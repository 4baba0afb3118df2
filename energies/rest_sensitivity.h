// Derivatives of a solution by the rest positions of a mesh of degree 1, against which its
// densities measure maps.
//
//   const SolveResult result = NewtonMinimizer().minimize(problem, y0, nullptr);
//   const Sensitivity s(problem, result);
//   const RowMatrix positions = mesh->positions();          // #V by d
//   const RestSensitivity by(problem, s, {problem.terms().front()}, positions, mesh->faces());
//   const Vec dx = by.forward(positions);                   // change of x* where the mesh grows
//   const RowMatrix slopes = by.adjoint(s.adjoint(dx));     // dL/d(positions) of an L
//
// The rest shapes are flat_simplices(positions, cells) (elements/rest_shapes.h), possibly turned():
// then first axes stay fixed in the frames of the elements. The derivatives are exact, without
// differences: a change of a rest shape is a change of its reference coordinates.
//
// Curved rest shapes and elements of higher degree are refused by name.
#pragma once

#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/sensitivity.h"

namespace majorant {

class RestSensitivity {
 public:
  // A matrix of at most 3 by 3 numbers, without heap memory.
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;

  // problem, sensitivity: of the same problem; the latter outlives this object. terms: all terms
  // that are measured against these positions. Throws InvalidArgument for a term that the problem
  // does not have or that is no density, for positions or cells that do not match its elements, and
  // for rest shapes of another size. Throws Error(Unsupported) for elements of a degree above 1,
  // and for quads, hexahedra and other elements that are no simplices.
  RestSensitivity(const Problem& problem, const Sensitivity& sensitivity, std::vector<TermId> terms,
                  RowMatrix positions, Cells cells);

  // Returns the change of the energy's gradient, in full unknowns, along a change of the positions
  // (#V by d). It is a Sensitivity::Change::gradient, which may be combined with other changes.
  // Throws InvalidArgument for another number of positions and for positions that are not finite.
  Vec gradient(const RowMatrix& change) const;
  Vec forward(const RowMatrix& change) const;
  // Returns dL/d(positions), #V by d, from the result of Sensitivity::adjoint().
  RowMatrix adjoint(const Sensitivity::Derivative& derivative) const;

 private:
  struct Term {
    TermId id;
    Vec weights;            // #E
    RowMatrix by_tangents;  // #E by local_size() D d: of the local gradient
    ElementDofs dofs;
    Index unknown(Index e, Index k) const {
      return dofs.block * dofs.nodes(e, k / dofs.block) + k % dofs.block;
    }
  };
  Small tangents(Index element, const RowMatrix& points) const;
  Term differentiated(const Problem& problem, TermId id) const;

  const Sensitivity& sensitivity_;
  RowMatrix positions_;
  Cells cells_;
  Index dim_;
  std::vector<Term> terms_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
