#include "majorant/parametrization/solve/internal/proven_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/parametrization/scaffold/improve_mesh.h"

namespace majorant {
namespace {

// Returns the vertices of the faces in an order that does not depend on numbers of faces and first
// corners.
std::vector<std::array<Index, 3>> triangles_of(const BezierMap& map) {
  const Cells& faces = map.mesh().faces();
  std::vector<std::array<Index, 3>> triangles;
  triangles.reserve(to_size(map.mesh().face_count()));
  for (Index f = 0; f < faces.rows(); ++f) {
    std::array<Index, 3>& corners =
        triangles.emplace_back(std::array{faces(f, 0), faces(f, 1), faces(f, 2)});
    std::sort(corners.begin(), corners.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Returns what is not proven of the map; empty: all is proven.
std::string take_measures(ParametrizationResult& result, const EnergySum& energy,
                          const RunSharing& sharing, RunRecord& record) {
  record.begin(Activity::Measuring);
  const double started = record.seconds();
  std::string unproven =
      sharing.measure(*result.map, energy, record.telling(record.stop()), result.measures);
  result.measure_seconds += record.seconds() - started;
  return unproven;
}

// Sets the status by the proof. unproven: what is not proven of the result; if empty, all is
// proven, and a solver that failed has stalled.
void judge(ParametrizationResult& result, const std::string& unproven) {
  if (!unproven.empty()) {
    result.status = Status::Failed;
    result.message = fmt::format("the result fails its own proof: {} (the solver ended with: {})",
                                 unproven, result.message);
  } else if (result.status == Status::Failed) {
    result.status = Status::Stalled;
  }
}

// Proves from the boundary of the returned map that it does not overlap, as the scaffold has
// ensured.
void prove_no_overlaps(ParametrizationResult& result, RunRecord& record) {
  record.begin(Activity::Proving);
  const double started = record.seconds();
  result.boundary = check_boundary(*result.map);
  const GlobalInjectivity& proof = *result.boundary;
  result.measure_seconds += record.seconds() - started;
  if (proof.result == ProofStatus::Violated)
    judge(result, "the image overlaps itself" + (proof.reason.empty() ? "" : ": " + proof.reason));
  if (proof.result != ProofStatus::Undecided || result.status != Status::Converged) return;
  result.status = Status::Stalled;
  result.message = "boundary curves touch to within rounding: " + proof.reason;
}

void flip_triangles(ParametrizationResult& result, const EnergySum& energy,
                    const RunSharing& sharing, RunRecord& record) {
  record.begin(Activity::Solving);
  const double started = record.seconds();
  ImprovedMap improved = improve_mesh(*result.map, energy, record.stop());
  result.optimize_seconds += record.seconds() - started;
  result.flips.intended += improved.flips.intended;
  result.flips.performed += improved.flips.performed;
  // Flipped edges may have been flipped back.
  result.other_triangles = triangles_of(improved.map) != triangles_of(*result.map);
  result.map = std::move(improved.map);
  take_measures(result, energy, sharing, record);
}

}  // namespace

void prove_result(ParametrizationResult& result, const ParametrizationOptions& options,
                  const RunSharing& sharing, RunRecord& record) {
  const EnergySum& energy = options.map.energy;
  judge(result, take_measures(result, energy, sharing, record));
  if (options.map.injectivity == MapInjectivity::Global && result.status != Status::Failed)
    prove_no_overlaps(result, record);
  if (options.solve.triangles == Triangles::Flipped && result.status != Status::Failed &&
      record.directive() == Directive::Continue)
    flip_triangles(result, energy, sharing, record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
