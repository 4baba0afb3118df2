// Bernstein polynomials on any cell that is a simplex or a product of simplices.
//
// A cell has homogeneous coordinates: the barycentric ones of a triangle or a tetrahedron, 1-s, s,
// 1-t, t of a square. A basis function is weight * product of coordinates^exponents, the weight a
// product of one multinomial coefficient per factor simplex. So the product of two functions is a
// multiple of one function, and so is the derivative by a coordinate: every table of elements/
// follows from lists of exponents.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

using Exponents = std::array<int, 6>;  // of the homogeneous coordinates; unused ones are 0
using Factors = std::vector<int>;      // corners of each factor: {3} triangle, {4}, {2, 2} square
using Degrees = std::vector<int>;      // of a polynomial space, one per factor

class BernsteinBasis {
 public:
  // Functions in the given order; several polynomial spaces may follow each other. Throws
  // InvalidArgument for more than 6 coordinates and for weights beyond 2^53, which a double
  // would round.
  BernsteinBasis(Factors factors, std::vector<Exponents> functions);

  const Factors& factors() const { return factors_; }
  int coordinate_count() const { return coordinates_; }
  int count() const { return static_cast<int>(functions_.size()); }
  const Exponents& exponents(int k) const { return functions_[k]; }
  double weight(int k) const { return weights_[k]; }
  int find(const Exponents& e) const;  // -1 when no function has these exponents
  // The function that is 1 at a corner of the cell and whose coefficient is the value there.
  bool is_corner(int k) const;

  // Values of all functions; point: barycentric coordinates of a simplex, (s, t) of a square.
  Vec values(VecIn point) const;

 private:
  Factors factors_;
  int coordinates_;
  std::vector<Exponents> functions_;
  std::vector<double> weights_;
  std::map<Exponents, int> lookup_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
