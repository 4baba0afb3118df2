#include "distributed/parametrize_parts.h"

#include <fmt/format.h>

#include <utility>

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

}  // namespace

ParametrizationResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                                        const ParametrizationOptions& options, RunRecord& record,
                                        const Keeping& keeping,
                                        const std::optional<RunState>& from) {
  require_possible(options);
  const BezierMap start = BezierMap::linear(part->mesh, uv);
  return parametrize_part(std::move(part), start, options, record, keeping, from);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
