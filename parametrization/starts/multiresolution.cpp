#include "majorant/parametrization/starts/multiresolution.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <utility>

#include "majorant/framework/lbfgs.h"
#include "majorant/framework/newton.h"
#include "majorant/parametrization/maps/map_problem.h"
#include "majorant/parametrization/starts/internal/decimation.h"
#include "majorant/parametrization/starts/internal/reinsertion.h"
#include "majorant/parametrization/starts/internal/room.h"
#include "majorant/parametrization/starts/internal/vertex_descent.h"
#include "majorant/parametrization/starts/tutte.h"

namespace majorant {
namespace {

// CPU seconds of the process: what measurements on a busy machine can compare.
class CpuWatch {
 public:
  double restart() {
    const std::clock_t now = std::clock();
    return static_cast<double>(now - std::exchange(started_, now)) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t started_ = std::clock();
};

// Of the radius: points of two circles with the same spacing, computed from sums of other edges.
// Origin: far above rounding, far below the distance that another spacing makes.
constexpr double kSamePlace = 1e-9;

// The surface that a CollapsingMesh has left, its vertices numbered without gaps.
struct Level {
  Cells faces;
  std::vector<Index> vertex, face;  // of the whole surface
  Points3 positions;

  Level(const CollapsingMesh& mesh, const Points3& all) : faces(mesh.faces_left(), 3) {
    std::vector<Index> number(at(mesh.vertex_count()), -1);
    vertex.reserve(at(mesh.vertices_left()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_present(v)) continue;
      number[at(v)] = static_cast<Index>(vertex.size());
      vertex.push_back(v);
    }
    face.reserve(at(mesh.faces_left()));
    for (Index f = 0; f < mesh.face_slots(); ++f) {
      if (!mesh.has_face(f)) continue;
      for (int k = 0; k < 3; ++k)
        faces(static_cast<Index>(face.size()), k) = number[at(mesh.from(3 * f + k))];
      face.push_back(f);
    }
    positions.resize(static_cast<Index>(vertex.size()), 3);
    for (std::size_t k = 0; k < vertex.size(); ++k)
      positions.row(static_cast<Index>(k)) = all.row(vertex[k]);
  }
};

// Levels factorize a matrix or two: an ordering that takes longer than that would not pay.
std::unique_ptr<LinearSolver> few_factorizations() { return make_direct_solver(Ordering::Amd); }

SurfaceMesh surface_of(const Level& level, const std::string& file) {
  SurfaceParts parts;
  parts.file = file;
  parts.positions = level.positions;
  parts.faces = level.faces;
  parts.input_vertex = level.vertex;
  parts.input_face = level.face;
  return SurfaceMesh::from_parts(std::move(parts));
}

// A power of two that brings positions to a size of about 1: exact, and exactly undone.
double unit_scale(const Points3& positions) {
  const double size = (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
  return std::exp2(-std::round(std::log2(size)));
}

class Multiresolution {
 public:
  Multiresolution(const SurfaceMesh& surface, const MapObjective& asked, const StopCheck& stop,
                  const MultiresolutionRules& rules, MultiresolutionRecord& record)
      : surface_(surface),
        asked_(asked),
        stop_(stop),
        rules_(rules),
        record_(record),
        scale_(unit_scale(surface.positions())),
        positions_(surface.positions() * scale_),
        mesh_(surface.faces(), surface.opposites(), surface.vertex_count()),
        uv_(Vec::Zero(2 * surface.vertex_count())),
        descent_(mesh_, positions_, asked.energy, uv_) {
    held_.assign(at(surface.vertex_count()), 0);
    if (asked.boundary == BoundaryCondition::Fixed) held_ = surface.boundary_flags();
  }

  std::optional<Vec> solve() {
    CpuWatch watch;
    decimate(mesh_, positions_, {rules_.coarsest, held_}, stop_);
    record_.decimation_seconds = watch.restart();
    if (mesh_.faces_left() == surface_.face_count() || !solve_coarsest()) return std::nullopt;
    for (const Index size : sizes())
      if (!refine_to(size)) return std::nullopt;
    if (faces_without_room(surface_.faces(), uv_) > 0) return std::nullopt;
    return uv_ / scale_;
  }

 private:
  // Vertices of the levels above the coarsest.
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
    const Level level(mesh_, positions_);
    const SurfaceMesh coarse = surface_of(level, surface_.file());
    const Vec x = tutte_map(coarse, stop_) * (scale_ * std::sqrt(surface_.area() / coarse.area()));
    set(level, x);
    if (asked_.boundary == BoundaryCondition::Fixed && !set_boundary()) return false;
    LevelRecord record;
    record.faces = mesh_.faces_left();
    NewtonOptions options;
    options.stop = stop_;
    options.stopping.relative_decrease = rules_.coarse_decrease;
    options.linear_solver = few_factorizations;
    const bool solved = improve_all(level, NewtonMinimizer(options), record);
    record.solve_seconds = watch.restart();
    record_.levels.push_back(record);
    return solved;
  }

  // Where Tutte's map of the surface has it, to the last digit; false where the coarse one had to
  // be spaced otherwise.
  bool set_boundary() {
    const Vec boundary = tutte_boundary(surface_);
    for (Index v = 0; v < surface_.vertex_count(); ++v) {
      if (!held_[at(v)]) continue;
      const Vector2 there = scale_ * boundary.segment<2>(2 * v);
      if (!((there - descent_.place(v)).norm() <= kSamePlace * there.norm())) return false;
      descent_.put(v, there);
    }
    return true;
  }

  void set(const Level& level, const Vec& x) {
    for (std::size_t k = 0; k < level.vertex.size(); ++k)
      uv_.segment<2>(2 * level.vertex[k]) = x.segment<2>(2 * static_cast<Index>(k));
  }

  bool refine_to(Index vertices) {
    CpuWatch watch;
    LevelRecord record;
    weigh(mesh_.vertex_count() - vertices);
    descent_.measure_all();
    while (mesh_.vertices_left() < vertices) {
      stop_.poll_at(at(mesh_.vertices_left()));
      if (!insert(record)) return false;
    }
    record.faces = mesh_.faces_left();
    record.insert_seconds = watch.restart();
    for (int sweep = 0; sweep < rules_.sweeps; ++sweep) this->sweep();
    record.sweep_seconds = watch.restart();
    const bool finest = vertices == surface_.vertex_count();
    const bool coarse = mesh_.faces_left() <= rules_.coarse_part * surface_.face_count();
    bool solved = true;
    if (!finest) {
      LbfgsOptions options;
      options.history = rules_.history;
      options.metric_every = rules_.metric_every;
      options.stop = stop_;
      options.stopping =
          brief_rules(rules_.most_steps, coarse ? rules_.coarse_decrease : rules_.decrease);
      options.linear_solver = few_factorizations;
      solved = improve_all(Level(mesh_, positions_), LbfgsMinimizer(options), record);
    }
    record.solve_seconds = watch.restart();
    record_.levels.push_back(record);
    return solved;
  }

  // Weights for the mesh that is left when the first `gone` collapses are not undone: a vertex
  // stands for all that collapsed onto it.
  void weigh(Index gone) {
    if (asked_.face_weight.size() == 0) return;
    if (gone == 0) return descent_.weigh_faces(asked_.face_weight);
    Vec area = Vec::Zero(surface_.vertex_count()), weight = area;
    for (Index f = 0; f < surface_.face_count(); ++f) {
      const Vector3 p = surface_.positions().row(surface_.faces()(f, 0));
      const Vector3 a = Vector3(surface_.positions().row(surface_.faces()(f, 1))) - p;
      const Vector3 b = Vector3(surface_.positions().row(surface_.faces()(f, 2))) - p;
      const double measure = a.cross(b).norm();
      for (int k = 0; k < 3; ++k) {
        area[surface_.faces()(f, k)] += measure;
        weight[surface_.faces()(f, k)] += measure * asked_.face_weight[f];
      }
    }
    for (Index k = 0; k < gone; ++k) {
      const auto [vertex, onto] = mesh_.collapsed(k);
      area[onto] += area[vertex];
      weight[onto] += weight[vertex];
    }
    descent_.weigh_vertices(weight.cwiseQuotient(area));
  }

  bool insert(LevelRecord& record) {
    const CollapsingMesh::Restored back = mesh_.restore();
    descent_.measure_star(back.vertex);
    if (!put_back(mesh_, positions_, descent_, back)) return false;
    double energy = descent_.improve(back.vertex, rules_.insertion_steps);
    if (!(energy > rules_.hot * level_energy_)) return true;
    ++record.hot;
    mesh_.ring(back.vertex, ring_);
    for (int round = 0; round < rules_.hot_rounds && energy > rules_.hot * level_energy_; ++round) {
      for (const Index w : ring_)
        if (!held_[at(w)]) descent_.improve(w, 2);
      energy = descent_.improve(back.vertex, 2);
    }
    return true;
  }

  void sweep() {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      stop_.poll_at(at(v));
      if (mesh_.is_present(v) && !held_[at(v)]) descent_.improve(v, 1);
    }
  }

  // All vertices of the mesh that is left together.
  bool improve_all(const Level& level, const Minimizer& minimizer, LevelRecord& record) {
    const auto space = std::make_shared<const BezierTriangleSpace>(
        level.faces, static_cast<Index>(level.vertex.size()), 1);
    MapSpecification spec;
    static_cast<MapObjective&>(spec) = asked_;
    spec.rest = flat_triangles(level.positions, level.faces);
    if (asked_.face_weight.size() > 0) {
      spec.face_weight.resize(static_cast<Index>(level.face.size()));
      for (std::size_t k = 0; k < level.face.size(); ++k)
        spec.face_weight[static_cast<Index>(k)] = descent_.weight_of(level.face[k]);
    }
    Vec x(2 * static_cast<Index>(level.vertex.size()));
    for (std::size_t k = 0; k < level.vertex.size(); ++k)
      x.segment<2>(2 * static_cast<Index>(k)) = uv_.segment<2>(2 * level.vertex[k]);
    const MapProblem built = map_problem(
        spec, space, x, energy_terms(spec, space, {lattice_rule(1)}),
        std::make_shared<const LocalInjectivity>(space, 2 * spec.rest.measure, 0, stop_));
    const SolveResult solved = minimizer.minimize(built.problem, built.problem.reduce(x), {});
    stop_.poll();
    if (!solved.y.allFinite() || !std::isfinite(solved.energy)) return false;
    record.steps = static_cast<int>(solved.iterations.size());
    record.energy = solved.energy;
    const double drop = level_energy_ - solved.energy;
    const bool misled =
        !record_.levels.empty() && drop > rules_.largest_drop * std::abs(solved.energy);
    level_energy_ = solved.energy;
    if (misled) return false;
    set(level, built.problem.expand(solved.y));
    return true;
  }

  const SurfaceMesh& surface_;
  const MapObjective& asked_;
  const StopCheck& stop_;
  const MultiresolutionRules& rules_;
  MultiresolutionRecord& record_;
  double scale_;
  Points3 positions_;  // times scale_, as all lengths here
  CollapsingMesh mesh_;
  Vec uv_;
  VertexDescent descent_;
  std::vector<char> held_;  // by vertex
  std::vector<Index> ring_;
  double level_energy_ = 0;  // mean, where the last level ended
};

}  // namespace

bool suits_multiresolution(const SurfaceMesh& mesh, const MapObjective& asked) {
  return barrier_of(asked.energy) != Barrier::None && mesh.rest_triangles().empty() &&
         asked.boundary_angles == BoundaryAngles::Free &&
         (asked.boundary == BoundaryCondition::Free || mesh.boundary_loops().size() == 1);
}

std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapObjective& asked,
                                       const StopCheck& stop, const MultiresolutionRules& rules,
                                       MultiresolutionRecord* record) {
  MultiresolutionRecord unused;
  if (!suits_multiresolution(mesh, asked)) return std::nullopt;
  return Multiresolution(mesh, asked, stop, rules, record ? *record : unused).solve();
}

}  // namespace majorant
