// The plan of a quad mesh before any work: counts, lengths, memory.
#include "majorant/quads/quad_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "expected_error.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// So many bytes are available, until the end of a test.
class MemoryPlan : public ::testing::Test {
 protected:
  static void leave(std::size_t bytes) {
    ASSERT_EQ(::setenv("MAJORANT_MEMORY_BYTES", std::to_string(bytes).c_str(), 1), 0);
  }
  void TearDown() override { ::unsetenv("MAJORANT_MEMORY_BYTES"); }

  const SurfaceMesh mesh_ = SurfaceMesh::from_polygons(grid(4, bumpy));
};

TEST_F(MemoryPlan, RefusesWithBothFigures) {
  leave(3'000'000'000);
  QuadMeshOptions options;
  options.count = 10'000'000;
  const auto refusal = [&] {
    RunRecord record;
    return error_message(ErrorKind::Unsupported, [&] { quad_mesh(mesh_, options, record); });
  };
  expect_contains(refusal(), {"10000000 quads need about 10.0 GB", "3.0 GB are available",
                              "ask for 3000000 at most"});
  options.count.reset();
  options.edge_length = std::sqrt(mesh_.area() / 1e7);
  expect_contains(refusal(), {"10000000 quads need about 10.0 GB"});
}

TEST_F(MemoryPlan, WhatFitsIsNotRefused) {
  leave(3'000'000'000);
  QuadMeshOptions options;
  options.count = 2'990'000;
  EXPECT_NO_THROW(require_memory_for_quads(mesh_, options));
  leave(kBytesOfQuad * 4);
  options.count = 4;
  EXPECT_NO_THROW(require_memory_for_quads(mesh_, options));
  options.count = 5;
  EXPECT_THROW(require_memory_for_quads(mesh_, options), Error);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
