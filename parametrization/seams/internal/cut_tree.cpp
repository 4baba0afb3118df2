#include "majorant/parametrization/seams/internal/cut_tree.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// The fraction of the diagonal of G that is added to it: far below the worth of a branch, far above
// the rounding of G, whose rows are nearly equal at neighbouring branches.
constexpr double kRegularization = 1e-9;

// Ends of a cut per end that is shortened in one step. Adjacent ends are rarely among the best.
// Cuts have ten to thirty ends, those of 70 handles hundreds.
constexpr std::size_t kEndsPerRemoval = 30;

// Branches that may be taken back, at most: G is dense and has a row or two for each. Cuts of usual
// surfaces have some hundreds of branches; those that join thousands of holes have as many.
constexpr std::size_t kMaxTreeBranches = 500;

}  // namespace

CutTree::CutTree(FlatteningSystem& system, const std::vector<char>& is_cut,
                 const std::vector<char>& is_terminal, const Vec& edge_cost, Index branches,
                 const StopCheck& stop)
    : mesh_(system.mesh()),
      cost_(edge_cost),
      is_cut_(is_cut),
      is_root_cut_(is_cut.size(), 0),
      node_(to_size(mesh_.vertex_count())),
      root_(mesh_.vertex_count() + static_cast<Index>(mesh_.boundary_loops().size())) {
  contract_loops();
  find_root();
  double cost = 0;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (is_cut_[h] && !is_root_cut_[h]) cost += 0.5 * cost_[h];
  grow(is_terminal, cost / branches);
  if (branches_.size() > kMaxTreeBranches) {
    put_into_root(inner_half_edges());
    branches_.clear();
    grow(is_terminal, cost / branches);
  }
  if (!branches_.empty()) constrain_ends(system, stop);
}

void CutTree::contract_loops() {
  for (Index v = 0; v < mesh_.vertex_count(); ++v) node_[v] = v;
  const auto& loops = mesh_.boundary_loops();
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const Index v : loops[l]) node_[v] = mesh_.vertex_count() + static_cast<Index>(l);
}

CutTree::Edges CutTree::cut_edges() const {
  Edges leaving(to_size(root_) + 1);
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (is_cut_[h] && !is_root_cut_[h]) leaving[node_[mesh_.from_vertex(h)]].push_back(h);
  return leaving;
}

void CutTree::find_root() {
  const auto& loops = mesh_.boundary_loops();
  if (genus(mesh_) > 0) {
    put_into_root(cycles());
  } else if (loops.empty()) {
    put_into_root(middle_edges());
  } else {
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      double length = 0;
      for (std::size_t i = 0; i < loops[l].size(); ++i)
        length += (mesh_.positions().row(loops[l][i]) -
                   mesh_.positions().row(loops[l][(i + 1) % loops[l].size()]))
                      .norm();
      if (length > most) most = length, longest = l;
    }
    for (const Index v : loops[longest]) node_[v] = root_;
    for (Index h = 0; h < mesh_.half_edge_count() && outer_ < 0; ++h)
      if (node_[mesh_.from_vertex(h)] == root_) outer_ = h;
  }
}

void CutTree::put_into_root(const std::vector<Index>& half_edges) {
  std::vector<char> in_root(to_size(root_) + 1, 0);
  for (const Index h : half_edges) {
    is_root_cut_[h] = is_root_cut_[mesh_.opposite(h)] = 1;
    for (const Index v : {mesh_.from_vertex(h), mesh_.to_vertex(h)}) in_root[node_[v]] = 1;
  }
  if (!half_edges.empty()) outer_ = half_edges.front();
  for (Index& node : node_)
    if (in_root[node]) node = root_;
}

// Returns two edges in the middle of the longest path of a cut that is a tree.
std::vector<Index> CutTree::middle_edges() const {
  const Edges leaving = cut_edges();
  std::vector<Index> entered;
  const auto farthest_from = [&](Index start) {
    entered.assign(leaving.size(), -1);
    std::vector<std::pair<Index, double>> stack{{start, 0}};
    std::pair<Index, double> farthest = stack[0];
    while (!stack.empty()) {
      const auto [v, distance] = stack.back();
      stack.pop_back();
      if (distance > farthest.second) farthest = {v, distance};
      for (const Index h : leaving[v]) {
        if (entered[v] >= 0 && h == mesh_.opposite(entered[v])) continue;
        entered[mesh_.to_vertex(h)] = h;
        stack.emplace_back(mesh_.to_vertex(h), distance + cost_[h]);
      }
    }
    return farthest;
  };
  Index some = 0;
  while (leaving[some].empty()) ++some;
  const auto [end, length] = farthest_from(farthest_from(some).first);
  double distance = 0;
  Index h = entered[end];
  for (Index before = entered[mesh_.from_vertex(h)]; before >= 0;
       before = entered[mesh_.from_vertex(h)]) {
    distance += cost_[h];
    if (2 * distance >= length || entered[mesh_.from_vertex(before)] < 0) return {before, h};
    h = before;
  }
  return {h};  // an edge beside a cut that opens the surface
}

// Returns the cycles of the cut: the edges left after every branch with an end is removed.
std::vector<Index> CutTree::cycles() const {
  const Edges leaving = cut_edges();
  std::vector<std::size_t> degree(leaving.size());
  std::vector<Index> ends;
  std::vector<char> kept = is_cut_;
  for (std::size_t n = 0; n < leaving.size(); ++n)
    if ((degree[n] = leaving[n].size()) == 1) ends.push_back(static_cast<Index>(n));
  while (!ends.empty()) {
    const Index n = ends.back();
    ends.pop_back();
    for (const Index h : leaving[n]) {
      if (!kept[h]) continue;
      kept[h] = kept[mesh_.opposite(h)] = 0;
      const Index m = node_[mesh_.to_vertex(h)];
      if (--degree[m] == 1) ends.push_back(m);
    }
  }
  std::vector<Index> edges;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (kept[h] && h < mesh_.opposite(h)) edges.push_back(h);
  return edges;
}

void CutTree::grow(const std::vector<char>& is_terminal, double length) {
  const Edges leaving = cut_edges();
  std::vector<std::pair<Index, Index>> starts;  // half-edge, branch below
  for (const Index h : leaving[root_]) starts.emplace_back(h, -1);
  while (!starts.empty()) {
    auto [h, parent] = starts.back();
    starts.pop_back();
    const auto number = static_cast<Index>(branches_.size());
    Branch branch;
    branch.parent = parent;
    Index node = -1;
    for (;;) {
      branch.half_edges.push_back(h);
      branch.cost += cost_[h];
      node = node_[mesh_.to_vertex(h)];
      const std::vector<Index>& on = leaving[node];
      if (branch.cost >= length || on.size() != 2 || node >= mesh_.vertex_count() ||
          is_terminal[node])
        break;
      h = on[on[0] == mesh_.opposite(h) ? 1 : 0];
    }
    for (const Index g : leaving[node])
      if (g != mesh_.opposite(h)) starts.emplace_back(g, number);
    if (parent >= 0) ++branches_[parent].children;
    branches_.push_back(std::move(branch));
  }
}

// Returns the half-edges of all branches but kMaxTreeBranches. These are the outermost ones, the
// costliest first. The height of a branch is the longest chain of branches that hang from it.
std::vector<Index> CutTree::inner_half_edges() const {
  std::vector<int> height(branches_.size(), 0);
  for (std::size_t t = branches_.size(); t-- > 0;)
    if (const Index p = branches_[t].parent; p >= 0) height[p] = std::max(height[p], height[t] + 1);
  std::vector<std::size_t> order(branches_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return height[a] != height[b] ? height[a] < height[b] : branches_[a].cost > branches_[b].cost;
  });
  std::vector<Index> inner;
  for (std::size_t k = kMaxTreeBranches; k < order.size(); ++k)
    inner.insert(inner.end(), branches_[order[k]].half_edges.begin(),
                 branches_[order[k]].half_edges.end());
  return inner;
}

void CutTree::constrain_ends(FlatteningSystem& system, const StopCheck& stop) {
  const FlatteningStrain sheet(system, is_root_cut_, outer_, stop.silent());
  std::vector<FlatteningStrain::Functional> held;
  const auto add = [&](Branch& branch, const FlatteningStrain::Functional& functional) {
    if (sheet.is_zero(functional)) return;
    held.push_back(functional);
    ++branch.rows;
  };
  for (Branch& branch : branches_) {
    branch.first_row = static_cast<Index>(held.size());
    const Index h = mesh_.opposite(branch.half_edges.back());
    add(branch, {{h, 1}});
    if (node_[mesh_.from_vertex(h)] < mesh_.vertex_count())
      add(branch, {{previous(h), 1}, {previous(mesh_.opposite(h)), -1}});
  }
  const auto count = static_cast<Index>(held.size());
  Eigen::MatrixXd g = sheet.responses(held, stop);
  Vec values(count);
  for (Index k = 0; k < count; ++k) values[k] = sheet.apply(held[k]);
  const Vec scale = g.diagonal().cwiseSqrt().cwiseInverse();
  g = (scale.asDiagonal() * g * scale.asDiagonal()).eval();
  g.diagonal().array() += kRegularization;
  precision_ = scale.asDiagonal() *
               Eigen::MatrixXd(g.ldlt().solve(Eigen::MatrixXd::Identity(count, count))) *
               scale.asDiagonal();
  force_ = precision_ * values;
  held_rows_ = count;
  place_.resize(to_size(count));
  std::iota(place_.begin(), place_.end(), 0);
}

// Returns the branches from this one, an end, down to the next place where other branches hang on.
std::vector<Index> CutTree::removable_run(Index branch) const {
  std::vector<Index> path{branch};
  for (Index t = branches_[branch].parent; t >= 0 && branches_[t].children == 1;
       t = branches_[t].parent)
    path.push_back(t);
  return path;
}

// Returns the indices in P and x of the rows of these branches.
std::vector<Index> CutTree::places_of(const std::vector<Index>& branches) const {
  std::vector<Index> places;
  for (const Index t : branches)
    for (Index r = 0; r < branches_[t].rows; ++r)
      places.push_back(place_[branches_[t].first_row + r]);
  return places;
}

double CutTree::added_strain(const std::vector<Index>& places) const {
  const Vec x = force_(places);
  return x.dot(precision_(places, places).ldlt().solve(x));
}

void CutTree::release(const std::vector<Index>& branches) {
  const std::vector<Index> places = places_of(branches);
  const Eigen::MatrixXd columns = precision_(Eigen::seqN(0, held_rows_), places);
  const auto block = Eigen::MatrixXd(precision_(places, places)).ldlt();
  force_.head(held_rows_) -= columns * block.solve(Vec(force_(places)));
  precision_.topLeftCorner(held_rows_, held_rows_) -= columns * block.solve(columns.transpose());
  for (const Index t : branches) {
    for (Index r = 0; r < branches_[t].rows; ++r) drop(branches_[t].first_row + r);
    branches_[t].is_removed = true;
    if (const Index p = branches_[t].parent; p >= 0) --branches_[p].children;
  }
}

// Moves the last held row to the place of this one.
void CutTree::drop(Index row) {
  const Index place = place_[row], last = --held_rows_;
  const auto moved = std::find(place_.begin(), place_.end(), last);
  precision_.row(place).swap(precision_.row(last));
  precision_.col(place).swap(precision_.col(last));
  std::swap(force_[place], force_[last]);
  std::swap(*moved, place_[row]);
}

void CutTree::shorten_in_pairs(const MirrorPlane& plane, double distance) {
  mirror_ = plane;
  pair_distance_ = distance;
}

Vector3 CutTree::far_end(std::size_t branch) const {
  return mesh_.positions().row(mesh_.to_vertex(branches_[branch].half_edges.back()));
}

// Returns for each of these ends the index of the one that is its mirror image, or -1. Each end is
// the image of at most one other.
std::vector<std::ptrdiff_t> CutTree::partners(const std::vector<std::size_t>& ends) const {
  std::vector<std::ptrdiff_t> partner(ends.size(), -1);
  if (!mirror_) return partner;
  const auto nearest = [&](std::size_t i) {
    const Vector3 image = mirror_->image(far_end(ends[i]));
    std::ptrdiff_t best = -1;
    double least = pair_distance_;
    for (std::size_t j = 0; j < ends.size(); ++j) {
      const double d = (far_end(ends[j]) - image).norm();
      if (j != i && d <= least) least = d, best = static_cast<std::ptrdiff_t>(j);
    }
    return best;
  };
  for (std::size_t i = 0; i < ends.size(); ++i) partner[i] = nearest(i);
  std::vector<std::ptrdiff_t> mutual(ends.size(), -1);
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (partner[i] >= 0 &&
        partner[to_size(static_cast<Index>(partner[i]))] == static_cast<std::ptrdiff_t>(i))
      mutual[i] = partner[i];
  return mutual;
}

// Returns these branches and, of the others, about the same cost.
std::vector<Index> CutTree::with_partner(std::vector<Index> part,
                                         const std::vector<Index>& other) const {
  double left = 0;
  for (const Index t : part) left += branches_[t].cost;
  for (const Index t : other) {
    if (left < 0.5 * branches_[t].cost) break;
    left -= branches_[t].cost;
    part.push_back(t);
  }
  return part;
}

// Returns the best way to shorten each end of the cut, or each pair of ends, the best of all first.
std::vector<CutTree::Removal> CutTree::removals(double most_added) const {
  std::vector<Removal> removals;
  std::vector<std::size_t> ends;
  for (std::size_t t = 0; t < branches_.size(); ++t)
    if (!branches_[t].is_removed && branches_[t].children == 0) ends.push_back(t);
  const std::vector<std::ptrdiff_t> partner = partners(ends);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (partner[i] >= 0 && partner[i] < static_cast<std::ptrdiff_t>(i)) continue;
    const std::vector<Index> path = removable_run(static_cast<Index>(ends[i]));
    std::vector<Index> other;
    if (partner[i] >= 0)
      other = removable_run(static_cast<Index>(ends[static_cast<std::size_t>(partner[i])]));
    Removal best{std::numeric_limits<double>::infinity(), {}};
    for (std::size_t count = 1;; count = std::min(2 * count, path.size())) {
      const std::vector<Index> part =
          with_partner({path.begin(), path.begin() + static_cast<std::ptrdiff_t>(count)}, other);
      const double added = added_strain(places_of(part));
      double cost = 0;
      for (const Index p : part) cost += branches_[p].cost;
      if (added <= most_added && added < best.price * cost) best = {added / cost, part};
      if (count == path.size()) break;
    }
    if (!best.branches.empty()) removals.push_back(std::move(best));
  }
  std::stable_sort(removals.begin(), removals.end(),
                   [](const Removal& a, const Removal& b) { return a.price < b.price; });
  return removals;
}

void CutTree::shorten(double strain, double limit, const StopCheck& stop) {
  for (;;) {
    stop.poll();
    std::vector<Removal> removals = this->removals(limit - strain);
    if (removals.empty()) return;
    removals.resize(1 + removals.size() / kEndsPerRemoval);
    for (Removal& removal : removals) {
      const double added = added_strain(places_of(removal.branches));  // after the others
      if (strain + added > limit) continue;
      strain += added;
      release(removal.branches);
      steps_.push_back({std::move(removal.branches), strain});
    }
  }
}

std::size_t CutTree::steps_within(double strain) const {
  std::size_t count = 0;
  while (count < steps_.size() && steps_[count].strain <= strain) ++count;
  return count;
}

CutTree::State CutTree::after(std::size_t steps) const {
  State state{is_cut_, {}};
  std::vector<Index> hanging(branches_.size(), 0);
  std::vector<char> removed(branches_.size(), 0);
  for (std::size_t s = 0; s < steps; ++s)
    for (const Index t : steps_[s].branches) {
      removed[t] = 1;
      for (const Index h : branches_[t].half_edges)
        state.is_cut[h] = state.is_cut[mesh_.opposite(h)] = 0;
    }
  for (std::size_t t = 0; t < branches_.size(); ++t)
    if (!removed[t] && branches_[t].parent >= 0) ++hanging[branches_[t].parent];
  for (std::size_t t = 0; t < branches_.size(); ++t) {
    const Index v = mesh_.to_vertex(branches_[t].half_edges.back());
    if (!removed[t] && hanging[t] == 0 && node_[v] < mesh_.vertex_count()) state.ends.push_back(v);
  }
  return state;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
