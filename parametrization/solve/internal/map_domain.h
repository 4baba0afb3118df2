// The domain on which the map of one degree is optimized: its own nodes (PlainDomain), or with the
// space around its image as a part of the problem (ScaffoldedDomain), which keeps it free of
// overlaps.
//
//     PlainDomain domain;
//     DegreeSolver solver(setup, domain, map.shared_space(), map.control_points());
//
// Internal to parametrize(). A domain lives as long as a run: it is elevated with the map.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/stepper.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/parametrization/scaffold/scaffold.h"
#include "majorant/parametrization/solve/internal/prepared_solve.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

// The change of the unknowns between two steps.
enum class DomainChange {
  None,
  Deferred,   // none yet: what the surroundings hold back is not known
  Values,     // they are elsewhere: energies are others
  Structure,  // there are others: the problem must be built anew
};

class MapDomain {
 public:
  virtual ~MapDomain() = default;

  // The unknowns of a problem for a map with these control points, which come first.
  virtual Vec unknowns(VecIn map) const = 0;
  // Does what map_problem() does, on the unknowns x.
  virtual MapProblem build(const MapSpecification& map,
                           const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                           const DensityTerms& terms,
                           const std::shared_ptr<const LocalInjectivity>& injectivity, VecIn x) = 0;

  // What was prepared of the first problem, for whoever asks first; null: nothing.
  virtual std::shared_ptr<PreparedParts> take_prepared() { return nullptr; }

  // States that follow the unknowns x of the last problem built; empty: as they are. Not stopped:
  // coming back to a place after a stop needs it, too.
  virtual TermChanges before_step(const MapProblem&, VecIn /*x*/) { return {}; }
  // The surroundings are adapted to x, which was reached by `step` or could not be left. depth: of
  // certificates.
  virtual DomainChange after_step(Vec& /*x*/, const StepResult& /*step*/, int /*depth*/) {
    return DomainChange::None;
  }
  // The part of the problem's energy at x that is not the map's own.
  virtual double foreign_energy(const Problem&, VecIn /*x*/) const { return 0; }

  // The surroundings follow a barrier of their own: weight relative to the map's energy, 0 as ever.
  // Returns whether that changes anything.
  virtual bool strengthen(double /*weight*/) { return false; }

  // Called where a run stalls: surroundings that had yielded because the image rested do so no more
  // at this degree. Returns whether they had.
  virtual bool hold() { return false; }

  // The ordering of unknowns for factorizations.
  virtual Ordering ordering() const { return Ordering::Automatic; }

  // The rules by which a run ends at the tolerance asked for, as this domain needs them.
  virtual StoppingRules final_rules(StoppingRules usual) { return usual; }

  virtual void elevate(const std::shared_ptr<const BezierTriangleSpace>& /*higher*/) {}

  // The surroundings at a place, to come back to it; none where there are none.
  virtual std::optional<Scaffold> surroundings() const { return {}; }
  virtual void restore(const std::optional<Scaffold>&) {}
  virtual FlipCounts flips() const { return {}; }
  // Spent on the surroundings, outside of steps; charge() adds what their changes cost elsewhere.
  virtual double seconds() const { return 0; }
  virtual void charge(double /*seconds*/) {}
};

class PlainDomain final : public MapDomain {
 public:
  explicit PlainDomain(std::shared_ptr<PreparedParts> prepared = nullptr)
      : prepared_(std::move(prepared)) {}

  Vec unknowns(VecIn map) const override { return map; }
  MapProblem build(const MapSpecification& map,
                   const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                   const DensityTerms& terms,
                   const std::shared_ptr<const LocalInjectivity>& injectivity, VecIn) override {
    return map_problem(map, space, start, terms, injectivity);
  }
  std::shared_ptr<PreparedParts> take_prepared() override { return std::move(prepared_); }

 private:
  std::shared_ptr<PreparedParts> prepared_;
};

// [MC20] Sec. 6. Every iteration is one Newton step on
//     E(map) + lambda E_conf(scaffold),   lambda = share E(map) / E_conf(scaffold),
// then the scaffold's edges are flipped and its triangles relaxed with the image fixed. The share
// is large while the image moves and falls when it rests: what remains of it is an error of the
// map.
class ScaffoldedDomain final : public MapDomain {
 public:
  // stop: ends relaxations. Throws Error(Infeasible) as Scaffold does where the start overlaps
  // itself.
  ScaffoldedDomain(const BezierMap& start, ScaffoldFlips flips, const SolverRules& rules,
                   const StopCheck& stop);

  Vec unknowns(VecIn map) const override { return scaffold_.joined(map); }
  MapProblem build(const MapSpecification& map,
                   const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                   const DensityTerms& terms,
                   const std::shared_ptr<const LocalInjectivity>& injectivity, VecIn x) override;
  TermChanges before_step(const MapProblem& built, VecIn x) override;
  DomainChange after_step(Vec& x, const StepResult& step, int depth) override;
  double foreign_energy(const Problem& problem, VecIn x) const override;
  bool strengthen(double weight) override;
  bool hold() override;
  // Flips change the pattern nearly every step, and METIS would cost more than it saves, but where
  // the scaffold waits.
  Ordering ordering() const override {
    return map_faces_ >= rules_.patient_faces ? Ordering::Metis : Ordering::Amd;
  }
  StoppingRules final_rules(StoppingRules usual) override;
  void elevate(const std::shared_ptr<const BezierTriangleSpace>& higher) override;
  std::optional<Scaffold> surroundings() const override { return scaffold_; }
  void restore(const std::optional<Scaffold>& scaffold) override;
  FlipCounts flips() const override { return flips_; }
  double seconds() const override { return seconds_; }
  void charge(double seconds) override { seconds_ += seconds; }

 private:
  enum class Stage { Moving, AtRest, Held };  // held: as while it moves, although it rests

  bool refine(const std::vector<Index>& blocking);
  FlipCounts flip();
  int depth(int of_map) const { return std::max(of_map, rules_.depth); }  // of certificates
  bool needs_relaxing(const IterationRecord& step, const FlipCounts& flips) const;
  bool rests(const StepResult& step) const;
  bool waits(const StepResult& step);

  double seconds_ = 0;
  Index map_faces_;
  Scaffold scaffold_;
  ScaffoldFlips mode_;
  ScaffoldRules rules_;
  double served_below_;    // the decrease of steps after which a factor is kept
  double ends_below_ = 0;  // of those that end the run: they must not for want of room
  NewtonOptions relaxing_;
  FlipCounts flips_;
  double share_;  // lambda E_conf / E while the image moves
  Stage stage_ = Stage::Moving;
  int waited_ = 0;                // steps since it was last looked after
  std::optional<Problem> built_;  // the last one
  std::optional<TermId> around_;  // E_conf in it
  std::optional<double> lambda_;  // none: not set since the problem was built
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
