#include "ring.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "cases.h"
#include "majorant/constraints/constraints.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/materials/stable_neo_hookean.h"
#include "majorant/framework/newton.h"

namespace majorant::elasticity {
namespace {

constexpr double kInner = 1, kOuter = 2, kPush = 1.3;  // radii; the inner circle is pushed to kPush
constexpr double kNear = 1e-9;
constexpr double kThickness = 0.25;  // of rings in space, which are one element thick

// ------------------------------------------------------------------ the incompressible ring
// A point at R moves to r, r^2 = R^2 + kPush^2 - 1. With stretches R/r and r/R and
// s = 1 - 1 / (I + 1) the stresses are s stretch^2 - 3/4 + p. The radial stress is 0 on the outer
// circle, and its derivative is (hoop stress - radial stress) / r.
struct Incompressible {
  double radius, radial, hoop, shear;
  explicit Incompressible(double R)
      : radius(std::sqrt(R * R + kPush * kPush - 1)),
        radial(R / radius),
        hoop(radius / R),
        shear(1 - 1 / (radial * radial + hoop * hoop + 2)) {}
};

double exact_pressure(double R) {
  constexpr int kIntervals = 2000;  // of the midpoint rule, whose error is then 1e-8
  const double from = Incompressible(R).radius, to = Incompressible(kOuter).radius;
  double integral = 0;
  for (int k = 0; k < kIntervals; ++k) {
    const double r = from + (k + 0.5) / kIntervals * (to - from);
    const Incompressible at(std::sqrt(r * r - kPush * kPush + 1));
    integral += at.shear * (at.hoop * at.hoop - at.radial * at.radial) / r;
  }
  const Incompressible at(R);
  return 0.75 - at.shear * at.radial * at.radial - integral * (to - from) / kIntervals;
}

// ------------------------------------------------------------------ the mesh
// Vertices by radius, angle and height.
struct RingMesh {
  RowMatrix polar;
  Cells cells;
};

RingMesh mesh_of(const RingElement& element, int n) {
  const int layers = element.is_solid ? 2 : 1, around = 2 * n;
  const Index a_layer = (n + 1) * (around + 1);
  RingMesh mesh;
  mesh.polar.resize(layers * a_layer, element.is_solid ? 3 : 2);
  for (Index v = 0; v < mesh.polar.rows(); ++v) {
    mesh.polar(v, 0) = kInner + (kOuter - kInner) * static_cast<double>(v % (n + 1)) / n;
    mesh.polar(v, 1) = std::numbers::pi / 2 * static_cast<double>(v % a_layer / (n + 1)) / around;
    if (element.is_solid) mesh.polar(v, 2) = v < a_layer ? 0 : kThickness;
  }
  const Index squares = n * around;
  mesh.cells.resize(element.is_product ? squares : 2 * squares, element.is_solid     ? 8
                                                                : element.is_product ? 4
                                                                                     : 3);
  for (Index q = 0; q < squares; ++q) {
    const Index a = q / n * (n + 1) + q % n, b = a + n + 1;
    if (element.is_solid) {
      const Index c = a + a_layer, d = b + a_layer;
      mesh.cells.row(q) << a, a + 1, b + 1, b, c, c + 1, d + 1, d;
    } else if (element.is_product) {
      mesh.cells.row(q) << a, a + 1, b + 1, b;
    } else {
      mesh.cells.row(2 * q) << a, a + 1, b + 1;
      mesh.cells.row(2 * q + 1) << a, b + 1, b;
    }
  }
  return mesh;
}

std::shared_ptr<const BernsteinSpace> space_of(const RingElement& element, const RingMesh& mesh) {
  const auto count = static_cast<Index>(mesh.polar.rows());
  if (element.is_solid)
    return std::make_shared<const BezierHexahedronSpace>(mesh.cells, count, element.degree);
  if (element.is_product)
    return std::make_shared<const BezierQuadSpace>(mesh.cells, count, element.degree);
  return std::make_shared<const BezierTriangleSpace>(mesh.cells, count, element.degree);
}

// Returns the point of the cell where function k is largest.
Vec lattice_point(const BernsteinElement& element, const Exponents& exponents) {
  std::vector<double> point;
  int c = 0;
  for (const int corners : element.factors) {
    for (int j = 0; j < corners; ++j)
      if (corners > 2 || j == 1) point.push_back(1.0 * exponents[to_size(c + j)] / element.degree);
    c += corners;
  }
  return Eigen::Map<const Vec>(point.data(), static_cast<Index>(point.size()));
}

// Returns control points of the curved ring, which interpolates the exact ring at the lattice of
// every cell.
RowMatrix curved_nodes(const BernsteinSpace& space, const RowMatrix& polar) {
  const BernsteinBasis& basis = space.basis();
  const int m = basis.count();
  Eigen::MatrixXd values(m, m);
  for (int k = 0; k < m; ++k)
    values.row(k) = basis.values(lattice_point(space.element(), basis.exponents(k))).transpose();
  const Eigen::PartialPivLU<Eigen::MatrixXd> interpolation(values);
  RowMatrix out(polar.rows(), polar.cols());
  for (Index e = 0; e < space.element_count(); ++e) {
    Eigen::MatrixXd control(m, polar.cols());
    for (int k = 0; k < m; ++k) control.row(k) = polar.row(space.cells()(e, k));
    Eigen::MatrixXd points = values * control;
    const Eigen::VectorXd radius = points.col(0), angle = points.col(1);
    points.col(0) = radius.cwiseProduct(angle.array().cos().matrix());
    points.col(1) = radius.cwiseProduct(angle.array().sin().matrix());
    const Eigen::MatrixXd curved = interpolation.solve(points);
    for (int k = 0; k < m; ++k) out.row(space.cells()(e, k)) = curved.row(k);
  }
  return out;
}

std::shared_ptr<const DensityTerm> term_of(const RingElement& element,
                                           const std::shared_ptr<const BernsteinSpace>& space,
                                           const RestShapes& rest, double nu) {
  const LameConstants constants = constants_of(nu);
  const auto made = [&](const auto& material) {
    return make_energy(space, rest, mean_dilatation(material, element.pressure_degree));
  };
  return element.is_solid ? made(stable_neo_hookean<3>(constants))
                          : made(stable_neo_hookean<2>(constants));
}

// Returns the problem with the inner side pushed and rollers on both straight sides and, in space,
// on both ends.
Case case_of(const BernsteinSpace& space, const RowMatrix& polar, const RowMatrix& nodes,
             std::shared_ptr<const EnergyTerm> term) {
  const auto dim = static_cast<int>(nodes.cols());
  RowMatrix x = nodes;
  std::vector<FixedUnknown> held;
  for (Index k = 0; k < nodes.rows(); ++k) {
    const double R = polar(k, 0), angle = polar(k, 1);
    x.row(k).head(2) *= 1 + (kPush - 1) * (kOuter - R) / (kOuter - kInner);
    const bool is_pushed = R < kInner + kNear;
    if (is_pushed || angle > std::numbers::pi / 2 - kNear) held.push_back({dim * k, x(k, 0)});
    if (is_pushed || angle < kNear) held.push_back({dim * k + 1, x(k, 1)});
    if (dim == 3) held.push_back({dim * k + 2, x(k, 2)});
  }
  ProblemBuilder builder(dim * space.node_count());
  builder.add(std::move(term), 1.0);
  builder.add(FixedUnknowns(held));
  const Problem problem = builder.build();
  return {problem, problem.reduce(Eigen::Map<const Vec>(x.data(), x.size()))};
}

}  // namespace

const std::vector<RingElement>& ring_elements() {
  static const std::vector<RingElement> elements{
      {"triangles of degree 2", false, false, 2, 0},
      {"triangles of degree 3", false, false, 3, 1},
      {"quadrilaterals of degree 2", true, false, 2, 1},
      {"hexahedra of degree 2", true, true, 2, 1},
  };
  return elements;
}

RingResult solve_ring(const RingElement& element, int n, double nu) {
  const RingMesh mesh = mesh_of(element, n);
  const auto space = space_of(element, mesh);
  const RowMatrix polar = space->node_positions(mesh.polar), nodes = curved_nodes(*space, polar);
  // The rest shapes are strongly curved, so that their measures need a finer rule than the energy.
  const RestShapes rest =
      curved_shapes(*space, nodes, exact_rule(space->element().factors, 3 * element.degree + 1));
  const auto term = term_of(element, space, rest, nu);
  const Case ring = case_of(*space, polar, nodes, term);
  const SolveResult solved = NewtonMinimizer().minimize(ring.problem, ring.start, nullptr);

  RingResult result;
  result.elements = space->element_count();
  result.unknowns = ring.problem.size();
  result.iterations = static_cast<int>(solved.iterations.size());
  for (const IterationRecord& r : solved.iterations) result.factorizations += r.factorizations;
  result.has_converged = solved.status == Status::Converged;
  const int corner_count = space->element().corner_count();
  RowMatrix corners(corner_count,
                    lattice_point(space->element(), space->basis().exponents(0)).size());
  for (int k = 0; k < corner_count; ++k)
    corners.row(k) = lattice_point(space->element(), space->basis().exponents(k)).transpose();
  const RowMatrix p = term->pressures(ring.problem.expand(solved.y), corners);
  const Index count = space->vertex_count();
  Vec least = Vec::Constant(count, 1e300), most = -least;
  for (Index e = 0; e < p.rows(); ++e)
    for (int k = 0; k < corner_count; ++k) {
      const Index v = mesh.cells(e, k);
      least[v] = std::min(least[v], p(e, k));
      most[v] = std::max(most[v], p(e, k));
    }
  Vec exact(count);
  for (Index v = 0; v < count; ++v) exact[v] = exact_pressure(mesh.polar(v, 0));
  const double range = exact.maxCoeff() - exact.minCoeff();
  result.error =
      std::max((most - exact).cwiseAbs().maxCoeff(), (least - exact).cwiseAbs().maxCoeff()) / range;
  result.jump = (most - least).maxCoeff() / range;
  return result;
}

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
