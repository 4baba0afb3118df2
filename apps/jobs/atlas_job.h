// A job that makes a layout of charts, from the polygons of a mesh to its files and reports, as
// MapJob does for one map. Programs that only need the charts call unwrap().
//
//   RunRecord record;
//   AtlasJob job(record);
//   job.open(read_mesh(path), {});
//   job.solve();
//   job.prove();
//   const MapFile file = atlas_file(job);
//   const ProofRequest proof = proof_request(job, path);
//   write_map(path, file, job.polygons.get(), {}, proof_of_file(path, proof, file, {}));
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "majorant/apps/jobs/report.h"
#include "majorant/certify/map_proof.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant {

// The use of texture seams in the file: ignored, or also cut. CutMethod::Texture always follows
// them.
enum class OldSeams { Ignored, Cut };

// The state of the job. Fill it in this order: open(), `options`, solve(), place(), prove().
struct AtlasJob {
  // record: must outlive the job.
  explicit AtlasJob(RunRecord& of_run) : record(of_run) {}

  // Repairs the surface. Throws the errors of repair(), and stops at the limits of the run's start.
  void open(PolygonMesh input, const RepairOptions& repairs);
  // Returns the first repair that changes the surface in files; null if there is none. Edges joined
  // for the map alone (Welding::EqualPlaces) change nothing in files.
  const Repair* first_repair() const;
  void solve();
  // Moves the layout into the unit square. Returns false, and leaves the atlas unchanged, if the
  // result cannot be proven to lie in it.
  bool place();
  // Proves whether charts overlap in their current places. Single charts and packed charts are
  // proven already.
  void prove();

  RunRecord& record;
  std::string energy = {};             // as given; empty: an energy without a name
  Json options_json = Json::object();  // the given options, for reports and claims

  std::shared_ptr<PolygonMesh> polygons;  // as made by with_welded_vertices()
  RepairedSurface surface;
  UnwrapOptions options;
  OldSeams old_seams = OldSeams::Ignored;
  // The direction towards a distant viewer, from whom seams are hidden; none: from viewers on all
  // sides.
  std::optional<Vector3> hide_from;
  // Pixels of options.packing->resolution per unit of the surface, by polygon; may be empty. The
  // surface is cut where the density changes.
  std::vector<double> texel_density = {};

  Atlas atlas;
  std::optional<LayoutMotion> square;  // the motion of the maps into the unit square
  GlobalInjectivity boundary;          // set by prove()
  Vec visibility;                      // #V of the surface; set by solve()
  Json linear_solver, memory;          // sections of the report, or null
  double read_seconds = 0;
  double visibility_seconds = 0;  // part of the time of cutting; set by solve()

 private:
  void ask_for_density();
  bool is_joined_for_map_ = false;
};

// Returns the units of the surface per unit of uv in the file.
double scale_of(const AtlasJob& job);
// Returns the pixels per unit of the surface, as the root mean square over the faces with an area:
//     resolution / side * sqrt(area of the image / area of the surface)
// With requested densities, returns the density of charts that are as large as the surface; the
// actual one differs by the distortion of the charts. None if charts are not packed.
std::optional<double> texel_density(const AtlasJob& job);
// Returns the length of all cuts, including those of repair().
double seam_length(const AtlasJob& job);

// Returns the file of all charts with measures and claims. table (may be null) receives the
// distortion of every face, even if the file does not hold it: values that are not finite, or that
// a reader could not reproduce.
MapFile atlas_file(const AtlasJob& job, FaceDistortion* table = nullptr);
// Returns the properties that a data file must have when it is read back.
ProofRequest proof_request(const AtlasJob& job, const std::string& path);
// Returns the report, complete except for the seconds "write" and "total".
RunReport atlas_report(const AtlasJob& job);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
