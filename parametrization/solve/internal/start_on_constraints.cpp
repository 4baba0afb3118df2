#include "majorant/parametrization/solve/internal/start_on_constraints.h"

#include <fmt/format.h>

#include "majorant/constraints/constraints.h"
#include "majorant/elements/jacobian_net.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/projection.h"
#include "majorant/maps/map_problem.h"

namespace majorant {
namespace {

// The stiffness of a displacement, relative to that of a unit edge, which bounds displacements that
// no edge resists. Far below the cost of edges, far above rounding.
constexpr double kAnchor = 1e-6;
// The accuracy of a projected start, which needs few digits. It allows many steps, since there is
// no preconditioner.
constexpr ProjectionRules kRough{.enough = 1e-16, .most_steps = 2000};

// The operator d -> (L + kAnchor) d with the graph Laplacian L of the edges between neighbouring
// control points. Unknowns beyond the map's have unit weight.
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

Vec start_on_constraints(const Problem& problem,
                         const std::shared_ptr<const BezierTriangleSpace>& space,
                         const LocalInjectivity& injectivity,
                         const std::shared_ptr<const Seams>& seams, VecIn x) {
  Vec moved = problem.expand(projection(ProblemParts::elimination(problem), x, Stiffness(*space),
                                        Vec::Ones(problem.size()), kRough));
  const VecIn map = moved.head(2 * space->node_count());
  const Verdict faces = injectivity.check(map);
  if (!faces.feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("degree {}: the start, moved to where it satisfies the added "
                            "constraints, is not injective: face {} ({} in all) is not positively "
                            "oriented; give a start that satisfies them",
                            space->degree(), faces.blocking.front(), faces.blocking.size()));
  if (!AngleSums(space, AngleSums::Vertices::Interior, seams).check(map).feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("degree {}: the start, moved to where it satisfies the added "
                            "constraints, covers a place more than once; give a start that "
                            "satisfies them",
                            space->degree()));
  return moved;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
