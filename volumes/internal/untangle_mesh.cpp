#include "majorant/volumes/internal/untangle_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "majorant/constraints/untangling_descent.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/untangling.h"
#include "majorant/framework/constraint.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/volumes/node_orders.h"

namespace majorant {
namespace {

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

EnergyFactory untangling_energy(int dim) {
  return dim == 3 ? energy_factory(SolidUntanglingDensity(1))
                  : energy_factory(UntanglingDensity(1));
}

EnergyFactory dirichlet_energy(int dim) {
  const Traits everywhere{Domain::Everywhere, Convexity::Unknown, Reweighting::Refused};
  const auto squared = [](const auto& J) { return J.squaredNorm(); };
  return dim == 3 ? energy_factory(density<3, 3>("dirichlet", squared, everywhere))
                  : energy_factory(density<2, 2>("dirichlet", squared, everywhere));
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

// The attempts on one mesh. A free boundary is held at first, unless that makes elements
// impossible. It keeps shape and size, so that eps may be large, and most meshes are tangled only
// inside. A curved mesh that stays tangled is untangled as a straight one, as far as nothing is
// held, and once more from there.
class Untangling {
 public:
  Untangling(TangledMesh tangled, RunRecord& record)
      : tangled_(std::move(tangled)),
        mesh_(tangled_.mesh),
        elements_(tangled_.elements),
        net_(elements_.net()),
        held_(tangled_.held),
        record_(record),
        x_(std::move(tangled_.x)) {}

  UntangledMesh run() {
    record_.announce("untangling");
    untangle();
    return {std::move(x_), iterations_};
  }

 private:
  void untangle() {
    if (is_free()) {
      HeldPoints border(mesh_, tangled_.sides, net_, x_, VolumeBoundary::Fixed);
      border.hold_all_but(tangled_.movable);
      int steps = kHeldSteps;
      for (auto forced = border.impossible_cells(mesh_); !forced.empty();
           forced = border.impossible_cells(mesh_)) {
        border.release(forced, held_);
        steps = kReleasedSteps;
      }
      UntangledPoint inside =
          descended(x_, border, nullptr, {.first_eps = kFirstEpsHeld, .max_iterations = steps});
      if (inside.verdict.feasible) x_ = std::move(inside.x);
      if (inside.verdict.feasible || record_.stop()() != Directive::Continue) return;
    }
    if (comes_free_smoothed() || record_.stop()() != Directive::Continue) return;
    UntangledPoint point = descended(x_, nullptr);
    const bool is_curved = std::any_of(net_.parts().begin(), net_.parts().end(),
                                       [](const auto& part) { return part.space->degree() > 1; });
    if (!point.verdict.feasible && is_curved && record_.stop()() == Directive::Continue) {
      const StraightPoints straight(mesh_, net_, held_);
      point = descended(x_, &straight);
      if (!point.verdict.feasible) point = descended(point.x, nullptr);
    }
    x_ = std::move(point.x);
  }

  // Starts from the minimum of the mean of |J|^2, which takes one linear system. A mesh that is
  // tangled only inside a held boundary is then untangled in few steps, however far its nodes are
  // from their places. Not for meshes that stay mostly invalid.
  bool comes_free_smoothed() {
    if (is_free()) return false;
    const Problem smooth = elements_.problem({{dirichlet_energy(net_.dim()), 1.0}},
                                             elements_.equal_weights(), &held_, {});
    NewtonOptions newton = newton_of_maps();
    newton.stop = record_.stop();
    newton.stopping.max_iterations = 1;
    const Vec start = smooth.reduce(x_);
    const SolveResult solved = NewtonMinimizer(newton).minimize(smooth, start, nullptr);
    if (record_.stop()() != Directive::Continue) return false;
    const VolumeElements::Checkers all = elements_.checkers(ProofDepth::kStart);
    Vec x = smooth.expand(solved.y);
    const auto before = static_cast<double>(check_all(all, x_).blocking.size());
    const Verdict after = check_all(all, x);
    if (static_cast<double>(after.blocking.size()) > kSmoothPart * before) return false;
    iterations_ += static_cast<int>(solved.iterations.size());
    if (!after.feasible) {
      UntangledPoint point = descended(
          x, held_, nullptr, {.first_eps = kFirstEpsHeld, .max_iterations = kSmoothSteps});
      if (!point.verdict.feasible) return false;
      x = std::move(point.x);
    }
    x_ = std::move(x);
    return true;
  }

  UntangledPoint descended(VecIn x, const StraightPoints* straight) {
    return descended(x, held_, straight, {.first_eps = is_free() ? kFirstEps : kFirstEpsHeld});
  }

  UntangledPoint descended(VecIn x, const HeldPoints& held, const StraightPoints* straight,
                           const UntanglingRules& rules) {
    ProblemBuilder builder = elements_.builder();
    const std::vector<TermId> energies =
        elements_.add_mean(builder, {untangling_energy(net_.dim())}, elements_.equal_weights());
    builder.add(held);
    if (straight != nullptr) builder.add(*straight);
    const Problem problem = builder.build();
    const VolumeElements::Checkers all = elements_.checkers(ProofDepth::kStart);
    UntangledPoint point = descend_untangling(
        problem, energies, [&](VecIn at) { return check_all(all, at); }, problem.reduce(x), rules,
        record_.stop());
    iterations_ += point.iterations;
    return point;
  }

  bool is_free() const { return tangled_.boundary == VolumeBoundary::Free; }

  TangledMesh tangled_;
  const VolumeMesh& mesh_;
  const VolumeElements& elements_;
  const ControlNet& net_;
  const HeldPoints& held_;
  RunRecord& record_;
  Vec x_;  // the present control points
  int iterations_ = 0;
};

}  // namespace

UntangledMesh untangle_mesh(TangledMesh tangled, RunRecord& record) {
  return Untangling(std::move(tangled), record).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
