// Densities with data by element: each element uses its own row for every kind of data, order and
// number of elements of a batch. Data of wrong sizes are refused.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "energies/density_fixture.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"

namespace majorant {
namespace {

// A map with positive determinants on the faces of a bent grid.
struct Sheet {
  test::Mesh mesh = test::grid(5, 4, 0.2, 0.3);
  std::shared_ptr<const BezierTriangleSpace> space;
  RestShapes rest = flat_triangles(mesh.positions, mesh.faces);
  Vec x;

  explicit Sheet(int degree)
      : space(std::make_shared<const BezierTriangleSpace>(
            mesh.faces, static_cast<Index>(mesh.positions.rows()), degree)),
        x(test::linear_map(*space, test::flat(mesh.positions))) {
    test::Random random(7);
    x += 0.02 / degree * random.vector(x.size());
  }
  Index count() const { return space->element_count(); }
};

RowMatrix random_rows(Index rows, Index columns) {
  test::Random random(11);
  RowMatrix m(rows, columns);
  for (Index e = 0; e < rows; ++e)
    for (Index c = 0; c < columns; ++c) m(e, c) = random.uniform(0.5, 2);
  return m;
}

std::vector<double> element_values_of(const EnergyTerm& term, VecIn x) {
  return test::element_models(term, x, Curvature::Exact).values;
}

struct Material {
  double stiffness;
  Vector2 fibre;
};

// Expects the values of the density of one element at a time, with its data in the formula.
void expect_own_rows(const EnergyTerm& with_data,
                     const std::function<std::shared_ptr<const EnergyTerm>(Index)>& of_element,
                     VecIn x) {
  const std::vector<double> all = element_values_of(with_data, x);
  for (Index e = 0; e < with_data.element_dofs().element_count(); ++e) {
    const double expected = element_values_of(*of_element(e), x)[e];
    EXPECT_EQ(all[e], expected) << "element " << e;
  }
}

TEST(ElementData, EachElementHasItsOwnRow) {
  const Sheet s(2);
  const std::vector<Quadrature> rules{lattice_rule(3)};
  const auto stretch = [](const auto& J, auto&& d) {
    const auto u = J(0, 0) * d[0] + J(0, 1) * d[1], v = J(1, 0) * d[0] + J(1, 1) * d[1];
    return J.squaredNorm() + J.inverse().squaredNorm() + d[2] * (u * u + v * v);
  };
  const RowMatrix rows = random_rows(s.count(), 3);
  const auto term = make_energy(s.space, s.rest, density<2, 2>("rows", stretch, rows), rules);
  expect_own_rows(
      *term,
      [&](Index e) {
        const auto fixed = [&, e](const auto& J) { return stretch(J, rows.row(e)); };
        return make_energy(s.space, s.rest, density<2, 2>("fixed", fixed), rules);
      },
      s.x);
}

TEST(ElementData, NumbersAndValuesOfAnyTypeArrive) {
  const Sheet s(1);
  const std::vector<Quadrature> rules{lattice_rule(1)};
  const Vec k = random_rows(s.count(), 1).col(0);
  const auto scaled = [](const auto& J, double c) { return c * J.squaredNorm(); };
  const auto plain = [](const auto& J) { return J.squaredNorm(); };
  const std::vector<double> one =
      element_values_of(*make_energy(s.space, s.rest, density<2, 2>("one", plain), rules), s.x);
  const std::vector<double> many = element_values_of(
      *make_energy(s.space, s.rest, density<2, 2>("many", scaled, k), rules), s.x);
  for (std::size_t e = 0; e < one.size(); ++e)
    EXPECT_NEAR(many[e], k[static_cast<Index>(e)] * one[e], 1e-14 * one[e]);

  std::vector<Material> materials;
  for (Index e = 0; e < s.count(); ++e) materials.push_back({k[e], Vector2(1, 0)});
  const auto of_material = [](const auto& J, const Material& m) {
    return m.stiffness * m.fibre.x() * J.squaredNorm();
  };
  EXPECT_EQ(
      element_values_of(
          *make_energy(s.space, s.rest, density<2, 2>("m", of_material, materials), rules), s.x),
      many);
}

TEST(ElementData, IsotropicFormulasHaveDataToo) {
  const Sheet s(2);
  const std::vector<Quadrature> rules{lattice_rule(2)};
  const Vec k = random_rows(s.count(), 1).col(0);
  const auto of_sigma = [](auto S, auto t, double c) {
    return c * (S * S + t * t) + 2.0 / (S * t);
  };
  const auto of_xy = [](const auto& x, const auto& y, double c) {
    return c * 2.0 * (x + y) + 2.0 / (x - y);
  };
  const auto of_J = [](const auto& J, double c) {
    return c * J.squaredNorm() + 2.0 / J.determinant();
  };
  const auto reference = test::element_models(
      *make_energy(s.space, s.rest, density<2, 2>("J", of_J, k), rules), s.x, Curvature::Projected);
  const std::shared_ptr<const DensityTerm> isotropic[] = {
      make_energy(s.space, s.rest, spectral("S", of_sigma, k), rules),
      make_energy(s.space, s.rest, invariant("x", of_xy, k), rules)};
  for (const auto& term : isotropic) {
    EXPECT_TRUE(check_derivatives(*term, s.x).ok()) << check_derivatives(*term, s.x).message();
    const auto models = test::element_models(*term, s.x, Curvature::Projected);
    for (std::size_t e = 0; e < models.values.size(); ++e) {
      EXPECT_NEAR(models.values[e], reference.values[e], 1e-12 * reference.values[e]);
      EXPECT_LE((models.gradients[e] - reference.gradients[e]).norm(),
                1e-11 * (1 + reference.hessians[e].norm()));
      EXPECT_LE((models.hessians[e] - reference.hessians[e]).norm(),
                1e-9 * reference.hessians[e].norm());
    }
  }
}

TEST(ElementData, DerivativesInTheTriangleAndInVolumes) {
  const Sheet s(2);
  const auto shear = [](const auto& J, std::span<const double> a) {
    using std::abs;
    const auto u = J(0, 0) * a[0] + J(0, 1) * a[1], v = J(1, 0) * a[0] + J(1, 1) * a[1];
    const auto stretch = u * u + v * v;
    auto f = J.squaredNorm() + J.inverse().squaredNorm();
    if (stretch > 1.0) f += pow(stretch - 1.0, 3);  // branches are allowed
    return f;
  };
  const auto term = make_energy(
      s.space, s.rest, density<2, 2>("shear", shear, random_rows(s.count(), 2)), {radon_rule()});
  const DerivativeReport planar = check_derivatives(*term, s.x);
  EXPECT_TRUE(planar.ok()) << planar.message();

  Cells cells(2, 4);
  cells << 0, 1, 2, 3, 1, 2, 3, 4;
  RowMatrix positions(5, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1;
  const auto space = std::make_shared<const BezierTetrahedronSpace>(cells, 5, 2);
  const auto solid = [](const auto& J, double c) {
    return c * J.squaredNorm() + J.inverse().squaredNorm();
  };
  const auto volume =
      make_energy(space, flat_simplices(positions, cells),
                  density<3, 3>("solid", solid, Vec(Vec::LinSpaced(2, 1, 2))), {walkington_rule()});
  const RowMatrix nodes = space->node_positions(positions);
  test::Random random(3);
  const DerivativeReport report =
      check_derivatives(*volume, Eigen::Map<const Vec>(nodes.data(), nodes.size()) +
                                     0.02 * random.vector(nodes.size()));
  EXPECT_TRUE(report.ok()) << report.message();
}

template <class Action>
std::string invalid_argument_of(const Action& action) {
  try {
    action();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(ElementData, WrongSizesAreRefused) {
  const Sheet s(1);
  const std::vector<Quadrature> rules{lattice_rule(1)};
  const auto f = [](const auto& J, double c) { return c * J.squaredNorm(); };
  for (const Index wrong : {s.count() - 1, s.count() + 1, Index(0), Index(1)}) {
    const auto mine = density<2, 2>("mine", f, Vec(Vec::Ones(wrong)));
    const std::string expected = "energy 'mine': data for " + std::to_string(wrong) +
                                 " elements, the space has " + std::to_string(s.count());
    EXPECT_NE(
        invalid_argument_of([&] { make_energy(s.space, s.rest, mine, rules); }).find(expected),
        std::string::npos);
    EXPECT_NE(
        invalid_argument_of([&] { energy_factory(mine)(s.space, s.rest, rules); }).find(expected),
        std::string::npos);
  }
  Vec k = Vec::Ones(s.count());
  k[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(invalid_argument_of([&] { density<2, 2>("mine", f, k); }),
            "density 'mine': the data of element 3 are not finite");
  EXPECT_EQ(invalid_argument_of([&] {
              spectral(
                  "mine", [](auto S, auto t, double c) { return c * S * t; }, k);
            }),
            "density 'mine': the data of element 3 are not finite");
}

TEST(ElementData, FactoriesOfPartsHaveTheirRows) {
  const Sheet s(1);
  const std::vector<Quadrature> rules{lattice_rule(1)};
  const Vec k = random_rows(s.count(), 1).col(0);
  const EnergyFactory whole = energy_factory(density<2, 2>(
      "mine", [](const auto& J, double c) { return c * J.squaredNorm(); }, k));
  const std::vector<double> all = element_values_of(*whole(s.space, s.rest, rules), s.x);
  const std::vector<Index> chosen{7, 2, 30};
  const Cells faces = s.mesh.faces(chosen, Eigen::all);
  const auto space = std::make_shared<const BezierTriangleSpace>(
      faces, static_cast<Index>(s.mesh.positions.rows()), 1);
  const EnergyFactory part = whole.for_elements(chosen);
  EXPECT_EQ(part.traits().elements, 3);
  const std::vector<double> some =
      element_values_of(*part(space, flat_triangles(s.mesh.positions, faces), rules), s.x);
  for (std::size_t q = 0; q < chosen.size(); ++q) EXPECT_EQ(some[q], all[chosen[q]]);
  // Parts of parts; energies without data are their own parts.
  const std::vector<Index> second{1};
  const Cells one = s.mesh.faces(std::vector<Index>{2}, Eigen::all);
  EXPECT_EQ(element_values_of(
                *part.for_elements(second)(std::make_shared<const BezierTriangleSpace>(
                                               one, static_cast<Index>(s.mesh.positions.rows()), 1),
                                           flat_triangles(s.mesh.positions, one), rules),
                s.x)[0],
            all[2]);
  EXPECT_FALSE(symmetric_dirichlet().for_elements(chosen).traits().elements);
  const std::vector<Index> none{s.count()};
  EXPECT_THROW(whole.for_elements(none), InvalidArgument);
}

TEST(ElementData, SumsCheckTheirElementCount) {
  const EnergyFactory of_two = energy_factory(density<2, 2>(
      "two", [](const auto& J, double c) { return c * J.squaredNorm(); }, Vec(Vec::Ones(2))));
  EXPECT_FALSE(knows_elements({{symmetric_dirichlet()}}));
  EXPECT_TRUE(knows_elements({{symmetric_dirichlet()}, {of_two}}));
  const EnergySum weighed{{symmetric_dirichlet(), 2.0, Vec(Vector3(1, 2, 3))}};
  EXPECT_TRUE(knows_elements(weighed));
  EXPECT_NO_THROW(require_elements(weighed, 3));
  EXPECT_EQ(invalid_argument_of([&] { require_elements(weighed, 4); }),
            "energy 'symmetric-dirichlet' has weights for 3 elements, not 4");
  EXPECT_EQ(invalid_argument_of([&] { require_elements({{of_two}}, 3); }),
            "energy 'two' has data for 2 elements, not 3");
  const std::vector<Index> chosen{2, 0};
  const EnergySum part = for_elements(weighed, chosen);
  EXPECT_EQ(part[0].weight, 2.0);
  EXPECT_EQ(part[0].face_weight, Vec(Vector2(3, 1)));
}

// A vertex of a coarse mesh has triangles without data.
TEST(ElementData, StarsAreRefused) {
  const test::Triangles t(1);
  const auto mine = density<2, 2>(
      "mine", [](const auto& J, double c) { return c * J.squaredNorm(); }, Vec(Vec::Ones(1)));
  const auto term = make_energy(t.space, t.rest, mine, {lattice_rule(1)});
  EXPECT_THROW(term->star(StarView{}, Vector2(0, 0)), InvalidArgument);
}

TEST(ElementData, NumbersChangeBetweenSteps) {
  const Sheet s(2);
  const Vec stiffness = random_rows(s.count(), 1).col(0);
  const RowMatrix rows = random_rows(s.count(), 2);
  const auto scalar = make_energy(
      s.space, s.rest,
      density<2, 2>(
          "scaled", [](const auto& J, double k) { return k * J.squaredNorm(); }, stiffness));
  const auto spans = make_energy(
      s.space, s.rest,
      density<2, 2>(
          "scaled", [](const auto& J, auto&& k) { return k[0] * J.squaredNorm() + k[1]; }, rows));
  for (const auto& [term, numbers] : {std::pair{scalar, Vec(stiffness)},
                                      std::pair{spans, Vec(rows.reshaped<Eigen::RowMajor>())}}) {
    ProblemBuilder builder(s.space->node_count() * 2);
    const TermId id = builder.add(term, 3.0);
    const Problem problem = builder.build();
    const Problem doubled = problem.with({{id, {.parameters = 2 * numbers}}});
    const Vec before = element_values(problem, id, s.x), after = element_values(doubled, id, s.x);
    EXPECT_NEAR((after - 2 * before).norm(), 0, 1e-13 * after.norm());
    EXPECT_EQ(doubled.state(id).weight, 3.0);
    EXPECT_EQ(term->parameter_count(), numbers.size());
    EXPECT_THROW(problem.with({{id, {.parameters = Vec::Ones(3)}}}), InvalidArgument);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
