// The quadrature rules of the optimizer, from the usual one to those for elements on which it is
// not accurate enough.
//
// With the lattices of [MC20], det J may approach 0 at element corners without any effect on the
// energy (method.md N12). Here Radon's rule on subtriangles is combined with guard points of small
// total weight on the element's boundary, which make the energy a barrier there. Most elements stay
// on level 0; an element that blocks a run, or whose integral on level 0 is inaccurate, is refined.
#pragma once

#include <vector>

#include "majorant/elements/quadrature.h"

namespace majorant {

// The rules by which an optimizer integrates.
struct QuadratureRules {
  // Total weight of guard points at the corners, level 0. Tuned by bench/tune.py
  // quadrature.corner_guard.
  double corner_guard = 1e-3;
  // The weight of guard points at levels above 0, where they also cover the edges. Tuned by
  // bench/tune.py quadrature.boundary_guard.
  double boundary_guard = 3e-3;
  // Levels above 0, each of which halves the subtriangles. Tuned by bench/tune.py
  // quadrature.refinements.
  int refinements = 4;
  // The error bound over all elements of a result together, relative to the energy. Tuned by
  // bench/tune.py quadrature.error.
  double error = 3e-5;
};

// Rules of increasing accuracy: level 0 is the coarsest.
struct QuadratureHierarchy {
  std::vector<Quadrature> guarded;  // by level: the rules of the optimizer
  std::vector<Quadrature> plain;    // by level: the same without guard points
  int top() const { return static_cast<int>(guarded.size()) - 1; }
};

// Upper bound on the pieces along an edge of an element on the first level, which otherwise are as
// many as the degree: 4 of them have 112 points. Chosen, not tuned, since elements that need more
// are refined.
constexpr int kMostFirstPieces = 4;
constexpr int first_pieces(int degree) {
  return degree < kMostFirstPieces ? degree : kMostFirstPieces;
}

// Returns the hierarchy for maps of degree n. lattice_points > 0 replaces level 0's interior rule
// by the lattice (i) of method.md E5 with the smallest m such that m(m+1)/2 >= lattice_points.
QuadratureHierarchy optimizer_quadrature(int n, int lattice_points,
                                         const QuadratureRules& rules = {});

// Returns plain rules of increasing accuracy for measuring: Radon on 2^2, 4^2, 8^2, ...
// subtriangles, the last one graded towards the corners. One point for n = 1, where densities are
// constant.
std::vector<Quadrature> measuring_rules(int n);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
