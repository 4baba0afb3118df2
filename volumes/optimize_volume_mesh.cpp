#include "majorant/volumes/optimize_volume_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "majorant/energies/solid_energies.h"
#include "majorant/framework/error.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/volumes/internal/target_shapes.h"
#include "majorant/volumes/internal/untangle_mesh.h"

namespace majorant {
namespace {

// The shortest part of the way from the start that is tried if rounded nodes are not valid.
constexpr double kLeastWrittenPart = 1.0 / 64;

// Above this mean energy another energy is minimized first. Good elements have some 1 to 10, so a
// larger mean is that of a few nearly invalid elements, for which an exponential overflows.
constexpr double kSteepMean = 1e3;
// The Newton steps on symmetric Dirichlet between two evaluations of the energy, and the maximum
// number of evaluations.
constexpr int kApproachSteps = 5, kMostApproaches = 20;

// Scaled Jacobians that differ by less count as equal.
constexpr double kSameScaledJacobian = 1e-3;
// The factor of the weights of elements that became worse than the worst one was, and the maximum
// number of rounds. Of 4, 10 and 30, this factor gave the largest minimum of the scaled Jacobian in
// the mean over four curved models of gmsh, all of which end above the input within three rounds.
constexpr double kHeavier = 10;
constexpr int kMostRounds = 4;

// The maximum number of rounds in which nodes slide along curved sides, the shortest part of a
// round's way that is tried, and the relative decrease of the energy below which rounds end.
constexpr int kMostSlidingRounds = 20;
constexpr double kLeastSlidingPart = 1.0 / 64, kSlidingDecrease = 1e-4;

// Returns the cells that are not proven valid, and those that share a side with one.
std::vector<CellName> faulty_and_neighbours(const VolumeCheck& check,
                                            const std::vector<CellSide>& sides) {
  const auto key = [](CellName name) { return std::pair(name.block, name.cell); };
  std::set<std::pair<Index, Index>> faulty, all;
  for (const CheckedCell& cell : check.cells)
    if (cell.range.positive != ProofStatus::Proven) faulty.insert(key(cell.name));
  all = faulty;
  for_each_side(sides, [&](std::span<const CellSide> cells) {
    const bool is_any_faulty = std::any_of(cells.begin(), cells.end(), [&](const CellSide& side) {
      return faulty.count(key(side.name)) > 0;
    });
    for (const CellSide& side : cells)
      if (is_any_faulty) all.insert(key(side.name));
  });
  std::vector<CellName> out;
  for (const auto& [block, cell] : all) out.push_back({block, cell});
  return out;
}

class VolumeOptimizer {
 public:
  VolumeOptimizer(const VolumeMesh& mesh, const VolumeOptions& options, RunRecord& record)
      : mesh_(mesh), options_(options), record_(record) {}

  VolumeResult run() {
    record_.begin(Activity::Proving);
    result_.points = mesh_.points;
    result_.before = check_volume_mesh(mesh_, record_.telling(record_.start_stop()));
    require_usable();
    record_.begin(Activity::Starting);
    const std::vector<CellSide> sides = sides_of(mesh_);
    net_.emplace(mesh_, sides);
    x_ = net_->control_points();
    boundary_ = options_.boundary;
    if (boundary_ == VolumeBoundary::Free && result_.before.is_valid())
      boundary_ = VolumeBoundary::Fixed;
    held_.emplace(mesh_, sides, *net_, x_, boundary_);
    std::vector<CellName> movable;
    if (boundary_ == VolumeBoundary::Free) {
      movable = faulty_and_neighbours(result_.before, sides);
      held_->hold_all_but(movable);
    }
    result_.held_sides = held_->sides();
    result_.curved_sides = held_->curved_sides();
    result_.impossible = held_->impossible_cells(mesh_);
    if (!result_.impossible.empty()) return refused();
    elements_.emplace(*net_, target_shapes(mesh_, *net_, options_), record_);
    weights_ = elements_->equal_weights();
    start_ = x_;
    std::optional<int> depth = elements_->proven_depth(x_);
    if (!depth) {
      UntangledMesh untangled =
          untangle_mesh({mesh_, sides, *elements_, *held_, boundary_, movable, x_}, record_);
      x_ = std::move(untangled.x);
      result_.untangling_iterations = untangled.iterations;
      depth = elements_->proven_depth(x_);
    }
    if (!depth) return not_untangled();
    approach(*depth);
    solve_start_ = x_;
    result_.initial_value = mean_energy();
    optimize(*depth);
    finish();
    lift_worst(*depth);
    return std::move(result_);
  }

 private:
  void require_usable() const {
    const VolumeCheck& check = result_.before;
    const auto refuse = [&](const std::string& what) {
      throw Error(ErrorKind::Unsupported, fmt::format("{}: {}", mesh_.file, what));
    };
    if (check.inverted() == static_cast<Index>(check.cells.size()))
      refuse(
          fmt::format("all {} elements are turned around, det J < 0 all over them; reverse the "
                      "order of their corners, or mirror the mesh",
                      check.cells.size()));
    if (!check.sides_fit())
      refuse(
          "its elements do not fit together, mesh check says where; only what is the same in "
          "both elements of a side can be moved");
  }

  VolumeResult refused() {
    result_.status = Status::Infeasible;
    result_.message = fmt::format(
        "{} element{} cannot be valid whatever moves: the nodes that are held make det J <= 0 "
        "there",
        result_.impossible.size(), result_.impossible.size() == 1 ? "" : "s");
    result_.after = result_.before;
    return std::move(result_);
  }

  // Moves a mesh on which the energy is steep, or overflows, to points where it is not, by
  // symmetric Dirichlet. It has the same domain, and its barrier grows only as a power.
  void approach(int depth) {
    if (options_.energy.empty() || record_.iterations_left() <= 0) return;
    for (int look = 0; look < kMostApproaches && !(mean_energy() <= kSteepMean); ++look) {
      const Problem tame =
          elements_->problem(default_energy(), weights_, &*held_, elements_->checkers(depth));
      NewtonOptions newton = newton_of_maps();
      newton.stop = record_.stop();
      newton.stopping.max_iterations = kApproachSteps;
      const Vec start = tame.reduce(x_);
      const SolveResult solved = NewtonMinimizer(newton).minimize(tame, start, nullptr);
      if (solved.y == start || record_.stop()() != Directive::Continue) return;
      x_ = tame.expand(solved.y);
      result_.untangling_iterations += static_cast<int>(solved.iterations.size());
      if (solved.status != Status::MaxIterations) return;
    }
  }

  // Returns the end of untangling. A mesh that is valid only by proofs that steps cannot maintain
  // is unchanged.
  VolumeResult not_untangled() {
    const Directive why = record_.stop()();
    const bool was_valid = result_.before.is_valid();
    if (was_valid)
      result_.after = result_.before;
    else
      move_points();
    result_.status = why != Directive::Continue ? stopped_status(why)
                     : result_.after.is_valid() ? Status::Stalled
                                                : Status::Infeasible;
    const auto count = static_cast<Index>(result_.after.cells.size());
    result_.message =
        was_valid
            ? "nothing moved: the bounds that hold steps do not show all elements to be valid"
            : fmt::format("{}: {} of {} elements are not proven to be valid after {} steps",
                          why != Directive::Continue ? "stopped while untangling" : "not untangled",
                          count - result_.after.count(ProofStatus::Proven), count,
                          result_.untangling_iterations);
    return std::move(result_);
  }

  // Returns the energy of the options; by default symmetric Dirichlet.
  EnergySum energy() const { return options_.energy.empty() ? default_energy() : options_.energy; }
  EnergySum default_energy() const {
    return {{find_volume_energy("symmetric-dirichlet", net_->dim())->make, 1.0}};
  }

  // Optimizes, round by round if nodes slide along curved sides. A round moves them in their
  // tangents, then back to the original sides: the whole way, or the part of it that leaves all
  // elements valid and the energy lower.
  void optimize(int first) {
    if (!held_->has_sliding()) return optimize_linear(first);
    double value = elements_->mean(energy(), weights_, x_);
    for (int round = 0; round < kMostSlidingRounds; ++round) {
      const Vec before = x_;
      held_->let_slide(x_);
      optimize_linear(first);
      if (x_ == before) break;
      const RowMatrix from = net_->node_places(before), to = net_->node_places(x_);
      x_ = before;
      double next_value = value;
      for (double part = 1; part >= kLeastSlidingPart; part /= 2) {
        RowMatrix nodes = from + part * (to - from);
        held_->put_back(nodes);
        const Vec next = before + net_->control_change(nodes - from);
        if (!check_all(elements_->checkers(ProofDepth::kDeepest), next).feasible) continue;
        next_value = elements_->mean(energy(), weights_, next);
        if (!(next_value < value)) continue;
        x_ = next;
        break;
      }
      const bool is_lower = next_value < value - kSlidingDecrease * std::abs(value);
      value = std::min(value, next_value);
      if (!is_lower || result_.status != Status::Converged) break;
    }
  }

  // Optimizes with proofs of that depth first, then with the deepest if proofs limit the steps.
  void optimize_linear(int first) {
    record_.begin(Activity::Solving);
    StepObserver noted([&](const TraceEntry& row, const Vec&) {
      TraceEntry entry = row;
      entry.energy = row.record.energy;
      return record_.note(std::move(entry));
    });
    for (int depth = first;; depth = ProofDepth::kDeepest) {
      const Problem problem =
          elements_->problem(energy(), weights_, &*held_, elements_->checkers(depth));
      result_.unknowns = problem.size();
      const Vec start = problem.reduce(x_);
      NewtonOptions newton = newton_of_maps();
      newton.stop = record_.stop();
      newton.stopping.relative_decrease = options_.tolerance;
      newton.stopping.max_iterations =
          std::min(newton.stopping.max_iterations, std::max(0, record_.iterations_left()));
      const SolveResult solved = NewtonMinimizer(newton).minimize(problem, start, &noted);
      result_.status = solved.status;
      result_.message = solved.message;
      // Without a step the points stay as they are, without rounding.
      if (solved.y != start) x_ = problem.expand(solved.y);
      if (solved.status != Status::Stalled || depth == ProofDepth::kDeepest) break;
    }
  }

  // Elements that are valid by their control points may be invalid after their nodes are rounded to
  // doubles. Then only a part of the way from the start of the solve is taken.
  void finish() {
    move_points();
    const Vec whole = x_;
    for (double part = 0.5; !result_.after.is_valid() && part >= kLeastWrittenPart; part /= 2) {
      x_ = solve_start_ + part * (whole - solve_start_);
      if (held_->has_sliding()) {
        const RowMatrix from = net_->node_places(x_);
        RowMatrix nodes = from;
        held_->put_back(nodes);
        x_ += net_->control_change(nodes - from);
      }
      move_points();
    }
    if (!result_.after.is_valid()) {
      x_ = solve_start_;
      move_points();
    }
    result_.value = mean_energy();
    if (result_.after.is_valid()) return;
    result_.status = Status::Infeasible;
    result_.message = "the nodes, rounded to doubles, are not proven to be valid";
  }

  double mean_energy() const { return elements_->mean(energy(), elements_->equal_weights(), x_); }

  // Minimizing a mean may worsen the worst element. While the least scaled Jacobian of a valid mesh
  // falls, the elements below its former value get larger weights, and everything is solved again.
  // The points with the largest least value stay. A limit that ends this ends the run.
  void lift_worst(int depth) {
    if (!result_.before.is_valid()) return;
    VolumeResult best = result_;
    Vec best_x = x_;
    for (int round = 0; round < kMostRounds && result_.status == Status::Converged; ++round) {
      if (!result_.least_fell()) break;
      record_.begin_pass(kMostRounds - round - 1);
      weigh_more();
      optimize(depth);
      finish();
      if (!result_.is_valid() ||
          result_.after.least_scaled_jacobian() <= best.after.least_scaled_jacobian())
        continue;
      best = result_;
      best_x = x_;
    }
    const bool is_limited =
        result_.status == Status::MaxIterations || record_.stop()() != Directive::Continue;
    if (is_limited) {
      best.status = result_.status;
      best.message = result_.message;
    }
    result_ = std::move(best);
    x_ = std::move(best_x);
  }

  void weigh_more() {
    const double least = result_.before.least_scaled_jacobian() - kSameScaledJacobian;
    std::size_t cell = 0;
    for (Vec& weights : weights_)
      for (Index e = 0; e < weights.size(); ++e, ++cell)
        if (result_.after.cells[cell].scaled_jacobian < least) weights[e] *= kHeavier;
  }

  // Computes the nodes of x_ and proves them.
  void move_points() {
    record_.begin(Activity::Proving);
    VolumeMesh moved = mesh_;
    moved.points = net_->nodes(start_, x_, held_->held());
    result_.moved_nodes = 0;
    result_.largest_displacement = 0;
    for (Index k = 0; k < moved.points.rows(); ++k) {
      if (moved.points.row(k) == mesh_.points.row(k)) continue;
      ++result_.moved_nodes;
      result_.largest_displacement = std::max(
          result_.largest_displacement, (moved.points.row(k) - mesh_.points.row(k)).stableNorm());
    }
    result_.after = check_volume_mesh(moved, record_.telling({}));
    result_.points = std::move(moved.points);
  }

  const VolumeMesh& mesh_;
  const VolumeOptions& options_;
  RunRecord& record_;
  VolumeResult result_;
  VolumeBoundary boundary_ = VolumeBoundary::Fixed;
  std::optional<ControlNet> net_;
  std::optional<HeldPoints> held_;
  std::optional<VolumeElements> elements_;
  std::vector<Vec> weights_;  // of the elements of each part
  // Control points: of the mesh, at the start of the minimization (all elements valid), and at
  // present.
  Vec start_, solve_start_, x_;
};

}  // namespace

bool VolumeResult::least_fell() const {
  return before.is_valid() &&
         after.least_scaled_jacobian() < before.least_scaled_jacobian() - kSameScaledJacobian;
}

std::span<const NamedEnergy> volume_energies(int dim) {
  return dim == 3 ? solid_energies() : named_energies();
}

const NamedEnergy* find_volume_energy(std::string_view name, int dim) {
  return dim == 3 ? find_solid_energy(name) : find_energy(name);
}

bool is_edge_length(double x, int dim) {
  const double square = std::pow(x, 2 * dim);
  return x > 0 && std::isnormal(square) && std::isnormal(1 / square);
}

VolumeResult optimize_volume_mesh(const VolumeMesh& mesh, const VolumeOptions& options,
                                  RunRecord& record) {
  return VolumeOptimizer(mesh, options, record).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
