// Uses the library as an installed package: reads a mesh, prints an energy.
#include <cstdio>
#include <memory>

#include "majorant/majorant.h"

int main(int argc, char** argv) try {
  if (argc != 2) return 1;
  const auto mesh = std::make_shared<const majorant::SurfaceMesh>(
      majorant::SurfaceMesh::from_polygons(majorant::read_mesh(argv[1])));
  majorant::ParametrizationOptions options;
  options.map.degree = 3;
  // memory that the library allocated is freed here
  options.map.initial = majorant::tutte_map(*mesh);
  const majorant::ParametrizationResult result = majorant::parametrize(mesh, options);
  std::printf("%.17g\n", result.measures.value);
  return result.status == majorant::Status::Converged ? 0 : 4;
} catch (const majorant::Error& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 3;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
