#include "majorant/parametrization/drive/internal/meet_constraints.h"

#include <utility>

#include "majorant/elements/jacobian_net.h"
#include "majorant/framework/internal/problem_parts.h"
#include "majorant/mesh/half_edge.h"

namespace majorant {
namespace {

// Of the coordinates: what constraints are satisfied to. Origin: as Elimination::project().
constexpr double kSatisfied = 1e-14;
// Of a unit edge's stiffness, that a unit displacement costs: displacements that no edge feels stay
// small. Origin: far below what edges cost, far above rounding.
constexpr double kAnchor = 1e-6;
// Of the first residual, squared, and steps at most. Origin: a start needs no more digits.
constexpr double kEnough = 1e-16;
constexpr int kMostSteps = 2000;

// d -> (L + kAnchor) d, L the graph Laplacian of the edges between neighbouring control points;
// unknowns beyond the map's have unit weight.
class Stiffness {
 public:
  explicit Stiffness(const BezierTriangleSpace& space)
      : triangles_(control_triangles(space)), map_size_(2 * space.node_count()) {}

  Vec operator*(const Vec& d) const {
    Vec out = d;
    out.head(map_size_) *= kAnchor;
    for (Index t = 0; t < triangles_.rows(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Index a = triangles_(t, k), b = triangles_(t, next(k));
        const Vector2 edge = d.segment<2>(2 * a) - d.segment<2>(2 * b);
        out.segment<2>(2 * a) += edge;
        out.segment<2>(2 * b) -= edge;
      }
    return out;
  }

 private:
  Cells triangles_;
  Index map_size_;
};

}  // namespace

// Conjugate gradients on Z^T K Z y = Z^T K (x - c).
Vec meet_constraints(const Problem& problem, const BezierTriangleSpace& space, VecIn x) {
  double residual = 0;
  Vec y = problem.reduce(x, &residual);
  Vec image = problem.expand(y);
  if (y.size() == 0 || residual <= kSatisfied * x.cwiseAbs().maxCoeff()) return image;
  const Elimination& z = ProblemParts::elimination(problem);
  const Stiffness stiffness(space);
  Vec gradient, direction, product;
  z.restrict_gradient(stiffness * (x - image), gradient);
  direction = gradient;
  double slope = gradient.squaredNorm();
  const double enough = kEnough * slope;
  for (int k = 0; k < kMostSteps && slope > enough; ++k) {
    z.expand_direction(direction, image);
    product = stiffness * image;
    const double length = slope / image.dot(product);
    y += length * direction;
    Vec change;
    z.restrict_gradient(product, change);
    gradient -= length * change;
    const double before = std::exchange(slope, gradient.squaredNorm());
    direction = gradient + (slope / before) * direction;
  }
  return problem.expand(y);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
