#include "majorant/parametrization/drive/internal/meet_constraints.h"

#include "majorant/elements/jacobian_net.h"
#include "majorant/framework/internal/problem_parts.h"
#include "majorant/framework/internal/projection.h"
#include "majorant/mesh/half_edge.h"

namespace majorant {
namespace {

// Of a unit edge's stiffness, that a unit displacement costs: displacements that no edge feels stay
// small. Origin: far below what edges cost, far above rounding.
constexpr double kAnchor = 1e-6;
// How near a start comes. Origin: it needs no more digits, and takes more steps, since nothing
// preconditions it.
constexpr ProjectionRules kRough{.enough = 1e-16, .most_steps = 2000};

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

Vec meet_constraints(const Problem& problem, const BezierTriangleSpace& space, VecIn x) {
  return problem.expand(projection(ProblemParts::elimination(problem), x, Stiffness(space),
                                   Vec::Ones(problem.size()), kRough));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
