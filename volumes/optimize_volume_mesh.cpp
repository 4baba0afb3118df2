#include "majorant/volumes/optimize_volume_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/constraints/untangling_descent.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/solid_energies.h"
#include "majorant/energies/untangling.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/error.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/volumes/internal/control_net.h"
#include "majorant/volumes/internal/held_points.h"
#include "majorant/volumes/internal/target_shapes.h"
#include "majorant/volumes/node_orders.h"

namespace majorant {
namespace {

// The weight of the lattice points: the worst points of a curved element are at its corners and
// edges, where quadrature rules have none. Of 0.001, 0.3, 0.6 and 0.9, this value gave the largest
// mean scaled Jacobian on four of five public meshes of degrees 2 to 4.
constexpr double kLatticePart = 0.9;

// The maximum number of Newton steps that untangle a mesh whose boundary is held. The public meshes
// need 6, 8 and 134 without a smooth start.
constexpr int kHeldSteps = 200;
// A smooth start is kept if it leaves at most this part of the invalid elements; then the maximum
// number of Newton steps that untangle the mesh from there.
constexpr double kSmoothPart = 0.5;
constexpr int kSmoothSteps = 50;
// The maximum number of Newton steps after a part of the boundary is released; gmsh's models need
// 2.
constexpr int kReleasedSteps = 20;

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

EnergyFactory untangling_energy(int dim) {
  return dim == 3 ? energy_factory(SolidUntanglingDensity(1))
                  : energy_factory(UntanglingDensity(1));
}

// Puts control points where the straight cells of their corners have them: a mesh of fewer
// unknowns, which folds in fewer ways. The rows N x = sum of w_c x_c over the corners c of a cell,
// for points that nothing holds, have integer coefficients.
class StraightPoints final : public Constraint {
 public:
  // All three must outlive this object.
  StraightPoints(const VolumeMesh& mesh, const ControlNet& net, const HeldPoints& held)
      : mesh_(mesh), net_(net), held_(held) {}

  void append_rows(ConstraintRows& rows) const override {
    const int dim = net_.dim();
    std::vector<char> is_done(to_size(net_.count()), 0);
    for (const ControlNet::Part& part : net_.parts()) {
      const CellType& type = mesh_.blocks[to_size(part.block)].type;
      const std::vector<std::array<int, 8>> weights = corner_weights(type.shape, type.degree);
      const Cells& cells = part.space->cells();
      const int corners = corner_count(type.shape);
      for (Index e = 0; e < cells.rows(); ++e)
        for (Index k = corners; k < cells.cols(); ++k) {
          const Index point = cells(e, k);
          if (!held_.is_free(point) || is_done[to_size(point)] != 0) continue;
          is_done[to_size(point)] = 1;
          const std::array<int, 8>& of_corners = weights[to_size(k)];
          for (int d = 0; d < dim; ++d) {
            rows.begin_row(fmt::format("straight coordinate {} of control point {}", d, point));
            rows.add(dim * point + d, std::accumulate(of_corners.begin(), of_corners.end(), 0));
            for (int c = 0; c < corners; ++c)
              if (of_corners[to_size(c)] != 0)
                rows.add(dim * cells(e, c) + d, -of_corners[to_size(c)]);
            rows.end_row(0);
          }
        }
    }
  }

 private:
  const VolumeMesh& mesh_;
  const ControlNet& net_;
  const HeldPoints& held_;
};

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
    if (boundary_ == VolumeBoundary::Free) held_->hold_all_but(faulty_and_neighbours(sides));
    result_.held_sides = held_->sides();
    result_.curved_sides = held_->curved_sides();
    result_.impossible = held_->impossible_cells(mesh_);
    if (!result_.impossible.empty()) return refused();
    targets_ = target_shapes(mesh_, *net_, options_);
    for (const RestShapes& rest : targets_) {
      measure_ += rest.measure.sum();
      weights_.push_back(Vec::Ones(rest.measure.size()));
    }
    start_ = x_;
    std::optional<int> depth = proven_depth();
    if (!depth) {
      untangle();
      depth = proven_depth();
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
  using Checkers = std::vector<std::shared_ptr<const LocalInjectivity>>;

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

  Checkers checkers(int depth) const {
    Checkers out;
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      const std::shared_ptr<const BernsteinSpace>& space = net_->parts()[k].space;
      out.push_back(std::make_shared<const LocalInjectivity>(
          space, targets_[k].measure / space->reference_measure(), depth, record_.stop()));
    }
    return out;
  }

  static Verdict judge(const Checkers& checkers, VecIn x) {
    Verdict all;
    all.margin = std::numeric_limits<double>::infinity();
    for (const auto& checker : checkers) {
      const Verdict verdict = checker->check(x);
      all.feasible = all.feasible && verdict.feasible;
      all.margin = std::min(all.margin, verdict.margin);
      all.blocking.insert(all.blocking.end(), verdict.blocking.begin(), verdict.blocking.end());
    }
    return all;
  }

  // Returns the depth of proofs that show x_ to be valid; none if not even the deepest do.
  std::optional<int> proven_depth() const {
    for (const int depth : {ProofDepth::kStart, ProofDepth::kDeepest})
      if (judge(checkers(depth), x_).feasible) return depth;
    return std::nullopt;
  }

  static Quadrature rule_of(const BernsteinSpace& space) {
    const Quadrature rule = space.default_rule(RestJacobian::Constant);
    const bool is_affine = space.degree() == 1 && space.element().factors.size() == 1;
    return is_affine ? rule : guarded_rule(rule, space.degree(), kLatticePart);
  }

  // Returns the cells that are not proven valid, and those that share a side with one.
  std::vector<CellName> faulty_and_neighbours(const std::vector<CellSide>& sides) const {
    const auto key = [](CellName name) { return std::pair(name.block, name.cell); };
    std::set<std::pair<Index, Index>> faulty, all;
    for (const CheckedCell& cell : result_.before.cells)
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

  // A free boundary is held at first, unless that makes elements impossible. It keeps shape and
  // size, so that eps may be large, and most meshes are tangled only inside. A curved mesh that
  // stays tangled is untangled as a straight one, as far as nothing is held, and once more from
  // there.
  void untangle() {
    record_.announce("untangling");
    if (boundary_ == VolumeBoundary::Free) {
      const std::vector<CellSide> sides = sides_of(mesh_);
      HeldPoints border(mesh_, sides, *net_, x_, VolumeBoundary::Fixed);
      border.hold_all_but(faulty_and_neighbours(sides));
      int steps = kHeldSteps;
      for (auto forced = border.impossible_cells(mesh_); !forced.empty();
           forced = border.impossible_cells(mesh_)) {
        border.release(forced, *held_);
        steps = kReleasedSteps;
      }
      UntangledPoint inside =
          descended(x_, border, nullptr, {.first_eps = kFirstEpsHeld, .max_iterations = steps});
      if (inside.verdict.feasible) x_ = std::move(inside.x);
      if (inside.verdict.feasible || record_.stop()() != Directive::Continue) return;
    }
    if (comes_free_smoothed() || record_.stop()() != Directive::Continue) return;
    UntangledPoint point = descended(x_, nullptr);
    const bool is_curved = std::any_of(net_->parts().begin(), net_->parts().end(),
                                       [](const auto& part) { return part.space->degree() > 1; });
    if (!point.verdict.feasible && is_curved && record_.stop()() == Directive::Continue) {
      const StraightPoints straight(mesh_, *net_, *held_);
      point = descended(x_, &straight);
      if (!point.verdict.feasible) point = descended(point.x, nullptr);
    }
    x_ = std::move(point.x);
  }

  // Starts from the minimum of the mean of |J|^2, which takes one linear system. A mesh that is
  // tangled only inside a held boundary is then untangled in few steps, however far its nodes are
  // from their places. Not for meshes that stay mostly invalid.
  bool comes_free_smoothed() {
    if (boundary_ == VolumeBoundary::Free) return false;
    const Problem smooth = problem(dirichlet_energy(), weights_, &*held_, {});
    NewtonOptions newton = newton_of_maps();
    newton.stop = record_.stop();
    newton.stopping.max_iterations = 1;
    const Vec start = smooth.reduce(x_);
    const SolveResult solved = NewtonMinimizer(newton).minimize(smooth, start, nullptr);
    if (record_.stop()() != Directive::Continue) return false;
    const Checkers all = checkers(ProofDepth::kStart);
    Vec x = smooth.expand(solved.y);
    const auto before = static_cast<double>(judge(all, x_).blocking.size());
    const Verdict after = judge(all, x);
    if (static_cast<double>(after.blocking.size()) > kSmoothPart * before) return false;
    result_.untangling_iterations += static_cast<int>(solved.iterations.size());
    if (!after.feasible) {
      UntangledPoint point = descended(
          x, *held_, nullptr, {.first_eps = kFirstEpsHeld, .max_iterations = kSmoothSteps});
      if (!point.verdict.feasible) return false;
      x = std::move(point.x);
    }
    x_ = std::move(x);
    return true;
  }
  EnergySum dirichlet_energy() const {
    const Traits everywhere{Domain::Everywhere, Convexity::Unknown, Reweighting::Refused};
    const auto squared = [](const auto& J) { return J.squaredNorm(); };
    return {{net_->dim() == 3 ? energy_factory(density<3, 3>("dirichlet", squared, everywhere))
                              : energy_factory(density<2, 2>("dirichlet", squared, everywhere)),
             1.0}};
  }

  UntangledPoint descended(VecIn x, const StraightPoints* straight) {
    const bool is_free = boundary_ == VolumeBoundary::Free;
    return descended(x, *held_, straight, {.first_eps = is_free ? kFirstEps : kFirstEpsHeld});
  }

  UntangledPoint descended(VecIn x, const HeldPoints& held, const StraightPoints* straight,
                           const UntanglingRules& rules) {
    const EnergyFactory energy = untangling_energy(net_->dim());
    ProblemBuilder builder(static_cast<Index>(x_.size()));
    std::vector<TermId> energies;
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      const auto& space = net_->parts()[k].space;
      energies.push_back(builder.add(energy(space, targets_[k], {rule_of(*space)}), 1 / measure_));
    }
    builder.add(held);
    if (straight != nullptr) builder.add(*straight);
    const Problem problem = builder.build();
    const Checkers all = checkers(ProofDepth::kStart);
    UntangledPoint point = descend_untangling(
        problem, energies, [&](VecIn at) { return judge(all, at); }, problem.reduce(x), rules,
        record_.stop());
    result_.untangling_iterations += point.iterations;
    return point;
  }

  // Moves a mesh on which the energy is steep, or overflows, to points where it is not, by
  // symmetric Dirichlet. It has the same domain, and its barrier grows only as a power.
  void approach(int depth) {
    if (options_.energy.empty() || record_.iterations_left() <= 0) return;
    for (int look = 0; look < kMostApproaches && !(mean_energy() <= kSteepMean); ++look) {
      const Problem tame = problem(default_energy(), weights_, &*held_, checkers(depth));
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

  // Returns the problem of the weighted mean of the energy over the elements, whose steps are
  // proven to that depth. held: the fixed part, or null.
  Problem problem(int depth, const std::vector<Vec>& weights, const HeldPoints* held) const {
    return problem(options_.energy.empty() ? default_energy() : options_.energy, weights, held,
                   checkers(depth));
  }
  EnergySum default_energy() const {
    return {{find_volume_energy("symmetric-dirichlet", net_->dim())->make, 1.0}};
  }
  Problem problem(const EnergySum& energy, const std::vector<Vec>& weights, const HeldPoints* held,
                  Checkers checks) const {
    ProblemBuilder builder(static_cast<Index>(x_.size()));
    for (const WeightedEnergy& summand : energy)
      for (std::size_t k = 0; k < targets_.size(); ++k) {
        RestShapes rest = targets_[k];
        rest.measure.array() *= weights[k].array();
        builder.add(summand.make(net_->parts()[k].space, rest, {rule_of(*net_->parts()[k].space)}),
                    summand.weight / measure_);
      }
    if (held != nullptr) builder.add(*held);
    for (auto& checker : checks) builder.add(std::move(checker));
    return builder.build();
  }

  // Optimizes, round by round if nodes slide along curved sides. A round moves them in their
  // tangents, then back to the original sides: the whole way, or the part of it that leaves all
  // elements valid and the energy lower.
  void optimize(int first) {
    if (!held_->has_sliding()) return optimize_linear(first);
    double value = value_at(x_);
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
        if (!judge(checkers(ProofDepth::kDeepest), next).feasible) continue;
        next_value = value_at(next);
        if (!(next_value < value)) continue;
        x_ = next;
        break;
      }
      const bool is_lower = next_value < value - kSlidingDecrease * std::abs(value);
      value = std::min(value, next_value);
      if (!is_lower || result_.status != Status::Converged) break;
    }
  }

  // Returns the mean of the energy at control points, which may violate the constraints.
  double value_at(VecIn x) const {
    const Problem all = problem(ProofDepth::kStart, weights_, nullptr);
    return Evaluator(all).value(all.reduce(x));
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
      const Problem problem_here = problem(depth, weights_, &*held_);
      result_.unknowns = problem_here.size();
      const Vec start = problem_here.reduce(x_);
      NewtonOptions newton = newton_of_maps();
      newton.stop = record_.stop();
      newton.stopping.relative_decrease = options_.tolerance;
      newton.stopping.max_iterations =
          std::min(newton.stopping.max_iterations, std::max(0, record_.iterations_left()));
      const SolveResult solved = NewtonMinimizer(newton).minimize(problem_here, start, &noted);
      result_.status = solved.status;
      result_.message = solved.message;
      // Without a step the points stay as they are, without rounding.
      if (solved.y != start) x_ = problem_here.expand(solved.y);
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

  double mean_energy() const {
    std::vector<Vec> ones;
    for (const Vec& weights : weights_) ones.push_back(Vec::Ones(weights.size()));
    const Problem plain = problem(ProofDepth::kStart, ones, nullptr);
    return Evaluator(plain).value(plain.reduce(x_));
  }

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
  std::vector<RestShapes> targets_;
  std::vector<Vec> weights_;  // of the elements of each part
  double measure_ = 0;
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
