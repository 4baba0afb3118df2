// Elements of any size: derivatives compared with differences and with terms of one size, problems
// with polygons of many sizes, elements of 120 unknowns.
#include "majorant/framework/terms/list_term.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "majorant/framework/error.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/manifold_problem.h"
#include "random.h"

namespace majorant {
namespace {

// A nonconvex function of all nodes that is no sum of functions of few nodes.
constexpr auto tangled = [](Index e, const auto& z) {
  using std::sin;
  using T = typename std::decay_t<decltype(z)>::Scalar;
  T sum(0.0), product(1.0);
  for (Index i = 0; i < z.cols(); ++i)
    for (Index c = 0; c < z.rows(); ++c) {
      sum = sum + z(c, i) * (0.1 * static_cast<double>(i + 1) + static_cast<double>(e));
      product = product * (1.0 + 0.2 * sin(z(c, i)));
    }
  return sum * sum * 0.1 + product;
};

ElementLists lists_of_sizes(const std::vector<int>& sizes, Index nodes) {
  ElementLists lists;
  for (const int size : sizes) {
    lists.emplace_back();
    for (int k = 0; k < size; ++k)
      lists.back().push_back(static_cast<Index>((3 * lists.size() + 7 * k) % nodes));
  }
  return lists;
}

TEST(ListTerm, HasItsDerivativesAtAllSizes) {
  // Three unknowns per node: elements of 3 to 120 unknowns, with sizes at the borders of slices.
  const Index nodes = 41;  // a prime, so that nodes of an element differ
  const auto term = make_term<3>("tangled", lists_of_sizes({1, 3, 4, 5, 8, 9, 40}, nodes), tangled);
  const Vec x = test::Random(1).vector(3 * nodes);
  const DerivativeReport report = check_derivatives(*term, x);
  EXPECT_TRUE(report.ok()) << report.message();
  EXPECT_EQ(term->element_dofs().local_size(), 120);
  EXPECT_EQ(term->element_dofs().node_count(3), 5);
}

TEST(ListTerm, IsTheTermOfEachSize) {
  const Index nodes = 20;
  const Vec y = test::Random(2).vector(2 * nodes);
  for (const double weight : {0.0, 1.0, 2.0}) {
    const BlendedCurvature curvature = BlendedCurvature::projected(weight);
    ProblemBuilder lists(2 * nodes), sizes(2 * nodes);
    lists.add(make_term<2>("all", ElementLists{{0, 1, 2}, {3, 4, 5, 6}, {7, 8, 9}, {1, 5, 12, 19}},
                           tangled),
              1.5);
    const auto shifted = [](std::array<Index, 2> number) {
      return [number](Index e, const auto& z) { return tangled(number[to_size(e)], z); };
    };
    sizes.add(make_term<3, 2>("three", Cells{{0, 1, 2}, {7, 8, 9}}, shifted({0, 2})), 1.5);
    sizes.add(make_term<4, 2>("four", Cells{{3, 4, 5, 6}, {1, 5, 12, 19}}, shifted({1, 3})), 1.5);
    const Problem a = lists.build(), b = sizes.build();
    Vec g, h, gradient, hessian;
    const double energy = Evaluator(a).linearize(y, curvature, g, h),
                 expected = Evaluator(b).linearize(y, curvature, gradient, hessian);
    EXPECT_EQ(a.pattern().rows, b.pattern().rows);  // repetitions add no entries
    EXPECT_NEAR(energy, expected, 1e-13 * std::abs(expected));
    EXPECT_LE((g - gradient).norm(), 1e-13 * gradient.norm());
    EXPECT_LE((h - hessian).norm(), 1e-12 * hessian.norm());
    Vec alone;
    EXPECT_EQ(Evaluator(a).gradient(y, alone), energy);
    EXPECT_LE((alone - g).norm(), 1e-13 * g.norm());
  }
}

// The energy of planar polygons of 3 to 12 corners, which is least for regular ones of unit area.
constexpr auto regular = [](Index, const auto& z) {
  using T = typename std::decay_t<decltype(z)>::Scalar;
  const Index n = z.cols();
  T area(0.0), length(0.0);
  for (Index i = 0; i < n; ++i) {
    const auto a = z.col(i), b = z.col((i + 1) % n);
    area = area + 0.5 * (a[0] * b[1] - a[1] * b[0]);
    length = length + (b - a).squaredNorm();
  }
  return length + 4.0 * (area - 1.0) * (area - 1.0);
};

TEST(ListTerm, OneTermOfPolygonsOfThreeToTwelveCorners) {
  ElementLists faces;
  Index node = 0;
  for (int n = 3; n <= 12; ++n) {
    faces.emplace_back();
    for (int k = 0; k < n; ++k) faces.back().push_back(node++);
  }
  Vec x(2 * node);
  for (const auto& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(face.size());
      x.segment<2>(2 * face[k]) << 0.5 * std::cos(angle) + 0.03 * std::sin(5 * angle + 1),
          0.8 * std::sin(angle);
    }
  ProblemBuilder builder(2 * node);
  builder.add(make_term<2>("regular", faces, regular), 1.0);
  const Problem problem = builder.build();
  const SolveResult result = NewtonMinimizer().minimize(problem, x, nullptr);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  for (const auto& face : faces) {
    // A regular polygon of area A has the sum of squares 4 tan(pi / n) A.
    const double n = static_cast<double>(face.size()), t = 4 * std::tan(std::numbers::pi / n);
    double area = 0, length = 0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector2 a = result.y.segment<2>(2 * face[k]),
                    b = result.y.segment<2>(2 * face[(k + 1) % face.size()]);
      area += cross(a, b) / 2;
      length += (b - a).squaredNorm();
    }
    EXPECT_NEAR(area, 1 - t / 8, 1e-4) << n << " corners";
    EXPECT_NEAR(length, t * area, 1e-4) << n << " corners";
  }
}

TEST(ListTerm, TakesDataOfElementsAndConstraints) {
  // Least squares for sums of nodes equal to the element's number: x = number / nodes.
  const ElementLists groups{{0, 1}, {2, 3, 4}};
  const auto term = make_term(
      "sums", groups,
      [](Index, const auto& z, const auto& data) {
        const auto r = z.sum() - data[0];
        return r * r + 0.01 * z.squaredNorm();
      },
      RowMatrix{{2.0}, {6.0}});
  ProblemBuilder builder(5);
  const TermId id = builder.add(term, 1.0);
  builder.add(FixedUnknowns({{4, 1.0}}));
  const Problem problem = builder.build();
  const auto solved = [&](const Problem& p) {
    return p.expand(NewtonMinimizer().minimize(p, Vec::Zero(4), nullptr).y);
  };
  const Vec x = solved(problem);
  EXPECT_NEAR(x[0], 2 / 2.01, 1e-9);
  EXPECT_NEAR(x[2], 5 / 2.01, 1e-9);
  EXPECT_EQ(x[4], 1);
  const Vec other = solved(problem.with({{id, {.parameters = Vec{{4, 6}}}}}));
  EXPECT_NEAR(other[0], 4 / 2.01, 1e-9);
}

TEST(ListTerm, RefusesInvalidElements) {
  const auto refusal = [](const ElementLists& lists) -> std::string {
    try {
      make_term("t", lists, [](Index, const auto& z) { return z.sum(); });
    } catch (const InvalidArgument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal({{0}, {}}).find("element 1 has no nodes"), std::string::npos);
  EXPECT_NE(refusal({{0, -3}}).find("a node of element 0 is -3"), std::string::npos);
  EXPECT_THROW(make_term(
                   "t", ElementLists{{0}},
                   [](Index, const auto& z, const auto& d) { return z.sum() * d[0]; },
                   RowMatrix{{1.0}, {2.0}}),
               InvalidArgument);
  ProblemBuilder builder(3);
  EXPECT_THROW(
      builder.add(
          make_term("t", ElementLists{{0, 3}}, [](Index, const auto& z) { return z.sum(); }), 1.0),
      InvalidArgument);
}

TEST(ListTerm, MayLieOnManifolds) {
  ManifoldProblemBuilder builder(9);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}, {3, 4, 5}});
  builder.add(make_term<3>("near", ElementLists{{0, 1, 2}, {2}},
                           [](Index e, const auto& z) {
                             if (e == 1) return (z.array() - 1.0).matrix().squaredNorm();
                             return (z.col(0) + z.col(1) - z.col(2)).squaredNorm();
                           }),
              1.0);
  const ManifoldProblem problem = builder.build();
  Vec y;
  const Problem around = problem.around(test::Random(3).vector(9), &y);
  const TermId id = around.terms().front();
  const DerivativeReport report = check_derivatives(around.term(id), y, 1e-5, around.state(id));
  EXPECT_TRUE(report.ok()) << report.message();
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
