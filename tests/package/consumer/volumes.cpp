// Uses volume meshes of an installed package: reads a mesh, makes its elements valid, and writes
// the command's report.
#include "majorant/volumes/volumes.h"

#include <cstdio>

#include "majorant/io/volume_files.h"

int main(int argc, char** argv) try {
  if (argc != 2) return 1;
  const majorant::VolumeMesh mesh = majorant::read_volume_mesh(argv[1]);
  majorant::RunRecord record;
  const majorant::VolumeResult result = majorant::optimize_volume_mesh(mesh, {}, record);
  std::printf("%d %.17g\n", result.before.invalid(), result.after.least_scaled_jacobian());
  return result.is_valid() ? 0 : 5;
} catch (const majorant::Error& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 3;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
