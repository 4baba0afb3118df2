// Chart sets with given maps, for tests: no map is solved for.
#pragma once

#include <memory>
#include <set>

#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/internal/chart_maps.h"
#include "majorant/parametrization/atlas/internal/chart_set.h"
#include "mesh/test_meshes.h"

namespace majorant::test {

// A run; it owns its surface, options and record.
struct HandMadeRun {
  explicit HandMadeRun(const PolygonMesh& mesh, const UnwrapOptions& unwrap_options = {},
                       const StopCheck& stop = {})
      : surface(repair(mesh).mesh), options(unwrap_options), record(stop) {}

  // Returns the uncut components; their maps take the surface to the given points.
  ChartSet mapped(const std::function<Vector2(const Vector3&)>& map) {
    ChartSet set = charts_along(choose_cuts(*surface, {.method = CutMethod::Given}), run);
    for (ChartPiece& piece : set.pieces) {
      piece.chart.faces = piece.faces;
      piece.chart.status = Status::Converged;
      piece.chart.pins = piece.options.map.pins;
      set_map(piece, BezierMap::linear(piece.mesh, uv_of(*piece.mesh, map)), run);
    }
    return set;
  }
  // Returns maps that are projections along z.
  ChartSet projected() {
    return mapped([](const Vector3& p) -> Vector2 { return p.head<2>(); });
  }

  std::shared_ptr<const SurfaceMesh> surface;
  UnwrapOptions options;
  RunRecord record;
  UnwrapRun run = UnwrapRun(*surface, options, record);
};

// Expects every face in exactly one chart, and charts in the order of their first faces.
inline void expect_whole(const ChartSet& set, const SurfaceMesh& surface) {
  std::multiset<Index> faces;
  Index last = -1;
  for (const ChartPiece& piece : set.pieces) {
    ASSERT_TRUE(piece.chart.map);
    EXPECT_EQ(piece.chart.faces, piece.faces);
    EXPECT_EQ(piece.chart.map->mesh().face_count(), piece.mesh->face_count());
    EXPECT_GT(piece.faces.front(), last);
    last = piece.faces.front();
    faces.insert(piece.faces.begin(), piece.faces.end());
  }
  EXPECT_EQ(faces.size(), to_size(surface.face_count()));
  EXPECT_EQ(std::set<Index>(faces.begin(), faces.end()).size(), faces.size());
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
