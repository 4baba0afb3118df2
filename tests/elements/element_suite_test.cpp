// Tables and numbering of every element space through its public interface. Certificates:
// element_certificates_test.cpp. Elements: element_cases.h.
#include <gtest/gtest.h>

#include <set>

#include "element_maps.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

using test::ElementCase;
using test::Random;

class Element : public testing::TestWithParam<ElementCase> {
 protected:
  const ElementCase& sample() const { return GetParam(); }
  const BernsteinSpace& space() const { return *space_; }
  const Factors& factors() const { return space_->element().factors; }
  int dim() const { return space_->reference_dim(); }
  int n() const { return sample().degree; }
  std::vector<std::vector<double>> random_points(int count, unsigned seed = 1) const {
    Random random(seed);
    std::vector<std::vector<double>> points;
    for (int k = 0; k < count; ++k) points.push_back(test::random_coordinates(factors(), random));
    return points;
  }
  RowMatrix straight() const { return space_->node_positions(sample().mesh.vertices); }

  std::shared_ptr<const BernsteinSpace> space_ = GetParam().space();
};

// ---- Tables. ----

TEST_P(Element, TableShapes) {
  const ContractionTable t = space().tabulate(sample().rule);
  EXPECT_EQ(t.nodes, space().nodes_per_element());
  EXPECT_EQ(t.weights, sample().rule.weights);
  EXPECT_EQ(t.directions.cols(), dim());
  EXPECT_LE(t.directions.rows(), 4);
  EXPECT_EQ(t.shape_gradient.rows(), sample().rule.size());
  EXPECT_EQ(t.gradient_product.rows(), sample().rule.size());
  for (const GradientEntry& e : t.gradient) {
    EXPECT_TRUE(e.node >= 0 && e.node < t.nodes);
    EXPECT_TRUE(e.direction >= 0 && e.direction < t.directions.rows());
    EXPECT_TRUE(e.shape_gradient >= 0 && e.shape_gradient < t.shape_gradient.cols());
  }
  for (const HessianEntry& e : t.hessian)
    EXPECT_TRUE(e.gradient_product >= 0 && e.gradient_product < t.gradient_product.cols());
  ASSERT_EQ(t.pair_starts.size(), static_cast<std::size_t>(t.nodes * (t.nodes + 1) / 2 + 1));
  EXPECT_EQ(t.pair_starts.front(), 0);
  EXPECT_EQ(t.pair_starts.back(), static_cast<int>(t.hessian.size()));
  EXPECT_TRUE(std::is_sorted(t.pair_starts.begin(), t.pair_starts.end()));
}

TEST_P(Element, PartitionOfUnity) {
  const auto points = random_points(20);
  const ContractionTable t = space().tabulate(test::rule_at(factors(), points));
  for (Index l = 0; l < t.weights.size(); ++l) {
    const Vec b = space().basis().values(
        test::quadrature_point(factors(), points[static_cast<std::size_t>(l)]));
    EXPECT_NEAR(b.sum(), 1, 1e-14);
    EXPECT_GT(b.minCoeff(), 0);
    EXPECT_LE(
        (b - test::basis_values(space().element(), points[static_cast<std::size_t>(l)])).norm(),
        1e-14);
    EXPECT_LE(test::reference_gradients(t, l).colwise().sum().norm(), 1e-13 * n());
  }
}

// Sixth-order differences of the basis functions' formula.
TEST_P(Element, GradientsMatchFiniteDifferences) {
  constexpr double h = 1e-3;
  const auto points = random_points(6, 2);
  const ContractionTable t = space().tabulate(test::rule_at(factors(), points));
  for (Index l = 0; l < t.weights.size(); ++l) {
    const RowMatrix g = test::reference_gradients(t, l);
    for (int d = 0; d < dim(); ++d) {
      const std::array<int, 2> ends = space().element().derivatives[static_cast<std::size_t>(d)];
      const auto at = [&](double s) {
        std::vector<double> x = points[static_cast<std::size_t>(l)];
        x[static_cast<std::size_t>(ends[0])] += s * h;
        x[static_cast<std::size_t>(ends[1])] -= s * h;
        return test::basis_values(space().element(), x);
      };
      const Vec fd = (45 * (at(1) - at(-1)) - 9 * (at(2) - at(-2)) + (at(3) - at(-3))) / (60 * h);
      EXPECT_LE((fd - g.col(d)).cwiseAbs().maxCoeff(), 1e-10 * (1 + n() * n() * n()));
    }
  }
}

TEST_P(Element, ProductsAreRecombinedMoments) {
  const ContractionTable t = space().tabulate(test::rule_at(factors(), random_points(5, 3)));
  const Index dirs = static_cast<Index>(t.directions.rows());
  for (Index l = 0; l < t.weights.size(); ++l) {
    RowMatrix d = RowMatrix::Zero(t.nodes, dirs);
    for (const GradientEntry& e : t.gradient)
      d(e.node, e.direction) += e.coefficient * t.shape_gradient(l, e.shape_gradient);
    std::size_t p = 0;
    for (int i = 0; i < t.nodes; ++i)
      for (int j = 0; j <= i; ++j, ++p) {
        RowMatrix product = RowMatrix::Zero(dirs, dirs);
        for (int q = t.pair_starts[p]; q < t.pair_starts[p + 1]; ++q) {
          const HessianEntry& e = t.hessian[static_cast<std::size_t>(q)];
          product(e.direction_i, e.direction_j) +=
              e.coefficient * t.gradient_product(l, e.gradient_product);
        }
        EXPECT_LE((product - d.row(i).transpose() * d.row(j)).norm(), 1e-12 * n() * n());
      }
  }
}

// Three columns may be a point of a triangle or of a cube: the rule states its cell.
TEST_P(Element, RulesOfOtherCellsAreRefused) {
  for (const ElementCase& other : test::all_elements()) {
    if (other.rule.cell == sample().rule.cell)
      EXPECT_NO_THROW(space().tabulate(other.rule));
    else
      EXPECT_THROW(space().tabulate(other.rule), InvalidArgument) << other.name;
  }
  EXPECT_THROW(curved_shapes(space(), straight(), gauss_rule(2)), InvalidArgument);
}

// The basis functions of each space have the sum 1.
TEST_P(Element, RulesIntegrateTheTables) {
  Quadrature rule = composite_rule(sample().rule, 2);
  rule = composite_rule(rule, 2);
  const ContractionTable t = space().tabulate(rule);
  const RowMatrix mean = t.weights.transpose() * t.gradient_product;
  const Index spaces = static_cast<Index>(factors().size() * (factors().size() + 1) / 2);
  EXPECT_NEAR(mean.sum(), double(spaces), 1e-12);
  EXPECT_NEAR((t.weights.transpose() * t.shape_gradient).sum(), double(factors().size()), 1e-12);
}

class SimplexElement : public Element {};  // one factor

// All functions of one Bernstein basis have the same integral.
TEST_P(SimplexElement, MomentsHaveOneMean) {
  const Quadrature rule = composite_rule(composite_rule(sample().rule, 2), 2);
  const ContractionTable t = space().tabulate(rule);
  const RowMatrix mean = t.weights.transpose() * t.gradient_product;
  EXPECT_LE((mean.array() * double(t.gradient_product.cols()) - 1).abs().maxCoeff(), 1e-3);
}

// ---- Positions. ----

// Returns the corners of the reference cell in reference coordinates.
RowMatrix reference_corners(const BernsteinElement& element) {
  const std::vector<Exponents> nodes = element.lattice(element.degrees());
  RowMatrix p(element.corner_count(), element.dim());
  for (int c = 0; c < element.corner_count(); ++c)
    for (int d = 0; d < element.dim(); ++d)
      p(c, d) =
          nodes[static_cast<std::size_t>(c)]
               [static_cast<std::size_t>(element.derivatives[static_cast<std::size_t>(d)][0])] > 0;
  return p;
}

TEST_P(Element, AffineMapsHaveConstantJacobians) {
  Random random(4);
  Cells cell(1, space().element().corner_count());
  for (Index k = 0; k < cell.cols(); ++k) cell(0, k) = k;
  const auto reference = sample().make(cell, static_cast<Index>(cell.cols()), n());
  RowMatrix a(dim(), dim());
  for (double& value : a.reshaped()) value = random.uniform();
  const RowMatrix corners = (reference_corners(space().element()) * a.transpose()).rowwise() +
                            random.vector(dim()).transpose();
  const Vec x = test::unknowns(reference->node_positions(corners));
  const ContractionTable t = reference->tabulate(test::rule_at(factors(), random_points(10)));
  for (Index l = 0; l < t.weights.size(); ++l)
    EXPECT_LE((test::jacobian(*reference, t, x, 0, l) - a).norm(), 1e-13 * n());
}

TEST_P(Element, AffineMapsOfMeshesAreReproduced) {
  Random random(5);
  RowMatrix a(dim(), dim());
  for (double& value : a.reshaped()) value = random.uniform();
  const Eigen::RowVectorXd shift = random.vector(dim());
  const RowMatrix rest = straight();
  const RowMatrix image =
      space().node_positions((sample().mesh.vertices * a.transpose()).rowwise() + shift);
  EXPECT_LE((image - ((rest * a.transpose()).rowwise() + shift)).norm(),
            1e-13 * double(rest.size()));
  const ContractionTable t = space().tabulate(test::rule_at(factors(), random_points(4)));
  for (Index e = 0; e < space().element_count(); ++e)
    for (Index l = 0; l < t.weights.size(); ++l)
      EXPECT_LE((test::jacobian(space(), t, test::unknowns(image), e, l) -
                 a * test::jacobian(space(), t, test::unknowns(rest), e, l))
                    .norm(),
                1e-12);
}

TEST_P(Element, MeasuresOfRestShapesAddUp) {
  const RestShapes rest = curved_shapes(space(), straight(), sample().rule);
  EXPECT_GT(rest.measure.minCoeff(), 0);
  EXPECT_NEAR(rest.measure.sum(), dim() == 2 ? 6 : 8, 1e-12);
  double measure = 1;
  for (const int corners : factors()) measure /= corners == 4 ? 6 : corners == 3 ? 2 : 1;
  EXPECT_EQ(space().reference_measure(), measure);
}

TEST_P(SimplexElement, CurvedRestShapesOfStraightCellsAreFlat) {
  const RestShapes rest = curved_shapes(space(), straight(), sample().rule);
  const RestShapes flat = flat_simplices(sample().mesh.vertices, sample().mesh.cells);
  EXPECT_LE((flat.measure - rest.measure).norm(), 1e-13);
  const ContractionTable t = space().tabulate(sample().rule);
  for (Index e = 0; e < space().element_count(); ++e)
    EXPECT_LE((flat.inverse_of(e) * test::jacobian(space(), t, test::unknowns(straight()), e, 0) -
               RowMatrix::Identity(dim(), dim()))
                  .norm(),
              1e-13);
}

// ---- Numbering. ----

TEST_P(Element, VerticesKeepTheirNumbers) {
  const auto corners = sample().mesh.cells.cols();
  EXPECT_EQ(space().cells().leftCols(corners), sample().mesh.cells);
  EXPECT_EQ(space().vertex_count(), sample().mesh.vertices.rows());
  EXPECT_EQ(straight().topRows(space().vertex_count()), sample().mesh.vertices);
  std::set<Index> used(space().cells().data(), space().cells().data() + space().cells().size());
  EXPECT_EQ(static_cast<Index>(used.size()), space().node_count());
  EXPECT_EQ(*used.begin(), 0);
  EXPECT_EQ(*used.rbegin(), space().node_count() - 1);
}

// Expects that nodes of different cells are equal exactly if their straight positions are equal.
void expect_positions_identify_nodes(const ElementCase& sample, const Cells& cells) {
  const auto space = sample.space(cells);
  const RowMatrix nodes = space->node_positions(sample.mesh.vertices);
  for (Index i = 0; i < nodes.rows(); ++i)
    for (Index j = 0; j < i; ++j) ASSERT_GT((nodes.row(i) - nodes.row(j)).norm(), 1e-3);
  const BernsteinElement& element = space->element();
  const std::vector<Exponents> lattice = element.lattice(element.degrees());
  for (Index e = 0; e < cells.rows(); ++e)
    for (std::size_t l = 0; l < lattice.size(); ++l) {
      // A straight cell is the multilinear map of its corners.
      RowMatrix p = RowMatrix::Zero(1, nodes.cols());
      for (Index c = 0; c < cells.cols(); ++c) {
        double weight = 1;
        std::size_t k = 0;
        for (const int corners : element.factors)
          for (int q = 0; q < corners; ++q, ++k)
            if (lattice[static_cast<std::size_t>(c)][k] > 0)
              weight *= lattice[l][k] / double(element.degree);
        p += weight * sample.mesh.vertices.row(cells(e, c));
      }
      ASSERT_LE((nodes.row(space->cells()(e, static_cast<Index>(l))) - p).norm(), 1e-12);
    }
}

// Every first corner of a cell, and any first corners of its neighbours.
TEST_P(Element, NeighboursShareNodesInAllOrientations) {
  Random random(6);
  const int count = static_cast<int>(sample().rotations.size());
  for (int rotation = 0; rotation < count; ++rotation) {
    Cells cells = sample().mesh.cells;
    for (Index e = 0; e < cells.rows(); ++e) {
      const int which = e == 0 ? rotation : random.integer(0, count - 1);
      for (Index k = 0; k < cells.cols(); ++k)
        cells(e, k) = sample().mesh.cells(
            e, sample().rotations[static_cast<std::size_t>(which)][static_cast<std::size_t>(k)]);
    }
    expect_positions_identify_nodes(sample(), cells);
  }
}

// Returns homogeneous coordinates in cell e of the point with these weights on the vertices of one
// facet.
std::vector<double> coordinates_of(const BernsteinSpace& space, Index e,
                                   const std::map<Index, double>& weights) {
  const BernsteinElement& element = space.element();
  const std::vector<Exponents> lattice = element.lattice(element.degrees());
  std::vector<double> x(static_cast<std::size_t>(space.basis().coordinate_count()), 0.0);
  for (Index c = 0; c < element.corner_count(); ++c) {
    const auto found = weights.find(space.cells()(e, c));
    if (found == weights.end()) continue;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (lattice[static_cast<std::size_t>(c)][k] > 0) x[k] += found->second;
  }
  return x;
}

TEST_P(Element, EveryAssignmentIsContinuous) {
  Random random(7);
  const Vec x = random.vector(dim() * space().node_count());
  std::map<std::set<Index>, std::vector<Index>> facets;  // vertices -> cells
  const std::vector<Exponents> lattice = space().element().lattice(space().element().degrees());
  for (Index e = 0; e < space().element_count(); ++e)
    for (std::size_t k = 0; k < static_cast<std::size_t>(space().basis().coordinate_count()); ++k) {
      std::set<Index> vertices;
      for (Index c = 0; c < space().element().corner_count(); ++c)
        if (lattice[static_cast<std::size_t>(c)][k] == 0) vertices.insert(space().cells()(e, c));
      facets[vertices].push_back(e);
    }
  int shared = 0;
  for (const auto& [vertices, cells] : facets) {
    ASSERT_LE(cells.size(), 2u);
    if (cells.size() < 2) continue;
    ++shared;
    std::map<Index, double> weights;
    double sum = 0;
    for (const Index v : vertices) sum += weights[v] = random.uniform(0, 1);
    for (auto& [v, w] : weights) w /= sum;
    const Vec a = test::map_point(space(), x, cells[0], coordinates_of(space(), cells[0], weights));
    const Vec b = test::map_point(space(), x, cells[1], coordinates_of(space(), cells[1], weights));
    EXPECT_LE((a - b).norm(), 1e-13);
  }
  EXPECT_GE(shared, 7);
}

TEST_P(Element, BoundaryNodesLieOnTheBoundary) {
  const RowMatrix nodes = straight();
  const Eigen::RowVectorXd low = sample().mesh.vertices.colwise().minCoeff(),
                           high = sample().mesh.vertices.colwise().maxCoeff();
  std::vector<Index> expected;
  for (Index i = 0; i < nodes.rows(); ++i)
    if ((nodes.row(i) - low).cwiseAbs().minCoeff() < 1e-12 ||
        (nodes.row(i) - high).cwiseAbs().minCoeff() < 1e-12)
      expected.push_back(i);
  EXPECT_EQ(space().boundary_nodes(), expected);
}

// ---- Bad input. ----

TEST_P(Element, BadInputIsRefused) {
  const Cells& cells = sample().mesh.cells;
  const auto vertices = static_cast<Index>(sample().mesh.vertices.rows());
  const auto refused = [&](const Cells& c, Index v, int degree) {
    EXPECT_THROW(sample().make(c, v, degree), InvalidArgument);
  };
  refused(cells, vertices, 0);
  refused(cells, vertices, space().element().max_degree + 1);
  refused(cells.leftCols(cells.cols() - 1), vertices, n());
  refused(cells, vertices - 1, n());
  Cells broken = cells;
  broken(0, 1) = -1;
  refused(broken, vertices, n());
  broken(0, 1) = broken(0, 0);
  refused(broken, vertices, n());
  Cells three(3, cells.cols());
  for (Index e = 0; e < 3; ++e) three.row(e) = cells.row(0);
  refused(three, vertices, n());
  EXPECT_THROW(space().node_positions(sample().mesh.vertices.topRows(3)), InvalidArgument);
}

INSTANTIATE_TEST_SUITE_P(All, Element, testing::ValuesIn(test::all_elements()), test::case_name);
INSTANTIATE_TEST_SUITE_P(Simplices, SimplexElement,
                         testing::ValuesIn(test::elements_where([](const ElementCase& c) {
                           return c.space()->element().factors.size() == 1;
                         })),
                         test::case_name);

// VTK_BEZIER_TETRAHEDRON of degree 6 and VTK_BEZIER_QUADRILATERAL of degree 4, from VTK 9.1:
// vtkHigherOrderTetra.BarycentricIndex (vertex 0 has its last coordinate) and
// vtkHigherOrderQuadrilateral.PointIndexFromIJK.
TEST(VtkOrder, Tetrahedron) {
  const std::string expected =
      "6000 0600 0060 0006 5100 4200 3300 2400 1500 0510 0420 0330 0240 0150 1050 2040 3030 4020 "
      "5010 5001 4002 3003 2004 1005 0501 0402 0303 0204 0105 0051 0042 0033 0024 0015 4101 1401 "
      "1104 3201 2301 1302 1203 2103 3102 2202 0141 0114 0411 0132 0123 0213 0312 0321 0231 0222 "
      "4011 1014 1041 3012 2013 1023 1032 2031 3021 2022 4110 1140 1410 3120 2130 1230 1320 2310 "
      "3210 2220 3111 1311 1131 1113 2211 1221 2121 2112 1212 1122 ";
  const BezierTetrahedronSpace space(test::tetrahedron_grid().cells, 27, 6);
  std::string order;
  for (int k = 0; k < space.nodes_per_element(); ++k) {
    for (std::size_t c = 0; c < 4; ++c) order += std::to_string(space.basis().exponents(k)[c]);
    order += ' ';
  }
  EXPECT_EQ(order, expected);
}

TEST(VtkOrder, Quad) {
  const std::string expected =
      "00 40 44 04 10 20 30 41 42 43 14 24 34 01 02 03 11 21 31 12 22 32 13 23 33 ";
  const BezierQuadSpace space(test::quad_grid().cells, 12, 4);
  std::string order;
  for (int k = 0; k < space.nodes_per_element(); ++k)
    order += std::to_string(space.basis().exponents(k)[1]) +
             std::to_string(space.basis().exponents(k)[3]) + ' ';
  EXPECT_EQ(order, expected);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
