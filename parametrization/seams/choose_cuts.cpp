#include "majorant/parametrization/seams/choose_cuts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <queue>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/mesh/cut_graph.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/model_unit.h"
#include "majorant/mesh/nearest_point.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/mesh/union_find.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/seams/cut_paths.h"
#include "majorant/parametrization/seams/edge_flags.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/cut_tree.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/mirror_plane.h"
#include "majorant/parametrization/seams/internal/mirrored_cuts.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// Edges named by the vertices of a file.

enum class Found { Nothing, InnerEdge, Edge };

[[noreturn]] void refuse(const std::string& source, const std::pair<Index, Index>& edge,
                         const std::string& what) {
  throw Error(
      ErrorKind::Usage,
      fmt::format("{}{}vertices {} and {} (counting from 0) are joined {}; correct the list",
                  source, source.empty() ? "" : ": ", edge.first, edge.second, what));
}

// Charts between sharp edges.

// A component of n faces has at most kFewCharts + n / kFacesPerChart charts: what a texture
// artist still handles; a box has six.
constexpr Index kFewCharts = 2, kFacesPerChart = 200;

class Charts {
 public:
  Charts(const SurfaceMesh& mesh, double radians)
      : mesh_(mesh),
        charts_(mesh.face_count()),
        component_(face_components(mesh.opposites())),
        size_(to_size(mesh.face_count()), 0),
        borders_(to_size(mesh.face_count())) {
    const Vec angle = dihedral_angles(mesh);
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (const Index o = mesh.opposite(h); o > h && angle[h] <= radians)
        charts_.join(face_of(h), face_of(o));
    for (Index f = 0; f < mesh.face_count(); ++f) ++size_[charts_.find(f)];
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      if (mesh.opposite(h) < 0) continue;
      const Index a = charts_.find(face_of(h)), b = charts_.find(face_of(mesh.opposite(h)));
      if (a != b) borders_[a][b] += mesh.edge_length(h);
    }
  }

  void join_small() {
    const Index components =
        component_.empty() ? 0 : *std::max_element(component_.begin(), component_.end()) + 1;
    std::vector<Index> faces(to_size(components), 0), charts(to_size(components), 0);
    std::set<std::pair<Index, Index>> by_size;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      ++faces[component_[f]];
      if (charts_.find(f) != f) continue;
      ++charts[component_[f]];
      by_size.emplace(size_[f], f);
    }
    while (!by_size.empty()) {
      const auto [size, chart] = *by_size.begin();
      by_size.erase(by_size.begin());
      const std::size_t c = to_size(component_[chart]);
      const bool few = charts[c] <= kFewCharts + faces[c] / kFacesPerChart;
      if (borders_[chart].empty() || (few && size > 1)) continue;
      Index best = -1;
      double longest = -1;
      for (const auto& [other, length] : borders_[chart])
        if (length > longest) longest = length, best = other;
      by_size.erase({size_[best], best});
      by_size.emplace(size + size_[best], join(chart, best));
      --charts[c];
    }
  }

  std::vector<char> borders() {
    std::vector<char> is_cut(to_size(mesh_.half_edge_count()), 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (const Index o = mesh_.opposite(h); o >= 0)
        is_cut[h] = charts_.find(face_of(h)) != charts_.find(face_of(o));
    return is_cut;
  }

 private:
  // The number of the chart that both become.
  Index join(Index a, Index b) {
    charts_.join(a, b);
    const Index joint = charts_.find(a), gone = joint == a ? b : a;
    borders_[joint].erase(gone);
    borders_[gone].erase(joint);
    for (const auto& [other, length] : borders_[gone]) {
      borders_[joint][other] += length;
      borders_[other].erase(gone);
      borders_[other][joint] += length;
    }
    borders_[gone].clear();
    size_[joint] += size_[gone];
    return joint;
  }

  const SurfaceMesh& mesh_;
  UnionFind charts_;
  const std::vector<Index> component_;            // #F
  std::vector<Index> size_;                       // faces, by number of the chart
  std::vector<std::map<Index, double>> borders_;  // by number of the chart: length with each other
};

// 3 #F flags, both sides, of the edges between the charts: parts of the surface that edges with a
// dihedral angle above `angle` (degrees) enclose. Creases that end inside a chart enclose nothing
// and are not cut. Charts are joined, the smallest first, each with the neighbour along the longest
// common border, until none is a single face and a component of n faces has at most 2 + n / 200;
// they may have any topology.
std::vector<char> sharp_charts(const SurfaceMesh& mesh, double angle) {
  Charts charts(mesh, angle * std::numbers::pi / 180);
  charts.join_small();
  return charts.borders();
}

// One chart of a connected surface, opened where that saves distortion.

// Whether a cut shall be its own mirror image where the surface is: not what is added to a chart,
// which would be added twice.
enum class Images { Wanted, Unasked };

// Of a surface, by its own half-edges and vertices.
struct CutWishes {
  CutPreferences wanted;
  std::vector<char> whole;  // #V: where cuts are not led on purpose
  StopCheck enough = {};    // CutOptions::enough
  Stacking copies = Stacking::None;
  Images images = Images::Wanted;
};

struct AutomaticCut {
  std::vector<char> is_cut;  // 3 #F, both sides: one planar piece
  double strain = 0;         // flattening_strain.h
  std::vector<Index> ends;   // vertices inside the surface where it ends
};

// The length, in square roots of the area, by which a cut that leaves no curvature at all may
// exceed the one chosen otherwise: a box, a tin and a square tube are unfolded whole.
constexpr double kDevelopableWorth = 1;
// The same where every curved vertex lies on a crease: sheared panels are seen at once.
constexpr double kFacetedWorth = 3;
// Cuts are routed anew through the ends and the cones that are left as long as they become shorter.
// Large ones only once: 50,000 faces are cut in ten seconds, and the third route of small
// ones is the last that changes anything.
constexpr Index kMostRoutes = 3, kRouteWork = 20000;
// What a cut may cost that is its own mirror image, and how long it may be, relative to the best
// one: most of the difference is that the plane is where surfaces are seen.
constexpr double kMirrorCost = 1.15, kMirrorLength = 1.1;
// Vertices whose costs are compared with those of their images, at most, and the part by which
// these may differ in the mean: rays leave a twentieth between what looks alike; a direction that
// is not in the plane, half.
constexpr Index kLookedAt = 2000;
constexpr double kUnlike = 0.2;
// The part of the limit that cuts of larger surfaces aim at: a map has some hundredths more than
// the estimate, a koala's of 114,000 faces 3 %, and a second cut costs as much as all before.
constexpr double kLargeAim = 0.95;
// In mean edges: how far an end of a cut may be from the image of another that it is shortened
// with; branches of cuts on both sides do not end at the same places.
constexpr double kPairDistance = 4;
// The numbers of branches that a cut is divided into: one for each two edges of a small mesh, and
// such that one solve for each takes as long on all large ones: a second or two; on public meshes
// the strains expected and found then agree within 10 %.
constexpr Index kMostBranches = 150, kFewestBranches = 40, kBranchSolves = 600000;
// Corrections, in proportion, where what branches are worth was estimated too low: one or two
// are enough, coarse meshes take five.
constexpr int kMostCorrections = 8;
// The number of defects at most, where there is no field: as many vertices of the largest angle
// defects; as many as fields have.
constexpr std::size_t kMostDefects = 40;
// Hollows, where weights are less than this part of the mean one and least in their neighbourhood,
// so many of them at most, the least ones: cuts of public meshes cost up to a tenth less.
constexpr double kHollow = 0.7;
constexpr std::size_t kMostHollows = 40;
// Where all cones leave more than the limit, cuts go to the places that are pressed most, too,
// those where the stress function is at least this part of its largest value, so often.
constexpr double kPressed = 0.5;
constexpr int kMostPresses = 6;
// The shares of a large surface's cut that are done after the field, the cut through its cones, and
// shortening that; of shortening what cuts through other points, after these; and of shortening,
// after what branches are worth. As measured on 270,000 faces.
constexpr double kFieldDone = 0.25, kFirstCutDone = 0.35, kFirstPeelDone = 0.6;
constexpr double kRouteDone = 0.3, kTreeDone = 0.7;

// The cut graph through these along straighter paths, where that still leaves one planar piece.
std::vector<char> straight_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                                 const Vec& cost, const StopCheck& stop) {
  const std::vector<char> is_cut = cut_graph(mesh, through, cost, stop);
  std::vector<char> straight = is_cut;
  smooth_cuts(mesh, through, cost, straight, stop);
  const SurfaceMesh open = mesh.cut_along(straight, nullptr);
  return open.topology().components == 1 && is_planar(open) ? straight : is_cut;
}

class Cutter {
 public:
  Cutter(const SurfaceMesh& mesh, const CutWishes& wishes, double limit, const StopCheck& stop)
      : mesh_(mesh),
        cost_(cut_costs(mesh, wishes.wanted, wishes.whole)),
        plain_cost_(cut_costs(mesh, {wishes.wanted.creases, {}}, wishes.whole)),
        is_whole_(wishes.whole),
        weight_(wishes.wanted.weight),
        limit_(mesh.vertex_count() > kRouteWork ? kLargeAim * limit : limit),
        unit_(std::sqrt(mesh.area())),
        told_(stop),
        stop_(stop.silent()),
        enough_(wishes.enough),
        images_(wishes.images),
        defect_(angle_defects(mesh)),
        curved_(curved_vertices()),
        is_faceted_(has_flat_panels(wishes.wanted.creases)) {}

  AutomaticCut run() {
    if (is_planar(mesh_)) {
      AutomaticCut none{std::vector<char>(to_size(mesh_.half_edge_count()), 0), 0, {}};
      none.strain = strain(none.is_cut);
      if (none.strain <= limit_) return is_faceted_ ? developed(none) : none;
    }
    std::vector<Index> cones = field_cones();
    told_.advance(kFieldDone);
    AutomaticCut best = through(cones);
    told_.advance(kFirstCutDone);
    const StopCheck run = std::exchange(stop_, enough_.may_stop() ? either(stop_, enough_) : stop_);
    try {
      improve(cones, best);
      AutomaticCut whole = developed(best);
      const bool is_plain = whole.is_cut == best.is_cut && images_ == Images::Wanted;
      best = is_plain ? mirrored(best, cones) : std::move(whole);
    } catch (const Stopped&) {
      run.poll();
    }
    return best;
  }

 private:
  static StopCheck either(const StopCheck& one, const StopCheck& other) {
    return one.asking([=] {
      const Directive why = one();
      return why == Directive::Continue ? other() : why;
    });
  }

  // Shorter cuts, as long as there are any. At every moment `best` is one.
  void improve(const std::vector<Index>& cones, AutomaticCut& best) const {
    best = peeled(best, cones, {}, told_.between(kFirstCutDone, kFirstPeelDone));
    const Index routes = std::clamp(kRouteWork / mesh_.vertex_count(), 1, kMostRoutes);
    if (routes > 1) best = through_hollows(cones, best);
    for (Index k = 0; k < routes; ++k) {
      const StopCheck told = k == 0 ? told_.between(kFirstPeelDone, 1) : StopCheck();
      AutomaticCut next = peeled_route(cones_on(best, cones), best, told);
      if (routes > 1) next = peeled_route(next.ends, next);
      if (!(cost(next) < cost(best))) break;
      best = std::move(next);
    }
  }

  // `best`, or what cuts through these and through all hollows lead to, if that is cheaper: what
  // runs where seams are wanted may take the place of what is seen.
  AutomaticCut through_hollows(std::vector<Index> terminals, const AutomaticCut& best) const {
    const std::vector<Index> low = hollows();
    if (low.empty()) return best;
    terminals.insert(terminals.end(), low.begin(), low.end());
    return peeled_route(terminals, best);
  }

  std::vector<Index> hollows() const {
    if (weight_.empty()) return {};
    const Index size = mesh_.vertex_count();
    Vec sum = Vec::Zero(size), length = sum;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      sum[mesh_.from_vertex(h)] += weight_[h] * mesh_.edge_length(h);
      length[mesh_.from_vertex(h)] += mesh_.edge_length(h);
    }
    const double most = kHollow * sum.sum() / length.sum();
    const Vec weight = sum.cwiseQuotient(length);
    std::vector<char> is_least = is_whole_;
    for (char& flag : is_least) flag = !flag;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index v = mesh_.from_vertex(h), w = mesh_.to_vertex(h);
      if (weight[v] >= weight[w]) is_least[v] = 0;
    }
    std::vector<Index> low;
    for (Index v = 0; v < size; ++v)
      if (is_least[v] && weight[v] < most) low.push_back(v);
    std::stable_sort(low.begin(), low.end(),
                     [&](Index a, Index b) { return weight[a] < weight[b]; });
    low.resize(std::min(low.size(), kMostHollows));
    return low;
  }

  // The cheapest cut found that is its own mirror image, where the surface is and that costs hardly
  // more, else `best`.
  AutomaticCut mirrored(const AutomaticCut& best, const std::vector<Index>& cones) const {
    const std::optional<MirrorPlane> plane = is_faceted_ || mesh_.vertex_count() > kRouteWork
                                                 ? std::nullopt
                                                 : mirror_plane(mesh_, stop_);
    if (!plane || !costs_are_images(*plane)) return best;
    const MirroredCuts halves(mesh_, *plane, cost_, stop_);
    if (!halves.is_parted()) return best;
    std::optional<MirroredWay> way = cheapest_way(halves, cones_on(best, cones), cones);
    if (!way) return best;
    // Large ones once, as without images.
    const Index rounds = std::clamp(kRouteWork / mesh_.vertex_count(), 1, kMostRoutes);
    for (Index k = 1; k < rounds; ++k) {
      AutomaticCut next = routed_in_halves(halves, cones_on(way->cut, cones), way->half, way->ends);
      if (next.strain > limit_ || next.is_cut == way->full) break;
      std::optional<AutomaticCut> cut = shortened_in_pairs(halves, next);
      if (!cut || !(cost(*cut) < cost(way->cut))) break;
      way->cut = *std::move(cut);
      way->full = std::move(next.is_cut);
    }
    return is_worth_mirroring(way->cut, best) ? std::move(way->cut) : best;
  }

  struct MirroredWay {
    MirroredCuts::Half half;
    MirroredCuts::Ends ends;
    std::vector<char> full;  // before it was shortened
    AutomaticCut cut;
  };

  // Of the cuts in both halves through these, or through all cones where that leaves more than the
  // limit, the cheapest once it is shortened.
  std::optional<MirroredWay> cheapest_way(const MirroredCuts& halves,
                                          const std::vector<Index>& through,
                                          const std::vector<Index>& cones) const {
    std::optional<MirroredWay> best;
    std::set<std::vector<char>> seen;
    for (const auto half : {MirroredCuts::Half::Above, MirroredCuts::Half::Below})
      for (const auto ends : {MirroredCuts::Ends::OfHalf, MirroredCuts::Ends::OfBoth}) {
        AutomaticCut full = routed_in_halves(halves, through, half, ends);
        if (full.strain > limit_) full = routed_in_halves(halves, cones, half, ends);
        if (full.strain > limit_ || !seen.insert(full.is_cut).second) continue;
        std::optional<AutomaticCut> cut = shortened_in_pairs(halves, full);
        if (cut && (!best || cost(*cut) < cost(best->cut)))
          best = {half, ends, std::move(full.is_cut), *std::move(cut)};
      }
    return best;
  }

  // Whether edges cost the same for their length near each vertex and near its image.
  bool costs_are_images(const MirrorPlane& plane) const {
    Vec cost = Vec::Zero(mesh_.vertex_count()), length = cost;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      cost[mesh_.from_vertex(h)] += cost_[h];
      length[mesh_.from_vertex(h)] += mesh_.edge_length(h);
    }
    const Vec factor = cost.cwiseQuotient(length);
    const VertexTree vertices(mesh_.positions());
    double off = 0, sum = 0;
    for (Index v = 0; v < mesh_.vertex_count(); v += 1 + mesh_.vertex_count() / kLookedAt) {
      const Index image = vertices.nearest(plane.image(mesh_.positions().row(v)));
      off += std::abs(factor[v] - factor[image]);
      sum += std::max(factor[v], factor[image]);
    }
    return off <= kUnlike * sum;
  }

  bool is_worth_mirroring(const AutomaticCut& cut, const AutomaticCut& best) const {
    return cost(cut) <= kMirrorCost * cost(best) && length(cut) <= kMirrorLength * length(best);
  }

  // The cut through these and their images.
  AutomaticCut routed_in_halves(const MirroredCuts& halves, const std::vector<Index>& through,
                                MirroredCuts::Half half, MirroredCuts::Ends ends) const {
    AutomaticCut cut{halves.cut(through, half, ends), 0, through};
    cut.strain = strain(cut.is_cut);
    return cut;
  }

  // The same, shortened on both sides alike; none where that leaves more than the limit.
  std::optional<AutomaticCut> shortened_in_pairs(const MirroredCuts& halves,
                                                 const AutomaticCut& full) const {
    const AutomaticCut part = peeled(full, full.ends, halves.plane());
    AutomaticCut cut{halves.with_images(full.is_cut, part.is_cut), 0, {}};
    const SurfaceMesh open = mesh_.cut_along(cut.is_cut, nullptr);
    if (open.topology().components != 1 || !is_planar(open)) return {};
    cut.ends = halves.ends_of(cut.is_cut);
    cut.strain = FlatteningStrain(open, -1, stop_).strain();
    if (cut.strain > limit_) return {};
    return cut;
  }

  std::vector<Index> curved_vertices() const {
    std::vector<Index> curved;
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (std::abs(defect_[v]) > kCurved && !is_whole_[v]) curved.push_back(v);
    return curved;
  }

  // Whether all curvature is where creases meet, so that panels between them unfold.
  bool has_flat_panels(const std::vector<char>& creases) const {
    std::vector<char> is_creased(to_size(mesh_.vertex_count()), 0);
    const Vec sharp = sharpness(mesh_, creases);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (sharp[h] > 0) is_creased[mesh_.from_vertex(h)] = is_creased[mesh_.to_vertex(h)] = 1;
    return !curved_.empty() &&
           std::all_of(curved_.begin(), curved_.end(), [&](Index v) { return is_creased[v] != 0; });
  }

  double cost(const AutomaticCut& cut) const { return sum_along(cut, cost_) / unit_; }
  double plain_cost(const AutomaticCut& cut) const { return sum_along(cut, plain_cost_) / unit_; }
  double sum_along(const AutomaticCut& cut, const Vec& of_edges) const {
    double sum = 0;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (cut.is_cut[h]) sum += 0.5 * of_edges[h];
    return sum;
  }
  double length(const AutomaticCut& cut) const {
    double sum = 0;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (cut.is_cut[h]) sum += 0.5 * mesh_.edge_length(h);
    return sum;
  }
  double strain(const std::vector<char>& is_cut) const {
    return FlatteningStrain(mesh_.cut_along(is_cut, nullptr), -1, stop_).strain();
  }
  AutomaticCut routed(const std::vector<Index>& terminals) const {
    AutomaticCut cut{straight_graph(mesh_, terminals, cost_, stop_), 0, terminals};
    cut.strain = strain(cut.is_cut);
    return cut;
  }

  // The cut through these, and through what is pressed most where that leaves more than the limit.
  AutomaticCut through(std::vector<Index>& terminals) const {
    AutomaticCut cut = routed(terminals);
    for (int k = 0; k < kMostPresses && cut.strain > limit_; ++k) {
      const std::vector<Index> more = pressed(cut);
      if (more.empty()) break;
      terminals.insert(terminals.end(), more.begin(), more.end());
      cut = routed(terminals);
    }
    return cut;
  }

  // Vertices inside the surface, cut so, where the stress function is largest in their
  // neighbourhood: what holds it at 0 there saves most.
  std::vector<Index> pressed(const AutomaticCut& cut) const {
    std::vector<Index> whole;  // vertex of mesh_
    const SurfaceMesh open = mesh_.cut_along(cut.is_cut, &whole);
    const FlatteningStrain sheet(open, -1, stop_);
    Vec stress = Vec::Zero(open.vertex_count());
    const std::vector<char> is_boundary = open.boundary_flags();
    for (Index v = 0; v < stress.size(); ++v)
      if (!is_boundary[v] && std::isfinite(sheet.strain()))
        stress[v] = std::abs(sheet.apply({{v, 1.0}}, sheet.chi()));
    std::vector<char> is_top(is_boundary.size(), 1);
    for (Index h = 0; h < open.half_edge_count(); ++h)
      if (stress[open.from_vertex(h)] < stress[open.to_vertex(h)]) is_top[open.from_vertex(h)] = 0;
    const double least = kPressed * stress.maxCoeff();
    std::vector<Index> tops;
    for (Index v = 0; v < stress.size(); ++v)
      if (stress[v] > 0 && stress[v] >= least && is_top[v] && !is_whole_[whole[v]])
        tops.push_back(whole[v]);
    return tops;
  }

  std::vector<Index> field_cones() const {
    std::vector<Index> cones = all_field_cones();
    std::erase_if(cones, [&](Index v) { return is_whole_[v] != 0; });
    return cones;
  }

  std::vector<Index> all_field_cones() const {
    CrossFieldOptions field;
    field.stop = told_.between(0, kFieldDone);
    try {
      return smoothest_field_cones(mesh_, field);
    } catch (const Error&) {  // too coarse
      std::vector<Index> most(to_size(mesh_.vertex_count()));
      for (Index v = 0; v < mesh_.vertex_count(); ++v) most[v] = v;
      std::stable_sort(most.begin(), most.end(), [&](Index a, Index b) {
        return std::abs(defect_[a]) > std::abs(defect_[b]);
      });
      most.resize(std::min(most.size(), kMostDefects));
      return most;
    }
  }

  // told: what is said of it; what stops it is stop_.
  AutomaticCut peeled(const AutomaticCut& full, const std::vector<Index>& terminals,
                      const std::optional<MirrorPlane>& mirror = {},
                      const StopCheck& told = {}) const {
    const StopCheck check = told.asking([this] { return stop_(); });
    std::vector<char> is_terminal(to_size(mesh_.vertex_count()), 0);
    for (const Index v : terminals) is_terminal[v] = 1;
    const Index branches =
        std::clamp(kBranchSolves / mesh_.vertex_count(), kFewestBranches, kMostBranches);
    CutTree tree(mesh_, full.is_cut, is_terminal, cost_, branches, check.between(0, kTreeDone));
    if (mirror) tree.shorten_in_pairs(*mirror, kPairDistance * mean_edge_length(mesh_));
    const double limit = std::max(limit_, full.strain);
    tree.peel(full.strain, limit, stop_);
    std::size_t steps = tree.steps_within(limit);
    for (int k = 0; k < kMostCorrections && steps > 0; ++k) {
      CutTree::State state = tree.after(steps);
      const double reached = strain(state.is_cut);
      if (reached <= limit) return {std::move(state.is_cut), reached, std::move(state.ends)};
      const double aim = full.strain + (tree.strain_after(steps) - full.strain) *
                                           (limit - full.strain) / (reached - full.strain);
      steps = std::min(steps - 1, tree.steps_within(aim));
    }
    return {full.is_cut, full.strain, tree.after(0).ends};
  }

  // `best`, or what a cut through these vertices leads to, if that is shorter.
  AutomaticCut peeled_route(const std::vector<Index>& terminals, const AutomaticCut& best,
                            const StopCheck& told = {}) const {
    const AutomaticCut full = routed(terminals);
    told.advance(kRouteDone);
    if (full.strain > std::max(limit_, best.strain)) return best;
    AutomaticCut cut = peeled(full, terminals, {}, told.between(kRouteDone, 1));
    return cost(cut) < cost(best) ? cut : best;
  }

  std::vector<Index> cones_on(const AutomaticCut& cut, const std::vector<Index>& cones) const {
    std::vector<char> is_met(to_size(mesh_.vertex_count()), 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (cut.is_cut[h]) is_met[mesh_.from_vertex(h)] = 1;
    std::vector<Index> on = cut.ends;
    for (const Index v : cones)
      if (is_met[v]) on.push_back(v);
    return on;
  }

  // What a cut through all of these costs at least: disjoint balls around them, in each of which it
  // leads from the middle to the border, half as far as to the nearest other one or the boundary.
  double cost_to_join(const std::vector<Index>& vertices) const {
    const auto size = to_size(mesh_.vertex_count());
    std::vector<std::vector<Index>> leaving(size);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (mesh_.opposite(h) >= 0) leaving[mesh_.from_vertex(h)].push_back(h);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::vector<double> distance(size, kFar);
    std::vector<Index> nearest(size, -1);
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    const auto start_at = [&](Index v) {
      distance[v] = 0;
      nearest[v] = v;
      front.emplace(0, v);
    };
    const std::vector<char> is_boundary = mesh_.boundary_flags();
    for (std::size_t v = 0; v < size; ++v)
      if (is_boundary[v]) start_at(static_cast<Index>(v));
    for (const Index v : vertices) start_at(v);
    while (!front.empty()) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance[v]) continue;
      for (const Index h : leaving[v]) {
        const Index w = mesh_.to_vertex(h);
        if (d + plain_cost_[h] >= distance[w]) continue;
        distance[w] = d + plain_cost_[h];
        nearest[w] = nearest[v];
        front.emplace(distance[w], w);
      }
    }
    std::vector<double> apart(size, kFar);  // by vertex: from the nearest other one
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index v = mesh_.from_vertex(h), w = mesh_.to_vertex(h);
      if (mesh_.opposite(h) < 0 || nearest[v] == nearest[w]) continue;
      apart[nearest[v]] = std::min(apart[nearest[v]], distance[v] + plain_cost_[h] + distance[w]);
    }
    double sum = 0;
    for (const Index v : vertices)
      if (apart[v] < kFar) sum += 0.5 * apart[v];
    return sum;
  }

  // The cut through all vertices that are not flat, if that is worth it, else `best`.
  AutomaticCut developed(const AutomaticCut& best) const {
    const double most = plain_cost(best) + (is_faceted_ ? kFacetedWorth : kDevelopableWorth);
    if (cost_to_join(curved_) > most * unit_) return best;
    const AutomaticCut cut = routed(curved_);
    return plain_cost(cut) <= most && (is_faceted_ || cut.strain < best.strain) ? cut : best;
  }

  const SurfaceMesh& mesh_;
  const Vec cost_;
  const Vec plain_cost_;  // without weights: they say where cuts run, not how much is cut
  const std::vector<char>& is_whole_;
  const std::vector<double>& weight_;
  const double limit_, unit_;
  const StopCheck told_;
  StopCheck stop_;  // says nothing: most of what it is for is done many times
  const StopCheck& enough_;
  const Images images_;
  const Vec defect_;
  const std::vector<Index> curved_;
  const bool is_faceted_;
};

// The rule is that of docs/atlas.md, "Where to cut". max_stretch: above 1. Stopped.
AutomaticCut automatic_cut(const SurfaceMesh& mesh, const CutWishes& wishes, double max_stretch,
                           const StopCheck& stop) {
  return Cutter(mesh, wishes, strain_of_stretch(max_stretch), stop).run();
}

std::vector<Index> curved_inside(const SurfaceMesh& mesh) {
  const Vec defect = angle_defects(mesh);
  std::vector<Index> curved;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (std::abs(defect[v]) > kCurved) curved.push_back(v);
  return curved;
}

// The least area of a piece, relative to that of all: squares of areas, and what remains of them
// after many factors, must be doubles; 1e-80 of the size is mapped.
constexpr double kLeastArea = 1e-160;

void require_valid(const SurfaceMesh& mesh, const CutOptions& options) {
  if (!(options.max_stretch > 1) || !std::isfinite(options.max_stretch))
    throw InvalidArgument(
        fmt::format("the largest stretch of a chart, {:g}, must be above 1, that of an "
                    "isometry; try {:g}",
                    options.max_stretch, CutOptions().max_stretch));
  if (!(options.sharp_angle > 0) || !(options.sharp_angle < 180))
    throw InvalidArgument("the angle of sharp edges must lie between 0 and 180 degrees");
  for (const Index v : options.whole)
    if (v < 0 || v >= mesh.vertex_count())
      throw InvalidArgument(
          fmt::format("{}vertex {}, to be left whole, does not exist", message_prefix(mesh), v));
  const std::vector<double>& weight = options.wanted.weight;
  for (const auto& [count, what] : {std::pair(options.given.size(), "flags"),
                                    {options.wanted.creases.size(), "flags"},
                                    {weight.size(), "weights"}})
    if (count > 0 && count != to_size(mesh.half_edge_count()))
      throw InvalidArgument(
          fmt::format("choose_cuts: {} {} for {} half-edges", count, what, mesh.half_edge_count()));
  for (std::size_t h = 0; h < weight.size(); ++h)
    if (!(weight[h] > 0) || !std::isfinite(weight[h]))
      throw InvalidArgument(fmt::format(
          "choose_cuts: the weight of half-edge {} is {:g}, not a positive number", h, weight[h]));
  if (options.method == CutMethod::Texture && mesh.corner_texcoords().rows() == 0)
    throw Refusal(
        ErrorKind::Unsupported, mesh.file(),
        message_prefix(mesh) + "no face has texture coordinates, along which it could be cut; use ",
        Hint::AutomaticCuts);
}

// The cuts that are asked for: flags of both sides.
std::vector<char> asked_cuts(const SurfaceMesh& mesh, const CutOptions& options) {
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  if (options.method == CutMethod::Texture) is_cut = texture_borders(mesh);
  if (options.method == CutMethod::Sharp) is_cut = sharp_charts(mesh, options.sharp_angle);
  if (options.method == CutMethod::Given)
    is_cut = flags_of_edges(mesh, options.edges, options.edges_source);
  for (std::size_t h = 0; h < options.given.size(); ++h)
    if (const Index o = mesh.opposite(static_cast<Index>(h)); options.given[h] && o >= 0)
      is_cut[h] = is_cut[o] = 1;
  return is_cut;
}

// surface: in units in which its extent is an ordinary number.
void require_area_in_range(const SurfaceMesh& surface, double unit) {
  const double area = surface.area() * unit * unit;
  if (area >= std::numeric_limits<double>::min() && std::isfinite(area)) return;
  throw Error(ErrorKind::Unsupported,
              fmt::format("{}of some {:.0e} units, its area leaves the range of doubles; scale "
                          "the mesh",
                          message_prefix(surface), unit));
}

void require_usable_size(const SurfacePiece& part, double whole) {
  const double area = part.mesh->area();
  if (area > kLeastArea * whole) return;
  throw Refusal(ErrorKind::Unsupported, part.mesh->file(),
                fmt::format("{}the piece of face {} has {:.3g} of the area of all, too little for "
                            "lengths in double precision; remove it or ",
                            message_prefix(*part.mesh), user_face(*part.mesh, 0), area / whole),
                Hint::MapAlone);
}

bool face_has_area(const SurfaceMesh& mesh, Index face) {
  const auto corner = [&](Index k) -> Vector3 {
    return mesh.positions().row(mesh.faces()(face, k));
  };
  return has_area(corner(0), corner(1), corner(2));
}

// Twice the largest area of a face, where all have none but for rounding.
std::optional<double> area_of_slivers(const SurfaceMesh& mesh) {
  double largest = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (face_has_area(mesh, f)) return {};
    largest = std::max(largest, area_vector(mesh, f).norm());
  }
  return largest;
}

// A face without an area beside others that have one gets a place of its own: around it these would
// be distorted. Not a part of a polygon.
void part_from_slivers(const SurfacePiece& part, std::vector<char>& is_cut) {
  const SurfaceMesh& mesh = *part.mesh;
  if (mesh.rest_triangles().empty() || area_of_slivers(mesh)) return;
  for (const RestTriangle& t : mesh.rest_triangles()) {
    const Index first = 3 * t.face;
    const auto is_polygon = [&](Index h) { return mesh.opposite(h) >= 0 && is_inner(mesh, h); };
    if (face_has_area(mesh, t.face) || is_polygon(first) || is_polygon(first + 1) ||
        is_polygon(first + 2))
      continue;
    for (Index h = first; h < first + 3; ++h) {
      const Index o = mesh.opposite(h);
      if (o < 0) continue;
      is_cut[3 * part.face[t.face] + corner_of(h)] = 1;
      is_cut[3 * part.face[face_of(o)] + corner_of(o)] = 1;
    }
  }
}

// A piece whose faces all have no area is taken apart, unless they are thin beyond measure and lie
// in the plane: nothing is known of their shapes beside each other.
void take_apart_if_flat(const SurfacePiece& part, double max_stretch, std::vector<char>& is_cut,
                        const StopCheck& stop) {
  const SurfaceMesh& mesh = *part.mesh;
  const std::optional<double> largest = area_of_slivers(mesh);
  if (!largest) return;
  if (*largest > 0 && is_planar(mesh) &&
      FlatteningStrain(mesh, -1, stop).strain() <= strain_of_stretch(max_stretch))
    return;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0) is_cut[3 * part.face[face_of(h)] + corner_of(h)] = 1;
}

// The pieces that are meant, of those that are left so far. NotByTexture: those that are closed, as
// no coordinates cut them (all zero, say), and those whose faces have none.
enum class Pieces { All, NotByTexture };

// Of every piece the first one that it is a copy of, where these are to be cut alike.
std::vector<std::optional<StackPlace>> copies_among(const std::vector<SurfacePiece>& pieces,
                                                    const CutWishes& wishes) {
  std::vector<std::shared_ptr<const SurfaceMesh>> meshes;
  for (const SurfacePiece& piece : pieces) meshes.push_back(piece.mesh);
  const bool is_any_whole =
      std::find(wishes.whole.begin(), wishes.whole.end(), 1) != wishes.whole.end();
  return stack_places(meshes, is_any_whole ? Stacking::None : wishes.copies, {});
}

// Cuts them, each to one chart.
void cut_automatically(const SurfaceMesh& mesh, const CutWishes& wishes, double max_stretch,
                       Pieces which, SurfaceCuts& cuts, const StopCheck& stop) {
  std::vector<Index> uncut_vertex;
  const std::vector<Index> component = face_components(mesh.opposites());
  const std::vector<SurfacePiece> pieces = mesh.cut_along(cuts.is_cut, &uncut_vertex).split(stop);
  const std::vector<std::optional<StackPlace>> places = copies_among(pieces, wishes);
  std::vector<AutomaticCut> cut(pieces.size());
  const double all = mesh.face_count();
  double done = 0;  // faces
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    stop.poll();
    const auto& [part, faces, vertices] = pieces[k];
    const SurfaceMesh& piece = *part;
    const double before = std::exchange(done, done + piece.face_count());
    if (which == Pieces::NotByTexture && piece.topology().boundary_loops > 0 &&
        is_textured(piece, 0))
      continue;
    CutWishes own{preferences_on(faces, wishes.wanted), std::vector<char>(vertices.size()),
                  wishes.enough};
    for (std::size_t v = 0; v < vertices.size(); ++v)
      own.whole[v] = wishes.whole[uncut_vertex[vertices[v]]];
    AutomaticCut& more = cut[k];
    if (places[k]) {
      more = cut[places[k]->chart];
      more.is_cut = flags_on(more.is_cut, *places[k]);
    } else {
      more = automatic_cut(piece, own, max_stretch, stop.between(before / all, done / all));
    }
    stop.advance(done / all);
    for (Index h = 0; h < piece.half_edge_count(); ++h)
      if (more.is_cut[h]) cuts.is_cut[3 * faces[face_of(h)] + corner_of(h)] = 1;
    ComponentCuts& facts = cuts.components[component[faces.front()]];
    facts.terminals += static_cast<Index>(more.ends.size());
    facts.estimated_stretch = std::max(facts.estimated_stretch, stretch_of_strain(more.strain));
  }
}

// Lengths and counts, from the flags.
void add_up(const SurfaceMesh& mesh, const std::vector<char>& asked,
            const std::vector<std::vector<Index>>& components, SurfaceCuts& cuts) {
  const std::vector<Index> piece =
      face_components(mesh.cut_along(cuts.is_cut, nullptr).opposites());
  for (std::size_t c = 0; c < components.size(); ++c) {
    ComponentCuts& facts = cuts.components[c];
    std::set<Index> pieces;
    for (const Index f : components[c]) {
      pieces.insert(piece[f]);
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (!cuts.is_cut[h] || h > mesh.opposite(h)) continue;
        const double length = mesh.edge_length(h);
        facts.length += length;
        ++cuts.edges;
        if (asked[h]) continue;
        cuts.added_length += length;
        ++cuts.added_edges;
      }
    }
    facts.pieces = static_cast<Index>(pieces.size());
    cuts.length += facts.length;
  }
}

SurfaceCuts cuts_near_one(const SurfaceMesh& mesh, const CutOptions& options,
                          const StopCheck& stop) {
  CutWishes wishes{options.wanted, std::vector<char>(to_size(mesh.vertex_count()), 0),
                   options.enough, chooses_cuts(options.method) ? options.copies : Stacking::None};
  for (const Index v : options.whole) wishes.whole[v] = 1;
  SurfaceCuts out;
  out.is_cut = asked_cuts(mesh, options);
  std::vector<char> asked = out.is_cut;
  const auto components = component_faces(mesh.opposites());
  const double area = mesh.area();
  for (const SurfacePiece& part : mesh.split(stop)) {
    stop.poll();
    ComponentCuts facts;
    facts.first_face = part.face.front();
    facts.faces = part.mesh->face_count();
    facts.genus = genus(*part.mesh);
    facts.boundary_loops = part.mesh->topology().boundary_loops;
    out.components.push_back(facts);
    require_usable_size(part, area);
    take_apart_if_flat(part, options.max_stretch, out.is_cut, stop);
    if (chooses_cuts(options.method)) part_from_slivers(part, out.is_cut);
  }
  if (chooses_cuts(options.method))
    cut_automatically(mesh, wishes, options.max_stretch, Pieces::All, out, stop);
  if (options.method == CutMethod::Texture) {
    cut_automatically(mesh, wishes, options.max_stretch, Pieces::NotByTexture, out, stop);
    out.untextured_faces = untextured_polygons(mesh);
  }
  if (options.method == CutMethod::Automatic) asked = out.is_cut;
  open_pieces(mesh, cut_costs(mesh, wishes.wanted, wishes.whole), out.is_cut, stop);
  add_up(mesh, asked, components, out);
  return out;
}

// The flags of these half-edges, both sides, and what is counted of them.
void set_cuts(const SurfaceMesh& mesh, const CutOptions& options,
              const std::vector<Index>& half_edges, char flag, SurfaceCuts& cuts) {
  const std::vector<Index> component = face_components(mesh.opposites());
  const int sign = flag ? 1 : -1;
  for (const Index h : half_edges) {
    const Index o = mesh.opposite(h);
    if (o < 0 || cuts.is_cut[h] == flag) continue;
    cuts.is_cut[h] = cuts.is_cut[o] = flag;
    const double length = sign * mesh.edge_length(h);
    cuts.length += length;
    cuts.edges += sign;
    cuts.components[component[face_of(h)]].length += length;
    if (options.method == CutMethod::Automatic) continue;
    cuts.added_length += length;
    cuts.added_edges += sign;
  }
  for (ComponentCuts& facts : cuts.components) facts.pieces = 0;
  const auto pieces = component_faces(mesh.cut_along(cuts.is_cut, nullptr).opposites());
  for (const std::vector<Index>& faces : pieces) ++cuts.components[component[faces.front()]].pieces;
}

}  // namespace

std::vector<char> cut_further(const SurfaceMesh& chart, const CutPreferences& wanted,
                              double max_stretch, const StopCheck& stop) {
  CutWishes wishes{wanted, std::vector<char>(to_size(chart.vertex_count()), 0)};
  wishes.images = Images::Unasked;
  return automatic_cut(chart, wishes, max_stretch, stop).is_cut;
}

std::vector<char> cut_corners(const SurfaceMesh& chart, const CutPreferences& wanted,
                              const StopCheck& stop) {
  const std::vector<Index> curved = curved_inside(chart);
  if (curved.empty() || curved.size() > kMostDefects)
    return std::vector<char>(to_size(chart.half_edge_count()), 0);
  return straight_graph(chart, curved, cut_costs(chart, wanted), stop);
}

double estimated_stretch(const SurfaceMesh& chart, const StopCheck& stop) {
  return stretch_of_strain(FlatteningStrain(chart, -1, stop).strain());
}

void add_cuts(const SurfaceMesh& mesh, const CutOptions& options,
              const std::vector<Index>& half_edges, SurfaceCuts& cuts) {
  set_cuts(mesh, options, half_edges, 1, cuts);
}

void remove_cuts(const SurfaceMesh& mesh, const CutOptions& options,
                 const std::vector<Index>& half_edges, SurfaceCuts& cuts) {
  set_cuts(mesh, options, half_edges, 0, cuts);
}

void require_usable_sizes(const SurfaceMesh& mesh, const StopCheck& stop) {
  const double unit = model_unit(mesh);
  if (unit != 1) {
    const auto scaled = in_units(mesh, unit);
    require_area_in_range(*scaled, unit);
    return require_usable_sizes(*scaled, stop);
  }
  const double area = mesh.area();
  for (const SurfacePiece& part : mesh.split(stop)) require_usable_size(part, area);
}

std::vector<char> flags_of_edges(const SurfaceMesh& mesh,
                                 const std::vector<std::array<Index, 2>>& edges,
                                 const std::string& source) {
  std::map<std::pair<Index, Index>, Found> wanted;
  for (const auto& [a, b] : edges) wanted[std::minmax(a, b)] = Found::Nothing;
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    const auto edge = wanted.find(
        std::minmax(mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))));
    if (edge == wanted.end()) continue;
    if (o >= 0 && mesh.input_face(face_of(h)) == mesh.input_face(face_of(o))) {
      edge->second = std::max(edge->second, Found::InnerEdge);
    } else {
      edge->second = Found::Edge;
      is_cut[h] = o >= 0;
    }
  }
  for (const auto& [edge, found] : wanted) {
    if (found == Found::Nothing)
      refuse(source, edge, "by no edge of " + (mesh.file().empty() ? "the mesh" : mesh.file()));
    if (found == Found::InnerEdge)
      refuse(source, edge, "inside a polygon only, of which edges alone count");
  }
  return is_cut;
}

SurfaceCuts choose_cuts(const SurfaceMesh& mesh, const CutOptions& options, const StopCheck& stop) {
  require_valid(mesh, options);
  const double unit = model_unit(mesh);
  if (unit == 1) return cuts_near_one(mesh, options, stop);
  const auto scaled = in_units(mesh, unit);
  require_area_in_range(*scaled, unit);
  SurfaceCuts cuts = cuts_near_one(*scaled, options, stop);
  cuts.length *= unit;
  cuts.added_length *= unit;
  for (ComponentCuts& component : cuts.components) component.length *= unit;
  return cuts;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
