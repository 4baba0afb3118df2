// Bernstein-Bezier algebra on the triangle.
//
// A polynomial of degree n is sum_{i+j+k=n} c_ijk B_ijk(xi), B_ijk = n!/(i!j!k!) xi0^i xi1^j xi2^k.
// Coefficients are stored in VTK order: corners (n,0,0) (0,n,0) (0,0,n), the inner points of edges
// 01, 12, 20 in edge direction, then the inner points as a triangle of degree n-3, recursively.
// Derivatives are by xi0 and xi1 with xi2 = 1 - xi0 - xi1. [MC20] Sec. 3.1, [Far02].
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

using MultiIndex = std::array<int, 3>;

// Returns the number of control points of degree n, (n+1)(n+2)/2.
constexpr int control_point_count(int n) { return (n + 1) * (n + 2) / 2; }
// Returns the inverse of control_point_count; -1 if `count` is not triangular.
int degree_from_control_points(int count);

// Returns x^e by e multiplications; 1 if e is not positive.
inline double integer_power(double x, int e) {
  double power = 1;
  for (; e > 0; --e) power *= x;
  return power;
}

// The numbering of one degree; tables are built once per degree and shared.
class TriangleIndices {
 public:
  static constexpr int kMaxDegree = 20;
  static const TriangleIndices& of_degree(int n);  // 0..kMaxDegree, throws std::out_of_range

  int degree() const { return degree_; }
  int count() const { return static_cast<int>(multi_.size()); }
  const MultiIndex& multi(int local) const { return multi_[local]; }
  int local(int i, int j, int k) const {  // i + j + k = degree
    static_cast<void>(k);
    return lookup_[i * (degree_ + 1) + j];
  }
  // Returns local numbers along edge 0 (corner 0 -> 1), 1 (1 -> 2) or 2 (2 -> 0), ends included.
  const std::vector<int>& edge(int e) const { return edges_[e]; }
  // Returns the points next to a corner on its two edges, counterclockwise: the directions of a
  // map's tangents there.
  std::array<int, 2> beside_corner(int corner) const {
    return {edge(corner)[1], edge((corner + 2) % 3)[degree_ - 1]};
  }
  // Returns n! / (i! j! k!).
  double multinomial(int local) const { return multinomial_[local]; }

 private:
  explicit TriangleIndices(int n);
  int degree_;
  std::vector<MultiIndex> multi_;
  std::vector<int> lookup_;
  std::array<std::vector<int>, 3> edges_;
  std::vector<double> multinomial_;
};

// Returns the values of all basis functions, size control_point_count(n).
Vec bernstein_values(int n, const Barycentric& xi);
// Returns derivatives by xi0 (column 0) and xi1 (column 1): control_point_count(n) by 2.
Eigen::MatrixX2d bernstein_gradients(int n, const Barycentric& xi);

// Returns the matrix E with coefficients of degree n+1 = E * coefficients of degree n.
Eigen::MatrixXd elevation_matrix(int n);

// Returns the coefficients of the product of two polynomials of degrees m and n, degree m + n.
Vec multiply(int m, VecIn a, int n, VecIn b);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
