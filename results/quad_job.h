// A job that makes quads of a surface, from the polygons of a mesh to files and reports: what
// MapJob is for maps. Programs that only want the quads of a sound surface call quad_mesh().
//
//   QuadJob job(record);
//   job.open(read_mesh(path));
//   job.options.count = 4000;
//   job.solve();
//   write_quads("quads.obj", job.quads, *job.surface.mesh);
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "majorant/mesh/repair.h"
#include "majorant/quads/quad_mesh.h"
#include "majorant/results/report.h"

namespace majorant {

// Filled in this order: open(), `options`, solve().
struct QuadJob {
  // record: outlives the job.
  explicit QuadJob(RunRecord& of_run) : record(of_run) {}

  // Repairs the surface as unwrap() does, edges at equal places joined. Throws as repair(), at the
  // limits of the run's start.
  void open(PolygonMesh input);
  // Every component by itself, with its share of the count by area. cones of the options: vertices
  // of the input; source: who names them, for messages. Throws as quad_mesh().
  void solve(const std::string& source = {});

  RunRecord& record;
  QuadMeshOptions options;
  Json asked = Json::object();  // as said, for reports

  PolygonMesh polygons;
  RepairedSurface surface;
  PolygonMesh quads;  // of all components
  QuadCheck check;
  long asked_count = 0;
  std::optional<long> least_count;  // as QuadMesh has it, of all components together
  Index patches = 0;
  std::vector<std::string> warnings;  // a count that is not close to the one asked for
  Status status = Status::Converged;  // of the maps: a limit may have ended their optimization
  double read_seconds = 0, solve_seconds = 0;
};

// Whole but for what writing adds to it: "outputs", their seconds and the total.
Json quad_report(const QuadJob& job);

// The extensions that write_quads() knows.
std::vector<std::string> quad_extensions();
// .obj (v and f alone) or .ply (binary, doubles). The bytes are read back and judged by
// check_quads() with the surface before the file takes its name: throws Error(Invalid) with what is
// wrong; Error(Usage) where it cannot be written.
void write_quads(const std::string& path, const PolygonMesh& quads, const SurfaceMesh& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
