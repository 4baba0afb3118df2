// The library refuses a map whose scale is undetermined, in every interface.
#include "majorant/parametrization/solve/free_scale.h"

#include <gtest/gtest.h>

#include <limits>

#include "expected_error.h"
#include "majorant/energies/make_energy.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

EnergySum energy(const std::vector<const char*>& names) {
  EnergySum sum;
  for (const char* name : names) sum.push_back({find_energy(name)->make, 1.0});
  return sum;
}

ParametrizationOptions options_for(const std::vector<const char*>& names) {
  ParametrizationOptions options;
  options.map.degree = 1;
  options.map.energy = energy(names);
  return options;
}

std::string refusal(const ParametrizationOptions& options) {
  return error_message(ErrorKind::Usage, [&] { parametrize(surface(grid(3, bumpy)), options); });
}

void expect_a_map(const char* what, const ParametrizationOptions& options) {
  SCOPED_TRACE(what);
  const ParametrizationResult r = parametrize(surface(grid(3, bumpy)), options);
  ASSERT_TRUE(r.map.has_value()) << r.message;
  EXPECT_TRUE(r.measures.locally_injective);
  const Points2 corners = r.map->sample({Barycentric(1, 0, 0)});
  EXPECT_GT((corners.colwise().maxCoeff() - corners.colwise().minCoeff()).minCoeff(),
            1e-3);  // above 1e-30
}

TEST(FreeScale, ACollapseIsRefusedWithCauseAndRemedy) {
  const std::string message = refusal(options_for({"asap"}));
  expect_contains(message, {"inline.obj", "the energy asap ", "shrunk to a point", "nothing holds",
                            "fix the boundary", "two points", "add an energy"});
  expect_contains(refusal(options_for({"mips", "asap"})), {"the energy mips + asap "});
}

TEST(FreeScale, UserDensitiesDeclareTheirScale) {
  ParametrizationOptions options = options_for({});
  const auto formula = [](const auto&, const auto& y) { return 4.0 * y; };
  options.map.energy = {{energy_factory(invariant(
      "similar", formula, {.domain = Domain::Everywhere, .free_scale = FreeScale::Collapses}))}};
  expect_contains(refusal(options), {"the energy similar "});
}

TEST(FreeScale, OneHeldPointDoesNotFixIt) {
  ParametrizationOptions options = options_for({"asap"});
  options.map.pins = {{0, {}}};
  refusal(options);
  options.map.pins.clear();
  options.map.handles = {{0, Vector2(1, 2)}};
  refusal(options);
  options.map.handles = {{0, Vector2(1, 2)}, {15, Vector2(1, 2)}};  // both with one target
  refusal(options);
  options.map.handles = {{0, {}}};
  options.map.handles.push_back(
      {15, Vector2(initial_map(*surface(grid(3, bumpy)), options.map).head<2>())});
  refusal(options);  // with the position of the first one as target
}

TEST(FreeScale, TwoPointsOrABoundaryFixIt) {
  ParametrizationOptions options = options_for({"asap"});
  options.map.boundary = BoundaryCondition::Fixed;
  expect_a_map("fixed boundary", options);
  options = options_for({"asap", "mips"});
  options.map.pins = {{0, {}}, {15, {}}};
  expect_a_map("two pins", options);
  options.map.pins.clear();
  options.map.handles = {{0, Vector2(0, 0)}, {15, Vector2(1, 1)}};
  expect_a_map("two handles", options);
  options.map.handles.pop_back();
  options.map.pins = {{15, {}}};
  expect_a_map("a pin and a handle", options);
  expect_a_map("a sum", options_for({"asap", "arap"}));
  expect_a_map("arbitrary", options_for({"mips"}));  // scale-invariant, but it does not collapse
}

TEST(FreeScale, DeformRefusesTheSameCases) {
  const BezierMap rest = planar_map(surface(grid(3, flat)));
  ParametrizationOptions options = options_for({"asap"});
  options.map.handles = {{0, Vector2(1, 1)}, {15, Vector2(1, 1)}};
  RunRecord record(std::numeric_limits<double>::infinity(), 100, nullptr, {});
  error_message(ErrorKind::Usage, [&] { deform(rest, options, record); });
  EXPECT_EQ(record.iterations_left(), 100);  // refused before the first step
}

// Two triangles without a common vertex: components of a cut surface.
TEST(FreeScale, TwoPointsOfOnePieceAreNeeded) {
  Cells faces(2, 3);
  faces << 0, 1, 2, 3, 4, 5;
  const BezierTriangleSpace pieces(faces, 6, 1);
  EXPECT_EQ(vertex_components(pieces), (std::vector<Index>{0, 0, 0, 3, 3, 3}));
  ParametrizationOptions options = options_for({"asap"});
  options.map.pins = {{1, {}}, {4, {}}};
  EXPECT_TRUE(collapses(options.map, pieces, {}));
  options.map.handles = {{5, Vector2(0, 0)}};
  EXPECT_FALSE(collapses(options.map, pieces, {}));
}

TEST(FreeScale, AClosedSurfaceHasNoBoundaryToFix) {
  const auto closed = surface(tetrahedron());
  const BezierTriangleSpace space(closed->faces(), closed->vertex_count(), 1);
  ParametrizationOptions options = options_for({"asap"});
  options.map.boundary = BoundaryCondition::Fixed;
  EXPECT_TRUE(collapses(options.map, space, {}));
  EXPECT_FALSE(collapses(options_for({"arap"}).map, space, {}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
