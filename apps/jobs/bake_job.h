// A job that bakes data of one surface into the layout of another, from files to the image and its
// report.
//
//   BakeJob job;
//   job.target = read_bake_surface("low.obj", Texcoords::Needed);
//   job.carrier = read_bake_surface("scan.obj", Texcoords::Optional);
//   job.attribute = "position";
//   job.run();
//   if (job.is_proven()) write_baked("low.npy", job);
//   const Json report = to_json(bake_report(job));
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "majorant/apps/jobs/report.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/pictures/baking/bake.h"

namespace majorant {

// A surface from a file, with its layout if it has one.
struct BakeSurface {
  std::string file;
  PolygonMesh polygons;  // for meshes; empty for files that hold maps
  // The surface of the layout if there is one. Its faces are triangles; input_face() is the polygon
  // that contains the triangle.
  std::shared_ptr<const SurfaceMesh> mesh;
  Cells polygon_corner;  // #F by 3: polygon corner of each face corner, from 0; no rows without
                         // polygons
  std::optional<BezierMap> layout;
  double scale = 1;  // surface units per uv unit of the layout
  std::vector<std::string> warnings;
};

enum class Texcoords { Needed, Optional };
// Throws the errors of read_mesh() and read_map(); Refusal(Unsupported) with Hint::Unwrap for a
// mesh that lacks required texture coordinates.
BakeSurface read_bake_surface(const std::string& path, Texcoords texcoords,
                              const StopCheck& stop = {},
                              Strictness strictness = Strictness::Texcoords);
// Returns the same for polygons in memory. They must have all texture coordinates if these are
// required.
BakeSurface bake_surface(PolygonMesh polygons, Texcoords texcoords, const StopCheck& stop = {});

enum class BakeMethod {
  Automatic,  // equal faces if possible, else nearest points
  Same,       // equal faces, by number
  Nearest     // nearest points
};
std::string_view method_name(BakeMethod method);

// color: the colours of vertices in the carrier's file.
inline constexpr std::array<std::string_view, 5> kBakeAttributes{"color", "position", "normal",
                                                                 "face", "distortion"};
// Returns whether vertices of the file have colours: OBJ, PLY, and COLOR_0 of glTF.
bool has_vertex_colors(const BakeSurface& surface);

// The state of the job. The members up to `options` are its input.
struct BakeJob {
  BakeSurface target, carrier;
  // Images in the carrier's layout, and the image of each polygon (empty: the only image). Without
  // images:
  std::vector<Raster> images;
  std::vector<Wraps> wraps;  // by image; empty: all repeat
  std::vector<int> image_of_polygon;
  std::string attribute;                     // one of kBakeAttributes, or a .npy file of numbers
  Transfer image_transfer = Transfer::Srgb;  // for integer images, and for colours of OBJ and PLY
  Filter filter = Filter::Bilinear;
  BakeMethod method = BakeMethod::Automatic;
  std::optional<double> distance;  // limit for Nearest; none: kFarthest times the diagonal
  BakeOptions options;

  // Nearest points are searched within this part of the carrier's diagonal.
  static constexpr double kFarthest = 0.02;

  // Bakes, and frees the images. Throws Error(Unsupported) if the target's layout leaves [0, 1]^2,
  // if the carrier lacks the data, or if faces differ; Error(Unreadable) for a file of numbers of
  // another size; Stopped.
  void run(const StopCheck& stop = {});
  // Returns whether it is proven that every texel centre in a chart lies in one place only.
  bool is_proven() const;
  // Returns whether charts cover texels but no value was found for any of them.
  bool is_all_missed() const;
  // Returns the share of covered texels with a value whose normal is opposed to the surface that
  // they show.
  double opposed() const;

  std::vector<std::string> channels;  // names of the channels
  float background = 0;
  double farthest = 0;          // largest distance of a nearest point
  Sense sense = Sense::Equal;   // orientation of the carrier's faces relative to the target
  std::optional<double> apart;  // if all texels miss: least distance between target and carrier
  std::optional<BakedImage> baked;
  TexelDensity density;
  // Wall-clock seconds of building and searching the tree, and of the rest.
  double nearest_seconds = 0, bake_seconds = 0;
};

// Returns the report of a finished job, without its options.
RunReport bake_report(const BakeJob& job);
// Writes the image atomically, and NAME.npy.json beside a .npy, which says what points of the
// layout it holds. Throws the errors of encode_image() and write_file_atomically().
void write_baked(const std::string& path, const BakeJob& job);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
