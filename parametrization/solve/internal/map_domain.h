// The domain on which the map of one degree is optimized. PlainDomain: the map's own nodes.
// ScaffoldedDomain: also the space around its image, which keeps it free of overlaps. BarrierDomain
// (barrier_domain.h): the map's own nodes, free of overlaps, at degree 1.
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
// * None: there is no change.
// * Deferred: there is no change yet, since the effect on the surroundings is not known.
// * Values: they have other values, so energies change.
// * Structure: there are other unknowns, so the problem must be rebuilt.
enum class DomainChange { None, Deferred, Values, Structure };

class MapDomain {
 public:
  virtual ~MapDomain() = default;

  // Returns the unknowns of a problem for a map with these control points, which come first.
  virtual Vec unknowns(VecIn map) const = 0;
  // Does what map_problem() does, on the unknowns x.
  virtual MapProblem build(const MapSpecification& map,
                           const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                           const DensityTerms& terms,
                           const std::shared_ptr<const LocalInjectivity>& injectivity, VecIn x) = 0;

  // Returns the parts prepared for the first problem, once; null if there are none.
  virtual std::shared_ptr<PreparedParts> take_prepared() { return nullptr; }

  // Returns the changes of states that follow the unknowns x of the last problem built; empty:
  // none. Must not be stopped, since returning to a place after a stop needs it.
  virtual TermChanges before_step(const MapProblem&, VecIn /*x*/) { return {}; }
  // Adapts the surroundings to x, which was reached by `step`, or from which no step was possible.
  // depth: of certificates.
  virtual DomainChange after_step(Vec& /*x*/, const StepResult& /*step*/, int /*depth*/) {
    return DomainChange::None;
  }
  // Returns whether the last problem built is also that of x.
  virtual bool fits(VecIn /*x*/) const { return true; }
  // Returns the part of the problem's energy at x that is not the map's own.
  virtual double foreign_energy(const Problem&, VecIn /*x*/) const { return 0; }

  // Makes the surroundings follow a barrier of the given weight relative to the map's energy; 0: as
  // usual. Returns whether that changes anything.
  virtual bool strengthen(double /*weight*/) { return false; }

  // Called when a run stalls: surroundings that had yielded because the image rested stop yielding
  // at this degree. Returns whether they had.
  virtual bool hold() { return false; }

  // Returns the ordering of unknowns for factorizations.
  virtual Ordering ordering() const { return Ordering::Automatic; }

  // Returns the rules by which a run ends at the requested tolerance, adapted to this domain.
  virtual StoppingRules final_rules(StoppingRules usual) { return usual; }

  // Returns the rules by which a factor serves several steps, adapted to this domain.
  virtual LaggedFactorRules lagged(LaggedFactorRules usual) const { return usual; }

  virtual void elevate(const std::shared_ptr<const BezierTriangleSpace>& /*higher*/) {}

  // Returns the surroundings at a place, to return to it; none if there are none.
  virtual std::optional<Scaffold> surroundings() const { return {}; }
  virtual void restore(const std::optional<Scaffold>&) {}
  virtual FlipCounts flips() const { return {}; }
  // Returns the time spent on the surroundings outside of steps, seconds; charge() adds the cost of
  // their changes elsewhere.
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

// A map and its scaffold [MC20] Sec. 6. Every iteration is one Newton step on
//     E(map) + lambda E_conf(scaffold),   lambda = share E(map) / E_conf(scaffold),
// then the scaffold's edges are flipped and its triangles relaxed with the image fixed. The share
// is large while the image moves and falls when it rests, since the remaining share is an error of
// the map.
class ScaffoldedDomain final : public MapDomain {
 public:
  // stop: ends relaxations. Throws Error(Infeasible) as Scaffold does if the start overlaps itself.
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
  // Returns Metis where the scaffold waits. Elsewhere flips change the pattern at nearly every
  // step, and METIS would cost more than it saves.
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
  enum class Stage { Moving, AtRest, Held };  // Held: treated as moving although it rests

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
  double served_below_;    // a factor is kept if the decrease of a step is below this
  double ends_below_ = 0;  // the decrease that ends the run; must not come from a lack of room
  NewtonOptions relaxing_;
  FlipCounts flips_;
  double share_;  // lambda E_conf / E while the image moves
  Stage stage_ = Stage::Moving;
  int waited_ = 0;                // steps since the scaffold was last adapted
  std::optional<Problem> built_;  // the last problem
  std::optional<TermId> around_;  // E_conf in that problem
  std::optional<double> lambda_;  // none: not set since the problem was built
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
