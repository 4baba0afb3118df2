// Layouts whose coordinates are floats.
#include "majorant/apps/jobs/float_layout.h"

#include <gtest/gtest.h>

#include "majorant/apps/jobs/atlas_job.h"
#include "mesh/surfaces_of_any_genus.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

TEST(FloatLayout, IsProvenOfFloats) {
  RunRecord record;
  AtlasJob job(record);
  job.open(grid(6, bumpy), {});
  job.solve();
  ASSERT_TRUE(job.place());
  job.prove();
  const ProofRequest request = proof_request(job, "map.vtu");
  const FloatLayout layout = float_layout(atlas_file(job), *job.polygons, request);
  EXPECT_EQ(layout.defect, "");
  EXPECT_EQ(layout.map.uv, (layout.map.uv.cast<float>().cast<double>()));
  // The proof finds a cell that is turned over.
  MapFile broken = layout.map;
  const Eigen::RowVector2d first = broken.uv.row(broken.cells(0, 0));
  broken.uv.row(broken.cells(0, 0)) = broken.uv.row(broken.cells(0, 1));
  broken.uv.row(broken.cells(0, 1)) = first;
  EXPECT_NE(float_layout(broken, *job.polygons, request).defect, "");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
