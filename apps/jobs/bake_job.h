// A job that bakes what one surface carries into the layout of another, from files to the image and
// what reports say of it.
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

// A surface of a file, and its layout where it has one.
struct BakeSurface {
  std::string file;
  PolygonMesh polygons;  // of a mesh; empty of files that hold maps
  // That of the layout, where there is one. Its faces are triangles; input_face() is the number of
  // the file's polygon that a triangle is a part of.
  std::shared_ptr<const SurfaceMesh> mesh;
  Cells polygon_corner;  // #F by 3: which corner of its polygon each corner of a face is, from 0;
                         // no rows without polygons
  std::optional<BezierMap> layout;
  double scale = 1;  // of the layout, in surface units
  std::vector<std::string> warnings;
};

enum class Texcoords { Needed, Optional };
// Throws as read_mesh() and read_map(); Refusal(Unsupported) with Hint::Unwrap for a mesh without
// texture coordinates that are needed.
BakeSurface read_bake_surface(const std::string& path, Texcoords texcoords,
                              const StopCheck& stop = {},
                              Strictness strictness = Strictness::Texcoords);
// The same of polygons that are in memory; all have texture coordinates where they are needed.
BakeSurface bake_surface(PolygonMesh polygons, Texcoords texcoords, const StopCheck& stop = {});

enum class BakeMethod {
  Automatic,  // Same where that is possible
  Same,       // equal faces by their numbers
  Nearest     // nearest points
};
std::string_view method_name(BakeMethod method);

// color: of vertices, as the carrier's file has it.
inline constexpr std::array<std::string_view, 5> kBakeAttributes{"color", "position", "normal",
                                                                 "face", "distortion"};
// Returns whether vertices of the file have colours: of OBJ and PLY, COLOR_0 of glTF.
bool has_vertex_colors(const BakeSurface& surface);

// The members up to `options` are what is asked for.
struct BakeJob {
  BakeSurface target, carrier;
  // Of the carrier's layout, and which of them, by its polygons; empty: the only one. Or none:
  std::vector<Raster> images;
  std::vector<Wraps> wraps;  // by image; empty: all repeat
  std::vector<int> image_of_polygon;
  std::string attribute;                     // one of kBakeAttributes, or a .npy file of numbers
  Transfer image_transfer = Transfer::Srgb;  // of integer images, and colours of OBJ and PLY
  Filter filter = Filter::Bilinear;
  BakeMethod method = BakeMethod::Automatic;
  std::optional<double> distance;  // farthest points of Nearest; none: kFarthest of the diagonal
  BakeOptions options;

  // The part of the carrier's diagonal within which points are looked for.
  static constexpr double kFarthest = 0.02;

  // Throws Error(Unsupported) where the target's layout leaves [0, 1]^2, the carrier lacks what is
  // asked of it, or faces are not the same; Error(Unreadable) for a file of numbers of another
  // size; Stopped. Frees the images.
  void run(const StopCheck& stop = {});
  // True where every texel centre in a chart was written once: it lies there in one place, proven.
  bool is_proven() const;
  // True where charts cover texels and nothing was found for any of them.
  bool is_all_missed() const;
  // The share of covered texels with a value that show a place whose normal is opposed.
  double opposed() const;

  std::vector<std::string> channels;  // their names
  float background = 0;
  double farthest = 0;          // of Nearest
  Sense sense = Sense::Equal;   // of the carrier's faces, likewise
  std::optional<double> apart;  // where all is missed: the least distance of target and carrier
  std::optional<BakedImage> baked;
  TexelDensity density;
  // Of the search tree and the searches in it; of all else. Wall clock.
  double nearest_seconds = 0, bake_seconds = 0;
};

// The report of a job that has run, but for its options.
RunReport bake_report(const BakeJob& job);
// The image, atomically, and beside a .npy NAME.npy.json: which points of the layout it holds.
// Throws as encode_image() and write_file_atomically().
void write_baked(const std::string& path, const BakeJob& job);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
