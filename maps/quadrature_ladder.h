// The quadrature rules of the optimizer, from the usual one to those for elements where it is not
// enough.
//
// The paper's lattices let det J run to 0 at element corners unseen (method.md N12). Ours: Radon's
// rule on subtriangles, plus guard points of small total weight on the element's boundary, which
// make it a barrier. Most elements stay on level 0 for good; an element that blocks a run, or whose
// integral level 0 gets wrong, is refined.
#pragma once

#include <vector>

#include "majorant/elements/quadrature.h"

namespace majorant {

// The rules by which an optimizer integrates.
struct QuadratureRules {
  // Total weight of guard points at the corners, level 0; measured by bench/tune.py
  // quadrature.corner_guard.
  double corner_guard = 1e-3;
  // The weight of guard points at levels above 0, where they also cover the edges; measured by
  // bench/tune.py quadrature.boundary_guard.
  double boundary_guard = 3e-3;
  // Levels above 0, each halves the subtriangles; measured by bench/tune.py quadrature.refinements.
  int refinements = 4;
  // The error that is allowed, relative to the energy, over all elements of a result together;
  // measured by bench/tune.py quadrature.error.
  double error = 3e-5;
};

struct QuadratureLadder {
  std::vector<Quadrature> guarded;  // by level: what the optimizer minimizes
  std::vector<Quadrature> plain;    // by level: the same without guard points
  int top() const { return static_cast<int>(guarded.size()) - 1; }
};

// The first level has this many pieces along an edge of an element: the degree, up
// to 4 of them with 112 points; chosen, not tuned, since elements that need more are refined.
constexpr int kMostFirstPieces = 4;
constexpr int first_pieces(int degree) {
  return degree < kMostFirstPieces ? degree : kMostFirstPieces;
}

// Ladder for maps of degree n. lattice_points > 0 replaces level 0's interior rule by the lattice
// (i) of method.md E5 with the smallest m such that m(m+1)/2 >= lattice_points.
QuadratureLadder optimizer_ladder(int n, int lattice_points, const QuadratureRules& rules = {});

// Plain rules of growing accuracy for measuring: Radon on 2^2, 4^2, 8^2, ... subtriangles, graded
// towards the corners at the end. One point for n = 1, where densities are constant.
std::vector<Quadrature> measuring_rules(int n);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
