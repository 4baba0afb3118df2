// Element spaces, which compute the tables that energies contract from geometry, and prove det J >
// 0.
//
//   const ContractionTable table = space->tabulate(space->default_rule(RestJacobian::Constant));
//   const PositivityProof proof = space->certify(0, x, ProofDepth::kFinal);
//
// A space numbers the nodes of its cells, tabulates the data that the contraction of energies/
// needs on a quadrature rule, and proves that det J is positive, at a map and along a line of maps.
// Layers above do not use basis functions.
//
// Elements of Bernstein polynomials are described (bernstein_space.h, docs/elements.md), and their
// space follows. Only other bases derive from ElementSpace.
#pragma once

#include <memory>
#include <vector>

#include "majorant/elements/detail/contraction_entries.h"
#include "majorant/elements/quadrature.h"
#include "majorant/framework/types.h"

namespace majorant {

// The contraction's view of an element type on one quadrature rule (method.md section 4).
//
// Derivatives are taken in directions gamma_a of the reference element (for Bezier triangles the
// three barycentric ones, which makes every recombination a single term). With basis functions B_i:
//     d_a B_i       = sum_k  G[i,a,k]    shape_gradient_k     (`gradient` list)
//     d_a B_i d_b B_j = sum_m H[i,a,j,b,m] gradient_product_m     (`hessian` list)
// so the sums over quadrature points are moments, and basis pairs appear only afterwards.
struct ContractionTable {
  int nodes = 0;               // per element
  RowMatrix directions;        // a row each, by reference coordinate: gamma_a
  Vec weights;                 // L
  RowMatrix shape_gradient;    // L by N1
  RowMatrix gradient_product;  // L by Nm
  std::vector<GradientEntry> gradient;
  // Entries of node pair (i, j), j <= i, are [pair_starts[p], pair_starts[p+1]), p = i(i+1)/2 + j.
  std::vector<HessianEntry> hessian;
  std::vector<int> pair_starts;
};

// The outcome of a proof. Proven: there is a proof. Violated: there is a counterexample; in the
// floating-point proofs of elements, det J is at least not provably positive at a corner.
// Undecided: no proof was found. NotRequested: no proof was tried.
enum class ProofStatus { Proven, Violated, Undecided, NotRequested };

// The outcome of the proof that det J > 0 on an element.
struct PositivityProof {
  ProofStatus result = ProofStatus::Undecided;
  double lower_bound = 0;  // of the minimum on the element; certified whatever the result
  int depth = 0;           // of bisection that was needed
};

// The number of bisections after which a proof of det J > 0 on an element is given up.
//
// There are three values: frequent checks are quick, and final certificates are as strong as
// possible. A deeper proof never contradicts a shallower one.
struct ProofDepth {
  // The depth while optimizing. Tuned by bench/tune.py depth.
  static constexpr int kStart = 5;
  // The depth of a run that stalls at kStart. Tuned by bench/tune.py deepest_bisection.
  static constexpr int kDeepest = 13;
  // The depth of the final proof of a result: a little deeper than that of any run, so that a
  // proven map passes again after scaling and rounding.
  static constexpr int kFinal = 16;
};

// Constant: the inverse Jacobian M of the rest shape (rest_shapes.h) is constant on every element.
enum class RestJacobian { Constant, Varying };

class ElementSpace {
 public:
  virtual ~ElementSpace() = default;
  virtual int reference_dim() const = 0;         // D: 2 for triangles and quads, 3 for tetrahedra
  virtual double reference_measure() const = 0;  // of the reference element: 1/2, 1, 1/6
  // Global node numbers, #E by nodes per element; one point each.
  virtual const Cells& cells() const = 0;
  virtual Index node_count() const = 0;
  Index element_count() const { return static_cast<Index>(cells().rows()); }
  int nodes_per_element() const { return static_cast<int>(cells().cols()); }

  // Throws InvalidArgument for the rule of another cell (require_cell() says why).
  virtual ContractionTable tabulate(const Quadrature& rule) const = 0;
  // Returns the rule of terms without a rule of their own. Throws InvalidArgument if a space has
  // none, as here.
  virtual Quadrature default_rule(RestJacobian rest) const;

  // Proves that det J > 0 on element e of the map x (D numbers per node), by bisection of its
  // Bernstein coefficients down to max_depth, rounding errors included. The determinant is by
  // reference coordinates; dividing by that of the rest shape gives that of the map.
  virtual PositivityProof certify(Index e, VecIn x, int max_depth) const = 0;
  // Returns the largest s' <= s such that det J of x + t d is positive on element e for all 0 <= t
  // < s'. It is computed in floating point without the error bounds of certify(), so the end point
  // must be certified.
  virtual double largest_step(Index e, VecIn x, VecIn d, double s, int max_depth) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
