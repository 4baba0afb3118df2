// A job that makes one map, from the polygons of a mesh to its files and reports. The command, the
// Python package and majorant-mpi use it; options and messages are theirs. Programs that only need
// a map call parametrize().
//
//   RunRecord record;
//   MapJob job(MapTask::Parametrize, record);
//   job.open(std::make_shared<const PolygonMesh>(read_mesh(path)));
//   job.solve();
//   job.prove();
//   const MapFile file = map_file(job);
//   const ProofRequest proof = proof_request(job, path);
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

// The task of a job: a map of a surface; a seamless map from a start that is made; a planar mesh
// moved by its handles.
enum class MapTask { Parametrize, Seamless, Deform };
// Returns "parametrize", "seamless" or "deform".
std::string_view task_name(MapTask task);

// Returns the method with this method_name(); Automatic if there is none.
SeamlessMethod method_called(std::string_view name);

// Says if the layout may be turned. Held: never. Free: if that is possible. Required: always.
enum class Turned { Held, Free, Required };

// The size of a result: the size of the surface, or the unit square.
enum class LayoutSize { Model, UnitSquare };

// The state of the job. Fill it in this order: open(), a start if needed, `options`, solve(),
// place(), prove(). majorant-mpi replaces solve() by a solve on several processes.
struct MapJob {
  // record: must outlive the job.
  MapJob(MapTask kind, RunRecord& of_run) : task(kind), record(of_run) {}
  MapJob(const MapJob&) = delete;  // snapshots are reported by address
  MapJob& operator=(const MapJob&) = delete;

  // Makes the surface of the polygons. For deform, a planar mesh that is clockwise everywhere is
  // turned over (mesh/plane_side.h), and `polygons` is changed likewise. Throws the errors of
  // SurfaceMesh::from_polygons(), and stops at the limits of the run's start.
  void open(std::shared_ptr<const PolygonMesh> input);
  // These set another start than a map of the uncut surface: the texture coordinates with their
  // seams; a seamless map with given cones by vertex of the input (source: their origin, for
  // messages); the planar mesh itself; Tutte's map of the surface after a cut, which must leave one
  // piece (pieces: the message otherwise, an Error(Unsupported)). They throw the errors of
  // seamless_from_texture(), make_seamless(), planar_map(), choose_cuts() and initial_map().
  void start_from_texture();
  void start_seamless(SeamlessOptions settings, const std::string& source);
  void start_in_plane();
  void start_cut(const CutOptions& settings,
                 const std::function<std::string(Index pieces)>& refusal);
  // Returns the mapped surface, cut open if the start is; `options` refer to its vertices. Throws
  // Error(Unsupported) without a start if the surface is no disk, with or without holes.
  const SurfaceMesh& mapped_mesh() const;

  // Keeps the map every `every` iterations.
  void take_snapshots(int every);
  void solve();
  // Moves the result, horizontally along its longer side or into the unit square, and proves it
  // again. If the proof fails, sets the status Failed with a message and returns false.
  bool place(Turned turn, LayoutSize size);
  // Proves that the final map is globally injective. Call it after everything that moves the map.
  // Takes milliseconds, about a second if curves run along each other; limits do not stop it.
  void prove();
  // Returns whether there is a map to write: the run did not fail and was feasible.
  bool has_result() const;

  MapTask task;
  RunRecord& record;
  std::string energy = {};             // as given; empty: an energy without a name
  std::string init = "auto";           // as given, or the method of the start
  Json options_json = Json::object();  // the given options, for reports and claims

  std::shared_ptr<const PolygonMesh> polygons;
  std::shared_ptr<const SurfaceMesh> mesh;  // the uncut surface of the polygons
  ParametrizationOptions options;
  std::optional<Start> start;
  std::optional<SurfaceCuts> cuts;  // of a surface that was cut open
  std::optional<Film> film;

  ParametrizationResult result;
  std::optional<LayoutMotion> placement;           // the motion of result.map
  bool is_aligned = false, is_normalized = false;  // the requested parts of that motion
  bool is_left_unturned = false;  // not turned, because cells would round to nothing
  GlobalInjectivity boundary;     // set by prove()
  Json linear_solver, memory;     // sections of the report, or null
  double read_seconds = 0, start_seconds = 0;
};

// Returns the units of the surface per unit of uv in the file.
double scale_of(const MapJob& job);
// Returns the file of a job with a result, with measures and claims.
MapFile map_file(const MapJob& job);
// Returns the properties that a data file of that name must have when it is read back.
ProofRequest proof_request(const MapJob& job, const std::string& path);
// Returns the report, complete except for the seconds "write" and "total".
RunReport map_report(const MapJob& job);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
