// A job that makes one map, from the polygons of a mesh to what files and reports say of the
// result. The command, the Python package and majorant-mpi run theirs through it; their words, and
// telling people, are their own affair. Programs that only want a map call parametrize().
//
//   RunRecord record;
//   MapJob job(MapTask::Parametrize, record);
//   job.open(std::make_shared<const PolygonMesh>(read_mesh(path)));
//   job.solve();
//   job.prove();
//   const MapFile file = map_file(job);
//   const ProofRequest proof = promise(job, path);
//   write_map(path, file, job.polygons.get(), {}, proof_of_file(path, proof, file, {}));
//   const Json report = to_json(map_report(job));
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "majorant/apps/jobs/report.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/map_proof.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// The task of a job: a map of a surface; one with seams, from a start that is made; a plane mesh
// moved by its handles.
enum class MapTask { Parametrize, Seamless, Deform };
// "parametrize", "seamless", "deform"
std::string_view task_name(MapTask task);

// The method of this method_name(); Automatic where no method has it.
SeamlessMethod method_called(std::string_view name);

// Held: the result stays as it is. Free: it may be turned where that is possible. Required: it has
// to be turned.
enum class Turned { Held, Free, Required };

// The size of a result: that of the surface, or that of the unit square.
enum class LayoutSize { Model, UnitSquare };

// Filled in this order: open(), a start where there is one, `options`, solve(), place(), prove().
// solve() is optional: majorant-mpi solves on several processes what it has opened on one.
struct MapJob {
  // record: outlives the job.
  MapJob(MapTask kind, RunRecord& of_run) : task(kind), record(of_run) {}
  MapJob(const MapJob&) = delete;  // films are told of by address
  MapJob& operator=(const MapJob&) = delete;

  // The surface of the polygons; to be deformed, a mesh of the plane that is all clockwise is
  // turned (mesh/plane_side.h), and `polygons` says so. Throws as SurfaceMesh::from_polygons(), at
  // the limits of the run's start.
  void open(std::shared_ptr<const PolygonMesh> input);
  // These set the start of the map, in place of a map of the surface as it is: the seams of its
  // texture coordinates; a seamless map that is made, its cones by vertex of the input (source: who
  // names them, for messages); the plane mesh itself; Tutte's map of the surface cut open, one
  // piece or Error(Unsupported) - pieces: what to say of several. Throw as seamless_from_texture(),
  // make_seamless(), planar_map(), choose_cuts() and initial_map().
  void start_from_texture();
  void start_seamless(SeamlessOptions how, const std::string& source);
  void start_in_plane();
  void start_cut(const CutOptions& how, const std::function<std::string(Index pieces)>& refusal);
  // The surface that is mapped, cut open where the start is: vertices of `options` are its own.
  // Throws Error(Unsupported) where there is no start and the surface is no disk, with or without
  // holes.
  const SurfaceMesh& mapped_mesh() const;

  // Keeps the map after every so many iterations.
  void take_snapshots(int every);
  void solve();
  // Moves the result: turned along its longer side, or into the unit square, and proven anew. Where
  // it cannot be proven in there, the status is Failed, the message says so, and it returns false.
  bool place(Turned turn, LayoutSize size);
  // Proves that the map is injective as a whole, as it is now: after everything that moves it.
  // Takes milliseconds, a second or so where curves run along each other; limits do not end it.
  void prove();
  // True where there is a map to write: the run did not fail, and was feasible.
  bool has_result() const;

  MapTask task;
  RunRecord& record;
  std::string energy = {};             // as said; empty: one without a name
  std::string init = "auto";           // likewise, or what the start was made from
  Json options_json = Json::object();  // the options as given, for reports and claims

  std::shared_ptr<const PolygonMesh> polygons;
  std::shared_ptr<const SurfaceMesh> mesh;  // of these, not cut
  ParametrizationOptions options;
  std::optional<Start> start;
  std::optional<SurfaceCuts> cuts;  // of a surface cut open
  std::optional<Film> film;

  ParametrizationResult result;
  std::optional<LayoutMotion> placement;           // how result.map was moved
  bool is_aligned = false, is_normalized = false;  // of that, what was asked for
  bool is_left_unturned = false;  // although it was free to be turned: that rounds cells away
  GlobalInjectivity boundary;     // prove()
  Json linear_solver, memory;     // sections of the report, or null
  double read_seconds = 0, start_seconds = 0;
};

// Units of the surface per unit of uv in the file.
double scale_of(const MapJob& job);
// The file of a job that has a result: with its measures and claims.
MapFile map_file(const MapJob& job);
// The properties that a data file of that name must have when it is read back.
ProofRequest promise(const MapJob& job, const std::string& path);
// Whole but for what writing adds to it: the seconds "write" and "total".
RunReport map_report(const MapJob& job);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
