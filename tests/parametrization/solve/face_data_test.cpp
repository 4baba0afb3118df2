// Energies with data of single faces in whole runs. Data, fibres and summand weights stay with
// their faces through degrees, quadrature rules, normalization and charts. The reported value is
// the minimized sum, computed here by hand.
#include <Eigen/Geometry>
#include <limits>

#include "expected_error.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/parametrization/initialization/start.h"
#include "parametrization/solve/parametrize_expectations.h"
#include "random.h"
#include "singular_values.h"

namespace majorant {
namespace {

using Matrix2 = Eigen::Matrix2d;

std::shared_ptr<const SurfaceMesh> sheet(double size = 1) {
  PolygonMesh mesh = grid(6, bumpy);
  for (Vector3& p : mesh.positions) p = size * Vector3(p.x(), p.y(), 3 * p.z());
  return surface(mesh);
}

// Returns one number per face in [1, most].
Vec numbers(const SurfaceMesh& mesh, double most) {
  test::Random random(17);
  return random.vector(mesh.face_count(), 1, most);
}

// Returns directions in space that are neither constant nor tangential.
Points3 directions(const SurfaceMesh& mesh) {
  Points3 d(mesh.face_count(), 3);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double t = 1.5 * mesh.positions()(mesh.faces()(f, 0), 0);
    d.row(f) << std::cos(t), std::sin(t), 0.3;
  }
  return d;
}

double symmetric_dirichlet_of(const Matrix2& J) {
  return J.squaredNorm() + J.inverse().squaredNorm();
}

// Accurate to 1e-6 on these maps; the finest rule of the hierarchy has thousands of points per
// face.
Quadrature fine_rule(int degree) { return measuring_rules(degree)[1]; }

// Returns the mean of value(face, J) over the surface.
template <class Value>
double mean_of(const BezierMap& map, const Value& value) {
  const Quadrature rule = fine_rule(map.degree());
  const RestShapes rest = rest_shapes(map.mesh());
  double sum = 0;
  for (Index f = 0; f < map.mesh().face_count(); ++f)
    for (Index l = 0; l < rule.size(); ++l)
      sum += rest.measure[f] * rule.weights[l] *
             value(f, map.jacobian(f, Barycentric(rule.points.row(l).transpose())));
  return sum / rest.measure.sum();
}

auto stiff(const Vec& data) {
  return density<2, 2>(
      "stiff",
      [](const auto& J, double k) { return k * (J.squaredNorm() + J.inverse().squaredNorm()); },
      data, {.barrier = Barrier::Strong});
}

auto shear() {
  return density<2, 2>(
      "shear",
      [](const auto& J) {
        const auto along = J(0, 0) * J(0, 0) + J(1, 0) * J(1, 0);
        const auto dot = J(0, 0) * J(0, 1) + J(1, 0) * J(1, 1);
        return (along - 1.0) * (along - 1.0) + 4.0 * dot * dot;
      },
      Traits{.domain = Domain::Everywhere});
}

TEST(FaceData, DataFollowTheFacesThroughTheDegrees) {
  for (const double size : {1.0, 1000.0}) {
    const auto mesh = sheet(size);
    const Vec k = numbers(*mesh, 30);
    ParametrizationOptions options = degree(3);
    options.map.energy = {{energy_factory(stiff(k))}};
    const ParametrizationResult result = parametrize(mesh, options);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    expect_valid(result, 3);
    const double by_hand = mean_of(
        *result.map, [&](Index f, const Matrix2& J) { return k[f] * symmetric_dirichlet_of(J); });
    EXPECT_NEAR(result.measures.value, by_hand, 1e-5 * by_hand);
    EXPECT_NEAR(result.value_quadrature, by_hand, 5e-3 * by_hand);
    // The energy with summand weights equals the energy with data.
    options.map.energy = {{symmetric_dirichlet(), 1.0, k}};
    const ParametrizationResult weighed = parametrize(mesh, options);
    EXPECT_NEAR(weighed.measures.value, result.measures.value, 1e-5 * by_hand);
    EXPECT_LE((weighed.measures.face_value - result.measures.face_value).cwiseAbs().maxCoeff(),
              2e-3 * result.measures.face_value.maxCoeff());
    // The energy without data differs.
    options.map.energy = {{symmetric_dirichlet()}};
    EXPECT_GT(mean_of(*parametrize(mesh, options).map,
                      [&](Index f, const Matrix2& J) { return k[f] * symmetric_dirichlet_of(J); }),
              1.0001 * by_hand);
  }
}

TEST(FaceData, WeightsOfSummandsAndOfTheSumMultiply) {
  const auto mesh = sheet();
  const Vec first = numbers(*mesh, 5), second = first.reverse(), whole = numbers(*mesh, 3);
  const double arap_weight = 0.25;
  const EnergySum sum{{symmetric_dirichlet(), 2.0, first},
                      {find_energy("arap")->make, arap_weight, second},
                      {mips()}};
  const auto value = [&](Index f, const Matrix2& J) {
    const double arap = (test::singular_values(J).array() - 1).square().sum();
    return 2 * first[f] * symmetric_dirichlet_of(J) + arap_weight * second[f] * arap +
           J.squaredNorm() / J.determinant();
  };
  ParametrizationOptions options = degree(2);
  options.map.energy = sum;
  options.map.face_weight = whole;
  const ParametrizationResult result = parametrize(mesh, options);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  // Face weights of the whole sum are in the minimized value, not in the measured one.
  const double measured = mean_of(*result.map, value);
  const double minimized =
      mean_of(*result.map, [&](Index f, const Matrix2& J) { return whole[f] * value(f, J); });
  EXPECT_NEAR(result.measures.value, measured, 1e-5 * measured);
  EXPECT_NEAR(result.value_quadrature, minimized, 5e-3 * minimized);

  // The terms of a map's problem: assembled, by face, and with additional face weights.
  MapSpecification spec(options.map);
  spec.rest = std::make_shared<const RestShapes>(rest_shapes(*mesh));
  const auto space = result.map->shared_space();
  const Vec& x = result.map->control_points();
  const Quadrature fine = fine_rule(2);
  const DensityTerms terms = energy_terms(spec, space, {fine});
  EXPECT_NEAR(energy_of_map(spec, terms, {}, x), minimized, 1e-9 * minimized);
  const MapProblem built = map_problem(spec, space, x, terms, nullptr);
  EXPECT_NEAR(Evaluator(built.problem).value(built.problem.reduce(x)), minimized, 1e-9 * minimized);
  const Vec more = Vec::LinSpaced(mesh->face_count(), 0, 1);
  const Problem reweighed = built.problem.with(energy_states(spec, built.energies, {}, more));
  const double expected = mean_of(
      *result.map, [&](Index f, const Matrix2& J) { return more[f] * whole[f] * value(f, J); });
  EXPECT_NEAR(Evaluator(reweighed).value(reweighed.reduce(x)), expected, 1e-9 * expected);
}

PolygonMesh with_corners_turned(const SurfaceMesh& mesh, const Eigen::Matrix3d& turn) {
  std::vector<Vector3> positions;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    positions.push_back(turn * mesh.positions().row(v).transpose());
  std::vector<std::vector<Index>> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](Index k) { return mesh.faces()(f, (k + f) % 3); };
    faces.push_back({corner(0), corner(1), corner(2)});
  }
  return polygon_mesh(std::move(positions), std::move(faces));
}

// The result depends neither on a rotation of surface and fibres nor on the first corners of faces.
TEST(FaceData, FibresTurnWithTheSurface) {
  const auto mesh = sheet();
  const Points3 fibres = directions(*mesh);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  const auto other = surface(with_corners_turned(*mesh, turn));
  const auto energy = [&](const SurfaceMesh& on, const Points3& along_what) {
    return EnergySum{{symmetric_dirichlet()},
                     {along(in_frames(on, along_what), energy_factory(shear())), 0.5}};
  };
  ParametrizationOptions options = degree(3);
  options.map.energy = energy(*mesh, fibres);
  const ParametrizationResult a = parametrize(mesh, options);
  EXPECT_EQ(a.status, Status::Converged) << a.message;
  options.map.energy = energy(*other, fibres * turn.transpose());
  const ParametrizationResult b = parametrize(other, options);
  EXPECT_NEAR(a.measures.value, b.measures.value, 1e-5 * a.measures.value);
  // Computed by hand: the image of the fibre in any frame.
  const RowMatrix in = in_frames(*mesh, fibres);
  const double by_hand = mean_of(*a.map, [&](Index f, const Matrix2& J) {
    const Vector2 d = in.row(f).transpose().normalized(), n(-d.y(), d.x());
    const Vector2 u = J * d, v = J * n;
    return symmetric_dirichlet_of(J) +
           0.5 * (std::pow(u.squaredNorm() - 1, 2) + 4 * std::pow(u.dot(v), 2));
  });
  EXPECT_NEAR(a.measures.value, by_hand, 1e-5 * by_hand);
  // Without fibres the result depends on first corners.
  options.map.energy = {{symmetric_dirichlet()}, {energy_factory(shear()), 0.5}};
  EXPECT_GT(std::abs(parametrize(mesh, options).measures.value -
                     parametrize(other, options).measures.value),
            1e-4);
}

TEST(FaceData, FibresAndDataTogetherOnParts) {
  const auto mesh = sheet();
  const Vec k = numbers(*mesh, 5);
  const RowMatrix fibres = in_frames(*mesh, directions(*mesh));
  const auto pulled = density<2, 2>(
      "pulled", [](const auto& J, double c) { return c * J(0, 0) * J(0, 0); }, k);
  const EnergyFactory both = along(fibres, energy_factory(pulled));
  EXPECT_EQ(both.traits().elements, mesh->face_count());
  EXPECT_THROW(along(RowMatrix(fibres.topRows(3)), energy_factory(pulled)), InvalidArgument);
  const BezierMap map = BezierMap::linear(mesh, tutte_map(*mesh));
  const std::vector<Index> chosen{9, 0, 33};
  const auto space = std::make_shared<const BezierTriangleSpace>(
      Cells(mesh->faces()(chosen, Eigen::all)), mesh->vertex_count(), 1);
  const RestShapes all = rest_shapes(*mesh);
  RestShapes rest;
  rest.inverse = all.inverse(chosen, Eigen::all);
  rest.measure = all.measure(chosen);
  const auto part = both.for_elements(chosen)(space, rest, {lattice_rule(1)});
  const Vec values = element_values(
      *part, TermState{}, ColoredBatches(part->element_dofs(), {0, 0, 0}), map.control_points());
  for (Index q = 0; q < 3; ++q) {
    const Index f = chosen[q];
    const Vector2 u =
        map.jacobian(f, Barycentric::Constant(1.0 / 3)) * fibres.row(f).transpose().normalized();
    EXPECT_NEAR(values[q], all.measure[f] * k[f] * u.x() * u.x(), 1e-12);
  }
}

TEST(FaceData, BijectiveRunsAndFixedBoundariesHaveThemToo) {
  const auto mesh = sheet();
  const Vec k = numbers(*mesh, 30);
  for (const bool global : {false, true}) {
    ParametrizationOptions options = degree(2);
    options.map.energy = {{energy_factory(stiff(k))}};
    if (global) options.map.injectivity = MapInjectivity::Global;
    if (!global) options.map.boundary = BoundaryCondition::Fixed;
    const ParametrizationResult result = parametrize(mesh, options);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    const double by_hand = mean_of(
        *result.map, [&](Index f, const Matrix2& J) { return k[f] * symmetric_dirichlet_of(J); });
    EXPECT_NEAR(result.measures.value, by_hand, 1e-5 * by_hand);
  }
}

// An energy with face data starts from Tutte's map, since coarse surfaces have other faces.
TEST(FaceData, StartsFromTheFinestSurface) {
  const auto mesh = sheet();
  ParametrizationOptions options = degree(1);
  options.map.start = StartMethod::Multiresolution;
  options.map.energy = {{energy_factory(stiff(numbers(*mesh, 2)))}};
  EXPECT_EQ(parametrize(mesh, options).start, StartMethod::Tutte);
}

TEST(FaceData, DataOfAnotherSizeAreRefused) {
  const auto mesh = sheet();
  const Index faces = mesh->face_count();
  const auto refused = [&](const EnergySum& energy) {
    ParametrizationOptions options = degree(1);
    options.map.energy = energy;
    return error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
  };
  for (const Index wrong : {faces - 1, faces + 1, Index(0)})
    expect_contains(refused({{energy_factory(stiff(Vec::Ones(wrong)))}}),
                    {"'stiff'", std::to_string(wrong), std::to_string(faces)});
  expect_contains(refused({{along(RowMatrix::Ones(3, 2), symmetric_dirichlet())}}),
                  {"'symmetric-dirichlet'", "3 faces"});
  Vec weight = Vec::Ones(faces);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    weight[4] = bad;
    expect_contains(refused({{symmetric_dirichlet(), 1.0, weight}}), {"face weight [4]"});
  }
  expect_contains(refused({{symmetric_dirichlet(), 1.0, Vec::Ones(faces - 1)}}), {"face weights"});
  ParametrizationOptions options = degree(1);
  options.solve.triangles = Triangles::Flipped;
  options.map.energy = {{energy_factory(stiff(Vec::Ones(faces)))}};
  expect_contains(error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); }),
                  {"flipping", "data"});
  EXPECT_THROW(measure_map(BezierMap::linear(mesh, tutte_map(*mesh)),
                           {{energy_factory(stiff(Vec::Ones(faces - 1)))}}),
               InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
