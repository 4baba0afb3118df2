#include "majorant/parametrization/initialization/internal/field_integration.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>

#include "majorant/constraints/cut_surface.h"
#include "majorant/constraints/seamless_constraint.h"
#include "majorant/framework/error.h"
#include "majorant/framework/newton.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/maps/map_problem.h"

namespace majorant {
namespace {

// area / scale^2 * (|grad u - X|^2 + |grad v - Y|^2) of every face, X and Y of length scale.
class FieldTerm final : public EnergyTerm {
 public:
  FieldTerm(const SurfaceMesh& surface, const CrossField& field, const Vec& scale)
      : element_dofs_{surface.faces(), 2},
        gradients_(surface.face_count(), 6),
        targets_(surface.face_count(), 4),
        weight_(surface.face_count()) {
    for (Index f = 0; f < surface.face_count(); ++f)
      tabulate(surface, field, scale.size() > 0 ? scale[f] : 1.0, f);
  }

  std::string_view name() const override { return "field"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      f[p] = weight_[e] * difference(x, e).squaredNorm();
    }
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const Eigen::Matrix2d d = difference(x, e);
      for (int i = 0, k = 0; i < 6; ++i) {
        out.gradient[i * LocalSystem::stride + static_cast<int>(p)] =
            2 * weight_[e] * gradient(e, i / 2).dot(d.row(i % 2));
        if (!out.hessian) continue;
        for (int j = 0; j <= i; ++j, ++k)
          out.hessian[k * LocalSystem::stride + static_cast<int>(p)] =
              i % 2 == j % 2 ? 2 * weight_[e] * gradient(e, i / 2).dot(gradient(e, j / 2)) : 0.0;
      }
    }
  }

 private:
  // In the face's frame: first axis along the edge corner 0 -> corner 1, as CrossField has it.
  void tabulate(const SurfaceMesh& surface, const CrossField& field, double scale, Index f) {
    const auto p = [&](int k) { return Vector3(surface.positions().row(surface.faces()(f, k))); };
    const Vector3 a = p(1) - p(0), b = p(2) - p(0);
    const double length = a.norm();
    const Vector2 q1(length, 0), q2(a.dot(b) / length, length_of(a.cross(b)) / length);
    const double twice_area = q1.x() * q2.y();
    const std::array<Vector2, 3> corner{Vector2(0, 0), q1, q2};
    for (int k = 0; k < 3; ++k) {
      const Vector2 e = corner[previous(k)] - corner[next(k)];  // opposite edge
      gradients_.row(f).segment<2>(2 * k) << -e.y() / twice_area, e.x() / twice_area;
    }
    const Vector2 x = scale * Vector2(std::cos(field.angle[f]), std::sin(field.angle[f]));
    targets_.row(f) << x.x(), x.y(), -x.y(), x.x();
    weight_[f] = 0.5 * twice_area / (scale * scale);
  }
  Eigen::RowVector2d gradient(Index e, int corner) const {
    return gradients_.row(e).segment<2>(2 * corner);
  }
  // Rows: grad u - X, grad v - Y.
  Eigen::Matrix2d difference(VecIn x, Index e) const {
    Eigen::Matrix2d d;
    d << -targets_(e, 0), -targets_(e, 1), -targets_(e, 2), -targets_(e, 3);
    for (int k = 0; k < 3; ++k) d += x.segment<2>(2 * element_dofs_.nodes(e, k)) * gradient(e, k);
    return d;
  }

  ElementDofs element_dofs_;
  RowMatrix gradients_;  // #F by 6: of the three hat functions
  RowMatrix targets_;    // #F by 4: X, Y
  Vec weight_;
};

}  // namespace

BezierMap integrate_field(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                          const CrossField& field, const Vec& scale) {
  const CutSurface cut = cut_open(mesh, is_cut, field.turns, field.quarter_turns);
  BezierMap map = BezierMap::linear(cut.mesh, Vec::Zero(2 * cut.mesh->vertex_count()), cut.seams);
  MapSpecification spec;
  spec.seams = cut.seams;
  ProblemBuilder builder(map.control_points().size());
  builder.add(std::make_shared<const FieldTerm>(*cut.mesh, field, scale), 1.0 / mesh.area());
  builder.add(SeamlessConstraint(map.shared_space(), cut.seams));
  builder.add(FixedPoints::at(gauge_vertices(spec, map.space()), map.control_points()));
  const Problem problem = builder.build();
  // Quadratic: one Newton step, and a second one against rounding.
  NewtonOptions options;
  options.curvature = Curvature::Exact;
  NewtonStepper stepper(problem, options);
  const SolveResult solved = stepper.minimize(Vec::Zero(problem.size()), brief_rules(2, 0));
  if (solved.status == Status::Failed || solved.status == Status::Infeasible)
    throw Error(
        ErrorKind::Infeasible,
        message_prefix(mesh) + "the field's linear system is singular; check the mesh for defects");
  return map.with(map.shared_space(), problem.expand(solved.y));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
