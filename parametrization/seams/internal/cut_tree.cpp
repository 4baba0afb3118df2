#include "majorant/parametrization/seams/internal/cut_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "majorant/parametrization/seams/internal/flattening_strain.h"

namespace majorant {
namespace {

// Ends of a cut per end that is shortened in one step. Adjacent ends are rarely among the best.
// Cuts have ten to thirty ends, those of 70 handles hundreds.
constexpr std::size_t kEndsPerRemoval = 30;

}  // namespace

CutTree::CutTree(FlatteningSystem& system, const std::vector<char>& is_cut,
                 const std::vector<char>& is_terminal, const Vec& edge_cost, Index branches,
                 const StopCheck& stop)
    : mesh_(system.mesh()),
      is_cut_(is_cut),
      tree_(cut_branches(mesh_, is_cut, is_terminal, edge_cost, branches)),
      states_(tree_.all.size()) {
  for (const CutBranch& branch : tree_.all)
    if (branch.parent >= 0) ++states_[branch.parent].children;
  if (!tree_.all.empty()) constrain_ends(system, stop);
}

void CutTree::constrain_ends(FlatteningSystem& system, const StopCheck& stop) {
  const FlatteningStrain sheet(system, tree_.is_root_cut, tree_.outer, stop.silent());
  std::vector<FlatteningStrain::Functional> held;
  const auto add = [&](std::size_t branch, const FlatteningStrain::Functional& functional) {
    if (sheet.is_zero(functional)) return;
    states_[branch].rows.push_back(static_cast<Index>(held.size()));
    held.push_back(functional);
  };
  for (std::size_t t = 0; t < states_.size(); ++t) {
    const Index h = mesh_.opposite(tree_.all[t].half_edges.back());
    add(t, {{h, 1}});
    if (tree_.is_inside[mesh_.from_vertex(h)])
      add(t, {{previous(h), 1}, {previous(mesh_.opposite(h)), -1}});
  }
  Eigen::MatrixXd responses = sheet.responses(held, stop);
  Vec values(static_cast<Index>(held.size()));
  for (Index k = 0; k < values.size(); ++k) values[k] = sheet.apply(held[to_size(k)]);
  conditions_ = HeldConditions(std::move(responses), values);
}

// Returns the branches from this one, an end, down to the next place where other branches hang on.
std::vector<Index> CutTree::removable_run(Index branch) const {
  std::vector<Index> path{branch};
  for (Index t = tree_.all[branch].parent; t >= 0 && states_[t].children == 1;
       t = tree_.all[t].parent)
    path.push_back(t);
  return path;
}

// Returns the conditions at the ends of these branches.
std::vector<Index> CutTree::rows_of(const std::vector<Index>& branches) const {
  std::vector<Index> rows;
  for (const Index t : branches)
    rows.insert(rows.end(), states_[t].rows.begin(), states_[t].rows.end());
  return rows;
}

void CutTree::release(const std::vector<Index>& branches) {
  conditions_.release(rows_of(branches));
  for (const Index t : branches) {
    states_[t].is_removed = true;
    if (const Index p = tree_.all[t].parent; p >= 0) --states_[p].children;
  }
}

void CutTree::shorten_in_pairs(const MirrorPlane& plane, double distance) {
  mirror_ = plane;
  pair_distance_ = distance;
}

Vector3 CutTree::far_end(std::size_t branch) const {
  return mesh_.positions().row(mesh_.to_vertex(tree_.all[branch].half_edges.back()));
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
  for (const Index t : part) left += tree_.all[t].cost;
  for (const Index t : other) {
    if (left < 0.5 * tree_.all[t].cost) break;
    left -= tree_.all[t].cost;
    part.push_back(t);
  }
  return part;
}

// Returns the best way to shorten each end of the cut, or each pair of ends, the best of all first.
std::vector<CutTree::Removal> CutTree::removals(double most_added) const {
  std::vector<Removal> removals;
  std::vector<std::size_t> ends;
  for (std::size_t t = 0; t < tree_.all.size(); ++t)
    if (!states_[t].is_removed && states_[t].children == 0) ends.push_back(t);
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
      const double added = conditions_.added_strain(rows_of(part));
      double cost = 0;
      for (const Index p : part) cost += tree_.all[p].cost;
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
      const double added = conditions_.added_strain(rows_of(removal.branches));  // after the others
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
  std::vector<Index> hanging(tree_.all.size(), 0);
  std::vector<char> removed(tree_.all.size(), 0);
  for (std::size_t s = 0; s < steps; ++s)
    for (const Index t : steps_[s].branches) {
      removed[t] = 1;
      for (const Index h : tree_.all[t].half_edges)
        state.is_cut[h] = state.is_cut[mesh_.opposite(h)] = 0;
    }
  for (std::size_t t = 0; t < tree_.all.size(); ++t)
    if (!removed[t] && tree_.all[t].parent >= 0) ++hanging[tree_.all[t].parent];
  for (std::size_t t = 0; t < tree_.all.size(); ++t) {
    const Index v = mesh_.to_vertex(tree_.all[t].half_edges.back());
    if (!removed[t] && hanging[t] == 0 && tree_.is_inside[v]) state.ends.push_back(v);
  }
  return state;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
