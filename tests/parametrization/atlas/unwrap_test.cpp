#include "majorant/parametrization/atlas/unwrap.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "certify/valley.h"
#include "counted_stop.h"
#include "expected_error.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/proven_distance.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/internal/chart_solver.h"
#include "majorant/parametrization/initialization/area_margin.h"
#include "majorant/parametrization/seams/congruent_surfaces.h"
#include "mesh/joined_meshes.h"
#include "mesh/list_edits.h"
#include "mesh/surfaces_of_any_genus.h"
#include "mesh/test_meshes.h"
#include "random.h"

namespace majorant {
namespace {

Atlas unwrapped(const PolygonMesh& mesh, const UnwrapOptions& options) {
  RunRecord record;
  return unwrap(repair(mesh).mesh, options, record);
}

UnwrapOptions of_degree(int degree) {
  UnwrapOptions options;
  options.chart.map.degree = degree;
  return options;
}

PolygonMesh limbs_of(const PolygonMesh& ball) {
  return transformed(ball, [](const Vector3& p) -> Vector3 {
    return p * (1 + 1.5 * std::pow(p.cwiseAbs().maxCoeff(), 12) + 0.2 * p.x());
  });
}

// Expects every face in one chart, injective charts and no overlaps of charts.
void expect_layout(const Atlas& atlas, const SurfaceMesh& surface) {
  std::multiset<Index> faces;
  for (const Chart& chart : atlas.charts) {
    faces.insert(chart.faces.begin(), chart.faces.end());
    EXPECT_TRUE(chart.measures.locally_injective);
    EXPECT_EQ(check_boundary(*chart.map).result, ProofStatus::Proven);
  }
  EXPECT_EQ(faces.size(), to_size(surface.face_count()));
  EXPECT_EQ(std::set<Index>(faces.begin(), faces.end()).size(), faces.size());
  ASSERT_TRUE(atlas.packing);
  const double gap = 4.0 / 1024 * atlas.packing->side;
  EXPECT_GE(proven_distance(maps_of(atlas), gap), gap);
}

TEST(Unwrap, KeepsTheLimitOfStretch) {
  for (const double limit : {1.015, 1.008}) {
    for (const PolygonMesh& mesh : {limbs_of(cube_sphere(5)), torus(16, 8, 0)}) {
      UnwrapOptions options;
      options.cuts.max_stretch = limit;
      const RepairedSurface surface = repair(mesh);
      RunRecord record;
      const Atlas atlas = unwrap(surface.mesh, options, record);
      expect_layout(atlas, *surface.mesh);
      Index pieces = 0, last = -1;
      for (const ComponentCuts& component : atlas.cuts.components) pieces += component.pieces;
      EXPECT_EQ(to_size(pieces), atlas.charts.size());
      for (const Chart& chart : atlas.charts) {
        EXPECT_LE(chart.stretch.l2, limit);
        EXPECT_EQ(why_stretched(options, chart), "");
        EXPECT_GT(chart.faces.front(), last);
        last = chart.faces.front();
      }
      double length = 0;
      for (Index h = 0; h < surface.mesh->half_edge_count(); ++h)
        if (atlas.cuts.is_cut[h]) length += 0.5 * surface.mesh->edge_length(h);
      EXPECT_NEAR(atlas.cuts.length, length, 1e-9 * length);
    }
  }
}

// The limit and the measured values do not depend on the size of the mesh.
TEST(Unwrap, KeepsTheLimitOfTinyMeshes) {
  PolygonMesh mesh = limbs_of(cube_sphere(4));
  UnwrapOptions options;
  options.cuts.max_stretch = 1.004;
  const std::size_t charts = unwrapped(mesh, options).charts.size();
  for (Vector3& p : mesh.positions) p *= std::ldexp(1, -200);
  const Atlas tiny = unwrapped(mesh, options);
  EXPECT_EQ(tiny.charts.size(), charts);
  for (const Chart& chart : tiny.charts) EXPECT_LE(measure_stretch(*chart.map).l2, 1.004 + 1e-12);
}

// Returns a cylinder of radius 1 / (2 pi) and length 1, open at both ends, with n squares around.
PolygonMesh cylinder(int n) {
  PolygonMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < n; ++i) {
      const double t = 2 * std::numbers::pi * i / n;
      mesh.positions.emplace_back(std::cos(t) / (2 * std::numbers::pi),
                                  std::sin(t) / (2 * std::numbers::pi), double(j) / n);
    }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index next = (i + 1) % n;
      mesh.polygons.push_back({j * n + i, j * n + next, (j + 1) * n + next, (j + 1) * n + i});
    }
  return mesh;
}

TEST(Unwrap, SeveralComponentsOfAnyGenus) {
  const PolygonMesh mesh = together(together(cube_sphere(3), moved(torus(10, 8, 0), {5, 0, 0})),
                                    moved(grid(4, bumpy), {0, 0, 9}));
  const RepairedSurface surface = repair(mesh);
  UnwrapOptions options;
  options.least_fill = 0;
  const Atlas atlas = unwrapped(mesh, options);
  EXPECT_EQ(atlas.status(), Status::Converged);
  EXPECT_EQ(atlas.charts.size(), 3U);
  expect_layout(atlas, *surface.mesh);
  EXPECT_GT(atlas.value(), 4);
  EXPECT_LT(atlas.value(), 4.5);
  EXPECT_GE(atlas.stretch().l2, 1);
}

TEST(Unwrap, CurvedCharts) {
  const PolygonMesh mesh = cube_sphere(3);
  const double straight = unwrapped(mesh, of_degree(1)).value();
  const Atlas curved = unwrapped(mesh, of_degree(2));
  EXPECT_EQ(curved.charts.front().map->degree(), 2);
  expect_layout(curved, *repair(mesh).mesh);
  EXPECT_LT(curved.value(), straight);
}

// Returns the mesh with each triangle divided into three, one of them so thin that curved sides
// deviate by more than its height.
PolygonMesh with_slivers(const PolygonMesh& mesh) {
  PolygonMesh out;
  out.positions = mesh.positions;
  for (const auto& face : mesh.polygons)
    for (std::size_t k = 2; k < face.size(); ++k) {
      const Index a = face[0], b = face[k - 1], c = face[k],
                  p = static_cast<Index>(out.positions.size());
      out.positions.push_back(0.4995 * (mesh.positions[a] + mesh.positions[b]) +
                              0.001 * mesh.positions[c]);
      for (const std::vector<Index>& part : {std::vector<Index>{a, b, p}, {b, c, p}, {c, a, p}})
        out.polygons.push_back(part);
    }
  return out;
}

// Curved faces may be positive where the triangles of their corners are not.
TEST(Unwrap, CurvedFacesWithInvertedCorners) {
  const PolygonMesh mesh = with_slivers(limbs_of(cube_sphere(3)));
  UnwrapOptions options = of_degree(2);
  options.cuts.max_stretch = 1.3;
  const Atlas atlas = unwrapped(mesh, options);
  expect_layout(atlas, *repair(mesh).mesh);
  ASSERT_EQ(atlas.charts.size(), 1);
  const BezierMap& map = *atlas.charts.front().map;
  EXPECT_GT(faces_without_area_margin(map.mesh().faces(), map.control_points()), 0);
}

TEST(Unwrap, OverlapsAreUndoneByAScaffold) {
  PolygonMesh mesh;
  constexpr int kSteps = 48;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = 4 * std::numbers::pi * k / kSteps;
    for (const double r : {1.0, 1.4})
      mesh.positions.emplace_back(r * std::cos(t), r * std::sin(t), 0.02 * t);
  }
  for (Index k = 0; k < kSteps; ++k)
    mesh.polygons.push_back({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2});
  UnwrapOptions options = of_degree(1);
  options.cuts.max_stretch = 1e3;  // prevents cuts
  const Atlas atlas = unwrapped(mesh, options);
  expect_layout(atlas, *repair(mesh).mesh);
  RunRecord record;
  const ParametrizationResult free =
      parametrize(repair(mesh).mesh, options.chart, record);  // without scaffold
  EXPECT_EQ(check_boundary(*free.map).result, ProofStatus::Violated);
}

TEST(Unwrap, ThreadsDoNotMatter) {
  PolygonMesh mesh = cube_sphere(2);
  for (int k = 1; k < 6; ++k) mesh = together(mesh, moved(grid(2 + k % 3, bumpy), {0, 0, 3.0 * k}));
  UnwrapOptions one = of_degree(1), four = of_degree(1);
  one.chart.solve.threads = 1;
  four.chart.solve.threads = 4;
  const Atlas a = unwrapped(mesh, one), b = unwrapped(mesh, four);
  ASSERT_EQ(a.charts.size(), b.charts.size());
  for (std::size_t k = 0; k < a.charts.size(); ++k)
    EXPECT_EQ(a.charts[k].map->control_points(), b.charts[k].map->control_points());
}

// Small charts are solved in parallel: the last step of each is reported, and calls do not overlap.
TEST(Unwrap, ProgressHearsOfSmallCharts) {
  PolygonMesh mesh = grid(2, bumpy);
  for (int k = 1; k < 6; ++k) mesh = together(mesh, moved(grid(2, bumpy), {0, 0, 3.0 * k}));
  std::vector<TraceEntry> notified;
  StepObserver observer([&](const TraceEntry& row, const Vec&) {
    notified.push_back(row);
    return Directive::Continue;
  });
  RunRecord record(INFINITY, 1000, nullptr, &observer);
  const Atlas atlas = unwrap(repair(mesh).mesh, of_degree(2), record);
  ASSERT_EQ(notified.size(), atlas.charts.size());
  double sum = 0, expected = 0;
  for (const TraceEntry& row : notified) sum += row.energy;
  for (const Chart& chart : atlas.charts) expected += chart.trace.back().energy;
  EXPECT_NEAR(sum, expected, 1e-12 * expected);
}

TEST(Unwrap, AStopLeavesAValidLayout) {
  const PolygonMesh mesh = together(cube_sphere(4), moved(torus(10, 8, 0), {5, 0, 0}));
  const std::shared_ptr<const SurfaceMesh> surface = repair(mesh).mesh;
  RunRecord record(0);  // time limit 0: returns the starts
  const Atlas atlas = unwrap(surface, of_degree(2), record);
  EXPECT_EQ(atlas.status(), Status::TimeLimit);
  for (const Chart& chart : atlas.charts) EXPECT_EQ(chart.map->degree(), 2);
  expect_layout(atlas, *surface);
}

// Stopped at every possible moment, a run returns nothing, or a layout of the charts that have maps
// and the names of the others.
TEST(Unwrap, AStopLeavesTheChartsThatHaveAMap) {
  PolygonMesh mesh = grid(2, bumpy);
  for (int k = 1; k < 5; ++k) mesh = together(mesh, moved(grid(2, bumpy), {0, 0, 3.0 * k}));
  const std::shared_ptr<const SurfaceMesh> surface = repair(mesh).mesh;
  CountedStop never;
  RunRecord whole(never.check());
  const Atlas all = unwrap(surface, of_degree(1), whole);
  EXPECT_TRUE(all.is_complete());
  int without = 0, partial = 0;
  for (long k = 1; k <= never.polls(); k += std::max(1L, never.polls() / 60)) {
    const CountedStop stop(k);
    RunRecord record(stop.check());
    Atlas atlas;
    try {
      atlas = unwrap(surface, of_degree(1), record);
    } catch (const Stopped&) {
      ++without;
      continue;
    }
    std::multiset<Index> faces(atlas.unmapped.faces.begin(), atlas.unmapped.faces.end());
    for (const Chart& chart : atlas.charts) {
      ASSERT_TRUE(chart.map);
      EXPECT_EQ(check_boundary(*chart.map).result, ProofStatus::Proven);
      faces.insert(chart.faces.begin(), chart.faces.end());
    }
    EXPECT_EQ(faces.size(), to_size(surface->face_count()));
    EXPECT_EQ(std::set<Index>(faces.begin(), faces.end()).size(), faces.size());
    ASSERT_TRUE(atlas.packing);
    const double gap = 4.0 / 1024 * atlas.packing->side;
    EXPECT_GE(proven_distance(maps_of(atlas), gap), gap);
    if (atlas.is_complete()) continue;
    ++partial;
    EXPECT_EQ(atlas.status(), Status::Interrupted);
    EXPECT_EQ(to_size(atlas.unmapped.count) + atlas.charts.size(), all.charts.size());
    EXPECT_GT(atlas.unmapped.count, 0);
    EXPECT_TRUE(std::isfinite(atlas.value()));
  }
  EXPECT_GT(without, 0);
  EXPECT_GT(partial, 0);
}

// A chart with pins that was not attempted is not reported as violating them.
TEST(Unwrap, AStopIsNoRefusalOfPins) {
  UnwrapOptions options = of_degree(1);
  options.chart.map.pins = {{0, Vector2(0, 0)}, {8, Vector2(3, 3)}};
  const CountedStop stop(1);
  RunRecord record(stop.check());
  EXPECT_THROW(unwrap(repair(grid(2, bumpy)).mesh, options, record), Stopped);
}

TEST(Unwrap, PinsHoldTheirChart) {
  const PolygonMesh mesh = together(grid(4, bumpy), moved(grid(3, bumpy), {0, 0, 9}));
  UnwrapOptions options = of_degree(1);
  const Vector2 target(3.25, -1.5);
  options.chart.map.pins = {{7, target}};
  const Atlas atlas = unwrapped(mesh, options);
  const Chart& pinned = atlas.charts.front();
  ASSERT_EQ(pinned.pins.size(), 1U);
  EXPECT_EQ(Vector2(pinned.map->control_points().segment<2>(2 * pinned.pins[0].vertex)), target);
  EXPECT_TRUE(atlas.charts.back().pins.empty());
  expect_layout(atlas, *repair(mesh).mesh);
}

// Of three copies, the two without pins share a place.
TEST(Unwrap, PinnedChartsAreNotStacked) {
  const PolygonMesh sheet = grid(3, bumpy);
  const PolygonMesh mesh =
      together(together(sheet, moved(sheet, {0, 0, 9})), moved(sheet, {0, 0, 18}));
  const auto count = static_cast<Index>(sheet.positions.size());
  for (std::size_t pinned = 0; pinned < 3; ++pinned) {
    UnwrapOptions options = of_degree(1);
    options.stacking = Stacking::Equal;
    const Vector2 target(3.25, -1.5);
    options.chart.map.pins = {{static_cast<Index>(pinned) * count + 7, target}};
    const Atlas atlas = unwrapped(mesh, options);
    ASSERT_EQ(atlas.charts.size(), 3U);
    const std::size_t under = pinned == 0 ? 1 : 0, on = 3 - pinned - under;
    EXPECT_FALSE(atlas.charts[pinned].place || atlas.charts[under].place);
    ASSERT_TRUE(atlas.charts[on].place);
    EXPECT_EQ(atlas.charts[on].place->chart, under);
    const Chart& chart = atlas.charts[pinned];
    EXPECT_EQ(Vector2(chart.map->control_points().segment<2>(2 * chart.pins.at(0).vertex)), target);
  }
}

// Strips of equal size: the tolerance is relative to the length, for any width.
TEST(Stacks, ToleranceIsRelativeToTheLength) {
  const auto strip = [](double width) {
    return repair(transformed(grid(6),
                              [width](const Vector3& p) -> Vector3 {
                                return {p.x(), width * p.y(), 0.002 * p.x() * p.x()};
                              }))
        .mesh;
  };
  const auto places = [&](double width) {
    return stack_places({strip(0.01), strip(width)}, Stacking::Equal, {});
  };
  EXPECT_TRUE(places(0.01 + 0.9e-4)[1]);
  EXPECT_FALSE(places(0.01 + 3e-4)[1]);
}

// Turns Newton's method into steepest descent, which needs thousands of iterations.
class SteepestDescent final : public LinearSolver {
 public:
  void analyze(const SparsePattern&) override {}
  FactorStatus factorize(const Vec&, double) override { return FactorStatus::Ok; }
  Solution solve(const Vec& r, Vec& p, double) override {
    p = 0.01 * r;
    return {};
  }
  std::string description() const override { return "steepest descent"; }
};

// With the usual limit of iterations, a chart that reaches the limit and exceeds the stretch limit
// is cut. With a lower limit, which is a request of the caller, the chart stays and the reason is
// reported.
TEST(Unwrap, ChartsWithoutAMinimumAfterAThousandIterationsAreCut) {
  const std::shared_ptr<const SurfaceMesh> surface =
      repair(transformed(grid(6), [](const Vector3& p) -> Vector3 {
        return {p.x(), 0.1 * p.y(), 0.4 * p.x() * (1 - p.x()) * p.y() * (1 - p.y())};
      })).mesh;
  UnwrapOptions options = of_degree(1);
  options.packing.reset();  // no division for the layout
  const auto solved = [&](int iterations) {
    RunRecord record(INFINITY, iterations);
    return unwrap(surface, options, record);
  };
  constexpr int kUsual = StoppingRules().max_iterations;
  EXPECT_EQ(solved(kUsual).charts.size(), 1U);
  options.chart.solve.tolerance = 1e-15;
  options.chart.solve.linear_solver = [](const SparsePattern&, const DirectSolverOptions&) {
    return std::make_shared<SteepestDescent>();
  };
  const Atlas cut = solved(kUsual), kept = solved(kUsual - 1);
  EXPECT_GT(cut.charts.size(), 1U);
  for (const Chart& chart : cut.charts) EXPECT_EQ(why_stretched(options, chart), "");
  ASSERT_EQ(kept.charts.size(), 1U);
  EXPECT_EQ(kept.charts[0].status, Status::MaxIterations);
  EXPECT_EQ(why_stretched(options, kept.charts[0]), "max_iterations");
}

// Returns a flat half ring, which fills a small part of a square.
PolygonMesh arch() {
  return transformed(grid(10), [](const Vector3& p) -> Vector3 {
    const double angle = std::numbers::pi * p.x(), radius = 1 + 0.1 * p.y();
    return {-radius * std::cos(angle), radius * std::sin(angle), 0};
  });
}

TEST(Unwrap, ChartsThatMayNotBeCutAreNotDivided) {
  UnwrapOptions options;
  options.least_fill = 0.9;
  EXPECT_GT(unwrapped(arch(), options).charts.size(), 1U);
  UnwrapOptions given = options, reported = options;
  given.cuts.method = CutMethod::Given;
  reported.limit = StretchLimit::Reported;
  for (const UnwrapOptions& kept : {given, reported})
    EXPECT_EQ(unwrapped(arch(), kept).charts.size(), 1U);
}

// Returns a planar L; the width of its arms is this part of their length.
PolygonMesh ell(int width) {
  constexpr int kLength = 20;
  std::set<int> gone;
  for (int j = width; j < kLength; ++j)
    for (int i = width; i < kLength; ++i) gone.insert(j * kLength + i);
  return grid_without(kLength, gone);
}

// Seams are compared with half of the border of the charts: 2 for the L, whose arms have length 1.
TEST(Unwrap, FillsHalfOfTheSquareWhereThatTakesLittleSeam) {
  UnwrapOptions plain;
  plain.least_fill = 0;
  for (const PolygonMesh& mesh : {ell(3), ell(4)}) {
    const std::shared_ptr<const SurfaceMesh> surface = repair(mesh).mesh;
    const Atlas before = unwrapped(mesh, plain), after = unwrapped(mesh, {});
    EXPECT_EQ(before.charts.size(), 1U);
    EXPECT_LT(before.packing->fill, kLowFill);
    EXPECT_GE(after.packing->fill, kUsualFill);
    expect_layout(after, *surface);
    double border = 0;
    for (Index h = 0; h < surface->half_edge_count(); ++h)
      if (surface->opposite(h) < 0) border += surface->edge_length(h);
    EXPECT_GT(after.cuts.length, 0);
    EXPECT_LE(after.cuts.length, kMoreSeam * border / 2);
    EXPECT_EQ(after.division, Status::Converged);
  }
  // The chart fills 0.44 of the square. A first cut of 0.25, an eighth of half the border, gains
  // nothing; a second one would be too long.
  const Atlas kept = unwrapped(ell(5), {});
  EXPECT_EQ(kept.charts.size(), 1U);
  EXPECT_GT(kept.packing->fill, kLowFill);
  EXPECT_LT(kept.packing->fill, kUsualFill);
}

TEST(Unwrap, DoesNotDivideForFillIfOptionsFixChartsOrSize) {
  UnwrapOptions counted, sized, tiled, loose;
  counted.least_charts = 1;
  sized.packing->side = 2;
  tiled.packing->tiles = 2;
  loose.packing.reset();
  for (const UnwrapOptions& options : {counted, sized, tiled, loose})
    EXPECT_EQ(unwrapped(ell(4), options).charts.size(), 1U);
}

TEST(Unwrap, ReportsWhyTheDivisionEnded) {
  const std::shared_ptr<const SurfaceMesh> surface = repair(cube_sphere(4)).mesh;
  UnwrapOptions counted, full;
  counted.least_charts = 3;
  full.least_fill = 0.99;
  for (const UnwrapOptions& options : {counted, full}) {
    RunRecord none(0);
    EXPECT_EQ(unwrap(surface, options, none).division, Status::TimeLimit);
  }
  RunRecord enough;
  const Atlas atlas = unwrap(surface, counted, enough);
  EXPECT_EQ(atlas.division, Status::Converged);
  EXPECT_EQ(atlas.charts.size(), 3U);
}

TEST(Unwrap, ScaledChartsAreMeasuredWhole) {
  const std::shared_ptr<const SurfaceMesh> surface = repair(grid(4, bumpy)).mesh;
  UnwrapOptions options = of_degree(2);
  options.face_scale = Vec::Constant(surface->face_count(), 2);
  RunRecord record(0);
  const Atlas atlas = unwrap(surface, options, record);
  EXPECT_EQ(atlas.status(), Status::TimeLimit);
  EXPECT_FALSE(atlas.charts.at(0).measures.cut_short);
}

// Automatic cuts avoid pinned vertices; pins on requested seams are refused.
TEST(Unwrap, PinnedVerticesHaveOnePlace) {
  const PolygonMesh mesh = cube_sphere(4);
  const std::shared_ptr<const SurfaceMesh> surface = repair(mesh).mesh;
  UnwrapOptions options = of_degree(1);
  const SurfaceCuts cuts = choose_cuts(*surface, options.cuts);
  Index h = 0;
  while (!cuts.is_cut[h]) ++h;
  const Index a = surface->from_vertex(h), b = surface->to_vertex(h);
  const Vector2 target(0.5, 0.25);
  for (auto* points : {&options.chart.map.pins, &options.chart.map.handles}) {
    for (const Index v : {a, b}) {
      *points = {{v, target}};
      expect_layout(unwrapped(mesh, options), *surface);
    }
    UnwrapOptions given = options;
    given.cuts.method = CutMethod::Given;
    given.cuts.given = cuts.is_cut;
    const std::vector<int> copies = [&] {
      std::vector<Index> uncut;
      surface->cut_along(cuts.is_cut, &uncut);
      std::vector<int> count(to_size(surface->vertex_count()), 0);
      for (const Index v : uncut) ++count[v];
      return count;
    }();
    const Index cut = copies[a] > 1 ? a : b;
    ASSERT_GT(copies[cut], 1);
    (points == &options.chart.map.pins ? given.chart.map.pins
                                       : given.chart.map.handles) = {{cut, target}};
    expect_contains(error_message(ErrorKind::Infeasible, [&] { unwrapped(mesh, given); }),
                    {"vertex " + std::to_string(cut), "on a seam", "CutMethod::Automatic"});
    points->clear();
  }
}

TEST(Unwrap, EnergiesWithoutAScaleGetTheSurfaces) {
  UnwrapOptions options = of_degree(1);
  options.chart.map.energy = {{mips(), 1.0}};
  const Atlas atlas = unwrapped(moved(grid(4, bumpy), {1, 2, 3}), options);
  EXPECT_NEAR(atlas.stretch().image_area / atlas.stretch().surface_area, 1, 1e-9);
}

// Returns a grid with the texture coordinates change(x, y).
PolygonMesh textured_grid(const std::function<Vector2(const Vector2&)>& change) {
  PolygonMesh mesh = grid(4, bumpy);
  for (const Vector3& p : mesh.positions) mesh.texcoords.push_back(change(p.head<2>()));
  mesh.polygon_texcoords = mesh.polygons;
  return mesh;
}

TEST(TextureStart, ReportsItsFindings) {
  RunRecord record;
  const auto start_of = [&](const std::function<Vector2(const Vector2&)>& change) {
    return texture_start(repair(textured_grid(change)).mesh, record);
  };
  const auto as_given = start_of([](const Vector2& p) { return p; });
  ASSERT_TRUE(as_given);
  EXPECT_EQ(as_given->start, ChartStart::Texture);
  const auto mirrored = start_of([](const Vector2& p) { return Vector2(-p.x(), p.y()); });
  ASSERT_TRUE(mirrored);
  EXPECT_EQ(mirrored->start, ChartStart::Texture);
  const auto folded = start_of([](const Vector2& p) {
    return p == Vector2(0.5, 0.5) ? Vector2(0.9, 0.1) : p;  // moves the vertex out of its ring
  });
  ASSERT_TRUE(folded);
  EXPECT_EQ(folded->start, ChartStart::Untangled);
  EXPECT_FALSE(start_of([](const Vector2&) { return Vector2(0, 0); }));
}

// The map of what it was cut from, where the file has none.

// A disk of kSpokes by kRings with an angle sum above 2 pi at its middle vertex, cut from there to
// the boundary, so that it overlaps itself when flattened. `parent` is a map of the uncut disk onto
// rings around 0, for the cut disk; in it the two sides of the cut coincide.
struct OpenSaddle {
  std::shared_ptr<const SurfaceMesh> mesh;
  Vec parent;
};

OpenSaddle open_saddle() {
  constexpr Index kSpokes = 16, kRings = 4;
  constexpr double kSteepness = 0.8;
  PolygonMesh disk;
  disk.positions = {Vector3::Zero()};
  std::vector<Vector2> rings = {Vector2::Zero()};
  const auto number = [](Index ring, Index spoke) {
    return ring == 0 ? 0 : 1 + (ring - 1) * kSpokes + spoke % kSpokes;
  };
  for (Index ring = 1; ring <= kRings; ++ring)
    for (Index spoke = 0; spoke < kSpokes; ++spoke) {
      const double angle = 2 * std::numbers::pi * spoke / kSpokes;
      const double slope = kSteepness * std::sin(2 * angle);
      const Vector2 round(std::cos(angle), std::sin(angle));
      rings.emplace_back(ring * round);
      disk.positions.emplace_back(ring * std::cos(slope) * round.x(),
                                  ring * std::cos(slope) * round.y(), ring * std::sin(slope));
    }
  for (Index ring = 0; ring < kRings; ++ring)
    for (Index spoke = 0; spoke < kSpokes; ++spoke) {
      const Index a = number(ring, spoke), b = number(ring + 1, spoke);
      const Index c = number(ring + 1, spoke + 1), d = number(ring, spoke + 1);
      disk.polygons.push_back({a, b, c});
      if (ring > 0) disk.polygons.push_back({a, c, d});
    }
  const SurfaceMesh whole = SurfaceMesh::from_polygons(disk);
  std::vector<char> is_cut(to_size(whole.half_edge_count()), 0);
  const auto is_on_slit = [&](Index v) { return v == 0 || (v - 1) % kSpokes == 0; };
  for (Index h = 0; h < whole.half_edge_count(); ++h)
    is_cut[h] = whole.opposite(h) >= 0 && is_on_slit(whole.from_vertex(h)) &&
                is_on_slit(whole.to_vertex(h));
  std::vector<Index> uncut;
  OpenSaddle saddle;
  saddle.mesh = std::make_shared<const SurfaceMesh>(whole.cut_along(is_cut, &uncut));
  saddle.parent.resize(2 * saddle.mesh->vertex_count());
  for (Index v = 0; v < saddle.mesh->vertex_count(); ++v)
    saddle.parent.segment<2>(2 * v) = rings[to_size(uncut[v])];
  return saddle;
}

TEST(ChartSolver, OpensSlitsOfTheParentWhereTheBestMapOverlapsItself) {
  const OpenSaddle saddle = open_saddle();
  const ParametrizationOptions options;
  for (const bool is_usable : {true, false}) {
    SCOPED_TRACE(is_usable);
    ChartHints hints;
    hints.parent = saddle.parent;
    // A cut cannot be opened where faces are inverted.
    if (!is_usable) hints.parent.head<2>() = 2 * hints.parent.segment<2>(2 * 20);
    RunRecord record;
    const Chart chart = ChartSolver(saddle.mesh, options, hints).solve(record);
    EXPECT_EQ(chart.start, is_usable ? ChartStart::Parent : ChartStart::Tutte);
    EXPECT_EQ(chart.status, Status::Converged) << chart.message;
    EXPECT_EQ(check_boundary(*chart.map).result, ProofStatus::Proven);
  }
}

// A height field with wide flat squares between rows of narrow, steep ones. Tutte's map ignores
// lengths; the projection along z is injective.
PolygonMesh steep_terrain(Index count, double width, double height) {
  const auto place = [&](Index i) { return i == 0 ? 0.0 : i == count ? 20.0 : 10 + width * i; };
  PolygonMesh mesh;
  for (Index i = 0; i <= count; ++i)
    for (Index j = 0; j <= count; ++j) {
      const bool is_high = i > 0 && i < count && j > 0 && j < count && (i + j) % 2 == 0;
      mesh.positions.emplace_back(place(i), place(j), is_high ? height : 0);
    }
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j) {
      const Index a = i * (count + 1) + j, b = a + count + 1;
      mesh.polygons.push_back({a, b, b + 1});
      mesh.polygons.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

TEST(ChartSolver, StartsFromAboveWhereThatIsNearer) {
  const std::shared_ptr<const SurfaceMesh> mesh = repair(steep_terrain(40, 0.01, 0.02)).mesh;
  RunRecord record;
  const ParametrizationOptions options;
  const Chart chart = ChartSolver(mesh, options, {}).solve(record);
  EXPECT_EQ(chart.start, ChartStart::Projected);
  EXPECT_EQ(chart.status, Status::Converged) << chart.message;
  EXPECT_LT(chart.stretch.l2, 1.01);
}

// A flat panel, a second one beside it, and a flap that touches the second panel when flattened.
TEST(Unwrap, ChartsKeepClearOfThemselves) {
  for (const double lean : {0.0, 1e-12, 1e-9}) {
    SCOPED_TRACE(lean);
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 3, 0}, {1, 3, 0},        {1, 1, 0},     {3, 1, 0},
                      {3, 0, 0}, {1, 3, 1}, {1, 1 + lean, 1}, {0.5, 3.5, 0}, {1.5, 3.5, 0}};
    mesh.polygons = {{0, 3, 2, 1}, {0, 5, 4, 3}, {2, 3, 7, 6}};
    const Atlas atlas = unwrapped(mesh, {});
    const double least = 1e-7 * std::sqrt(atlas.stretch().surface_area);
    for (const Chart& chart : atlas.charts)
      EXPECT_GE(border_clearance(*chart.map, {.at_least = least, .way = 1e5}), least);
    EXPECT_EQ(atlas.charts.size(), 2);
    Atlas square = atlas;
    EXPECT_TRUE(into_unit_square(square));
  }
}

// After a stop during packing, charts keep their first arrangement, and the atlas reports the stop.
TEST(Unwrap, LaysChartsWhenItIsStoppedWhilePacking) {
  const PolygonMesh mesh = limbs_of(cube_sphere(4));
  UnwrapOptions options;
  options.packing->tiles = 4;
  CountedStop counted;
  RunRecord whole(counted.check());
  const Atlas atlas = unwrap(repair(mesh).mesh, options, whole);
  int stopped = 0;
  for (long last = counted.polls(); last > counted.polls() * 9 / 10; last -= 7) {
    RunRecord record(CountedStop(last).check());
    try {
      const Atlas early = unwrap(repair(mesh).mesh, options, record);
      ASSERT_TRUE(early.packing);
      if (early.packed == Status::Converged) continue;
      ++stopped;
      EXPECT_EQ(early.status(), Status::Interrupted);
      EXPECT_FALSE(early.message().empty());
      expect_layout(early, *repair(mesh).mesh);
    } catch (const Stopped&) {
    }
  }
  EXPECT_GT(stopped, 0);
}

TEST(ChartSolver, NamesTheStart) {
  const std::shared_ptr<const SurfaceMesh> mesh =
      repair(textured_grid([](const Vector2&) { return Vector2(0, 0); })).mesh;
  for (const auto& [texture, start] : {std::pair(TextureStart::Tried, ChartStart::Anew),
                                       {TextureStart::Ignored, ChartStart::Parent}}) {
    ChartHints hints;
    hints.texture = texture;
    hints.parent = uv_of(*mesh, [](const Vector3& p) -> Vector2 { return p.head<2>(); });
    RunRecord record;
    const ParametrizationOptions options;
    EXPECT_EQ(ChartSolver(mesh, options, hints).solve(record).start, start);
  }
}

// From 50,000 faces on, a chart cut from another one has a multiresolution start, although the map
// of the other one would be admissible.
TEST(ChartSolver, VeryLargeChartsStartAnew) {
  for (const auto& [side, start] :
       {std::pair(158, ChartStart::Parent), {159, ChartStart::Multiresolution}}) {
    const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(grid(side)));
    SCOPED_TRACE(mesh->face_count());
    ChartHints hints;
    hints.parent = uv_of(*mesh, [](const Vector3& p) -> Vector2 { return p.head<2>(); });
    RunRecord record;
    ParametrizationOptions options;
    options.solve.linear_solver = [](const SparsePattern&, const DirectSolverOptions&) {
      return make_direct_solver({.ordering = Ordering::Amd});  // sufficient for a step or two
    };
    const Chart chart = ChartSolver(mesh, options, hints).solve(record);
    EXPECT_EQ(chart.start, start);
    EXPECT_EQ(chart.status, Status::Converged) << chart.message;
  }
}

TEST(UnitSquare, HoldsEverything) {
  const PolygonMesh mesh = together(cube_sphere(2), moved(grid(3, bumpy), {0, 0, 9}));
  Atlas atlas = unwrapped(mesh, of_degree(1));
  const double side = atlas.packing->side;
  const std::optional<LayoutMotion> square = into_unit_square(atlas);
  ASSERT_TRUE(square);
  EXPECT_EQ(square->size, side);
  for (const BezierMap& map : maps_of(atlas)) {
    EXPECT_GE(map.control_points().minCoeff(), 0);
    EXPECT_LE(map.control_points().maxCoeff(), 1);
  }
  const double gap = 4.0 / 1024 * (1 - 1e-9);
  EXPECT_GE(proven_distance(maps_of(atlas), gap), gap);
}

// One chart that only exact arithmetic proves injective: the unit square accepts the proof of
// packing.
TEST(UnitSquare, AcceptsTheProofOfPacking) {
  const BezierMap map = test::valley_map(1.0 / 3, 0x1p-21);
  ASSERT_LE(measure_map(map, {{symmetric_dirichlet(), 1.0}}).min_det.minCoeff(), 0);
  Atlas atlas;
  atlas.packing = pack({map});
  Chart& chart = atlas.charts.emplace_back();
  chart.map = atlas.packing->charts.front();
  ASSERT_TRUE(into_unit_square(atlas));
  EXPECT_GE(chart.map->control_points().minCoeff(), 0);
  EXPECT_LE(chart.map->control_points().maxCoeff(), 1);
}

TEST(Unwrap, ACylinderIsCutOpen) {
  const Atlas atlas = unwrapped(cylinder(12), of_degree(1));
  EXPECT_NEAR(atlas.value(), 4, 1e-6);
  EXPECT_NEAR(atlas.cuts.length, 1, 1e-9);
}

// With cuts and charts, data stay with their faces.
TEST(Unwrap, DataFollowTheFacesIntoTheCharts) {
  const auto mesh = repair(together(moved(grid(4, bumpy), {0, 0, 9}), cube_sphere(2))).mesh;
  test::Random random(3);
  const Vec k = random.vector(mesh->face_count(), 1, 30);
  const Vec weight = random.vector(mesh->face_count(), 1, 3);
  UnwrapOptions options = of_degree(1);
  options.chart.map.energy = {{energy_factory(density<2, 2>(
                                   "stiff",
                                   [](const auto& J, double c) {
                                     return c * (J.squaredNorm() + J.inverse().squaredNorm());
                                   },
                                   k)),
                               1.0, weight}};
  RunRecord record;
  const Atlas atlas = unwrap(mesh, options, record);
  EXPECT_GE(atlas.charts.size(), 2U);
  for (const Chart& chart : atlas.charts)
    for (Index f = 0; f < chart.map->mesh().face_count(); ++f) {
      const Eigen::Matrix2d J = chart.map->jacobian(f, Barycentric::Constant(1.0 / 3));
      const Index on_surface = chart.faces[f];
      const double expected =
          weight[on_surface] * k[on_surface] * (J.squaredNorm() + J.inverse().squaredNorm());
      EXPECT_NEAR(chart.measures.face_value[f], expected, 1e-9 * expected);
    }
  options.chart.map.energy[0].face_weight = Vec::Ones(3);
  expect_contains(error_message(ErrorKind::Usage, [&] { unwrap(mesh, options, record); }),
                  {"face weights"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
