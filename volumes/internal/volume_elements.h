// The elements of a mesh against their target shapes: the mean of an energy over them, and the
// proof that they are valid, as functions of the control points.
//
//     const VolumeElements elements(net, target_shapes(mesh, net, options), record);
//     const auto weights = elements.equal_weights();
//     const Problem problem =
//         elements.problem(options.energy, weights, &held, elements.checkers(ProofDepth::kStart));
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"
#include "majorant/volumes/internal/held_points.h"

namespace majorant {

class VolumeElements {
 public:
  // targets: by part of the net. The net and the record, whose stop() ends proofs, must outlive
  // this object.
  VolumeElements(const ControlNet& net, std::vector<RestShapes> targets, const RunRecord& record);

  const ControlNet& net() const { return net_; }

  // Returns weights of 1 for the elements of each part.
  std::vector<Vec> equal_weights() const;
  // Adds the weighted mean of an energy to a problem on the control points. Returns its terms.
  std::vector<TermId> add_mean(ProblemBuilder& builder, const WeightedEnergy& energy,
                               const std::vector<Vec>& weights) const;
  // Returns a builder for a problem on the control points.
  ProblemBuilder builder() const;

  using Checkers = std::vector<std::shared_ptr<const LocalInjectivity>>;
  // Returns a checker for each part. depth: of its proofs.
  Checkers checkers(int depth) const;
  // Returns the smallest depth of proofs that show all elements to be valid at x; none if not even
  // the deepest do.
  std::optional<int> proven_depth(VecIn x) const;

  // Returns the problem of the weighted mean of a sum of energies. held: the fixed part, or null.
  Problem problem(const EnergySum& energy, const std::vector<Vec>& weights, const HeldPoints* held,
                  const Checkers& checkers) const;
  // Returns the weighted mean at control points, which may violate the constraints.
  double mean(const EnergySum& energy, const std::vector<Vec>& weights, VecIn x) const;

 private:
  const ControlNet& net_;
  std::vector<RestShapes> targets_;
  const RunRecord& record_;
  double measure_ = 0;  // of all targets
};

// Returns the verdict of several checkers together.
Verdict check_all(const VolumeElements::Checkers& checkers, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
