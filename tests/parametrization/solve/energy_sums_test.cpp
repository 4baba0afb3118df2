// Weighted sums of energies and face weights: the optimizer minimizes the requested sum.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "expected_error.h"
#include "majorant/framework/problem.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "mesh/obj_file.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

EnergySum named(const std::vector<std::pair<const char*, double>>& summands) {
  EnergySum sum;
  for (const auto& [name, weight] : summands) sum.push_back({find_energy(name)->make, weight});
  return sum;
}

struct Linearized {
  double value, linearized_value;
  Vec gradient, hessian;
};

// The whole problem of `energy` with face weights, at a map of degree 2.
struct Sheet {
  Sheet() : mesh(test::grid(5, 4, 0.2, 0.3)) {
    space = std::make_shared<const BezierTriangleSpace>(
        mesh.faces, static_cast<Index>(mesh.positions.rows()), 2);
    spec.rest = std::make_shared<const RestShapes>(flat_triangles(mesh.positions, mesh.faces));
    x = test::linear_map(*space, test::flat(mesh.positions));
    x += test::Random(6).vector(x.size(), -0.05, 0.05);
  }
  Problem problem(const EnergySum& energy, const Vec& face_weight = {}) const {
    MapSpecification s = spec;
    s.energy = energy;
    s.face_weight = face_weight;
    return map_problem(s, space, x, energy_terms(s, space, {radon_rule()}),
                       std::make_shared<const LocalInjectivity>(space, 2 * s.rest->measure))
        .problem;
  }
  Linearized at(const Problem& p, Curvature c = Curvature::Projected) const {
    Linearized out;
    Evaluator evaluator(p);
    const Vec y = p.reduce(x);
    out.value = evaluator.value(y);
    out.linearized_value = evaluator.linearize(y, c, out.gradient, out.hessian);
    return out;
  }
  test::Mesh mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  MapSpecification spec;
  Vec x;
};

TEST(EnergySums, AreSums) {
  const Sheet s;
  const std::string first = "symmetric-dirichlet";
  for (const NamedEnergy& second : named_energies())
    for (const Curvature c : {Curvature::Exact, Curvature::Projected}) {
      const auto a = s.at(s.problem(named({{first.c_str(), 1}})), c);
      const auto b = s.at(s.problem(named({{second.name.c_str(), 1}})), c);
      const auto sum = s.at(s.problem(named({{first.c_str(), 1}, {second.name.c_str(), 0.1}})), c);
      EXPECT_NEAR(sum.value, a.value + 0.1 * b.value, 1e-13 * sum.value) << second.name;
      EXPECT_NEAR(sum.linearized_value, sum.value, 1e-13 * sum.value);
      EXPECT_LE((sum.gradient - a.gradient - 0.1 * b.gradient).norm(), 1e-13 * a.hessian.norm());
      EXPECT_LE((sum.hessian - a.hessian - 0.1 * b.hessian).norm(), 1e-13 * sum.hessian.norm());
      EXPECT_GT((0.1 * b.gradient).norm(), 1e-6);
    }
}

// The result does not depend on the order of summands or on a split of one into two halves.
TEST(EnergySums, OrderAndSplittingDoNotMatter) {
  const Sheet s;
  const auto a = s.at(s.problem(named({{"mips", 0.5}, {"arap", 2}})));
  const auto b = s.at(s.problem(named({{"arap", 1}, {"mips", 0.5}, {"arap", 1}})));
  EXPECT_NEAR(a.value, b.value, 1e-13 * a.value);
  EXPECT_LE((a.gradient - b.gradient).norm(), 1e-13 * a.hessian.norm());
}

TEST(FaceWeights, MultiplyTheDensityOfTheirFace) {
  const Sheet s;
  const Index faces = s.space->element_count();
  const EnergySum energy = named({{"symmetric-dirichlet", 1}, {"asap", 0.3}});
  const auto plain = s.at(s.problem(energy));
  const auto ones = s.at(s.problem(energy, Vec::Ones(faces)));
  EXPECT_EQ(plain.value, ones.value);
  EXPECT_EQ(plain.gradient, ones.gradient);
  const auto tripled = s.at(s.problem(energy, Vec::Constant(faces, 3)));
  EXPECT_NEAR(tripled.value, 3 * plain.value, 1e-13 * tripled.value);
  EXPECT_LE((tripled.hessian - 3 * plain.hessian).norm(), 1e-13 * tripled.hessian.norm());
  // The energy is linear in the weights of faces.
  const Vec w = test::Random(2).vector(faces, 0.1, 5);
  double sum = 0;
  for (Index f = 0; f < faces; ++f) {
    Vec one = Vec::Ones(faces);
    one[f] = 2;
    sum += w[f] * (s.at(s.problem(energy, one)).value - plain.value);
  }
  const auto weighted = s.at(s.problem(energy, w));
  EXPECT_NEAR(weighted.value, sum, 1e-11 * sum);
  // energy_by_face, which controls quadrature and the soft start, includes them.
  MapSpecification spec = s.spec;
  spec.energy = energy;
  spec.face_weight = w;
  const Vec by_face = energy_by_face(spec, energy_terms(spec, s.space, {radon_rule()}), {}, s.x);
  EXPECT_NEAR(by_face.sum() / s.spec.rest->measure.sum(), weighted.value, 1e-13 * weighted.value);
}

// ---- Whole runs ----

double mean_over(const ParametrizationResult& r, const Vec& area, const std::vector<bool>& region,
                 bool inside) {
  double sum = 0, total = 0;
  for (Index f = 0; f < area.size(); ++f)
    if (region[static_cast<std::size_t>(f)] == inside) {
      sum += area[f] * r.measures.face_value[f];
      total += area[f];
    }
  return sum / total;
}

TEST(FaceWeights, ConstantWeightsChangeNothing) {
  const auto mesh = generated("cap");
  for (const int n : {1, 2}) {
    ParametrizationOptions options = degree(n);
    const auto plain = parametrize(mesh, options);
    for (const double c : {1.0, 8.0, 0.3}) {
      options.map.face_weight = Vec::Constant(mesh->face_count(), c);
      const auto weighted = parametrize(mesh, options);
      expect_valid(weighted, n);
      // The reported energy is unweighted.
      EXPECT_NEAR(weighted.measures.value, plain.measures.value, 1e-6 * plain.measures.value) << c;
      EXPECT_NEAR(weighted.value_quadrature, c * plain.value_quadrature,
                  1e-6 * weighted.value_quadrature);
    }
  }
}

TEST(FaceWeights, AHeavyRegionIsLessDistorted) {
  const auto mesh = generated("wavy_disk");
  const RestShapes rest = flat_triangles(mesh->positions(), mesh->faces());
  std::vector<bool> region;
  for (Index f = 0; f < mesh->face_count(); ++f) {
    Vector3 centre = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      centre += mesh->positions().row(mesh->faces()(f, k)).transpose() / 3;
    const Vector3 middle = mesh->positions().colwise().mean();
    region.push_back(centre.x() > middle.x());
  }
  for (const int n : {1, 2}) {
    ParametrizationOptions options = degree(n);
    const auto plain = parametrize(mesh, options);
    options.map.face_weight = Vec::Ones(mesh->face_count());
    for (Index f = 0; f < mesh->face_count(); ++f)
      if (region[static_cast<std::size_t>(f)]) options.map.face_weight[f] = 100;
    const auto heavy = parametrize(mesh, options);
    expect_valid(heavy, n);
    const double inside = mean_over(plain, rest.measure, region, true),
                 heavy_inside = mean_over(heavy, rest.measure, region, true);
    EXPECT_LT(heavy_inside - 4, 0.95 * (inside - 4)) << "degree " << n;
    EXPECT_GT(mean_over(heavy, rest.measure, region, false),
              mean_over(plain, rest.measure, region, false));
    EXPECT_GE(heavy.measures.value, plain.measures.value);
  }
}

TEST(FaceWeights, Refusals) {
  const auto mesh = generated("cap");
  ParametrizationOptions options = degree(1);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    options.map.face_weight = Vec::Ones(mesh->face_count());
    options.map.face_weight[17] = bad;
    error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
  }
  options.map.face_weight = Vec::Ones(3);
  error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
  options.map.face_weight = {};
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    options.map.energy = named({{"mips", 1}, {"arap", bad}});
    error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
    options.map.energy = named({{"mips", 1}});
    options.map.handle_weight = bad;
    error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
    options.map.handle_weight = 1e3;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
