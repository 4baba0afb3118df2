#include "majorant/parametrization/atlas/unwrap.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/proven_distance.h"
#include "majorant/elements/bernstein.h"
#include "majorant/elements/quadrature.h"
#include "majorant/elements/singular_values.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/maps/smallest_rectangle.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/model_unit.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/atlas/internal/chart_solver.h"
#include "majorant/parametrization/atlas/internal/kept_islands.h"
#include "majorant/parametrization/initialization/strip_unfolding.h"
#include "majorant/parametrization/solve/normalized_start.h"

namespace majorant {
namespace {

// The rule by which a curved map's stretch is integrated, the finest there is of a triangle, and
// points for its largest value besides: corners and edges, where it is nearly always.
Quadrature stretch_rule(int degree) {
  if (degree == 1) return exact_rule({3}, 1);
  return exact_rule({3}, highest_exactness({3}));
}

std::vector<Barycentric> points_on_edges(int degree) {
  if (degree == 1) return {};
  std::vector<Barycentric> points;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 2 * degree; ++i) {
      Barycentric xi = Barycentric::Zero();
      xi[k] = 1 - i / (2.0 * degree);
      xi[(k + 1) % 3] = i / (2.0 * degree);
      points.push_back(xi);
    }
  return points;
}

// 2 by 2: the derivatives of the map in face f at a point, by coordinates of the rest shape.
Eigen::Matrix2d jacobian(const BezierMap& map, const RestShapes& rest, Index f,
                         const Eigen::MatrixX2d& gradients) {
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
  for (Index q = 0; q < gradients.rows(); ++q)
    j += map.control_points().segment<2>(2 * map.space().cells()(f, q)) * gradients.row(q);
  return j * rest.inverse_of(f);
}

// #F flags: faces that have an area; all where none has.
std::vector<char> faces_with_area(const SurfaceMesh& mesh) {
  std::vector<char> has_area(to_size(mesh.face_count()), 1);
  for (const RestTriangle& t : mesh.rest_triangles()) has_area[t.face] = 0;
  if (std::find(has_area.begin(), has_area.end(), 1) == has_area.end())
    std::fill(has_area.begin(), has_area.end(), 1);
  return has_area;
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

// Charts of so few faces are not divided for the sake of the layout.
constexpr Index kFewestFaces = 2;
// A chart that has not converged after so many iterations is cut like one that has stalled; smaller
// limits are somebody's wish.
const int kLongSolve = StoppingRules().max_iterations;
// A chart is cut further so often, then it is parted.
constexpr int kMostCuts = 2;
// Where the larger part of a chart has more of its area, and stretches too much again, it is halved
// whatever the planes: parts that are cut off one by one would each cost a map of all the rest.
constexpr double kMostOfIt = 0.875;
// The part of the stretch of a map above 1 that its estimate sees, at least, where one goes by it,
// and the part of what is allowed that is aimed at then.
constexpr double kSeen = 0.3, kSurely = 0.85;

// What a layout costs, besides its seams in square roots of the area, creases a quarter, and its
// stretch (choose_cuts.h): each chart, and the square that all charts need for their area. A chart
// that fills a twentieth of its box is worth a short cut; one that fills half of it, none, unless
// it is so long that the square is mostly empty.
constexpr double kChartCost = 0.1, kFillCost = 0.1;
// Charts longer than this part of the longest one are divided together with it: its halves are
// shorter.
constexpr double kAsLong = 0.7;
// In square roots of a chart's area: how near two sides of a cut lie on each other once the chart
// is unfolded, where that has no gap. Rounding is a millionth of it.
constexpr double kClosed = 1e-9;
// Passes through cutting and mapping at most, the first one included. Far more than any layout is
// known to take: 2 to 5 for the stretch, as many for what is asked for, one or two for each of the
// layouts on the way to a fill.
constexpr int kMostPasses = 100;
// Layouts packed at most on the way to a fill, each of which takes as long as the first one: where
// it is asked for, and where it is not.
constexpr int kMostFills = 16, kMostUsualFills = 6;
// Charts that are looked at in a layout on the way to the usual fill: those that leave most of
// their boxes empty.
constexpr std::size_t kMostCandidates = 4;
// The squares of the longer sides of boxes count so much beside the square that holds them all,
// where divisions are compared: of two charts as long as the square both must be divided before it
// gets smaller.
constexpr double kLongBoxes = 0.05;
// Layouts that do not get to the usual fill must have gained so many times as much of their fill as
// their seams have, each as a part of what there was.
constexpr double kWorthSeam = 2;

// In square roots of the surface's area: how near parts of a chart's border may come to each other
// that are no neighbours along it. Floats, which rounding moves by up to 4e-8 of a square that is
// 1.4 such roots wide or so, still tell them apart.
constexpr double kClearance = 2.5e-7;

// In square roots of a chart's area: what pinned charts are apart at least. A billion
// roundings.
constexpr double kTouching = 1e-7;

// Whether charts may be cut for the sake of their stretch, their number or their fill.
bool may_cut(const UnwrapOptions& options) {
  return options.limit == StretchLimit::Kept && options.islands == Islands::Mapped &&
         chooses_cuts(options.cuts.method);
}

bool is_stretched(const UnwrapOptions& options, const Chart& chart) {
  return may_cut(options) && exceeds_stretch(options, chart);
}

// The way in which a chart can be divided.
struct Division {
  std::vector<char> cut = {};  // 3 #F flags of its mesh, none where there is no way
  double cost = 0;             // of the cut, model units
  double saved = 0;            // area of boxes: of the chart minus those of its parts
  double longest = 0;          // side of the boxes of its parts
  double price = 0;            // cost per area of the smaller part
};

// The map of the same faces as `map` that lies on `under`, or mirrored at u = 0.
BezierMap map_on(const BezierMap& under, const BezierMap& map, const StackPlace& place) {
  const TriangleIndices& ix = TriangleIndices::of_degree(map.degree());
  const double sign = place.sense == ChartSense::Mirrored ? -1 : 1;
  Vec x(map.control_points().size());
  for (Index f = 0; f < map.mesh().face_count(); ++f)
    for (int l = 0; l < ix.count(); ++l) {
      std::array<int, 3> multi{};
      for (std::size_t k = 0; k < 3; ++k)
        multi[to_size(place.corner[to_size(f)][k])] = ix.multi(l)[k];
      const Index node =
          under.space().cells()(place.face[to_size(f)], ix.local(multi[0], multi[1], multi[2]));
      const Vector2 uv = under.control_points().segment<2>(2 * node);
      x.segment<2>(2 * map.space().cells()(f, l)) = Vector2(sign * uv.x(), uv.y());
    }
  return map.with(map.shared_space(), std::move(x));
}

// A piece of the cut surface and what is asked of it.
struct Task {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::vector<Index> faces;  // of the surface
  ParametrizationOptions options;
  CutPreferences wanted = {};  // of the mesh
  Vec parent = {};             // u, v per vertex: the map of what it was cut from, or nothing
  ParentMap parent_map = ParentMap::Slit;
  int cuts = 0;                           // since it was made or parted
  double share = 1;                       // of the area of what it was parted from
  std::optional<Division> division = {};  // once it was looked for
};

class Unwrapping {
 public:
  Unwrapping(const std::shared_ptr<const SurfaceMesh>& surface, const UnwrapOptions& options,
             RunRecord& record)
      : surface_(*surface),
        options_(options),
        record_(record),
        clearance_(kClearance * std::sqrt(surface->area())) {}

  Atlas solve() {
    const ThreadCount threads(options_.chart.solve.threads);
    const double started = record_.seconds();
    CutOptions cuts = options_.cuts;
    for (const auto* points : {&options_.chart.map.pins, &options_.chart.map.handles})
      for (const Pin& p : *points) cuts.whole.push_back(p.vertex);
    cuts.copies = options_.stacking;
    if (std::isfinite(options_.cutting_seconds))
      cuts.enough = StopCheck([this] {
        return record_.seconds() > options_.cutting_seconds ? Directive::TimeLimit
                                                            : Directive::Continue;
      });
    record_.begin(Activity::Cutting);
    atlas_.cuts = choose_cuts(surface_, cuts, record_.telling(record_.start_stop()));
    make_tasks();
    seconds_.cut = record_.seconds() - started;
    record_.begin(Activity::Solving);
    atlas_.charts.resize(tasks_.size());
    std::vector<std::size_t> all(tasks_.size());
    std::iota(all.begin(), all.end(), 0);
    if (options_.islands == Islands::Kept) {
      keep_islands();
    } else {
      solve_charts(all);
      keep_limit();
      if (!leave_unmapped()) divide();
      leave_unmapped();
    }
    scale_charts();
    if (options_.packing && atlas_.status() != Status::Failed) place_charts_in_any_case();
    if (atlas_.packing && atlas_.is_complete() && atlas_.packed == Status::Converged &&
        may_cut(options_) && is_of_one_scale())
      fill_square();
    const double left = record_.seconds() - started - seconds_.cut - seconds_.map - seconds_.pack;
    seconds_.recut = std::max(0.0, left);
    atlas_.seconds = seconds_;
    return std::move(atlas_);
  }

 private:
  using Flags = std::vector<char>;
  // The charts as they are, for a way back.
  struct Work {
    std::vector<Task> tasks;
    std::vector<Chart> charts;
    SurfaceCuts cuts;
  };

  void make_tasks() {
    std::vector<Index> surface_vertex;
    const SurfaceMesh cut = surface_.cut_along(atlas_.cuts.is_cut, &surface_vertex);
    require_one_place(surface_vertex, options_.chart.map.pins);
    require_one_place(surface_vertex, options_.chart.map.handles);
    for (SurfacePiece& piece : cut.split(record_.start_stop())) {
      std::vector<Pin> pins = points_on(piece, surface_vertex, options_.chart.map.pins);
      std::vector<Pin> handles = points_on(piece, surface_vertex, options_.chart.map.handles);
      // Faces keep their numbers where the surface is cut.
      Task& task = tasks_.emplace_back(task_of(std::move(piece.mesh), std::move(piece.face)));
      task.options.map.pins = std::move(pins);
      task.options.map.handles = std::move(handles);
    }
  }

  // Without pins and handles. faces: of the surface.
  Task task_of(std::shared_ptr<const SurfaceMesh> mesh, std::vector<Index> faces) const {
    Task task;
    task.options = options_.chart;
    task.options.solve.threads = 0;
    task.options.map.pins.clear();
    task.options.map.handles.clear();
    task.options.map.face_weight = weights_on(faces);
    task.options.map.energy = for_elements(options_.chart.map.energy, faces);
    task.wanted = preferences_on(faces, options_.cuts.wanted);
    task.mesh = std::move(mesh);
    task.faces = std::move(faces);
    return task;
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

  Vec weights_on(const std::vector<Index>& faces) const {
    const Vec& all = options_.chart.map.face_weight;
    return all.size() == 0 ? Vec() : Vec(all(faces));
  }

  static bool is_held(const Task& task) {
    return !task.options.map.pins.empty() || !task.options.map.handles.empty();
  }

  // Whether overlaps of its unfolded panels are cut, not mapped away.
  bool is_cut_where_it_overlaps(const Task& task) const {
    return may_cut(options_) && !is_held(task) && unfolds_at_creases(*task.mesh, task.wanted);
  }

  // Cuts charts that stretch more than they may and maps them again, until none is left that can
  // be or a limit is reached; those that have no map as long as a start may be made.
  void keep_limit() {
    try {
      cut_bad_charts();
    } catch (const Stopped&) {
    }
    const Status why = why_over();
    for (std::size_t k = 0; k < tasks_.size(); ++k)
      if (Chart& chart = atlas_.charts[k]; chart.status != Status::Failed && may_be_cut(k))
        chart.status = why;
    sort_charts();
  }

  // Stopped.
  void cut_bad_charts() {
    for (;;) {
      const bool is_over = !may_go_on();
      std::vector<std::size_t> bad;
      for (std::size_t k = 0; k < tasks_.size(); ++k)
        if (may_be_cut(k) && (!is_over || atlas_.charts[k].status == Status::Failed))
          bad.push_back(k);
      if (bad.empty()) return;
      if (is_over) record_.start_stop().poll();
      if (const std::vector<std::size_t> sewn = sew(bad); !sewn.empty())
        solve_charts(sewn);
      else if (is_over)
        solve_charts(cut_charts(bad, cuts_of(bad, record_.start_stop())));
      else
        recut(
            bad, [&](const StopCheck& stop) { return cuts_of(bad, stop); }, work());
    }
  }

  // Takes charts out that the run was stopped before it had a map of; whether there are some.
  // Throws Stopped where no chart has one.
  bool leave_unmapped() {
    const Directive why = record_.start_stop()();
    if (why == Directive::Continue) return false;
    std::vector<Task> tasks;
    std::vector<Chart> charts;
    UnmappedCharts& unmapped = atlas_.unmapped;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      if (atlas_.charts[k].map && atlas_.charts[k].status != Status::Failed) {
        tasks.push_back(std::move(tasks_[k]));
        charts.push_back(std::move(atlas_.charts[k]));
        continue;
      }
      const std::vector<Index>& faces = tasks_[k].faces;
      unmapped.faces.insert(unmapped.faces.end(), faces.begin(), faces.end());
      ++unmapped.count;
    }
    if (charts.empty()) throw Stopped(why);
    std::sort(unmapped.faces.begin(), unmapped.faces.end());
    if (unmapped.count > 0) unmapped.status = stopped_status(why);
    tasks_ = std::move(tasks);
    atlas_.charts = std::move(charts);
    return !atlas_.is_complete();
  }

  // Returns whether there may be another pass; why_over() says why not.
  bool may_go_on() const {
    return record_.directive() == Directive::Continue && pass_ < kMostPasses;
  }
  Status why_over() const {
    const Directive why = record_.directive();
    return why == Directive::Continue ? Status::MaxIterations : stopped_status(why);
  }

  bool may_be_cut(std::size_t k) const {
    const Task& task = tasks_[k];
    const Chart& chart = atlas_.charts[k];
    if (task.mesh->face_count() == 1 || is_held(task)) return false;
    if (chart.status == Status::Failed) return true;
    const bool is_at_end =
        chart.status == Status::MaxIterations && record_.iterations_left() >= kLongSolve;
    const bool is_done =
        chart.status == Status::Converged || chart.status == Status::Stalled || is_at_end;
    return is_done && is_stretched(options_, chart);
  }

  // Closes cuts of unfolded charts whose two sides lie on each other, as where a flat ring was cut
  // open; the numbers of the charts that are to be mapped anew, of these.
  std::vector<std::size_t> sew(const std::vector<std::size_t>& bad) {
    std::map<Index, std::pair<std::size_t, std::vector<Index>>> slits;  // by first face
    Flags is_cut = atlas_.cuts.is_cut;
    for (const std::size_t k : bad) {
      if (atlas_.charts[k].status != Status::Failed || !is_cut_where_it_overlaps(tasks_[k]))
        continue;
      std::vector<Index> closed = closed_cuts(tasks_[k]);
      if (closed.empty()) continue;
      for (const Index h : closed) is_cut[h] = is_cut[surface_.opposite(h)] = 0;
      slits[tasks_[k].faces.front()] = {k, std::move(closed)};
    }
    std::vector<std::size_t> sewn;
    if (slits.empty()) return sewn;
    for (SurfacePiece& piece : surface_.cut_along(is_cut, nullptr).split()) {
      const auto found = slits.find(piece.face.front());
      if (found == slits.end() || !is_planar(*piece.mesh)) continue;
      const auto& [k, closed] = found->second;
      remove_cuts(surface_, options_.cuts, closed, atlas_.cuts);
      tasks_[k] = task_of(std::move(piece.mesh), std::move(piece.face));
      sewn.push_back(k);
    }
    return sewn;
  }

  static bool is_planar(const SurfaceMesh& mesh) {
    const Topology t = mesh.topology();
    return t.boundary_loops > 0 && t.euler_characteristic() + t.boundary_loops == 2;
  }

  // Half-edges of the surface, of cuts that nobody asked for.
  std::vector<Index> closed_cuts(const Task& task) const {
    const SurfaceMesh& mesh = *task.mesh;
    const Flags& given = options_.cuts.given;
    const Vec uv = unfolded(mesh);
    const double near = std::max(kClosed * std::sqrt(mesh.area()), clearance_);
    const auto are_near = [&](Index a, Index b) {
      return (uv.segment<2>(2 * a) - uv.segment<2>(2 * b)).norm() <= near;
    };
    std::vector<Index> closed;
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      if (mesh.opposite(h) >= 0) continue;
      const Index one = 3 * task.faces[face_of(h)] + corner_of(h), other = surface_.opposite(one);
      if (other < 0 || (!given.empty() && (given[one] || given[other]))) continue;
      const auto face = std::lower_bound(task.faces.begin(), task.faces.end(), face_of(other));
      if (face == task.faces.end() || *face != face_of(other)) continue;
      const Index o = 3 * static_cast<Index>(face - task.faces.begin()) + corner_of(other);
      if (are_near(mesh.from_vertex(h), mesh.to_vertex(o)) &&
          are_near(mesh.to_vertex(h), mesh.from_vertex(o)))
        closed.push_back(one);
    }
    return closed;
  }

  // u, v of the vertices of a piece of the chart.
  static Vec points_of(const Chart& chart, const std::vector<Index>& vertices,
                       const std::vector<Index>& uncut_vertex) {
    Vec uv(2 * static_cast<Index>(vertices.size()));
    for (std::size_t v = 0; v < vertices.size(); ++v)
      uv.segment<2>(2 * static_cast<Index>(v)) =
          chart.map->control_points().segment<2>(2 * uncut_vertex[vertices[v]]);
    return uv;
  }

  std::vector<Flags> cuts_of(const std::vector<std::size_t>& bad, const StopCheck& stop) const {
    const double all = faces_of(bad);
    double done = 0;
    return alike(bad, [&](std::size_t k) {
      const double before = std::exchange(done, done + tasks_[k].mesh->face_count());
      return cut_of(k, stop.between(before / all, done / all));
    });
  }

  double faces_of(const std::vector<std::size_t>& which) const {
    double faces = 0;
    for (const std::size_t k : which) faces += tasks_[k].mesh->face_count();
    return faces;
  }

  // Of these charts; those of copies that are to be stacked are the same.
  std::vector<Flags> alike(const std::vector<std::size_t>& which,
                           const std::function<Flags(std::size_t)>& cut) const {
    std::vector<std::shared_ptr<const SurfaceMesh>> surfaces;
    for (const std::size_t k : which) surfaces.push_back(tasks_[k].mesh);
    const std::vector<std::optional<StackPlace>> places =
        stack_places(surfaces, options_.stacking, {});
    std::vector<Flags> cuts;
    for (std::size_t i = 0; i < which.size(); ++i)
      cuts.push_back(places[i] ? flags_on(cuts[places[i]->chart], *places[i]) : cut(which[i]));
    return cuts;
  }

  // Replaces these by what they are cut into, and maps that. Where a limit of the run is reached on
  // the way, all is as before, better than starts of what it was cut into: false. before: work().
  bool recut(const std::vector<std::size_t>& which,
             const std::function<std::vector<Flags>(const StopCheck&)>& cuts_of_these,
             const Work& before) {
    record_.begin_pass(kMostPasses - ++pass_);
    record_.begin(Activity::Cutting);
    record_.announce(fmt::format("cutting again: {} of {} chart{}", which.size(), tasks_.size(),
                                 tasks_.size() == 1 ? "" : "s"));
    try {
      const std::vector<std::size_t> changed =
          cut_charts(which, cuts_of_these(record_.telling(record_.stop())));
      record_.begin(Activity::Solving);
      solve_charts(changed);
    } catch (const Stopped&) {
    }
    if (record_.directive() == Directive::Continue) return true;
    go_back_to(before);
    return false;
  }

  Work work() const { return {tasks_, atlas_.charts, atlas_.cuts}; }
  void go_back_to(const Work& before) {
    tasks_ = before.tasks;
    atlas_.charts = before.charts;
    atlas_.cuts = before.cuts;
  }

  // Replaces these by what they are cut into; the numbers of the new ones.
  std::vector<std::size_t> cut_charts(const std::vector<std::size_t>& bad,
                                      const std::vector<Flags>& cuts) {
    std::vector<Index> half_edges;
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < bad.size(); ++i) {
      const Task parent = std::move(tasks_[bad[i]]);
      const Chart map = std::move(atlas_.charts[bad[i]]);
      for (Index h = 0; h < parent.mesh->half_edge_count(); ++h)
        if (cuts[i][h]) half_edges.push_back(3 * parent.faces[face_of(h)] + corner_of(h));
      std::size_t at = bad[i];
      std::vector<Index> uncut_vertex;
      const bool is_good = map.status != Status::Failed && !is_stretched(options_, map);
      for (SurfacePiece& piece : parent.mesh->cut_along(cuts[i], &uncut_vertex).split()) {
        std::vector<Index> faces;
        for (const Index f : piece.face) faces.push_back(parent.faces[f]);
        if (at == tasks_.size()) {
          tasks_.emplace_back();
          atlas_.charts.emplace_back();
        }
        Task& task = tasks_[at] = task_of(std::move(piece.mesh), std::move(faces));
        if (map.status != Status::Failed) task.parent = points_of(map, piece.vertex, uncut_vertex);
        task.share = task.mesh->area() / parent.mesh->area();
        const bool is_part = task.faces.size() < parent.faces.size();
        task.cuts = is_part ? 1 : parent.cuts + 1;
        if (is_part && is_good) task.parent_map = ParentMap::Whole;
        changed.push_back(at);
        at = tasks_.size();
      }
    }
    add_cuts(surface_, options_.cuts, half_edges, atlas_.cuts);
    return changed;
  }

  static bool is_any(const Flags& flags) {
    return std::find(flags.begin(), flags.end(), 1) != flags.end();
  }

  // 3 #F flags: of its further cuts as one piece, first, then in two.
  Flags cut_of(std::size_t k, const StopCheck& stop) const {
    const Task& task = tasks_[k];
    const SurfaceMesh& mesh = *task.mesh;
    const Chart& chart = atlas_.charts[k];
    Flags cuts;
    if (chart.status == Status::Failed && is_cut_where_it_overlaps(task)) {
      cuts = cut_across(mesh, task.wanted, PathsAcross::FromOverlaps, stop);
    } else if (chart.status != Status::Failed && task.cuts < kMostCuts) {
      const double found = chart.stretch.l2 - 1, expected = estimated_stretch(mesh, stop) - 1;
      if (expected > kSeen * found)
        cuts = cut_further(mesh, task.wanted,
                           1 + kSurely * expected * (options_.cuts.max_stretch - 1) / found, stop);
      else
        cuts = cut_corners(mesh, task.wanted, stop);
    }
    if (is_any(cuts)) return cuts;
    const bool is_most_of_it = task.share < 1 && task.share > kMostOfIt;
    return cut_in_two(mesh, task.wanted, is_most_of_it ? PartsAround::Ends : PartsAround::Planes,
                      stop);
  }

  // Divides charts for the sake of what is asked for, or where the layout costs less then.
  void divide() {
    try {
      for (;;) {
        const std::vector<std::size_t> next = worth_dividing();
        if (next.empty()) return;
        if (!divide(next)) break;
      }
      atlas_.division = why_over();
    } catch (const Stopped& stop) {
      atlas_.division = stopped_status(stop.why());
    }
  }

  bool divide(const std::vector<std::size_t>& which) {
    if (!may_go_on()) return false;
    const Work before = work();
    const auto cuts = [&](const StopCheck&) {
      return alike(which, [&](std::size_t k) { return tasks_[k].division->cut; });
    };
    const bool is_done = recut(which, cuts, before);
    keep_limit();
    if (record_.start_stop()() == Directive::Continue) return is_done;
    if (lacks_maps()) go_back_to(before);
    return false;
  }

  bool lacks_maps() const {
    return std::any_of(atlas_.charts.begin(), atlas_.charts.end(), [](const Chart& chart) {
      return !chart.map || chart.status == Status::Failed;
    });
  }

  bool may_be_divided(std::size_t k) const {
    const Task& task = tasks_[k];
    return task.mesh->face_count() > kFewestFaces && !is_held(task) &&
           atlas_.charts[k].status != Status::Failed;
  }

  // Those whose division lowers the cost that docs/atlas.md states, or makes as many as are asked
  // for. Stopped.
  std::vector<std::size_t> worth_dividing() {
    std::vector<std::size_t> next;
    if (!may_cut(options_)) return next;
    const auto asked = static_cast<std::size_t>(std::max<Index>(options_.least_charts, 0));
    const bool is_counted = asked > tasks_.size();
    if (!is_counted && (options_.least_charts > 0 || !options_.packing)) return next;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      if (!may_be_divided(k) || (!is_counted && !(gain_at_most(k) > 0))) continue;
      const Division* const division = division_of(k);
      if (!division) continue;
      if (is_counted)
        order.emplace_back(division->price, k);
      else if (gain_of(*division) > 0)
        next.push_back(k);
    }
    std::sort(order.begin(), order.end());
    const std::size_t most = is_counted ? asked - tasks_.size() : 0;
    order.resize(std::min({order.size(), most, std::max<std::size_t>(1, tasks_.size() / 2)}));
    for (const auto& [unused, k] : order) next.push_back(k);
    return next.empty() && !is_counted && is_of_one_scale() ? too_long() : next;
  }

  // All charts that are about as long as the longest one, where the square that holds it is larger
  // than boxes need and the layout costs less once they are divided. Stopped.
  std::vector<std::size_t> too_long() {
    std::vector<double> length;
    double boxes = 0;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      const SmallestRectangle box = box_of(atlas_.charts[k], all_vertices(k));
      boxes += area_of(box);
      length.push_back(std::max(box.along, box.across));
    }
    const double longest = *std::max_element(length.begin(), length.end());
    const double square = std::max(boxes, longest * longest), area = surface_.area();
    if (!(kFillCost * (square - boxes) / area > kChartCost)) return {};
    std::vector<std::size_t> next;
    double left = 0, cost = 0;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      left = std::max(left, length[k] > kAsLong * longest ? 0 : length[k]);
      if (!(length[k] > kAsLong * longest)) continue;
      const Division* const division = may_be_divided(k) ? division_of(k) : nullptr;
      if (!division) return {};
      left = std::max(left, division->longest);
      boxes -= division->saved;
      cost += division->cost / std::sqrt(area) + kChartCost;
      next.push_back(k);
    }
    const double saved = square - std::max(boxes, left * left);
    return kFillCost * saved / area > cost ? next : std::vector<std::size_t>();
  }

  double gain_of(const Division& division) const {
    const double area = surface_.area();
    return kFillCost * division.saved / area - division.cost / std::sqrt(area) - kChartCost;
  }
  // The same if its parts filled their boxes and the cut cost nothing.
  double gain_at_most(std::size_t k) const {
    const double box = area_of(box_of(atlas_.charts[k], all_vertices(k)));
    return kFillCost * (box - atlas_.charts[k].stretch.image_area) / surface_.area() - kChartCost;
  }

  // The smallest rectangle around its vertices there.
  static SmallestRectangle box_of(const Chart& chart, const std::vector<Index>& vertices) {
    std::vector<Vector2> points;
    for (const Index v : vertices)
      points.emplace_back(chart.map->control_points().segment<2>(2 * v));
    return smallest_rectangle(points);
  }
  static double area_of(const SmallestRectangle& box) { return box.along * box.across; }
  std::vector<Index> all_vertices(std::size_t k) const {
    std::vector<Index> all(to_size(tasks_[k].mesh->vertex_count()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  // The best division of a chart, found once; null where there is none.
  const Division* division_of(std::size_t k) {
    Task& task = tasks_[k];
    if (!task.division) {
      record_.stop().poll();
      record_.announce(fmt::format("where chart {} of {} divides best", k + 1, tasks_.size()));
      const Chart& chart = atlas_.charts[k];
      Division division;
      division.cut = cut_across(*task.mesh, task.wanted, PathsAcross::BetweenEnds, record_.stop());
      if (is_any(division.cut)) {
        // By lengths: what hides seams says where they run, not how many there are.
        division.cost = cost_of_cuts(*task.mesh, {task.wanted.creases, {}}, division.cut);
        division.saved = area_of(box_of(chart, all_vertices(k)));
        double smallest = std::numeric_limits<double>::infinity();
        std::vector<Index> uncut_vertex;
        for (const SurfacePiece& part : task.mesh->cut_along(division.cut, &uncut_vertex).split()) {
          std::vector<Index> vertices;
          for (const Index v : part.vertex) vertices.push_back(uncut_vertex[v]);
          const SmallestRectangle box = box_of(chart, vertices);
          division.saved -= area_of(box);
          division.longest = std::max({division.longest, box.along, box.across});
          smallest = std::min(smallest, part.mesh->area());
        }
        division.price = division.cost / smallest;
      }
      task.division = std::move(division);
    }
    return is_any(task.division->cut) ? &*task.division : nullptr;
  }

  // In the order of their first faces.
  void sort_charts() {
    std::vector<std::size_t> order(tasks_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return tasks_[a].faces.front() < tasks_[b].faces.front();
    });
    std::vector<Task> tasks;
    std::vector<Chart> charts;
    for (const std::size_t k : order) {
      tasks.push_back(std::move(tasks_[k]));
      charts.push_back(std::move(atlas_.charts[k]));
    }
    tasks_ = std::move(tasks);
    atlas_.charts = std::move(charts);
  }

  void keep_islands() {
    const AddedSeconds time(seconds_.map);
    std::vector<std::shared_ptr<const SurfaceMesh>> islands;
    for (const Task& task : tasks_) islands.push_back(task.mesh);
    const std::vector<BezierMap> maps = kept_islands(islands);
    for (std::size_t k = 0; k < maps.size(); ++k) {
      Chart& chart = atlas_.charts[k];
      chart.faces = tasks_[k].faces;
      chart.start = ChartStart::Texture;
      chart.status = Status::Converged;
      chart.message = "kept as it is";
      take(maps[k], k);
      chart.measures.locally_injective = true;  // exactly, by kept_islands()
    }
  }

  // As UnwrapOptions::face_scale says.
  void scale_charts() {
    for (std::size_t k = 0; options_.face_scale.size() > 0 && k < tasks_.size(); ++k) {
      Chart& chart = atlas_.charts[k];
      const double scale = options_.face_scale[chart.faces.front()];
      for (const Index f : chart.faces)
        if (options_.face_scale[f] != scale)
          throw InvalidArgument("unwrap: face_scale differs within a chart");
      if (scale == 1 || !chart.map) continue;
      const bool was_injective = chart.measures.locally_injective;
      take(chart.map->with(chart.map->shared_space(), Vec(scale * chart.map->control_points())), k);
      chart.measures.locally_injective = was_injective;  // pack() proves it anew
    }
  }

  // Gives chart k this map, and its measures, whole even where the time limit is reached.
  void take(BezierMap map, std::size_t k) {
    Chart& chart = atlas_.charts[k];
    chart.measures = measure_map(map, tasks_[k].options.map.energy, record_.start_stop());
    chart.stretch = measure_stretch(map);
    chart.map = std::move(map);
  }

  // Those with these numbers.
  void solve_charts(std::vector<std::size_t> order) {
    const AddedSeconds time(seconds_.map);
    const double all = faces_of(order);
    std::atomic<Index> done = 0;  // faces
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return tasks_[a].mesh->face_count() > tasks_[b].mesh->face_count();
    });
    std::size_t large = 0;
    const auto name = [&](std::size_t chart) {
      return fmt::format("chart {} of {}", chart, order.size());
    };
    const auto solve = [&](std::size_t chart, RunObserver* observer, StopCheck::Tell starting) {
      const Index faces = tasks_[chart].mesh->face_count();
      solve_chart(chart, observer, std::move(starting));
      record_.advance((done += faces) / all);
    };
    for (; large < order.size() && tasks_[order[large]].mesh->face_count() >= kLargeChart;
         ++large) {
      record_.announce(name(large + 1));
      int told = 0;  // percents of its start
      solve(order[large], record_.observer(), [&, chart = name(large + 1)](double share) {
        const int percents = static_cast<int>(100 * share);
        if (percents <= std::exchange(told, std::max(told, percents))) return;
        record_.announce(percents < 100 ? fmt::format("{}, start {} %", chart, percents) : chart);
      });
    }
    std::size_t solved = large;
    std::mutex failing, telling;
    std::exception_ptr failure;
    std::size_t failed = tasks_.size();  // the first in the order of charts is thrown
    parallel_for(static_cast<Index>(order.size() - large), 1, [&](Index task) {
      const std::size_t chart = order[large + to_size(task)];
      try {
        solve(chart, nullptr, {});
        const std::lock_guard lock(telling);
        if (record_.observer())
          record_.observer()->after_part(name(large + to_size(task) + 1),
                                         atlas_.charts[chart].trace);
        record_.announce(name(++solved));
      } catch (...) {
        const std::lock_guard lock(failing);
        if (chart < failed) failure = std::current_exception();
        failed = std::min(failed, chart);
      }
    });
    if (failure) std::rethrow_exception(failure);
  }

  // starting: told the share of its start, where that takes long.
  void solve_chart(std::size_t k, RunObserver* observer, StopCheck::Tell starting) {
    const Task& task = tasks_[k];
    if (record_.start_stop()() != Directive::Continue) {  // before there is a map
      atlas_.charts[k].map.reset();
      return;
    }
    RunRecord record = record_.part(observer, std::move(starting));
    ChartHints hints;
    hints.parent = task.parent;
    hints.parent_map = task.parent_map;
    hints.clearance = clearance_;
    if (options_.cuts.method == CutMethod::Texture && is_textured(*task.mesh, 0))
      hints.texture = TextureStart::Tried;
    if (unfolds(*task.mesh) && !is_held(task)) hints.shape = ChartShape::Unfolds;
    if (is_cut_where_it_overlaps(task)) hints.overlaps = UnfoldedOverlaps::LeftToCuts;
    if (may_cut(options_) && !is_held(task) && task.mesh->face_count() > kFewestFaces)
      hints.slow = SlowStart::LeftToCuts;
    Chart chart = ChartSolver(task.mesh, task.options, hints).solve(record);
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

  // Charts have a place each, at their own scale, on one square.
  bool is_of_one_scale() const {
    return options_.stacking == Stacking::None && options_.face_scale.size() == 0 &&
           options_.packing->tiles <= 1;
  }

  struct Layout {
    std::vector<Task> tasks;
    Atlas atlas;
  };
  Layout layout() const { return {tasks_, atlas_}; }
  void go_back_to(Layout before) {
    tasks_ = std::move(before.tasks);
    atlas_ = std::move(before.atlas);
  }

  // Divides charts as UnwrapOptions::least_fill says.
  void fill_square() {
    if (options_.least_fill)
      fill_whatever_it_costs(*options_.least_fill);
    else if (is_filled_as_usual() && atlas_.packing->fill < kUsualFill)
      fill_for_little_seam();
  }

  // Not where somebody else says how many charts there are or how large the square is, nor charts
  // that are not what they are to be.
  bool is_filled_as_usual() const {
    const bool has_fixed = std::any_of(atlas_.charts.begin(), atlas_.charts.end(),
                                       [](const Chart& chart) { return !chart.pins.empty(); });
    const Status status = atlas_.status();
    return options_.least_charts == 0 && !options_.packing->side && !has_fixed &&
           (status == Status::Converged || status == Status::Stalled);
  }

  // Divides charts, those first that save most area for what that costs, until they fill as much of
  // the square as is asked for, or nothing is saved any more. The best of all layouts stays.
  void fill_whatever_it_costs(double least_fill) {
    Layout best = layout();
    const Status why = fill_until_done(least_fill, [&] {
      if (atlas_.packing->fill > best.atlas.packing->fill) best = layout();
    });
    go_back_to(std::move(best));
    if (why != Status::Converged) atlas_.division = why;
  }

  // Calls after_layout() after every packing; Atlas::division.
  Status fill_until_done(double least_fill, const std::function<void()>& after_layout) {
    try {
      for (int k = 0; atlas_.packing->fill < least_fill; ++k) {
        if (k == kMostFills) return Status::MaxIterations;
        const std::vector<std::size_t> next = fullest_next(least_fill);
        if (next.empty()) break;
        if (!divide(next)) return why_over();
        place_charts(PackOptions::Effort::Smallest, record_.start_stop());
        after_layout();
      }
    } catch (const Stopped& stop) {
      return stopped_status(stop.why());
    }
    return Status::Converged;
  }

  // Divides charts one by one until they fill kUsualFill of the square, or more seam would be added
  // than kLittleSeam or kMoreSeam. The first layout that fills so much stays, else the fullest of
  // those whose fill has grown kWorthSeam times as much as their seams.
  void fill_for_little_seam() {
    const Layout first = layout();
    Layout best = first;
    const double fill = atlas_.packing->fill, seams = border_length() / 2;
    const double allowed = (fill < kLowFill ? kMoreSeam : kLittleSeam) * seams;
    const auto added = [&] { return atlas_.cuts.length - first.atlas.cuts.length; };
    try {
      for (int k = 0; k < kMostUsualFills && atlas_.packing->fill < kUsualFill; ++k) {
        const std::optional<std::size_t> next = cheapest_to_fill(allowed - added());
        if (!next || !divide({*next}) || added() > allowed) break;
        place_charts(PackOptions::Effort::Smallest, record_.start_stop());
        const double aim = std::min(kUsualFill, fill * (1 + kWorthSeam * added() / seams));
        if (atlas_.packing->fill > best.atlas.packing->fill && atlas_.packing->fill >= aim)
          best = layout();
      }
    } catch (const Stopped&) {
    } catch (const Error& e) {  // no room for the padding of more charts
      if (e.kind() != ErrorKind::Unsupported) throw;
    }
    go_back_to(std::move(best));
  }

  // Of all charts, in the surface.
  double border_length() const {
    double length = 0;
    for (const Task& task : tasks_)
      for (Index h = 0; h < task.mesh->half_edge_count(); ++h)
        if (task.mesh->opposite(h) < 0) length += task.mesh->edge_length(h);
    return length;
  }

  // A division, and what its boxes would need.
  struct Attempt {
    std::size_t chart = 0;
    PathAcross path;
    double side = 0;  // of the square
    double gain =
        0;  // of the area of the square and that of long boxes, for the length of the path
    double price = 0;  // the length of the path for the area of its smaller side
  };

  // The chart whose division, which is its division_of() then, is the cheapest one of those that
  // lead to kUsualFill, or gains most for its length; where none gains anything, the one that is
  // shortest for its smaller side, since smaller charts leave less between them. None where all are
  // longer than that. Stopped.
  std::optional<std::size_t> cheapest_to_fill(double most_length) {
    std::vector<Vector2> boxes;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      const SmallestRectangle box = box_of(atlas_.charts[k], all_vertices(k));
      boxes.push_back(sides_of(box));
      const double left = area_of(box) - atlas_.charts[k].stretch.image_area;
      if (may_be_divided(k)) order.emplace_back(-left, k);
    }
    std::sort(order.begin(), order.end());
    order.resize(std::min(order.size(), kMostCandidates));
    const double side = side_of_shelves(boxes, *options_.packing);
    const double before = size_of(boxes, side);
    // Outlines leave less between them than boxes, now as after a division.
    const double aim = side * std::sqrt(atlas_.packing->fill / kUsualFill);
    std::optional<Attempt> best;
    for (const auto& [unused, k] : order) {
      record_.announce(fmt::format("where chart {} of {} divides best", k + 1, tasks_.size()));
      for (PathAcross& path :
           paths_across(*tasks_[k].mesh, tasks_[k].wanted, corners_of(k), record_.stop())) {
        if (path.length > most_length) continue;
        Attempt attempt{k, std::move(path)};
        std::vector<Vector2> after = boxes;
        after[k] = sides_of(box_of(atlas_.charts[k], attempt.path.outlines[0]));
        after.push_back(sides_of(box_of(atlas_.charts[k], attempt.path.outlines[1])));
        attempt.side = side_of_shelves(after, *options_.packing);
        if (!std::isfinite(attempt.side)) continue;
        attempt.gain = (before - size_of(after, attempt.side)) / attempt.path.length;
        attempt.price = attempt.path.length / attempt.path.smaller_area;
        if (!best || is_cheaper(attempt, *best, aim)) best = std::move(attempt);
      }
    }
    if (!best) return std::nullopt;
    Task& task = tasks_[best->chart];
    task.division =
        Division{.cut = cut_along_path(*task.mesh, task.wanted, best->path, record_.stop())};
    return best->chart;
  }

  static bool is_cheaper(const Attempt& a, const Attempt& b, double aim) {
    const bool suffices = a.side <= aim, other_suffices = b.side <= aim;
    if (suffices != other_suffices) return suffices;
    if (suffices) return a.path.length < b.path.length;
    return std::max(a.gain, b.gain) > 0 ? a.gain > b.gain : a.price < b.price;
  }

  static Vector2 sides_of(const SmallestRectangle& box) {
    return {std::max(box.along, box.across), std::min(box.along, box.across)};
  }
  static double size_of(const std::vector<Vector2>& boxes, double side) {
    double size = side * side;
    for (const Vector2& box : boxes) size += kLongBoxes * box.x() * box.x();
    return size;
  }

  // u, v of the vertices of a chart.
  Vec corners_of(std::size_t k) const {
    const std::vector<Index> all = all_vertices(k);
    return points_of(atlas_.charts[k], all, all);
  }

  // As many as fill the square if all goes as with their boxes; where no division makes boxes
  // smaller, the one that costs least for the area of its smaller part: smaller charts leave less
  // between them.
  std::vector<std::size_t> fullest_next(double least_fill) {
    std::vector<std::pair<double, std::size_t>> order, by_price;
    const double area = surface_.area();
    double boxes = 0;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      boxes += area_of(box_of(atlas_.charts[k], all_vertices(k)));
      const Division* const division = may_be_divided(k) ? division_of(k) : nullptr;
      if (division) by_price.emplace_back(division->price, k);
      if (division && division->saved > 0)
        order.emplace_back(
            -division->saved / (division->cost * std::sqrt(area) + kChartCost * area), k);
    }
    if (order.empty() && !by_price.empty())
      return {std::min_element(by_price.begin(), by_price.end())->second};
    std::sort(order.begin(), order.end());
    const double aim = boxes * atlas_.packing->fill / least_fill;
    std::vector<std::size_t> next;
    for (const auto& [unused, k] : order) {
      if (boxes <= aim) break;
      boxes -= tasks_[k].division->saved;
      next.push_back(k);
    }
    return next;
  }

  // Charts that lie on none; those that pins or handles hold are among them, and none lies on them.
  std::vector<std::size_t> choose_places() {
    std::vector<std::size_t> loose;
    std::vector<std::shared_ptr<const SurfaceMesh>> surfaces;
    std::vector<double> scale;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      const Task& task = tasks_[k];
      atlas_.charts[k].place.reset();
      if (is_held(task)) continue;
      loose.push_back(k);
      surfaces.push_back(task.mesh);
      if (options_.face_scale.size() > 0) scale.push_back(options_.face_scale[task.faces.front()]);
    }
    std::vector<std::optional<StackPlace>> places =
        stack_places(surfaces, options_.stacking, scale);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i]) continue;
      places[i]->chart = loose[places[i]->chart];
      atlas_.charts[loose[i]].place = std::move(places[i]);
    }
    std::vector<std::size_t> lowest;
    for (std::size_t k = 0; k < tasks_.size(); ++k)
      if (!atlas_.charts[k].place) lowest.push_back(k);
    return lowest;
  }

  // In a hurry where the run is to end before they have their places.
  void place_charts_in_any_case() {
    try {
      place_charts(PackOptions::Effort::Smallest, record_.start_stop());
    } catch (const Stopped& stop) {
      place_charts(PackOptions::Effort::Quick, {});
      atlas_.packed = stopped_status(stop.why());
      if (atlas_.division == Status::Converged) atlas_.division = atlas_.packed;
    }
  }

  void place_charts(PackOptions::Effort effort, const StopCheck& stop) {
    const AddedSeconds time(seconds_.pack);
    stop.poll();
    record_.begin(Activity::Packing);
    PackOptions packing = *options_.packing;
    packing.fixed.clear();
    packing.effort = effort;
    require_pinned_apart(maps_of(atlas_));
    const std::vector<std::size_t> lowest = choose_places();
    std::vector<BezierMap> maps;
    for (const std::size_t k : lowest) {
      maps.push_back(*atlas_.charts[k].map);
      packing.fixed.push_back(!atlas_.charts[k].pins.empty());
    }
    Packing packed = pack(maps, packing, record_.telling(stop));
    for (std::size_t i = 0; i < lowest.size(); ++i) {
      Chart& chart = atlas_.charts[lowest[i]];
      chart.map = packed.charts[i];
      const bool was_injective = chart.measures.locally_injective;
      chart.measures = measures_once_moved(std::move(chart.measures), *chart.map,
                                           tasks_[lowest[i]].options.map.energy);
      chart.measures.locally_injective =
          was_injective;  // pack() has proven it, by more than bounds
    }
    atlas_.packing = std::move(packed);
    lay_on(lowest);
  }

  // The other charts on those; the packing is that of all.
  void lay_on(const std::vector<std::size_t>& lowest) {
    if (lowest.size() == atlas_.charts.size()) return;
    Packing& packing = *atlas_.packing;
    std::vector<std::size_t> number(atlas_.charts.size());
    for (std::size_t i = 0; i < lowest.size(); ++i) number[lowest[i]] = i;
    Packing all = packing;
    all.charts.clear();
    all.placements.clear();
    all.tiles.clear();
    for (std::size_t k = 0; k < atlas_.charts.size(); ++k) {
      Chart& chart = atlas_.charts[k];
      const std::size_t under = number[chart.place ? chart.place->chart : k];
      if (chart.place) {
        const bool is_injective = atlas_.charts[chart.place->chart].measures.locally_injective;
        take(map_on(packing.charts[under], *chart.map, *chart.place), k);
        chart.measures.locally_injective = is_injective;  // its digits are those of the other
      }
      all.charts.push_back(*chart.map);
      all.placements.push_back(packing.placements[under]);
      all.tiles.push_back(packing.tiles[under]);
    }
    packing = std::move(all);
  }

  const SurfaceMesh& surface_;
  const UnwrapOptions& options_;
  RunRecord& record_;
  const double clearance_;  // model units
  std::vector<Task> tasks_;
  Atlas atlas_;
  AtlasSeconds seconds_;
  int pass_ = 1;  // through cutting and solving
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
  packing.border *= unit;
  packing.distance *= unit;
}

// The map, scaled, of the same faces with other numbers of vertices; pins follow.
BezierMap on_mesh(const BezierMap& map, const std::shared_ptr<const SurfaceMesh>& mesh, double unit,
                  std::vector<Pin>& pins) {
  const Cells &before = map.mesh().faces(), &after = mesh->faces();
  if (before == after) return {mesh, map.shared_space(), Vec(unit * map.control_points())};
  std::vector<Index> number(to_size(mesh->vertex_count()));
  for (Index c = 0; c < mesh->half_edge_count(); ++c)
    number[map.mesh().from_vertex(c)] = mesh->from_vertex(c);
  for (Pin& pin : pins) pin.vertex = number[pin.vertex];
  auto space =
      std::make_shared<const BezierTriangleSpace>(after, mesh->vertex_count(), map.degree());
  Vec x(2 * space->node_count());
  for (Index f = 0; f < after.rows(); ++f)
    for (Index l = 0; l < space->nodes_per_element(); ++l)
      x.segment<2>(2 * space->cells()(f, l)) =
          unit * map.control_points().segment<2>(2 * map.space().cells()(f, l));
  return {mesh, std::move(space), std::move(x)};
}

// Scales an atlas of the surface in these units back to model units. Both surfaces fall into the
// same pieces.
void to_model_units(const SurfaceMesh& surface, double unit, Atlas& atlas) {
  atlas.cuts.length *= unit;
  atlas.cuts.added_length *= unit;
  for (ComponentCuts& component : atlas.cuts.components) component.length *= unit;
  if (atlas.packing) to_model_units(unit, *atlas.packing);
  const std::vector<SurfacePiece> pieces = surface.cut_along(atlas.cuts.is_cut, nullptr).split();
  auto piece = pieces.begin();
  for (std::size_t k = 0; k < atlas.charts.size(); ++k) {
    Chart& chart = atlas.charts[k];
    while (piece->face.front() != chart.faces.front()) ++piece;  // it has no map
    chart.map = on_mesh(*chart.map, piece->mesh, unit, chart.pins);
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

// The box around the charts that lie on no other.
Eigen::AlignedBox2d box_around(const Atlas& atlas) {
  Eigen::AlignedBox2d box;
  for (const Chart& chart : atlas.charts) {
    if (chart.place) continue;
    const auto points = chart.map->control_points().reshaped(2, chart.map->space().node_count());
    box.extend(Eigen::AlignedBox2d(points.rowwise().minCoeff(), points.rowwise().maxCoeff()));
  }
  return box;
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
  const std::vector<char> has_area = faces_with_area(map.mesh());
  const Quadrature rule = stretch_rule(map.degree());
  Stretch s;
  const auto visit = [&](const Barycentric& xi, double weight) {
    const Eigen::MatrixX2d gradients = bernstein_gradients(map.degree(), xi);
    for (Index f = 0; f < map.mesh().face_count(); ++f) {
      if (!has_area[f]) continue;
      const Eigen::Matrix2d j = jacobian(map, rest, f, gradients);
      const double det = j.determinant(), area = rest.measure[f] * weight;
      s.surface_area += area;
      s.image_area += det * area;
      s.square += area * 0.5 * j.squaredNorm() / (det * det);
      s.largest = std::max(s.largest, singular_values(j).first / det);  // 1 / sigma
    }
  };
  for (Index q = 0; q < rule.size(); ++q) visit(rule.points.row(q), rule.weights[q]);
  for (const Barycentric& xi : points_on_edges(map.degree())) visit(xi, 0);
  return normalized(s);
}

bool exceeds_stretch(const UnwrapOptions& options, const Chart& chart) {
  return chart.stretch.l2 > options.cuts.max_stretch &&
         chart.map->mesh().rest_triangles().size() < chart.faces.size();
}

std::string why_stretched(const UnwrapOptions& options, const Chart& chart) {
  if (!is_stretched(options, chart)) return {};
  const bool is_stopped = chart.status != Status::Converged && chart.status != Status::Stalled;
  if (!is_stopped && chart.faces.size() == 1) return "it has no more faces";
  const auto& points = options.chart.map;
  if (!chart.pins.empty() || !points.handles.empty()) return "pins or handles hold it";
  return std::string(status_name(chart.status));
}

std::vector<BezierMap> maps_of(const Atlas& atlas) {
  std::vector<BezierMap> maps;
  for (const Chart& chart : atlas.charts) maps.push_back(*chart.map);
  return maps;
}

std::string_view start_name(ChartStart start) {
  constexpr std::array<std::string_view, 8> kNames = {
      "tutte",     "multiresolution", "parent",    "unfolded",
      "projected", "texture",         "untangled", "anew"};
  return kNames[static_cast<std::size_t>(start)];
}

Status worse_of(Status a, Status b) {
  // From the best to the worst.
  constexpr std::array kOrder = {Status::Converged, Status::Stalled,     Status::MaxIterations,
                                 Status::TimeLimit, Status::Interrupted, Status::Infeasible,
                                 Status::Failed};
  const auto rank = [&](Status s) { return std::find(kOrder.begin(), kOrder.end(), s); };
  return rank(a) < rank(b) ? b : a;
}

Status Atlas::status() const {
  Status worst = worse_of(unmapped.status, packed);
  for (const Chart& chart : charts) worst = worse_of(worst, chart.status);
  return worst;
}

std::string Atlas::message() const {
  const Status worst = status();
  for (const Chart& chart : charts)
    if (chart.status == worst && worst != Status::Converged) return chart.message;
  if (!is_complete())
    return fmt::format("{} of {} charts have no map yet", unmapped.count,
                       unmapped.count + static_cast<Index>(charts.size()));
  if (packed != Status::Converged) return "charts lie as they were arranged first";
  return {};
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
  if (scaled.packing && scaled.packing->side) *scaled.packing->side /= unit;
  Atlas atlas = Unwrapping(in_units(*surface, unit), scaled, record).solve();
  to_model_units(*surface, unit, atlas);
  return atlas;
}

double layout_size(const Atlas& atlas) {
  const Eigen::AlignedBox2d box = box_around(atlas);
  return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

std::optional<double> clearance(const Chart& chart, double at_most) {
  const double found = border_clearance(*chart.map, {.at_least = at_most});
  return found < at_most ? std::optional(found) : std::nullopt;
}

std::string problem_in_unit_square(const Atlas& atlas) {
  const Eigen::AlignedBox2d box = box_around(atlas);
  const bool is_packed = atlas.packing.has_value();
  const LayoutMotion motion =
      unit_square_motions({1, 0}, is_packed ? atlas.packing->origin : Vector2(box.min()),
                          is_packed ? atlas.packing->side : box.sizes().maxCoeff())
          .front();
  for (const Chart& chart : atlas.charts) {
    if (chart.place) continue;
    const BezierMap moved = motion(*chart.map);
    if (!has_positive_determinants(moved))
      return "its smallest triangles are too small for doubles";
    const GlobalInjectivity proof = check_boundary(moved);
    if (proof.result != ProofStatus::Proven)
      return fmt::format(
          "the chart of face {} {}, since parts of its border have no room between them",
          chart.map->mesh().input_face(0) + 1, meeting_words(proof));
  }
  return "rounding brings its charts closer together than the padding";
}

std::optional<LayoutMotion> into_unit_square(Atlas& atlas) {
  std::vector<BezierMap> maps;
  std::vector<std::size_t> lowest;
  for (std::size_t k = 0; k < atlas.charts.size(); ++k) {
    if (atlas.charts[k].place) continue;
    maps.push_back(*atlas.charts[k].map);
    lowest.push_back(k);
  }
  const Eigen::AlignedBox2d box = box_around(atlas);
  Vector2 low = box.min();
  double side = box.sizes().maxCoeff();
  LayoutPromise promise{.simple_boundaries = true};
  if (atlas.packing) {
    low = atlas.packing->origin;
    side = atlas.packing->side;
    promise.distance = atlas.packing->distance;
    for (const std::size_t k : lowest) promise.fixed.push_back(!atlas.charts[k].pins.empty());
  }
  std::vector<LayoutMotion> attempts = unit_square_motions({1, 0}, low, side);
  if (atlas.packing && atlas.packing->has_tiles) {
    attempts.resize(1);  // of others the tiles are no unit squares
    const double border = atlas.packing->border / side;
    for (const std::size_t k : lowest) {
      const Vector2 corner = tile_corner(atlas.packing->tiles[k]);
      promise.boxes.emplace_back(corner.array() + border, corner.array() + (1 - border));
    }
  }
  std::optional<MovedLayout> moved = moved_layout(maps, attempts, promise);
  if (!moved) return std::nullopt;
  for (std::size_t i = 0; i < lowest.size(); ++i)
    atlas.charts[lowest[i]].map = std::move(moved->maps[i]);
  for (Chart& chart : atlas.charts)
    if (chart.place)
      chart.map = map_on(*atlas.charts[chart.place->chart].map, *chart.map, *chart.place);
  return moved->motion;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
