// The convex energy whose minimum is the discrete conformal metric with prescribed angle sums.
//
// Edge lengths of the metric with log factors u (one per vertex): exp((u_a + u_b) / 2) times the
// old ones. Its angles are derivatives of a convex function of u, E, with
//   dE/du_v = wanted angle sum at v - angle sum at v,
//   d2E/du2 = the cotangent Laplacian: sum of cot(angle opposite h) / 2 (x_a - x_b)^2 over the
//             half-edges h = (a, b), halved  [SSP08] Sec. 3.
// Lengths that violate the triangle inequality count as a triangle with angles 0, 0 and pi
// (opposite the longest side); E stays convex with continuous gradient [BPS15] Sec. 4.2, and is
// linear where that happens. The value of E is not needed (conformal_metric.cpp says why).
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/parametrization/surface_mesh.h"

namespace majorant {

// A triangle of which only the sides are known.
struct TriangleShape {
  std::array<double, 3> angle{};      // radians, by corner
  std::array<double, 3> cotangent{};  // of the angles; all 0 when the triangle is broken
  double log_area = 0;                // -inf when broken
  bool broken = false;                // the triangle inequality does not hold strictly
};
// log_sides[k]: logarithm of the side opposite corner k, finite. Accurate to rounding of the sides
// for needles as well, whatever their size.
TriangleShape triangle_shape(const std::array<double, 3>& log_sides);

// 3 #F logarithms of the lengths of half-edges 3 f + k; the same bits on both sides of an edge.
Vec log_edge_lengths(const SurfaceMesh& mesh);
// The same in the metric with the given log factors (#V).
Vec log_edge_lengths(const SurfaceMesh& mesh, const Vec& log_factor);
// Of face f, from the logarithms of the lengths of all half-edges.
TriangleShape face_shape(const Vec& log_lengths, Index f);

struct ConformalDerivatives {
  Vec gradient;         // #V: wanted angle sum - angle sum, radians; 0 at the boundary
  Vec hessian_weights;  // 3 #F: cotangents / 2, for EdgeLaplacian::values
};

class ConformalEnergy {
 public:
  // wanted_angles: #V, radians, read at interior vertices only. Keeps a reference to the mesh.
  ConformalEnergy(const SurfaceMesh& mesh, Vec wanted_angles);
  // log_factor: #V, finite.
  ConformalDerivatives derivatives(const Vec& log_factor) const;
  const std::vector<char>& is_interior() const { return is_interior_; }  // #V

 private:
  const SurfaceMesh& mesh_;
  Vec wanted_angles_, log_lengths_;
  std::vector<char> is_interior_;
};

}  // namespace majorant
