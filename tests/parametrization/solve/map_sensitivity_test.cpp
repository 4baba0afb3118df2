// Derivatives of maps of parametrize() and deform() with respect to their data, against Richardson
// extrapolated central differences of whole runs. Maps without derivatives are refused by name.
#include "majorant/parametrization/solve/map_sensitivity.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>

#include "expected_error.h"
#include "majorant/energies/make_energy.h"
#include "majorant/maps/map_extension.h"
#include "parametrization/initialization/seamless_cases.h"
#include "parametrization/solve/parametrize_expectations.h"
#include "random.h"

namespace majorant {
namespace map_sensitivities {

std::shared_ptr<const SurfaceMesh> bumpy(Index n, const RowMatrix& moved = {}) {
  PolygonMesh mesh = grid(static_cast<int>(n));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vector3& p = mesh.positions[v];
    p.z() = 0.25 * std::sin(4 * p.x() + 0.5) * std::cos(3 * p.y());
    if (moved.rows() > 0) p += moved.row(static_cast<Index>(v)).transpose();
  }
  return surface(mesh);
}

ParametrizationResult flattened(const std::shared_ptr<const SurfaceMesh>& mesh,
                                ParametrizationOptions options) {
  options.solve.tolerance = 1e-13;
  return parametrize(mesh, options);
}

// Returns the map of a run and exact steps after it; its derivatives are tested.
BezierMap exact_map(const std::shared_ptr<const SurfaceMesh>& mesh,
                    const ParametrizationOptions& options) {
  return MapSensitivity(flattened(mesh, options), options).map();
}

using Change = MapSensitivity::Change;
using Derivative = MapSensitivity::Derivative;
using MapAt = std::function<BezierMap(double t)>;

Vec extrapolated(const MapAt& map, double h = 4e-3) {
  const auto difference = [&](double step) {
    return Vec((map(step).control_points() - map(-step).control_points()) / (2 * step));
  };
  const Vec d1 = difference(h), d2 = difference(h / 2), d3 = difference(h / 4);
  return (16 * (4 * d3 - d2) - (4 * d2 - d1)) / 45;
}

void expect_close(const Vec& found, const Vec& expected) {
  EXPECT_GT(expected.norm(), 1e-3);
  EXPECT_LE((found - expected).norm(), 1e-7 * expected.norm());
}

// Two pins or more, weights, faces, data and, at degree 1, the surface, all at once.
TEST(MapSensitivity, OfPinnedMaps) {
  const auto mesh = bumpy(5);
  test::Random random(3);
  const Index n = mesh->vertex_count(), faces = mesh->face_count();
  ParametrizationOptions options;
  const Vec stiffness = Vec::LinSpaced(faces, 1, 2);
  const auto soft = [&](const Vec& k) {
    return energy_factory(density<2, 2>(
        "soft", [](const auto& J, double s) { return s * J.squaredNorm(); }, k));
  };
  options.map.pins = {{0, Vector2(0, 0)}, {5, Vector2(1.1, 0.05)}, {n - 1, Vector2(1, 1.05)}};
  options.map.face_weight = Vec::LinSpaced(faces, 1, 1.5);
  const Change by{.pins = {{0.3, -0.2}, {0.1, 0.4}, {-0.5, 0.2}},
                  .weights = Vec{{0.4, 0.3}},
                  .face_weights = random.vector(faces),
                  .parameters = {{}, random.vector(faces)}};
  for (const int degree : {1, 2, 3}) {
    SCOPED_TRACE(degree);
    options.map.degree = degree;
    Change change = by;
    if (degree == 1) {
      change.positions.resize(n, 3);
      for (double& entry : change.positions.reshaped()) entry = 0.3 * random.uniform();
    }
    const auto at = [&](double t) {
      ParametrizationOptions o = options;
      for (std::size_t k = 0; k < o.map.pins.size(); ++k) *o.map.pins[k].target += t * by.pins[k];
      o.map.face_weight += t * by.face_weights;
      o.map.energy = {{symmetric_dirichlet(), 1 + t * by.weights[0]},
                      {soft(stiffness + t * by.parameters[1]), 0.1 + t * by.weights[1]}};
      return std::pair{degree == 1 ? bumpy(5, t * change.positions) : mesh, o};
    };
    const auto [same, requested] = at(0);
    const ParametrizationResult result = flattened(same, requested);
    const MapSensitivity s(result, requested);
    EXPECT_EQ(s.motions(), 0);
    EXPECT_LT(s.error(), 1e-8);
    const Vec moved = s.forward(change);
    expect_close(moved, extrapolated([&](double t) {
                   const auto [m, o] = at(t);
                   return exact_map(m, o);
                 }));
    const Vec slope = random.vector(moved.size());
    const Derivative d = s.adjoint(slope);
    double product = d.weights.dot(by.weights) + d.face_weights.dot(by.face_weights) +
                     d.parameters[1].dot(by.parameters[1]);
    for (std::size_t k = 0; k < by.pins.size(); ++k) product += d.pins[k].dot(by.pins[k]);
    ASSERT_EQ(d.positions.has_value(), degree == 1);
    if (d.positions) product += d.positions->cwiseProduct(change.positions).sum();
    EXPECT_NEAR(product, slope.dot(moved), 1e-8 * slope.norm() * moved.norm());
    if (degree > 1) {
      change.positions = Points3::Zero(n, 3);
      expect_contains(error_message(ErrorKind::Unsupported, [&] { s.forward(change); }),
                      {"degree " + std::to_string(degree)});
    }
  }
}

// Returns dx without its component along rigid motions of the plane.
Vec without_motions(const BezierMap& map, Vec dx) {
  const Vec& x = map.control_points();
  Eigen::MatrixXd v = Eigen::MatrixXd::Zero(x.size(), 3);
  for (Index k = 0; k < x.size(); k += 2) {
    v(k, 0) = v(k + 1, 1) = 1;
    v(k, 2) = -x[k + 1];
    v(k + 1, 2) = x[k];
  }
  return dx - v * (v.transpose() * v).ldlt().solve(v.transpose() * dx);
}

TEST(MapSensitivity, OfFreeMapsHasTheLeastNormOrKeepsAGauge) {
  const Index n = 4;
  const auto mesh = bumpy(n);
  ParametrizationOptions options;
  options.map.degree = 1;
  options.map.energy = {{symmetric_dirichlet(), 1}, {find_energy("asap")->make, 0.2}};
  const ParametrizationResult result = flattened(mesh, options);
  const MapSensitivity s(result, options), held(result, options, {.gauge = {{2, 17}}});
  EXPECT_EQ(s.motions(), 3);
  test::Random random(4);
  Change change{.weights = Vec{{0.2, 0.5}}, .positions = Points3(mesh->vertex_count(), 3)};
  for (double& entry : change.positions.reshaped()) entry = 0.3 * random.uniform();
  const auto at = [&](double t) {
    ParametrizationOptions o = options;
    o.map.energy[0].weight += t * change.weights[0];
    o.map.energy[1].weight += t * change.weights[1];
    return exact_map(bumpy(n, t * change.positions), o);
  };
  // Runs fix a vertex, and the start rotates with the surface: only shapes are comparable.
  const auto turned = [&](double t) {
    const BezierMap map = at(t);
    const Vec& x = map.control_points();
    const Vector2 a = x.segment<2>(4), b = x.segment<2>(34), u = (b - a).normalized();
    const Vec& x0 = s.map().control_points();
    const Vector2 u0 = (x0.segment<2>(34) - x0.segment<2>(4)).normalized();
    Eigen::Matrix2d q;
    q << u.x(), -u.y(), u.y(), u.x();
    Eigen::Matrix2d q0;
    q0 << u0.x(), -u0.y(), u0.y(), u0.x();
    Vec out = x;
    for (Index k = 0; k < x.size(); k += 2)
      out.segment<2>(k) = x0.segment<2>(4) + q0 * q.transpose() * (x.segment<2>(k) - a);
    return map.with(map.shared_space(), out);
  };
  const Vec expected = extrapolated(turned);
  expect_close(held.forward(change), expected);
  expect_close(s.forward(change), without_motions(s.map(), expected));
  for (const MapSensitivity* one : {&s, &held}) {
    const Vec slope = random.vector(expected.size()), dx = one->forward(change);
    const Derivative d = one->adjoint(slope);
    EXPECT_NEAR(d.weights.dot(change.weights) + d.positions->cwiseProduct(change.positions).sum(),
                slope.dot(dx), 1e-8 * slope.norm() * dx.norm());
  }
}

TEST(MapSensitivity, OfDeformations) {
  const auto mesh = surface(grid(6));
  const BezierMap rest = planar_map(mesh);
  const Index n = mesh->vertex_count();
  for (const int degree : {1, 2}) {
    SCOPED_TRACE(degree);
    ParametrizationOptions options;
    options.map.degree = degree;
    options.map.handle_weight = 20;
    options.map.pins = {{0, Vector2(0, 0)}};
    options.map.handles = {{n - 1, Vector2(1.3, 1.2)}, {6, Vector2(1.1, -0.1)}};
    options.solve.tolerance = 1e-13;
    const Change by{.pins = {{0.2, 0.1}}, .handles = {{0.4, -0.3}, {0.1, 0.2}}, .handle_weight = 5};
    const auto requested = [&](double t) {
      ParametrizationOptions o = options;
      *o.map.pins[0].target += t * by.pins[0];
      for (std::size_t k = 0; k < 2; ++k) *o.map.handles[k].target += t * by.handles[k];
      o.map.handle_weight += t * by.handle_weight;
      return o;
    };
    const auto run = [&](double t) {
      RunRecord record;
      return MapSensitivity(deform(rest, requested(t), record), requested(t));
    };
    const MapSensitivity s = run(0);
    const Vec dx = s.forward(by);
    expect_close(dx, extrapolated([&](double t) { return run(t).map(); }));
    const Vec slope = test::Random(8).vector(dx.size());
    const Derivative d = s.adjoint(slope);
    double product = d.pins[0].dot(by.pins[0]) + d.handle_weight * by.handle_weight;
    for (std::size_t k = 0; k < 2; ++k) product += d.handles[k].dot(by.handles[k]);
    EXPECT_NEAR(product, slope.dot(dx), 1e-8 * slope.norm() * dx.norm());
  }
}

// A run that stopped early is continued by exact steps; a run for which they fail is refused.
TEST(MapSensitivity, OfRunsThatStoppedAtATolerance) {
  const auto mesh = bumpy(5);
  ParametrizationOptions options;
  options.map.degree = 2;
  options.map.pins = {{0, {}}, {35, {}}};
  options.map.initial = initial_map(*mesh, options.map);
  options.solve.tolerance = 1e-4;
  const ParametrizationResult rough = parametrize(mesh, options);
  const MapSensitivity s(rough, options), exact(flattened(mesh, options), options);
  EXPECT_GT(s.moved(), 1e-8);
  EXPECT_LT(s.error(), 1e-9);
  const Change by{.pins = {{1, 0}, {0, 1}}};
  expect_close(s.forward(by), exact.forward(by));
}

TEST(MapSensitivity, RefusesMapsWithoutDerivatives) {
  const auto mesh = bumpy(4);
  ParametrizationOptions options;
  options.map.degree = 1;
  const ParametrizationResult good = parametrize(mesh, options);
  const auto refused = [&](const ParametrizationResult& result, const ParametrizationOptions& o,
                           const char* what) {
    expect_contains(error_message(ErrorKind::Unsupported, [&] { MapSensitivity(result, o); }),
                    {what});
  };
  ParametrizationResult none = good;
  none.map.reset();
  refused(none, options, "no map");
  ParametrizationOptions other = options;
  other.extend = [](MapExtension&) {};
  refused(good, other, "added");
  other = options;
  other.map.aligned = {0};
  refused(good, other, "aligned");
  other = options;
  other.solve.triangles = Triangles::Flipped;
  refused(good, other, "flipped");
  // Without active scaffold the map is the same, and has derivatives.
  other = options;
  other.map.injectivity = MapInjectivity::Global;
  EXPECT_NO_THROW(MapSensitivity(parametrize(mesh, other), other));
  refused(parametrize(surface(saddle_fan()), other), other, "scaffold");
  RunRecord record;
  const SeamlessCase cube = squares_case(unit_cube(), 2, Charts::OneWithoutSlits);
  refused(parametrize(cube.start().map, options, record), options, "seamless");
}

}  // namespace map_sensitivities
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
