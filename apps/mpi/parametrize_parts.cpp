#include "apps/mpi/parametrize_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

void require_possible(const ParametrizationOptions& o) {
  const auto refuse = [](const char* what) {
    throw Error(ErrorKind::Usage,
                fmt::format("{} need the whole surface in one process; run `majorant`", what));
  };
  if (o.map.injectivity == MapInjectivity::Global) refuse("maps without overlaps");
  if (o.map.boundary_angles != BoundaryAngles::Free) refuse("angles at the boundary");
  if (!o.map.aligned.empty()) refuse("aligned edges");
  if (o.solve.triangles == Triangles::Flipped) refuse("flipped triangles");
  if (o.extend) refuse("terms of one's own");
}

// Combines the data of the ranks to data of the whole map.
class PartSharing final : public RunSharing {
 public:
  PartSharing(std::shared_ptr<const MapPart> part, const CheckpointPolicy& keeping,
              const std::optional<RunState>& from)
      : part_(std::move(part)), keeping_(keeping), from_(from) {}

  std::shared_ptr<const MapPart> part() const override { return part_; }
  const RunState* from() const override { return from_ ? &*from_ : nullptr; }

  // Stops are decided by the record of rank 0 between steps: a step that stopped on one rank would
  // leave the others waiting.
  StopCheck stop_of(RunRecord& record) const override {
    record.agree([part = part_](int own) { return part->ranks().of_first(own); });
    return {};
  }

  void require_injective(const BezierMap& map, const RestShapes& rest, int depth) const override {
    const std::string obstacle = part_->obstacle(
        map, 2 * rest.measure, from_ ? std::max(depth, from_->solver.depth) : depth);
    if (obstacle.empty()) return;
    if (from_)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("the map of the checkpoint is not injective: {}", obstacle));
    throw Error(ErrorKind::Infeasible,
                fmt::format("the initial map is not injective: {}", obstacle));
  }

  double mean(const BezierMap& map, const RestShapes& rest,
              const EnergySum& energy) const override {
    const double area = rest.measure.sum();
    const double all = ranks().sum(area > 0 ? area * RunSharing::mean(map, rest, energy) : 0);
    return all / ranks().sum(area);
  }

  bool follows() const override { return keeping_.every > 0; }

  // All ranks have the same rows.
  void after_row(const CurrentState& state) override {
    ++iterations_;
    if (follows() && ++since_kept_ >= keeping_.every) keep(state());
  }
  void at_limit(const CurrentState& state) override {
    if (follows()) keep(state());
  }

  void account(ParametrizationResult& result) const override {
    sum_by_depth(result.injectivity_tests);
    result.constraint_residual = ranks().max(result.constraint_residual);
    result.handle_distance = ranks().max(result.handle_distance);
  }

  std::string measure(const BezierMap& map, const EnergySum& energy, const StopCheck&,
                      MapMeasures& measures) const override {
    std::string unproven;
    measures = part_->measure(map, energy, unproven);
    return unproven;
  }

 private:
  const Ranks& ranks() const { return part_->ranks(); }

  void keep(std::optional<RunState> state) {
    if (!state) return;
    since_kept_ = 0;
    state->iterations = iterations_;
    keeping_.keep(*state);
  }

  // Ranks may have bisected to different depths, so lists are padded.
  void sum_by_depth(std::vector<long>& counts) const {
    const double deepest = ranks().max(static_cast<double>(counts.size()));
    std::vector<double> sums(counts.begin(), counts.end());
    sums.resize(static_cast<std::size_t>(deepest), 0.0);
    ranks().sum(sums);
    counts.assign(sums.begin(), sums.end());
  }

  std::shared_ptr<const MapPart> part_;
  const CheckpointPolicy& keeping_;
  const std::optional<RunState>& from_;
  int iterations_ = 0, since_kept_ = 0;
};

}  // namespace

ParametrizationResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                                        const ParametrizationOptions& options, RunRecord& record,
                                        const CheckpointPolicy& keeping,
                                        const std::optional<RunState>& from) {
  require_possible(options);
  const BezierMap start = BezierMap::linear(part->mesh, uv);
  PartSharing sharing(std::move(part), keeping, from);
  return parametrize_shared(sharing, start, options, record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
