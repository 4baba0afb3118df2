#include "majorant/parametrization/atlas/unwrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "majorant/certify/proven_distance.h"
#include "majorant/elements/bernstein.h"
#include "majorant/elements/singular_values.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/model_unit.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/atlas/internal/chart_solver.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"
#include "majorant/parametrization/solve/normalized_start.h"

namespace majorant {
namespace {

// Points inside a face, all of the same weight. 10 points a face; for reports alone.
constexpr int kLattice = 6;

std::vector<Barycentric> sample_points(int degree) {
  if (degree == 1) return {Barycentric::Constant(1.0 / 3)};
  std::vector<Barycentric> points;
  for (int i = 1; i < kLattice; ++i)
    for (int j = 1; j < kLattice - i; ++j)
      points.push_back(Barycentric(i, j, kLattice - i - j) / kLattice);
  return points;
}

Stretch normalized(Stretch s) {
  const double scale = s.image_area / s.surface_area;
  s.l2 = std::sqrt(s.square / s.surface_area * scale);
  s.max = s.largest * std::sqrt(scale);
  return s;
}

// Faces from which on a chart has all threads for itself. Below, loops over elements are
// too short for more than one thread to pay.
constexpr Index kLargeChart = 5000;

// In square roots of a chart's area: what pinned charts are apart at least. A billion
// roundings.
constexpr double kTouching = 1e-7;

// A piece of the cut surface and what is asked of it.
struct Task {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::vector<Index> faces;  // of the surface
  ParametrizationOptions options;
};

class Unwrapping {
 public:
  Unwrapping(const std::shared_ptr<const SurfaceMesh>& surface, const UnwrapOptions& options,
             RunRecord& record)
      : surface_(*surface), options_(options), record_(record) {}

  Atlas solve() {
    const ThreadCount threads(options_.chart.solve.threads);
    const double started = record_.seconds();
    CutOptions cuts = options_.cuts;
    for (const auto* points : {&options_.chart.map.pins, &options_.chart.map.handles})
      for (const Pin& p : *points) cuts.whole.push_back(p.vertex);
    record_.begin(Activity::Cutting);
    atlas_.cuts = choose_cuts(surface_, cuts, record_.start_stop());
    make_tasks();
    atlas_.initialize_seconds = record_.seconds() - started;
    record_.begin(Activity::Solving);
    solve_charts();
    atlas_.optimize_seconds = record_.seconds() - started - atlas_.initialize_seconds;
    if (options_.packing && atlas_.status() != Status::Failed) place_charts();
    atlas_.packing_seconds =
        record_.seconds() - started - atlas_.initialize_seconds - atlas_.optimize_seconds;
    return std::move(atlas_);
  }

 private:
  void make_tasks() {
    std::vector<Index> surface_vertex;
    const SurfaceMesh cut = surface_.cut_along(atlas_.cuts.is_cut, &surface_vertex);
    require_one_place(surface_vertex, options_.chart.map.pins);
    require_one_place(surface_vertex, options_.chart.map.handles);
    for (SurfacePiece& piece : cut.split(record_.start_stop())) {
      Task& task = tasks_.emplace_back();
      task.options = options_.chart;
      task.options.solve.threads = 0;
      task.options.map.pins = points_on(piece, surface_vertex, options_.chart.map.pins);
      task.options.map.handles = points_on(piece, surface_vertex, options_.chart.map.handles);
      task.options.map.face_weight = weights_on(piece);
      task.options.map.energy = for_elements(options_.chart.map.energy, piece.face);
      task.mesh = std::move(piece.mesh);
      task.faces = std::move(piece.face);  // faces keep their numbers where the surface is cut
    }
  }

  // Requires that every vertex of the input with a target has one place.
  void require_one_place(const std::vector<Index>& surface_vertex,
                         const std::vector<Pin>& points) const {
    std::vector<Index> copies(to_size(surface_.vertex_count()), 0);
    for (const Index v : surface_vertex) ++copies[v];
    std::map<Index, Index> places;  // by vertex of the input
    for (const Pin& p : points)
      if (p.target) places[surface_.input_vertex(p.vertex)] += copies[p.vertex];
    for (const Pin& p : points) {
      const Index name = surface_.input_vertex(p.vertex);
      if (!p.target || places.at(name) == 1) continue;
      const bool is_split = copies[p.vertex] == 1;
      const bool is_automatic = options_.cuts.method == CutMethod::Automatic;
      const std::string what =
          fmt::format("{}vertex {} has a target, but {} places in the layout: {}; take another",
                      message_prefix(surface_), name, places.at(name),
                      is_split ? "sheets were split there" : "it lies on a seam");
      if (is_split || is_automatic) throw Error(ErrorKind::Infeasible, what);
      throw Refusal(ErrorKind::Infeasible, surface_.file(), what + ", or ", Hint::AutomaticCuts,
                    ", which keeps off it");
    }
  }

  // Every copy of a vertex is held.
  static std::vector<Pin> points_on(const SurfacePiece& piece,
                                    const std::vector<Index>& surface_vertex,
                                    const std::vector<Pin>& points) {
    std::vector<Pin> out;
    if (points.empty()) return out;
    for (std::size_t v = 0; v < piece.vertex.size(); ++v)
      for (const Pin& p : points)
        if (surface_vertex[piece.vertex[v]] == p.vertex)
          out.push_back({static_cast<Index>(v), p.target});
    return out;
  }

  Vec weights_on(const SurfacePiece& piece) const {
    const Vec& all = options_.chart.map.face_weight;
    return all.size() == 0 ? Vec() : Vec(all(piece.face));
  }

  void solve_charts() {
    atlas_.charts.resize(tasks_.size());
    std::vector<std::size_t> order(tasks_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return tasks_[a].mesh->face_count() > tasks_[b].mesh->face_count();
    });
    std::size_t large = 0;
    while (large < order.size() && tasks_[order[large]].mesh->face_count() >= kLargeChart)
      solve_chart(order[large++], record_.observer());
    std::mutex failing, telling;
    std::exception_ptr failure;
    std::size_t failed = tasks_.size();  // the first in the order of charts is thrown
    parallel_for(static_cast<Index>(order.size() - large), 1, [&](Index task) {
      const std::size_t chart = order[large + to_size(task)];
      try {
        solve_chart(chart, nullptr);
        const std::vector<TraceEntry>& trace = atlas_.charts[chart].trace;
        if (trace.empty() || !record_.observer()) return;
        const std::lock_guard lock(telling);
        record_.observer()->after_step(trace.back(), {});
      } catch (...) {
        const std::lock_guard lock(failing);
        if (chart < failed) failure = std::current_exception();
        failed = std::min(failed, chart);
      }
    });
    if (failure) std::rethrow_exception(failure);
  }

  void solve_chart(std::size_t k, RunObserver* observer) {
    const Task& task = tasks_[k];
    RunRecord record = record_.part(observer);
    const bool has_texture =
        options_.cuts.method == CutMethod::Texture && is_textured(*task.mesh, 0);
    Chart chart = ChartSolver(task.mesh, task.options,
                              has_texture ? TextureStart::Tried : TextureStart::Ignored)
                      .solve(record);
    chart.faces = task.faces;
    atlas_.charts[k] = std::move(chart);
  }

  // Refuses charts that pins put on top of each other.
  void require_pinned_apart(const std::vector<BezierMap>& maps) const {
    std::vector<std::size_t> pinned;
    for (std::size_t k = 0; k < maps.size(); ++k)
      if (!atlas_.charts[k].pins.empty()) pinned.push_back(k);
    for (std::size_t i = 0; i < pinned.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const BezierMap &a = maps[pinned[j]], &b = maps[pinned[i]];
        const double near = kTouching * std::sqrt(atlas_.charts[pinned[i]].stretch.image_area);
        if (proven_distance({a, b}, near) > 0) continue;
        const auto name = [&](std::size_t k) {
          const Chart& chart = atlas_.charts[pinned[k]];
          return chart.map->mesh().input_vertex(chart.pins.front().vertex);
        };
        throw Error(ErrorKind::Infeasible,
                    fmt::format("{}the charts of the pinned vertices {} and {} meet; move their "
                                "targets apart",
                                message_prefix(surface_), name(j), name(i)));
      }
  }

  void place_charts() {
    record_.begin(Activity::Packing);
    std::vector<BezierMap> maps = maps_of(atlas_);
    PackOptions packing = *options_.packing;
    packing.fixed.clear();
    for (const Chart& chart : atlas_.charts) packing.fixed.push_back(!chart.pins.empty());
    require_pinned_apart(maps);
    atlas_.packing = pack(maps, packing, record_.start_stop());
    for (std::size_t k = 0; k < maps.size(); ++k) {
      Chart& chart = atlas_.charts[k];
      chart.map = atlas_.packing->charts[k];
      const bool was_injective = chart.measures.locally_injective;
      chart.measures =
          measures_once_moved(std::move(chart.measures), *chart.map, tasks_[k].options.map.energy);
      chart.measures.locally_injective =
          was_injective;  // pack() has proven it, by more than bounds
    }
  }

  const SurfaceMesh& surface_;
  const UnwrapOptions& options_;
  RunRecord& record_;
  std::vector<Task> tasks_;
  Atlas atlas_;
};

void scale_points(double factor, std::vector<Pin>& points) {
  for (Pin& p : points)
    if (p.target) *p.target *= factor;
}

// Returns whether it has all its digits.
bool is_in_range(double size) {
  return size >= std::numeric_limits<double>::min() && std::isfinite(size);
}

void to_model_units(double unit, Packing& packing) {
  for (LayoutMotion& placement : packing.placements) placement.origin *= unit;
  packing.origin *= unit;
  packing.side *= unit;
  packing.distance *= unit;
}

// Scales an atlas of the surface in these units back to model units. Both surfaces fall into the
// same pieces.
void to_model_units(const SurfaceMesh& surface, double unit, Atlas& atlas) {
  atlas.cuts.length *= unit;
  atlas.cuts.added_length *= unit;
  for (ComponentCuts& component : atlas.cuts.components) component.length *= unit;
  if (atlas.packing) to_model_units(unit, *atlas.packing);
  const std::vector<SurfacePiece> pieces = surface.cut_along(atlas.cuts.is_cut, nullptr).split();
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    Chart& chart = atlas.charts[k];
    chart.map = BezierMap(pieces[k].mesh, chart.map->shared_space(),
                          Vec(unit * chart.map->control_points()));
    if (atlas.packing) atlas.packing->charts[k] = *chart.map;
    scale_points(unit, chart.pins);
    Stretch& s = chart.stretch;
    for (double* area : {&s.surface_area, &s.image_area, &s.square}) *area *= unit * unit;
  }
  const Stretch all = atlas.stretch();
  const double side = atlas.packing ? atlas.packing->side : std::sqrt(all.image_area);
  if (!is_in_range(all.surface_area) || !is_in_range(all.image_area) || !is_in_range(side))
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}of some {:.0e} units, its areas or the side of its layout leave "
                            "the range of doubles; scale the mesh",
                            message_prefix(surface), unit));
}

}  // namespace

Stretch Stretch::joined(const Stretch& other) const {
  Stretch s;
  s.surface_area = surface_area + other.surface_area;
  s.image_area = image_area + other.image_area;
  s.square = square + other.square;
  s.largest = std::max(largest, other.largest);
  return s.surface_area > 0 ? normalized(s) : s;
}

Stretch measure_stretch(const BezierMap& map) {
  const RestShapes rest = rest_shapes(map.mesh());
  Stretch s;
  const std::vector<Barycentric> points = sample_points(map.degree());
  for (const Barycentric& xi : points) {
    const Eigen::MatrixX2d gradients = bernstein_gradients(map.degree(), xi);
    for (Index f = 0; f < map.mesh().face_count(); ++f) {
      Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
      for (Index q = 0; q < gradients.rows(); ++q)
        j += map.control_points().segment<2>(2 * map.space().cells()(f, q)) * gradients.row(q);
      j *= rest.inverse_of(f);
      const double det = j.determinant(), area = rest.measure[f] / double(points.size());
      s.surface_area += area;
      s.image_area += det * area;
      s.square += area * 0.5 * j.squaredNorm() / (det * det);
      s.largest = std::max(s.largest, singular_values(j).first / det);  // 1 / sigma
    }
  }
  return normalized(s);
}

std::vector<BezierMap> maps_of(const Atlas& atlas) {
  std::vector<BezierMap> maps;
  for (const Chart& chart : atlas.charts) maps.push_back(*chart.map);
  return maps;
}

std::string_view start_name(ChartStart start) {
  constexpr std::array<std::string_view, 5> kNames = {"tutte", "unfolded", "texture", "untangled",
                                                      "anew"};
  return kNames[static_cast<std::size_t>(start)];
}

Status Atlas::status() const {
  // Statuses from the best to the worst.
  constexpr std::array kOrder = {Status::Converged, Status::Stalled,     Status::MaxIterations,
                                 Status::TimeLimit, Status::Interrupted, Status::Infeasible,
                                 Status::Failed};
  const auto rank = [&](Status s) { return std::find(kOrder.begin(), kOrder.end(), s); };
  auto worst = kOrder.begin();
  for (const Chart& chart : charts) worst = std::max(worst, rank(chart.status));
  return *worst;
}

double Atlas::value() const {
  double sum = 0, area = 0;
  for (const Chart& chart : charts) {
    sum += chart.stretch.surface_area * chart.measures.value;
    area += chart.stretch.surface_area;
  }
  return sum / area;
}

Stretch Atlas::stretch() const {
  Stretch all;
  for (const Chart& chart : charts) all = all.joined(chart.stretch);
  return all;
}

Atlas unwrap(const std::shared_ptr<const SurfaceMesh>& surface, const UnwrapOptions& options,
             RunRecord& record) {
  require_given("unwrap: the surface", surface);
  require_face_data(*surface, options.chart.map);
  const double unit = model_unit(*surface);
  if (unit == 1) return Unwrapping(surface, options, record).solve();
  require_usable_sizes(*surface);
  UnwrapOptions scaled = options;
  scale_points(1 / unit, scaled.chart.map.pins);
  scale_points(1 / unit, scaled.chart.map.handles);
  Atlas atlas = Unwrapping(in_units(*surface, unit), scaled, record).solve();
  to_model_units(*surface, unit, atlas);
  return atlas;
}

std::optional<LayoutMotion> into_unit_square(Atlas& atlas) {
  const std::vector<BezierMap> maps = maps_of(atlas);
  Vector2 low = Vector2::Constant(INFINITY), high = -low;
  for (const BezierMap& map : maps) {
    const auto points = map.control_points().reshaped(2, map.space().node_count());
    low = low.cwiseMin(points.rowwise().minCoeff());
    high = high.cwiseMax(points.rowwise().maxCoeff());
  }
  double side = (high - low).maxCoeff();
  LayoutPromise promise{.simple_boundaries = true};
  if (atlas.packing) {
    low = atlas.packing->origin;
    side = atlas.packing->side;
    promise.distance = atlas.packing->distance;
    for (const Chart& chart : atlas.charts) promise.fixed.push_back(!chart.pins.empty());
  }
  std::optional<MovedLayout> moved =
      moved_layout(maps, unit_square_motions({1, 0}, low, side), promise);
  if (!moved) return std::nullopt;
  for (std::size_t k = 0; k < maps.size(); ++k) atlas.charts[k].map = std::move(moved->maps[k]);
  return moved->motion;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
