// What distinguishes one element type of Bernstein polynomials from another: data, no algorithms.
//
// To add an element, describe it and derive its space from BernsteinSpace (bernstein_space.h), as
// the tetrahedra, squares and triangles beside it do. A space checks the description when it is
// made.
#pragma once

#include <string_view>

#include "majorant/elements/bernstein_basis.h"

namespace majorant {

// A cut of a cell: of the edge between homogeneous coordinates a and b, at its midpoint. `first` is
// the child with vertex a, `second` the one with b: which coordinate of the parent, or kMidpoint,
// is each coordinate of the child.
struct EdgeBisection {
  static constexpr int kMidpoint = -1;
  int a, b;
  std::vector<int> first, second;
};

struct BernsteinElement {
  std::string_view name;  // of its space, for messages
  int degree;             // of the map
  int max_degree;
  Factors factors;  // 2 or 3 dimensions together
  // Exponents of a polynomial space in the element's node order (VTK's), corners first; each once,
  // also for degrees that are 0 or differ between the factors.
  std::vector<Exponents> (*lattice)(const Degrees& degrees);
  // Derivative by reference coordinate d: by homogeneous coordinate [0] minus by coordinate [1].
  std::vector<std::array<int, 2>> derivatives;
  std::vector<EdgeBisection> bisections;  // one after the other, cyclically

  int dim() const { return static_cast<int>(derivatives.size()); }
  int corner_count() const;
  int coordinate_count() const;  // homogeneous ones
  double measure() const;        // of the reference cell

  Degrees degrees() const { return Degrees(factors.size(), degree); }
  // lattice(of), which must name every function of the space once. Throws InvalidArgument.
  std::vector<Exponents> functions(const Degrees& of) const;
  BernsteinBasis basis(const Degrees& of) const { return {factors, functions(of)}; }
  // Factor that a homogeneous coordinate belongs to.
  int factor_of(int coordinate) const;
  // Degrees of the map's derivative by a coordinate of this factor.
  Degrees lowered(int factor) const;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
