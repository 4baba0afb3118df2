#include "majorant/constraints/local_injectivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "majorant/constraints/sector_angle.h"
#include "majorant/elements/bernstein.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

constexpr Index kElementsOfATask = 1024;  // too few to wake a thread for
// The square of the local unknowns of a triangle of degree 1. Tasks have fewer elements if these
// are larger.
constexpr Index kTriangle = 36;
constexpr Index kLeastPiece = 8;
constexpr Index kPolledElements = 64;  // tested between two polls
constexpr double kTwoPi = 2 * std::numbers::pi;

// Returns the number of elements of a task.
Index piece_of(const ElementSpace& space) {
  const Index size = space.reference_dim() * space.nodes_per_element();
  return std::max(kLeastPiece, kElementsOfATask * kTriangle / (size * size));
}

}  // namespace

LocalInjectivity::LocalInjectivity(std::shared_ptr<const ElementSpace> space, Vec rest_det,
                                   int max_depth, StopCheck stop)
    : space_(std::move(space)),
      rest_det_(std::move(rest_det)),
      max_depth_(std::min(max_depth, kMaxDepth)),
      stop_(std::move(stop)) {
  require_given("LocalInjectivity: the space", space_);
  if (rest_det_.size() != space_->element_count())
    throw InvalidArgument(fmt::format("LocalInjectivity: {} rest determinants for {} elements",
                                      rest_det_.size(), space_->element_count()));
  for (Index e = 0; e < rest_det_.size(); ++e)
    if (!(rest_det_[e] > 0) || !std::isfinite(rest_det_[e]))
      throw InvalidArgument(
          fmt::format("LocalInjectivity: the rest determinant of element {} is {}, finite and "
                      "positive is needed: RestShapes::measure / ElementSpace::reference_measure()",
                      e, rest_det_[e]));
  require_at_least("LocalInjectivity: the depth", max_depth, 0);
}

Index LocalInjectivity::unknowns() const { return space_->reference_dim() * space_->node_count(); }

// Returns lower bounds by element. proven: receives the number of elements by depth; may be null.
Vec LocalInjectivity::certify(VecIn x, std::vector<long>* proven) const {
  require_enough("LocalInjectivity: x", x.size(), unknowns());
  const Index count = space_->element_count();
  Vec bounds(count);
  std::vector<int> depths(proven ? to_size(count) : 0, -1);
  parallel_for(count, piece_of(*space_), [&](Index e) {
    const PositivityProof proof = space_->certify(e, x, max_depth_);
    const bool certified = proof.result == ProofStatus::Proven;
    bounds[e] = (certified ? proof.lower_bound : std::min(proof.lower_bound, 0.0)) / rest_det_[e];
    if (certified && proven) depths[e] = std::min(proof.depth, max_depth_);
  });
  for (const int depth : depths)
    if (depth >= 0) ++(*proven)[depth];
  return bounds;
}

Vec LocalInjectivity::lower_bounds(VecIn x) const { return certify(x, nullptr); }

Verdict LocalInjectivity::check(VecIn x) const {
  Verdict verdict;
  verdict.proven.resize(to_size(max_depth_) + 1);
  const Vec bounds = certify(x, &verdict.proven);
  verdict.margin = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < bounds.size(); ++e) {
    if (!(bounds[e] > 0)) verdict.blocking.push_back(e);
    verdict.margin = std::min(verdict.margin, bounds[e]);
  }
  verdict.feasible = verdict.blocking.empty();
  return verdict;
}

// Bounds the step coefficientwise first, without bisection, which settles almost all elements. Then
// bisects the elements that limit the step, each only up to the step that the others still allow.
StepBound LocalInjectivity::max_step(VecIn x, VecIn d, double s) const {
  require_enough("LocalInjectivity::max_step: x", x.size(), unknowns());
  require_enough("LocalInjectivity::max_step: d", d.size(), unknowns());
  const Index count = space_->element_count();
  Vec quick(count);
  parallel_for(count, piece_of(*space_), [&](Index e) {
    if (e % kPolledElements == 0) stop_.poll();
    quick[e] = space_->largest_step(e, x, d, s, 0);
  });
  std::vector<Index> limiting;
  for (Index e = 0; e < count; ++e)
    if (quick[e] < s) limiting.push_back(e);
  std::sort(limiting.begin(), limiting.end(),
            [&](Index a, Index b) { return quick[a] != quick[b] ? quick[a] < quick[b] : a < b; });
  StepBound bound{s, {}};
  for (const Index e : limiting) {
    if (quick[e] >= bound.step) continue;
    stop_.poll();
    const double step = space_->largest_step(e, x, d, bound.step, max_depth_);
    if (step < bound.step) {
      bound.step = step;
      bound.blocking.push_back(e);
    }
  }
  std::erase_if(bound.blocking, [&](Index e) { return quick[e] > 2 * bound.step; });
  std::sort(bound.blocking.begin(), bound.blocking.end());
  return bound;
}

Vec vertex_angle_sums(const BezierTriangleSpace& space, VecIn x) {
  require_enough("vertex_angle_sums: x", x.size(), 2 * space.node_count());
  Vec sums = Vec::Zero(space.vertex_count());
  const TriangleIndices& ix = TriangleIndices::of_degree(space.degree());
  const auto point = [&](Index e, int local) {
    const Index node = space.cells()(e, local);
    return Vector2(x[2 * node], x[2 * node + 1]);
  };
  Points3 angles(space.element_count(), 3);
  parallel_for(space.element_count(), kElementsOfATask, [&](Index e) {
    for (int k = 0; k < 3; ++k) {
      const Vector2 corner = point(e, k);
      const auto [right, left] = ix.beside_corner(k);
      angles(e, k) = std::abs(sector_angle(point(e, right) - corner, point(e, left) - corner));
    }
  });
  for (Index e = 0; e < space.element_count(); ++e)
    for (int k = 0; k < 3; ++k) sums[space.cells()(e, k)] += angles(e, k);
  return sums;
}

AngleSums::AngleSums(std::shared_ptr<const BezierTriangleSpace> space, Vertices which,
                     std::shared_ptr<const Seams> seams)
    : space_(given("AngleSums: the space", std::move(space))), which_(which) {
  const auto count = to_size(space_->vertex_count());
  if (seams && !seams->quarter_turns().empty()) {  // cones may lie on no cut
    require_size("AngleSums: the seams' list of vertices",
                 static_cast<Index>(seams->surface_vertex().size()), space_->vertex_count());
    vertex_of_ = seams->surface_vertex();
    quarter_turns_ = seams->quarter_turns();
    return;
  }
  vertex_of_.resize(count);
  std::iota(vertex_of_.begin(), vertex_of_.end(), 0);
  quarter_turns_.assign(count, 4);
  for (const Index node : space_->boundary_nodes())
    if (to_size(node) < count) quarter_turns_[node] = 0;
}

Verdict AngleSums::check(VecIn x) const {
  const Vec sums = vertex_angle_sums(*space_, x);
  Verdict verdict;
  verdict.margin = std::numeric_limits<double>::infinity();
  const auto hold = [&](Index v, double margin) {
    if (!(margin >= 0)) verdict.blocking.push_back(v);
    verdict.margin = std::min(verdict.margin, margin);
  };
  Vec total = Vec::Zero(static_cast<Index>(quarter_turns_.size()));
  for (Index v = 0; v < sums.size(); ++v) {
    const Index surface = vertex_of_[v];
    total[surface] += sums[v];
    if (which_ == Vertices::Boundary && quarter_turns_[surface] == 0)
      hold(v, kTwoPi + kTolerance - sums[v]);
  }
  for (Index v = 0; v < total.size() && which_ == Vertices::Interior; ++v) {
    const int turns = quarter_turns_[v];
    if (turns != 0) hold(v, kTolerance - std::abs(total[v] - turns * kTwoPi / 4));
  }
  verdict.feasible = verdict.blocking.empty();
  return verdict;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
