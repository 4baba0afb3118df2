// New elements out of old ones: a linear constraint takes functions away from a space, and what is
// left has its quadrature, its proof of det J > 0 and its sparse matrices. Here, of biquadratic
// quads, serendipity elements of 8 nodes, and C1 splines.
//
// Sample run:
//   example_elements_by_constraints splines.vtk
#include <cmath>
#include <iostream>
#include <string>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/newton.h"
#include "write_vtk.h"

using namespace majorant;

// node(i, j): the node at (i, j) of a grid of n by n biquadratic quads, 2 n + 1 nodes a row.
using NodeGrid = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>;

// The x^2 y^2 coefficient of each quad is 0: second differences in both directions.
struct Serendipity final : Constraint {
  NodeGrid node;
  void append_rows(ConstraintRows& rows) const override {
    for (Index i = 0; i + 2 < node.rows(); i += 2)
      for (Index j = 0; j + 2 < node.cols(); j += 2)
        for (const int k : {0, 1}) {
          rows.begin_row("serendipity, quad " + std::to_string(i / 2) + " " +
                         std::to_string(j / 2));
          for (const auto& [a, p] : {std::pair(0, 1), {1, -2}, {2, 1}})
            for (const auto& [b, q] : {std::pair(0, 1), {1, -2}, {2, 1}})
              rows.add(2 * node(i + a, j + b) + k, p * q);
          rows.end_row(0);
        }
  }
};

// Derivatives across the sides of quads are the same on both: the node there is the mean of its
// neighbours.
struct Smooth final : Constraint {
  NodeGrid node;
  void append_rows(ConstraintRows& rows) const override {
    const auto mean = [&](Index before, Index here, Index after) {
      for (const int k : {0, 1}) {
        rows.begin_row("smooth, node " + std::to_string(here));
        rows.add(2 * before + k, 1);
        rows.add(2 * here + k, -2);
        rows.add(2 * after + k, 1);
        rows.end_row(0);
      }
    };
    for (Index i = 2; i + 2 < node.rows(); i += 2)
      for (Index j = 0; j < node.cols(); ++j) {
        mean(node(i - 1, j), node(i, j), node(i + 1, j));
        mean(node(j, i - 1), node(j, i), node(j, i + 1));
      }
  }
};

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: " << argv[0] << " OUT.vtk\n", 1;
  // 1. Biquadratic quads, and their nodes by place.
  constexpr int n = 6;
  RowMatrix vertices((n + 1) * (n + 1), 2);
  Cells cells(n * n, 4);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Index v = i * (n + 1) + j;
      vertices.row(v) << double(i) / n, double(j) / n;
      if (i < n && j < n) cells.row(i * n + j) << v, v + n + 1, v + n + 2, v + 1;
    }
  auto space =
      std::make_shared<const BezierQuadSpace>(cells, static_cast<Index>(vertices.rows()), 2);
  const RowMatrix flat = space->node_positions(vertices);
  NodeGrid node(2 * n + 1, 2 * n + 1);
  for (Index k = 0; k < flat.rows(); ++k)
    node(std::lround(2 * n * flat(k, 0)), std::lround(2 * n * flat(k, 1))) = k;
  // 2. A curved patch, to be flattened; the start meets both constraints.
  RowMatrix surface(flat.rows(), 3);
  surface << flat,
      (0.3 * (3 * flat.col(0).array()).sin() * (2 * flat.col(1).array()).cos()).matrix();
  const RestShapes rest = curved_shapes(*space, surface, tensor_gauss_rule(5));
  const Vec start = Eigen::Map<const Vec>(flat.data(), flat.size());
  const auto injectivity = std::make_shared<const LocalInjectivity>(space, rest.measure);
  Vec x;
  const auto energy = [&](const char* name, const Constraint* constraint, Index size) {
    ProblemBuilder builder(2 * space->node_count());
    builder.add(symmetric_dirichlet()(space, rest), 1 / rest.measure.sum());
    builder.add(injectivity);
    builder.add(FixedPoints::at({node(0, 0)}, start));
    if (constraint) builder.add(*constraint);
    const Problem problem = builder.build();
    const SolveResult result = NewtonMinimizer().minimize(problem, problem.reduce(start), {});
    x = problem.expand(result.y);
    const double least = injectivity->lower_bounds(x).minCoeff();
    std::cout << name << ": " << problem.size() << " unknowns, energy " << result.energy
              << ", certified det J >= " << least << "\n";
    const bool good = result.status == Status::Converged && problem.size() == size && least > 0;
    return good ? result.energy : std::nan("");
  };
  // 3. Each is a part of the whole space: its minimum is a little higher.
  Serendipity serendipity;
  Smooth smooth;
  serendipity.node = smooth.node = node;
  const Index all = 2 * space->node_count() - 2;
  const double whole = energy("biquadratic", nullptr, all);
  const double eight = energy("serendipity", &serendipity, all - 2 * n * n);
  const double spline = energy("C1 splines", &smooth, 2 * (n + 2) * (n + 2) - 2);
  write_vtk(argv[argc - 1], *space, x, 2, 77);
  const auto is_near = [whole](double part) { return part > whole && part < whole + 1e-3; };
  return is_near(eight) && is_near(spline) ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
