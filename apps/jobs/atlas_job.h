// A job that makes a layout of charts, from the polygons of a mesh to what files and reports say of
// the result: what MapJob is for one map. Programs that only want the charts call unwrap().
//
//   RunRecord record;
//   AtlasJob job(record);
//   job.open(read_mesh(path), {});
//   job.solve();
//   job.prove();
//   const MapFile file = atlas_file(job);
//   const ProofRequest proof = promise(job, path);
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

// What becomes of the texture seams that a file has: nothing but where CutMethod::Texture follows
// them, or they are cuts, too.
enum class OldSeams { Ignored, Cut };

// Filled in this order: open(), `options`, solve(), place(), prove().
struct AtlasJob {
  // record: outlives the job.
  explicit AtlasJob(RunRecord& of_run) : record(of_run) {}

  // Repairs the surface. Throws as repair(), at the limits of the run's start.
  void open(PolygonMesh input, const RepairOptions& how);
  // The first repair that changes the surface as files have it; null where there is none. Edges
  // that are joined for the map alone (Welding::EqualPlaces) change none.
  const Repair* first_repair() const;
  void solve();
  // Into the unit square. False where it cannot be proven in there; the atlas is as it was then.
  bool place();
  // Proves whether charts overlap, as they lie now; each for itself does not, and packed ones do
  // not.
  void prove();

  RunRecord& record;
  std::string energy = {};             // as said; empty: one without a name
  Json options_json = Json::object();  // the options as given, for reports and claims

  std::shared_ptr<PolygonMesh> polygons;  // as with_welded_vertices() has them
  RepairedSurface surface;
  UnwrapOptions options;
  OldSeams old_seams = OldSeams::Ignored;
  // The direction of who looks from far away: seams keep out of sight of it; none: of all sides.
  std::optional<Vector3> hide_from;
  // By polygon, or empty: pixels of options.packing->resolution along a unit of the surface. Where
  // it changes, the surface is cut.
  std::vector<double> texel_density = {};

  Atlas atlas;
  std::optional<LayoutMotion> square;  // what the maps were moved into
  GlobalInjectivity boundary;          // prove()
  Vec visibility;                      // #V of the surface, of solve()
  Json linear_solver, memory;          // sections of the report, or null
  double read_seconds = 0;
  double visibility_seconds = 0;  // of solve(): a part of cutting

 private:
  void ask_for_density();
  bool is_joined_for_map_ = false;
};

// Units of the surface per unit of uv in the file.
double scale_of(const AtlasJob& job);
// Pixels along a unit of the surface, in the mean of squares over the faces that have an area:
//     resolution / side * sqrt(area of the image / area of the surface)
// Where a density is asked for, that with charts as large as the surface: this one differs by what
// their distortion leaves. None where charts are not packed.
std::optional<double> texel_density(const AtlasJob& job);
// The length of all cuts, those of repair() included.
double seam_length(const AtlasJob& job);

// All charts side by side: with what was measured, and with its claims. table (may be null)
// receives the distortion of every face, also where it is no part of the file: where it is not
// finite, and where who reads the file could not measure the same.
MapFile atlas_file(const AtlasJob& job, FaceDistortion* table = nullptr);
// The properties that a data file must have when it is read back.
ProofRequest promise(const AtlasJob& job, const std::string& path);
// Whole but for what writing adds to it: the seconds "write" and "total".
RunReport atlas_report(const AtlasJob& job);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
