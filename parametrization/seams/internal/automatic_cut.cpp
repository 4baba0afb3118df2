#include "majorant/parametrization/seams/internal/automatic_cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/cut_graph.h"
#include "majorant/mesh/geometry.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/seams/internal/cut_tree.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// What a cut that leaves no curvature at all may be longer than the one chosen otherwise, in square
// roots of the area: a box,
// a tin and a square tube are unfolded whole.
constexpr double kDevelopableWorth = 1;
constexpr double kCurved = 1e-3;  // radians: an angle defect; files with 4 digits are flat
// Cuts are routed anew through the ends and the cones that are left as long as they become shorter.
// Large ones only once: 50,000 faces are cut in ten seconds, and the third route of small
// ones is the last that changes anything.
constexpr Index kMostRoutes = 3, kRouteWork = 20000;
// How many branches a cut is divided into: one for each two edges of a small mesh, and such that
// one solve for each takes as long on all large ones: a second or two; on public meshes the strains
// expected and found then agree within 10 %.
constexpr Index kMostBranches = 150, kFewestBranches = 40, kBranchSolves = 600000;
// Corrections, in proportion, where what branches are worth was estimated too low: one or two
// are enough, coarse meshes take five.
constexpr int kMostCorrections = 8;
// Without a field: as many vertices of the largest angle defects; as many as fields have.
constexpr std::size_t kMostDefects = 40;

class Cutter {
 public:
  Cutter(const SurfaceMesh& mesh, const Vec& edge_cost, const std::vector<char>& is_whole,
         double limit, const StopCheck& stop)
      : mesh_(mesh),
        cost_(edge_cost),
        is_whole_(is_whole),
        limit_(limit),
        unit_(std::sqrt(mesh.area())),
        stop_(stop),
        defect_(angle_defects(mesh)) {}

  AutomaticCut run() const {
    if (is_planar(mesh_)) {
      AutomaticCut none{std::vector<char>(to_size(mesh_.half_edge_count()), 0), 0, {}};
      none.strain = strain(none.is_cut);
      if (none.strain <= limit_) return none;
    }
    const std::vector<Index> cones = field_cones();
    AutomaticCut best = peeled(routed(cones), cones);
    const Index routes = std::clamp(kRouteWork / mesh_.vertex_count(), 1, kMostRoutes);
    for (Index k = 0; k < routes; ++k) {
      AutomaticCut next = peeled_route(cones_on(best, cones), best);
      if (routes > 1) next = peeled_route(next.ends, next);
      if (!(cost(next) < cost(best))) break;
      best = std::move(next);
    }
    return developed(best);
  }

 private:
  static Vec angle_defects(const SurfaceMesh& mesh) {
    Vec defect = Vec::Constant(mesh.vertex_count(), 2 * std::numbers::pi);
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      defect[mesh.from_vertex(h)] -= corner_angle(mesh, h).radians();
    for (const auto& loop : mesh.boundary_loops())
      for (const Index v : loop) defect[v] = 0;
    return defect;
  }

  double cost(const AutomaticCut& cut) const {
    double sum = 0;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (cut.is_cut[h]) sum += 0.5 * cost_[h];
    return sum / unit_;
  }
  double strain(const std::vector<char>& is_cut) const {
    return FlatteningStrain(mesh_.cut_along(is_cut, nullptr), -1, stop_).strain();
  }
  AutomaticCut routed(const std::vector<Index>& terminals) const {
    AutomaticCut cut{cut_graph(mesh_, terminals, cost_, stop_), 0, terminals};
    cut.strain = strain(cut.is_cut);
    return cut;
  }

  std::vector<Index> field_cones() const {
    std::vector<Index> cones = all_field_cones();
    std::erase_if(cones, [&](Index v) { return is_whole_[v] != 0; });
    return cones;
  }

  std::vector<Index> all_field_cones() const {
    CrossFieldOptions field;
    field.stop = stop_;
    try {
      return cone_vertices(smoothest_cross_field(mesh_, field));
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

  AutomaticCut peeled(const AutomaticCut& full, const std::vector<Index>& terminals) const {
    std::vector<char> is_terminal(to_size(mesh_.vertex_count()), 0);
    for (const Index v : terminals) is_terminal[v] = 1;
    const Index branches =
        std::clamp(kBranchSolves / mesh_.vertex_count(), kFewestBranches, kMostBranches);
    CutTree tree(mesh_, full.is_cut, is_terminal, cost_, branches, stop_);
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
  AutomaticCut peeled_route(const std::vector<Index>& terminals, const AutomaticCut& best) const {
    const AutomaticCut full = routed(terminals);
    if (full.strain > std::max(limit_, best.strain)) return best;
    AutomaticCut cut = peeled(full, terminals);
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

  // The cut through all vertices that are not flat, if that is worth it, else `best`.
  AutomaticCut developed(const AutomaticCut& best) const {
    const double most = cost(best) + kDevelopableWorth;
    Vec cheapest = Vec::Constant(mesh_.vertex_count(), most * unit_);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      for (const Index v : {mesh_.from_vertex(h), mesh_.to_vertex(h)})
        cheapest[v] = std::min(cheapest[v], cost_[h]);
    std::vector<Index> curved;
    double least = 0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (std::abs(defect_[v]) > kCurved && !is_whole_[v]) {
        curved.push_back(v);
        least += 0.5 * cheapest[v];
      }
    if (least > most * unit_) return best;
    const AutomaticCut cut = routed(curved);
    return cost(cut) <= most && cut.strain < best.strain ? cut : best;
  }

  const SurfaceMesh& mesh_;
  const Vec& cost_;
  const std::vector<char>& is_whole_;
  const double limit_, unit_;
  const StopCheck& stop_;
  const Vec defect_;
};

}  // namespace

AutomaticCut automatic_cut(const SurfaceMesh& mesh, const Vec& edge_cost,
                           const std::vector<char>& is_whole, double max_stretch,
                           const StopCheck& stop) {
  return Cutter(mesh, edge_cost, is_whole, strain_of_stretch(max_stretch), stop).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
