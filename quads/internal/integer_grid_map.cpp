#include "majorant/quads/internal/integer_grid_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"
#include "majorant/framework/terms/quadratic_penalty.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// The stiffness of springs, in energies of a quad per edge length. At the first one, springs pull
// as strongly as a quad resists. Maps do not converge above the last one (bench/integer_grid_maps).
constexpr double kFirstSpring = 1, kStifferSpring = 10, kStiffestSpring = 1e4;
// Relative decrease and steps of intermediate solves, as in PinHomotopy.
constexpr double kRoughSolve = 1e-3;
constexpr int kRoughSteps = 50;
// Bisection depth of certificates.
constexpr int kGridProofDepth = 10;

// Solves for maps of one degree.
class GridSolver {
 public:
  // map: normalized, like all others.
  GridSolver(const MapSpecification& spec, BezierMap map, const GridTranslations& grid,
             const StopCheck& stop)
      : map_(std::move(map)),
        stop_(stop),
        area_(spec.rest->measure.sum()),
        injectivity_(std::make_shared<const LocalInjectivity>(
            map_.shared_space(), 2 * spec.rest->measure, kGridProofDepth, stop)),
        pulled_(problem(spec,
                        [&](MapExtension& added) {
                          added.add(std::make_shared<const QuadraticPenalty>(grid), 1);
                        })),
        held_(problem(spec, [&](MapExtension& added) { added.add(grid); })),
        stepper_(pulled_.problem, options_until(stop)) {}

  const BezierMap& map() const { return map_; }

  static NewtonOptions options_until(const StopCheck& stop) {
    NewtonOptions options = newton_of_maps();
    options.stop = stop;
    return options;
  }

  // Solves with springs of this stiffness.
  void pull(double stiffness) {
    TermState springs;
    springs.weight = stiffness / area_;
    const Problem stiffer = pulled_.problem.with({{pulled_.added.front(), springs}});
    StoppingRules roughly = stopping_of_maps();
    roughly.relative_decrease = kRoughSolve;
    roughly.max_iterations = kRoughSteps;
    stepper_.reset(stiffer);
    const SolveResult solved = stepper_.minimize(stiffer.reduce(map_.control_points()), roughly);
    stop_.poll();
    if (solved.status != Status::Infeasible) become(stiffer.expand(solved.y));
  }

  // Sets the integers exactly, if the path is certified. Returns whether it was.
  bool hold() {
    const Vec& from = map_.control_points();
    const Vec to = held_.problem.expand(held_.problem.reduce(from));
    if (injectivity_->max_step(from, to - from, 1).step < 1 || !injectivity_->check(to).feasible)
      return false;
    NewtonStepper last(held_.problem, options_until(stop_));
    const SolveResult solved = last.minimize(held_.problem.reduce(to), stopping_of_maps());
    stop_.poll();
    if (solved.status == Status::Infeasible) return false;
    become(held_.problem.expand(solved.y));
    return true;
  }

 private:
  template <class Add>
  MapProblem problem(MapSpecification spec, const Add& add) const {
    MapExtension added(map_, spec.rest, 1);
    add(added);
    spec.added = std::make_shared<const MapExtension>(std::move(added));
    const auto space = map_.shared_space();
    const Quadrature rule = optimizer_quadrature(map_.degree(), 0).guarded.front();
    return map_problem(spec, space, map_.control_points(), energy_terms(spec, space, {rule}),
                       injectivity_);
  }

  void become(Vec x) { map_ = map_.with(map_.shared_space(), std::move(x)); }

  BezierMap map_;
  const StopCheck& stop_;
  const double area_;
  std::shared_ptr<const LocalInjectivity> injectivity_;
  MapProblem pulled_, held_;
  NewtonStepper stepper_;
};

// A map that is linear on k^2 parts of every face, and equals the given map at their corners.
struct LinearParts {
  std::unique_ptr<const SurfaceMesh> surface;
  std::vector<char> is_feature;
  BezierMap map;
};

SurfaceMesh parts_of(const SurfaceMesh& mesh, const BezierMap::Refinement& refined, int k) {
  SurfaceParts parts;
  parts.file = mesh.file();
  parts.origin = mesh.origin();
  parts.positions = refined.positions;
  parts.faces = refined.triangles;
  // Messages name new vertices as a vertex of their face.
  parts.input_vertex.assign(static_cast<std::size_t>(refined.positions.rows()), -1);
  for (Index t = 0; t < refined.triangles.rows(); ++t) {
    const Index face = t / (k * k);
    parts.input_face.push_back(mesh.input_face(face));
    for (const Index v : refined.triangles.row(t))
      if (parts.input_vertex[v] < 0)
        parts.input_vertex[v] = mesh.input_vertex(mesh.faces()(face, 0));
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) parts.input_vertex[v] = mesh.input_vertex(v);
  return SurfaceMesh::from_parts(std::move(parts));
}

// Returns for each half-edge of the parts the surface's half-edge that contains it, or -1. The
// first parts of a face, row by row, have their corners in the order of the face's
// (BezierMap::refine).
std::vector<Index> half_edges_of_parts(Index faces, int k) {
  std::vector<Index> whole;
  for (Index f = 0; f < faces; ++f)
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < k - i; ++j) {
        whole.push_back(i + j == k - 1 ? 3 * f : -1);
        whole.push_back(i == 0 ? 3 * f + 1 : -1);
        whole.push_back(j == 0 ? 3 * f + 2 : -1);
        if (i + j < k - 1) whole.insert(whole.end(), 3, -1);
      }
  return whole;
}

LinearParts linear_parts(const ResolvedSurface& surface, const BezierMap& map, int k) {
  const SurfaceMesh& mesh = surface.mesh;
  const auto uncut = BezierMap::linear(std::make_shared<const SurfaceMesh>(mesh),
                                       Vec::Zero(2 * mesh.vertex_count()));
  const BezierMap::Refinement cut = map.refine(k);
  auto parts = std::make_unique<const SurfaceMesh>(parts_of(mesh, uncut.refine(k), k));
  auto cut_parts = std::make_shared<const SurfaceMesh>(parts_of(map.mesh(), cut, k));
  const std::vector<Index> whole = half_edges_of_parts(mesh.face_count(), k);
  std::vector<char> is_feature;
  if (!surface.is_feature.empty())
    for (const Index h : whole) is_feature.push_back(h >= 0 && surface.is_feature[h]);
  std::shared_ptr<const Seams> seams;
  if (const Seams& of_map = map.seams(); !of_map.quarter_turns().empty()) {
    std::vector<int> turns_of_side(to_size(mesh.half_edge_count()), -1);
    for (const SeamEdge& edge : of_map.edges()) turns_of_side[edge.side] = edge.turns;
    std::vector<Index> surface_vertex(to_size(cut_parts->vertex_count()));
    std::vector<SeamEdge> edges;
    for (Index h = 0; h < parts->half_edge_count(); ++h) {
      surface_vertex[cut_parts->from_vertex(h)] = parts->from_vertex(h);
      if (whole[h] >= 0 && turns_of_side[whole[h]] >= 0)
        edges.push_back({h, parts->opposite(h), turns_of_side[whole[h]]});
    }
    if (edges.empty()) surface_vertex.clear();
    std::vector<int> quarter_turns = of_map.quarter_turns();
    quarter_turns.resize(to_size(parts->vertex_count()), 4);
    for (const auto& loop : parts->boundary_loops())
      for (const Index v : loop) quarter_turns[v] = 0;
    seams = std::make_shared<const Seams>(cut_parts->faces(), std::move(surface_vertex),
                                          std::move(edges), std::move(quarter_turns));
  }
  Vec uv(2 * cut.uv.rows());
  for (Index v = 0; v < cut.uv.rows(); ++v) uv.segment<2>(2 * v) = cut.uv.row(v);
  return {std::move(parts), std::move(is_feature),
          BezierMap::linear(std::move(cut_parts), std::move(uv), std::move(seams))};
}

}  // namespace

std::optional<BezierMap> integer_grid_map(const BezierMap& map, const SeamlessLattice& lattice,
                                          const GridTranslations& grid, GridDegrees degrees,
                                          const StopCheck& stop) {
  const Points3& positions = map.mesh().positions();
  const double extent =
      (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
  const double scale = 1 / power_of_two(extent, PowerOfTwo::Nearest);
  MapSpecification spec;
  spec.rest = std::make_shared<const RestShapes>(rest_shapes(map.mesh(), scale));
  spec.seams = map.shared_seams();
  spec.aligned = held_axes(lattice);
  // Starts from the result of the first stiffness: stiffer springs distort what they do not move.
  BezierMap start = map.with(map.shared_space(), map.control_points() * scale);
  for (int degree = 1; degree <= degrees.last; ++degree) {
    if (degree > 1) start = start.elevated();
    if (degree < degrees.first) continue;
    GridSolver solver(spec, start, grid.scaled(scale), stop);
    for (double spring = kFirstSpring; spring <= kStiffestSpring; spring *= kStifferSpring) {
      solver.pull(spring);
      if (spring == kFirstSpring) start = solver.map();
      if (!solver.hold()) continue;
      const BezierMap& found = solver.map();
      return found.with(found.shared_space(), found.control_points() / scale);
    }
  }
  return std::nullopt;
}

IntegerGrid::IntegerGrid(const ResolvedSurface& surface, const BezierMap& map, double edge_length,
                         const StopCheck& stop) {
  constexpr int kMaxParts = 16;
  if (map.degree() == 1)
    lattice_ = std::make_unique<SeamlessLattice>(surface.mesh, map, surface.is_feature,
                                                 surface.border_turn);
  for (int k = 2 * map.degree(); !lattice_; k = std::min(2 * k, kMaxParts)) try {
      stop.poll();
      LinearParts parts = linear_parts(surface, map, k);
      parts_ = std::move(parts.surface);
      lattice_ = std::make_unique<SeamlessLattice>(*parts_, parts.map, std::move(parts.is_feature),
                                                   surface.border_turn);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Infeasible || k == kMaxParts) throw;
    }
  mesh_ = trace_t_mesh(*lattice_, stop);
  // Allows for pinned real lengths and rounding.
  constexpr double kWhole = 1e-2;
  for (const TArc& arc : mesh_.arcs) {
    const double edges = static_cast<double>(arc.length()) * lattice_->unit() / edge_length;
    edges_.push_back(static_cast<Index>(std::lround(edges)));
    if (std::abs(edges - edges_.back()) > kWhole)
      throw Error(ErrorKind::Infeasible, "an arc of the integer-grid map has no whole length");
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
