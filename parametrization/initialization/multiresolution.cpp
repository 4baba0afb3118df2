#include "majorant/parametrization/initialization/multiresolution.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/rounding.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/mesh/geometry.h"
#include "majorant/parametrization/initialization/area_margin.h"
#include "majorant/parametrization/initialization/collapsing_mesh.h"
#include "majorant/parametrization/initialization/internal/collapsed_level.h"
#include "majorant/parametrization/initialization/internal/sweep_stages.h"
#include "majorant/parametrization/initialization/internal/vertex_descent.h"
#include "majorant/parametrization/initialization/start.h"

namespace majorant {
namespace {

// A clock of the process' CPU seconds, which are comparable on a busy machine.
class CpuWatch {
 public:
  double restart() {
    const std::clock_t now = std::clock();
    return static_cast<double>(now - std::exchange(started_, now)) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t started_ = std::clock();
};

// Unlimited steps on the coarsest mesh, which cost next to nothing.
constexpr int kUnlimitedSteps = std::numeric_limits<int>::max();

// Fractions of progress: of the start once the surface is decimated, and of a level once its
// vertices are inserted. Measured on 270,000 faces.
constexpr double kDecimated = 0.2, kInserted = 0.6;
constexpr Index kInsertionsAPoll = 1024;

// The largest distance of equal boundary points, relative to the radius. Two circles with the same
// spacing differ by rounding, since their sums have other edges; another spacing differs far more.
constexpr double kSamePlace = 1e-9;

// Returns a solver with a fast ordering: a level factorizes one or two matrices, for which a better
// ordering does not pay.
std::unique_ptr<LinearSolver> few_factorizations() {
  return make_direct_solver({.ordering = Ordering::Amd});
}

// Returns a power of two that scales positions to a size of about 1, without rounding.
double unit_scale(const Points3& positions) {
  return 1 / power_of_two(extent(positions), PowerOfTwo::Nearest);
}

struct CompressedVertices {
  std::vector<char> flags;  // by vertex of the whole surface
  Index count = 0;
};

// Returns the vertices where the energy is high, and their neighbours.
CompressedVertices vertices_of_high_energy(const CollapsingMesh& mesh, VertexDescent& descent,
                                           const MultiresolutionRules& rules) {
  Vec mean = Vec::Zero(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_present(v)) mean[v] = descent.mean_energy(v);
  const double limit = rules.compressed * mean.sum() / mesh.vertices_left();
  std::vector<Index> found, ring;
  CompressedVertices result;
  result.flags.assign(to_size(mesh.vertex_count()), 0);
  const auto take = [&](Index v) {
    if (std::exchange(result.flags[v], 1) == 0) found.push_back(v);
  };
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mean[v] > limit) take(v);
  for (int round = 0; round < rules.compressed_rings; ++round)
    for (std::size_t k = 0, end = found.size(); k < end; ++k) {
      mesh.ring(found[k], ring);
      for (const Index w : ring) take(w);
    }
  result.count = static_cast<Index>(found.size());
  return result;
}

class Multiresolution {
 public:
  Multiresolution(const SurfaceMesh& surface, const MapOptions& options, RunRecord& run,
                  const MultiresolutionRules& rules, MultiresolutionRecord& record,
                  const LevelSolver& solve_level, const CoarseTest& goes_on)
      : surface_(surface),
        options_(options),
        run_(run),
        observed_stop_(run.telling_start(run.start_stop())),
        stop_(observed_stop_.silent()),
        rules_(rules),
        record_(record),
        solve_level_(solve_level),
        goes_on_(goes_on),
        scale_(unit_scale(surface.positions())),
        positions_(surface.positions() * scale_),
        mesh_(surface.faces(), surface.opposites(), surface.vertex_count()),
        uv_(Vec::Zero(2 * surface.vertex_count())),
        descent_(mesh_, positions_, options.energy, uv_) {
    all_.assign(to_size(surface.vertex_count()), 1);
    held_.assign(to_size(surface.vertex_count()), 0);
    if (options.boundary == BoundaryCondition::Fixed) held_ = surface.boundary_flags();
  }

  std::optional<Vec> solve() {
    CpuWatch watch;
    decimate(mesh_, positions_, {rules_.coarsest, held_, is_apart() ? Ears::Stay : Ears::Leave},
             observed_stop_.between(0, kDecimated));
    if (is_apart()) held_ = surface_.boundary_flags();
    record_.decimation_seconds = watch.restart();
    const std::vector<Index> sizes = this->sizes();
    if (sizes.empty()) return std::nullopt;
    level_ = static_cast<int>(sizes.size());
    if (!solve_coarsest()) return std::nullopt;
    const double all = std::accumulate(sizes.begin(), sizes.end(), 0.0);
    const StopCheck refined = observed_stop_.between(kDecimated, 1);
    double done = 0;  // vertices of levels
    for (const Index size : sizes) {
      --level_;
      const double before = std::exchange(done, done + size);
      if (!refine_to(size, refined.between(before / all, done / all))) return std::nullopt;
      refined.advance(done / all);
    }
    if (faces_without_area_margin(surface_.faces(), uv_) > 0) return std::nullopt;
    return uv_ / scale_;
  }

 private:
  // Returns whether the map is kept free of overlaps.
  bool is_apart() const { return options_.injectivity == MapInjectivity::Global; }

  // Returns the numbers of vertices of the levels above the coarsest.
  std::vector<Index> sizes() const {
    std::vector<Index> sizes;
    for (double n = surface_.vertex_count(); n > std::sqrt(rules_.ratio) * mesh_.vertices_left();
         n /= rules_.ratio)
      sizes.push_back(static_cast<Index>(n));
    std::reverse(sizes.begin(), sizes.end());
    return sizes;
  }

  bool solve_coarsest() {
    CpuWatch watch;
    weigh(mesh_.vertex_count() - mesh_.vertices_left());
    const CollapsedLevel level(mesh_, positions_, all_);
    const SurfaceMesh coarse = level.surface(surface_.file());
    const Vec x = tutte_map(coarse, stop_) * (scale_ * std::sqrt(surface_.area() / coarse.area()));
    level.put(x, uv_);
    if (options_.boundary == BoundaryCondition::Fixed && !set_boundary()) return false;
    LevelRecord record;
    record.faces = mesh_.faces_left();
    NewtonOptions options = newton_options();
    options.stopping.relative_decrease = rules_.coarse_decrease;
    const bool solved = is_apart()
                            ? solve_apart(level, rules_.coarse_decrease, kUnlimitedSteps, record)
                            : improve_all(level, options, record);
    record.solve_seconds = watch.restart();
    record_.levels.push_back(record);
    return solved && (is_apart() || !goes_on_ || goes_on_(coarse, level.places(descent_)));
  }

  // Puts the boundary where Tutte's map of the surface has it, to the last digit. Returns false if
  // the coarse boundary had to be spaced otherwise.
  bool set_boundary() {
    const Vec boundary = tutte_boundary(surface_);
    for (Index v = 0; v < surface_.vertex_count(); ++v) {
      if (!held_[v]) continue;
      const Vector2 there = scale_ * boundary.segment<2>(2 * v);
      if (!((there - descent_.place(v)).norm() <= kSamePlace * there.norm())) return false;
      descent_.put(v, there);
    }
    return true;
  }

  NewtonOptions newton_options() const {
    NewtonOptions options = newton_of_maps();
    options.stop = stop_;
    options.linear_solver = few_factorizations;
    return options;
  }

  bool refine_to(Index vertices, const StopCheck& progress) {
    CpuWatch watch;
    LevelRecord record;
    weigh(mesh_.vertex_count() - vertices);
    descent_.measure_all();
    const Index returning = vertices - mesh_.vertices_left();
    while (mesh_.vertices_left() < vertices) {
      const Index left = vertices - mesh_.vertices_left();
      if (left % kInsertionsAPoll == 0) {
        progress.poll();
        progress.advance(kInserted * (returning - left) / returning);
      }
      if (!insert(record)) return false;
    }
    record.faces = mesh_.faces_left();
    record.insert_seconds = watch.restart();
    sweep();
    record.sweep_seconds = watch.restart();
    if (record.high_energy >= rules_.compressed_share * returning) relax_compressed(record);
    record.compressed_seconds = watch.restart();
    bool solved = true;
    if (level_ > 0) {
      const CollapsedLevel level(mesh_, positions_, all_);
      const double decrease = is_coarse() ? rules_.coarse_decrease : rules_.decrease;
      NewtonOptions options = newton_options();
      options.lagged = {.below = std::numeric_limits<double>::infinity(),
                        .steps = rules_.factor_steps - 1};
      options.stopping = brief_rules(rules_.most_steps, decrease);
      solved = is_apart() ? solve_apart(level, decrease, rules_.most_steps, record)
                          : improve_all(level, options, record);
    }
    record.solve_seconds = watch.restart();
    record_.levels.push_back(record);
    return solved;
  }

  // Sets the weights of the mesh on which the first `gone` collapses are not undone. A vertex
  // stands for all vertices that collapsed onto it.
  void weigh(Index gone) {
    if (options_.face_weight.size() == 0) return;
    if (gone == 0) return descent_.weigh_faces(options_.face_weight);
    descent_.weigh_vertices(collapsed_weights(surface_, options_.face_weight, mesh_, gone));
  }

  bool insert(LevelRecord& record) {
    const CollapsingMesh::Restored back = mesh_.restore();
    descent_.measure_star(back.vertex);
    if (!(is_apart() ? put_back_within : put_back)(mesh_, positions_, descent_, back)) return false;
    double energy = improve(back.vertex, rules_.insertion_steps);
    if (!(energy > rules_.high_energy * level_energy_)) return true;
    ++record.high_energy;
    mesh_.ring(back.vertex, ring_);
    for (int round = 0;
         round < rules_.high_energy_rounds && energy > rules_.high_energy * level_energy_;
         ++round) {
      for (const Index w : ring_)
        if (!held_[w]) descent_.improve(w, 2);
      energy = improve(back.vertex, 2);
    }
    return true;
  }

  // Improves a vertex that was just reinserted.
  double improve(Index v, int steps) {
    return held_[v] ? descent_.improve_within(v, steps) : descent_.improve(v, steps);
  }

  // Moves the vertices one after the other, in the order of their numbers, several times.
  void sweep() {
    const auto moves = [this](Index v) { return mesh_.is_present(v) && !held_[v]; };
    const int threads = ThreadCount::current();
    if (threads > 1) {
      const SweepStages stages(mesh_, moves, rules_.sweeps);
      return stages.visit(descents_of(threads), stop_);
    }
    for (int sweep = 0; sweep < rules_.sweeps; ++sweep)
      for (Index v = 0; v < mesh_.vertex_count(); ++v) {
        stop_.poll_at(to_size(v));
        if (moves(v)) descent_.improve(v, 1);
      }
  }

  // Returns one descent a thread.
  std::vector<VertexDescent>& descents_of(int threads) {
    descents_.resize(to_size(threads), descent_);
    return descents_;
  }

  // Relaxes the compressed parts of a level. Errors of a difficult start lie in a small part of the
  // surface, where a Newton step costs a fraction of one on the whole.
  void relax_compressed(LevelRecord& record) {
    const CompressedVertices compressed = vertices_of_high_energy(mesh_, descent_, rules_);
    record.compressed = compressed.count;
    if (compressed.count == 0) return;
    const CollapsedLevel level(mesh_, positions_, compressed.flags);
    std::vector<char> moves = compressed.flags;
    if (is_apart())
      for (std::size_t v = 0; v < moves.size(); ++v) moves[v] = moves[v] && !held_[v];
    NewtonOptions options = newton_options();
    options.stopping = brief_rules(rules_.compressed_steps, rules_.compressed_decrease);
    const auto [problem, start] = level.problem(options_, descent_, moves, stop_);
    const SolveResult solved = NewtonMinimizer(options).minimize(problem, start, {});
    stop_.poll();
    record.compressed_steps = static_cast<int>(solved.iterations.size());
    if (solved.y.allFinite()) level.put(problem.expand(solved.y), uv_);
  }

  // Moves all vertices of the level together, without overlaps. Returns false if the solve fails.
  bool solve_apart(const CollapsedLevel& level, double decrease, int most_steps,
                   LevelRecord& record) {
    MapOptions options = options_;
    options.degree = 1;
    options.pins.clear();
    options.handles.clear();
    options.face_weight = level.weights(options_, descent_);
    options.initial = level.places(descent_);
    StepObserver watch([&](TraceEntry row, const Vec&) {
      row.level = level_;
      run_.note(std::move(row));
      return ++record.steps < most_steps ? Directive::Continue : Directive::Interrupt;
    });
    RunRecord steps = run_.part(&watch);
    const auto solved =
        solve_level_(std::make_shared<const SurfaceMesh>(level.surface(surface_.file())), options,
                     decrease, steps);
    stop_.poll();
    if (!solved) return false;
    record.energy = solved->energy;
    const bool misled = misled_by(solved->energy);
    level_energy_ = solved->energy;
    if (misled) return false;
    level.put(solved->uv, uv_);
    return true;
  }

  // Moves all vertices of the level together; the map may overlap.
  bool improve_all(const CollapsedLevel& level, const NewtonOptions& options, LevelRecord& record) {
    const auto [problem, start] = level.problem(options_, descent_, all_, stop_);
    // Energies only fall from here, so a misleading start is recognized before its steps.
    if (misled_by(Evaluator(problem).value(start))) return false;
    StepObserver watch([this](TraceEntry row, const Vec&) {
      row.level = level_;
      run_.note(std::move(row));
      return Directive::Continue;  // what ends a start is stop_
    });
    const SolveResult solved = NewtonMinimizer(options).minimize(problem, start, &watch);
    stop_.poll();
    if (!solved.y.allFinite() || !std::isfinite(solved.energy)) return false;
    record.steps = static_cast<int>(solved.iterations.size());
    record.energy = solved.energy;
    const bool misled = misled_by(solved.energy);
    level_energy_ = solved.energy;
    if (misled) return false;
    level.put(problem.expand(solved.y), uv_);
    return true;
  }

  bool is_coarse() const {
    return mesh_.faces_left() <= rules_.coarse_part * surface_.face_count();
  }

  bool misled_by(double energy) const {
    return !record_.levels.empty() && !is_coarse() &&
           level_energy_ - energy > rules_.largest_drop * std::abs(energy);
  }

  const SurfaceMesh& surface_;
  const MapOptions& options_;
  RunRecord& run_;
  const StopCheck observed_stop_, stop_;  // with progress, polled by this thread; without progress
  const MultiresolutionRules& rules_;
  MultiresolutionRecord& record_;
  const LevelSolver& solve_level_;  // if is_apart()
  const CoarseTest& goes_on_;       // if not; may be empty
  double scale_;
  Points3 positions_;  // times scale_, as all lengths here
  CollapsingMesh mesh_;
  Vec uv_;
  VertexDescent descent_;
  std::vector<VertexDescent> descents_;  // copies of it
  std::vector<char> all_, held_;         // by vertex; held: moved by solves of levels at most
  std::vector<Index> ring_;
  int level_ = 0;            // the current one, 0 the finest
  double level_energy_ = 0;  // mean, at the end of the last level
};

}  // namespace

bool suits_multiresolution(const SurfaceMesh& mesh, const MapOptions& options) {
  return barrier_of(options.energy) != Barrier::None && !knows_elements(options.energy) &&
         mesh.rest_triangles().empty() && options.boundary_angles == BoundaryAngles::Free &&
         (options.boundary == BoundaryCondition::Free || mesh.boundary_loops().size() == 1);
}

std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapOptions& options,
                                       RunRecord& run, const MultiresolutionRules& rules,
                                       MultiresolutionRecord* record,
                                       const LevelSolver& solve_level, const CoarseTest& goes_on) {
  MultiresolutionRecord unused;
  if (!suits_multiresolution(mesh, options)) return std::nullopt;
  if (options.injectivity == MapInjectivity::Global && !solve_level)
    throw InvalidArgument("multiresolution_map: a map without overlaps needs solve_level");
  return Multiresolution(mesh, options, run, rules, record ? *record : unused, solve_level, goes_on)
      .solve();
}

std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapOptions& options,
                                       const StopCheck& stop, const MultiresolutionRules& rules,
                                       MultiresolutionRecord* record) {
  RunRecord run(stop);
  return multiresolution_map(mesh, options, run, rules, record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
