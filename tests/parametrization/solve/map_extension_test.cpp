// Additions of a caller to parametrize(). Each has the effect of the equivalent MapOptions request,
// if one exists, and holds at every degree and on every domain. It is reported, and errors name it.
#include <cmath>
#include <limits>

#include "expected_error.h"
#include "majorant/constraints/constraints.h"
#include "majorant/framework/terms/quadratic_penalty.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/obj_file.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

Vector2 place(const ParametrizationResult& r, Index v) {
  return r.map->control_points().segment<2>(2 * v);
}

double difference(const ParametrizationResult& a, const ParametrizationResult& b) {
  return (a.map->control_points() - b.map->control_points()).cwiseAbs().maxCoeff();
}

// Soft handles as a caller's term: the same minimum, and the report has the term's value.
TEST(MapExtension, ATermIsEquivalentToHandles) {
  const auto mesh = generated("cap");
  const std::vector<Pin> handles{{3, Vector2(0.3, 0.1)}, {40, Vector2(-0.2, 0.4)}};
  for (const int n : {1, 2}) {
    ParametrizationOptions options = degree(n);
    options.map.handles = handles;
    options.map.handle_weight = 0.7;
    const ParametrizationResult expected = parametrize(mesh, options);
    options.map.handles.clear();
    int calls = 0;
    options.extend = [&](MapExtension& map) {
      EXPECT_EQ(map.degree(), ++calls);
      EXPECT_EQ(&map.mesh(), mesh.get());
      EXPECT_EQ(map.start().size(), 2 * map.space().node_count());
      EXPECT_NEAR(map.rest().measure.sum(), mesh->area() * map.scale() * map.scale(), 1e-12);
      std::vector<FixedPoint> points;
      for (const Pin& p : handles) points.push_back({p.vertex, *p.target * map.scale()});
      map.add(std::make_shared<const QuadraticPenalty>(FixedPoints(points)),
              0.7 / map.rest().measure.sum());
    };
    const ParametrizationResult result = parametrize(mesh, options);
    EXPECT_EQ(calls, n);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    expect_valid(result, n);
    EXPECT_LT(difference(result, expected), 1e-5);
    EXPECT_NEAR(result.value_quadrature, expected.value_quadrature, 1e-9);
    ASSERT_EQ(result.terms.size(), 1u);
    double off = 0;
    for (const Pin& p : handles) off += (place(result, p.vertex) - *p.target).squaredNorm();
    const double area = mesh->area();
    EXPECT_NEAR(result.terms[0].weight * result.terms[0].energy, 0.7 * off / area, 1e-12);
    EXPECT_NEAR(result.value_quadrature,
                result.measures.value + result.terms[0].weight * result.terms[0].energy,
                1e-4 * result.measures.value);
    EXPECT_EQ(result.start, StartMethod::Tutte);
  }
}

// Pins as a caller's constraint with real coefficients: a rotated frame.
TEST(MapExtension, AConstraintIsEquivalentToPins) {
  const auto mesh = generated("cap");
  const Vec start = tutte_map(*mesh);
  const std::vector<Index> pinned{3, 40, 120};
  for (const MapInjectivity injectivity : {MapInjectivity::Local, MapInjectivity::Global}) {
    ParametrizationOptions options = degree(2);
    options.map.injectivity = injectivity;
    options.map.initial = start;
    for (const Index v : pinned) options.map.pins.push_back({v, std::nullopt});
    const ParametrizationResult expected = parametrize(mesh, options);
    options.map.pins.clear();
    struct Turned final : Constraint {
      std::vector<FixedPoint> points;
      void append_rows(ConstraintRows& rows) const override {
        for (const FixedPoint& p : points)
          for (const double angle : {0.3, 1.1, 2.0}) {  // the third depends on the others
            rows.begin_row("turned " + std::to_string(p.node));
            rows.add(2 * p.node, std::cos(angle));
            rows.add(2 * p.node + 1, std::sin(angle));
            rows.end_row(p.position.dot(Vector2(std::cos(angle), std::sin(angle))));
          }
      }
    };
    options.extend = [&](MapExtension& map) {
      Turned turned;
      for (const Index v : pinned) turned.points.push_back({v, map.start().segment<2>(2 * v)});
      map.add(turned);
    };
    const ParametrizationResult result = parametrize(mesh, options);
    EXPECT_EQ(result.status, expected.status) << result.message;
    expect_valid(result, 2);
    EXPECT_EQ(result.variables, expected.variables);
    for (const Index v : pinned)
      EXPECT_LT((place(result, v) - start.segment<2>(2 * v)).norm(), 1e-13) << v;
    EXPECT_NEAR(result.measures.value, expected.measures.value, 1e-5 * expected.measures.value);
  }
}

// These constraints restrict translations only: the energy is that of the free map.
TEST(MapExtension, TranslationsAreNotHeldTwice) {
  const auto mesh = generated("cap");
  const double free = parametrize(mesh, degree(1)).measures.value;
  const auto with = [&](const auto& add) {
    ParametrizationOptions options = degree(1);
    options.extend = add;
    const ParametrizationResult result = parametrize(mesh, options);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_NEAR(result.measures.value, free, 1e-7 * free);
    return result;
  };
  const auto first = with([](MapExtension& map) {
    map.add(FixedUnknowns({{2 * 40, 0.25 * map.scale()}}));
  });
  EXPECT_EQ(place(first, 40).x(), 0.25);
  struct Diagonal final : Constraint {
    void append_rows(ConstraintRows& rows) const override {
      rows.begin_row("diagonal");
      rows.add(80, 0.6);
      rows.add(81, 0.8);
      rows.end_row(0.5);
    }
  };
  const auto second = with([](MapExtension& map) { map.add(Diagonal()); });
  EXPECT_EQ(second.variables, first.variables);
  const auto third = with([](MapExtension& map) {
    const std::vector<FixedPoint> soft{{40, Vector2(0.1, 0.2) * map.scale()}};
    map.add(std::make_shared<const QuadraticPenalty>(FixedPoints(soft)), 10);
  });
  EXPECT_LT((place(third, 40) - Vector2(0.1, 0.2)).norm(), 1e-7);
  EXPECT_EQ(third.variables, first.variables + 2);
  // A spring between two points does not restrict translations.
  const auto fourth = with([](MapExtension& map) {
    const std::vector<LinearExpression> nothing{{{{80, 1}, {82, -1}, {84, 0.0}}, 0}};
    map.add(std::make_shared<const QuadraticPenalty>(nothing), 1e-12);
  });
  EXPECT_EQ(fourth.variables, first.variables);
}

// Restricts the map to a disk smaller than the free map by feasibility, without barrier.
class InsideDisk final : public FeasibilityChecker {
 public:
  explicit InsideDisk(double radius) : radius_(radius) {}
  std::string_view name() const override { return "inside the disk"; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    verdict.margin = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < x.size() / 2; ++k)
      verdict.margin = std::min(verdict.margin, radius_ - x.segment<2>(2 * k).norm());
    verdict.feasible = verdict.margin > 0;
    return verdict;
  }
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }

 private:
  double radius_;
};

TEST(MapExtension, ACheckerHoldsAtEveryStepAndHasItsVerdict) {
  const auto mesh = generated("cap");
  for (const MapInjectivity injectivity : {MapInjectivity::Local, MapInjectivity::Global}) {
    ParametrizationOptions options = degree(2);
    options.map.injectivity = injectivity;
    double farthest = 0;
    const auto add = [&](double radius) {
      return [&farthest, radius](MapExtension& map) {
        map.add(std::make_shared<const InsideDisk>(radius * map.scale()));
        map.observe([&farthest, scale = map.scale()](const TraceEntry&, const MapView& at) {
          const VecIn& x = at.x;
          for (Index k = 0; k < x.size() / 2; ++k)
            farthest = std::max(farthest, x.segment<2>(2 * k).norm() / scale);
          return Directive::Continue;
        });
      };
    };
    options.extend = add(1e6);
    const ParametrizationResult wide = parametrize(mesh, options);
    EXPECT_EQ(wide.status, Status::Converged);
    ASSERT_EQ(wide.checks.size(), 1u);
    EXPECT_EQ(wide.checks[0].name, "inside the disk");
    EXPECT_TRUE(wide.checks[0].verdict.feasible);
    const double start = tutte_map(*mesh).cwiseAbs().maxCoeff();
    const double radius = std::max(1.01 * start, 0.9 * farthest);
    ASSERT_LT(radius, farthest);
    farthest = 0;
    options.extend = add(radius);
    const ParametrizationResult held = parametrize(mesh, options);
    expect_valid(held, 2);
    EXPECT_LT(farthest, radius);
    EXPECT_GT(farthest, 0.9 * radius);
    EXPECT_EQ(held.status, Status::Stalled);
    EXPECT_TRUE(held.checks[0].verdict.feasible);
    EXPECT_GT(held.measures.value, wide.measures.value);
    options.extend = add(0.5 * start);
    const ParametrizationResult outside = parametrize(mesh, options);
    EXPECT_EQ(outside.status, Status::Infeasible);
    expect_contains(outside.message, {"inside the disk"});
    EXPECT_FALSE(outside.checks[0].verdict.feasible);
  }
}

TEST(MapExtension, AnObserverEndsTheRun) {
  const auto mesh = generated("cap");
  for (const int last : {1, 3, 8}) {
    ParametrizationOptions options = degree(3);
    int rows = 0;
    options.extend = [&](MapExtension& map) {
      map.observe([&, n = map.degree()](const TraceEntry& row, const MapView& at) {
        EXPECT_EQ(row.degree, n);
        EXPECT_EQ(at.x.size(), 2 * at.space->node_count());
        return ++rows > last ? Directive::Interrupt : Directive::Continue;
      });
    };
    RunRecord record;
    const ParametrizationResult result = parametrize(mesh, options, record);
    EXPECT_EQ(result.status, Status::Interrupted);
    expect_valid(result, 3);
    EXPECT_EQ(rows, last + 1);
    EXPECT_EQ(record.trace().size(), static_cast<std::size_t>(last + 1));
  }
}

// SolveOptions::watch also sees the start, and steps of a start towards pins, where its return
// value does not end the run.
TEST(MapObserver, SeesMapsInModelUnitsAndEndsTheRun) {
  const auto mesh = generated("cap");
  for (const bool pulled : {false, true}) {
    ParametrizationOptions options = degree(2);
    if (pulled) options.map.pins = {{0, Vector2(0, 0)}, {7, Vector2(0.3, 1.7)}};
    RunRecord record;
    std::size_t rows = 0, starts = 0;
    double last_energy = 0;
    options.solve.watch = [&](const TraceEntry& row, const MapView& at) {
      ++rows;
      starts = rows - record.trace().size();
      const BezierMap map = at.in_model_units();
      EXPECT_EQ(map.degree(), row.degree);
      EXPECT_EQ(map.control_points().size(), at.x.size());
      last_energy = measure_map(map, options.map.energy).value;
      return Directive::Interrupt;
    };
    const ParametrizationResult result = parametrize(mesh, options, record);
    EXPECT_EQ(result.status, Status::Interrupted);
    expect_valid(result, 2);
    EXPECT_EQ(starts > 1, pulled);
    EXPECT_NEAR(result.measures.value, last_energy, 1e-6 * last_energy);
    if (!pulled) {
      EXPECT_EQ(record.trace().size(), 1u);
    }
  }
}

// Added constraints and observers are part of every phase of a run.
TEST(MapExtension, ConstraintsHoldInEveryPhase) {
  const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(
      read_mesh(std::string(MAJORANT_SOURCE_DIR) + "/examples/meshes/creature.obj")));
  ParametrizationOptions options = degree(2);
  options.map.energy = {{find_energy("arap")->make, 1.0}};
  double off = 0;
  bool seen[5] = {};
  options.extend = [&](MapExtension& map) {
    const double u = map.start()[2 * 12], v = map.start()[2 * 700 + 1];
    map.add(FixedUnknowns({{2 * 12, u}, {2 * 700 + 1, v}}));
    map.observe([&, u, v](const TraceEntry& row, const MapView& at) {
      const VecIn& x = at.x;
      seen[static_cast<int>(row.phase)] = true;
      off = std::max({off, std::abs(x[2 * 12] - u), std::abs(x[2 * 700 + 1] - v)});
      return Directive::Continue;
    });
  };
  const ParametrizationResult result = parametrize(mesh, options);
  EXPECT_EQ(off, 0);
  EXPECT_TRUE(result.measures.locally_injective);
  EXPECT_TRUE(seen[static_cast<int>(Phase::Newton)]);
}

TEST(MapExtension, StartsThatCannotMeetConstraintsAreRefused) {
  const auto mesh = generated("cap");
  ParametrizationOptions options = degree(1);
  options.extend = [](MapExtension& map) {
    const Cells& faces = map.mesh().faces();
    std::vector<FixedPoint> turned;  // a face with two corners exchanged
    for (int k = 0; k < 3; ++k)
      turned.push_back({faces(7, k), map.start().segment<2>(2 * faces(7, k == 0   ? 1
                                                                         : k == 1 ? 0
                                                                                  : 2))});
    map.add(FixedPoints(turned));
  };
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                  {"degree 1", "added constraints"});
  options.extend = [](MapExtension& map) {
    map.add(FixedUnknowns({{0, 1}}));
    map.add(FixedUnknowns({{0, 2}}));
  };
  expect_contains(error_message(ErrorKind::Unsupported, [&] { parametrize(mesh, options); }),
                  {"contradict"});
}

TEST(MapExtension, WrongCallsAreRefused) {
  const auto mesh = generated("cap");
  const auto refused = [&](const MapExtender& extend, const std::string& part) {
    ParametrizationOptions options = degree(1);
    options.extend = extend;
    expect_contains(error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); }), {part});
  };
  const auto term = std::make_shared<const QuadraticPenalty>(FixedPoints({{0, {0, 0}}}));
  refused([](MapExtension& map) { map.add(std::shared_ptr<const EnergyTerm>(), 1); }, "null");
  refused([](MapExtension& map) { map.add(std::shared_ptr<const Constraint>()); }, "null");
  refused([](MapExtension& map) { map.add(std::shared_ptr<const FeasibilityChecker>()); }, "null");
  refused([](MapExtension& map) { map.observe({}); }, "null");
  for (const double weight : {0.0, -1.0, std::nan("")})
    refused([&](MapExtension& map) { map.add(term, weight); }, "weight");
  refused(
      [&](MapExtension& map) {
        const FixedPoints beyond({{map.space().node_count(), {0, 0}}});
        map.add(std::make_shared<const QuadraticPenalty>(beyond), 1);
      },
      "leaves the");
  ParametrizationOptions options = degree(1);
  options.solve.triangles = Triangles::Flipped;
  options.extend = [](MapExtension&) {};
  expect_contains(error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); }),
                  {"flipping"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
