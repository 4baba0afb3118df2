// Baking: values on a surface as an image in the layout of a map.
//
//   const InverseMap layout(map);
//   const SurfaceTree tree(mesh->positions(), mesh->faces());
//   const Correspondence place_of = nearest_places(map.mesh(), tree, 0.1);
//   const BakedImage baked = bake(layout, {}, place_of, position_values(*mesh));
//   const bool is_proven = baked.counts.doubly_covered == 0 && baked.counts.undecided == 0;
//
// A texel whose centre lies in a chart gets the value there. Other texels that a bilinear filter
// reads at points of a chart show the surface as it continues beyond the chart's border, across
// cuts. Their values are adjusted so that the filter reads the surface's values at borders, and the
// two sides of a cut look alike. If a chart is so thin that no centre is near, a texel shows the
// middle of its covered part, on the face that covers most of it; so charts without any centre have
// texels, too. The rest is filled from the nearest of these texels.
//
// Not for layouts outside of [0, 1]^2, which the image cannot show: see is_in_unit_square().
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "majorant/certify/inverse_map.h"
#include "majorant/mesh/nearest_point.h"
#include "majorant/pictures/baking/chart_continuation.h"
#include "majorant/pictures/images/raster.h"

namespace majorant {

// A point of the surface that carries the values.
struct CarrierPlace : SurfacePlace {
  bool is_opposed = false;  // its normal is more than 90 degrees from that of the other surface
};

// Returns the point of the carrier that corresponds to a point of the target surface; none: a miss.
// likely: the face of the last answer, or -1. Called by several threads at a time.
using Correspondence =
    std::function<std::optional<CarrierPlace>(const SurfacePlace& of, Index likely)>;

// Finds equal polygons by their numbers in the file: by input_face() and input_vertex(), at
// positions equal to within kTenDigits. If `carrier` has triangulated a polygon differently, the
// point is the nearest one of its triangles. None if a polygon of `surface` is missing in
// `carrier`.
std::optional<Correspondence> same_places(const SurfaceMesh& surface, const SurfaceMesh& carrier);
// The orientation of the carrier's faces relative to the surface.
enum class Sense { Equal, Reversed };
// Returns the orientation for most of the surface, compared with the carrier within `distance`;
// Equal if nothing is near. tree: over the input positions of the carrier.
Sense sense_of(const SurfaceMesh& surface, const SurfaceTree& tree, double distance);
// Finds points within `distance` on the side of the carrier that the surface shows. The line along
// the surface's normal, interpolated between vertices, is intersected in both directions with faces
// of the carrier whose normals agree with it (less than 90 degrees). If there is no intersection,
// or it is more than twice as far as the nearest point of such faces, the nearest point is taken.
// If no face agrees, the nearest point of all is taken, which is opposed. tree and `surface` must
// outlive the result.
Correspondence nearest_places(const SurfaceMesh& surface, const SurfaceTree& tree, double distance,
                              Sense sense = Sense::Equal);

// The continuation of a surface's values across the edges of its faces.
enum class Continuation {
  Picture,     // as Continuous; texels in charts may change by some codes to hide cuts
  Continuous,  // continued values are mixed and shown around charts
  OfFaces      // numbers and normals of flat faces: the chart's nearest value is shown around it
};

// The values of a surface: `channels` numbers at every point, written to `value`.
struct SurfaceValues {
  int channels = 1;
  std::function<void(const SurfacePlace& place, float* value)> at;  // called by several threads
  float background = 0;                                             // for unknown values
  Continuation course = Continuation::Continuous;
  Transfer seen = Transfer::Linear;  // for pictures: the encoding in which differences are visible
};
// The arguments of these must outlive the results.
SurfaceValues position_values(const SurfaceMesh& mesh);  // x y z of the file; NaN: nothing
SurfaceValues normal_values(const SurfaceMesh& mesh);    // of flat faces
// Returns unit normals interpolated from those of the corners, #F by 9.
SurfaceValues normal_values(Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> corners);
SurfaceValues face_values(const SurfaceMesh& mesh);  // polygon of the file; -1: nothing
// These return rows of a table by face, or interpolated by vertex or by corner of a face (3 #F).
SurfaceValues table_of_faces(RowMatrix rows);
SurfaceValues table_of_vertices(const SurfaceMesh& mesh, RowMatrix rows);
SurfaceValues table_of_corners(RowMatrix rows);
// Returns the texture of a surface. Colours are linear if the decoder makes them so.
SurfaceValues texture_values(const BezierMap& layout, const Raster& image, Transfer transfer,
                             Filter filter, const Wraps& wraps = {});
// Returns interpolated colours of the corners of faces, 3 #F rows of 3 or 4 numbers in linear
// light.
SurfaceValues color_values(RowMatrix corners);

struct BakeOptions {
  int width = 1024, height = 1024;
  int padding = 16;  // width of the filled band around charts in texels; 0: only what charts cover
  int samples = 1;   // along each side of a texel
  PixelDepth depth = PixelDepth::Eight;
  Transfer transfer = Transfer::Linear;  // of the image
};

struct BakeCounts {
  long texels = 0;          // of the image
  long covered = 0;         // with their centre in a chart
  long doubly_covered = 0;  // of these, in several places of the layout
  long undecided = 0;       // of these, not decided because of rounding
  long partly = 0;          // partly covered, without their centre
  long misses = 0;          // covered or partly so, without a known value
  long opposed = 0;         // covered or partly so, with an opposed value
  Index charts = 0, charts_without_texels = 0;
};

struct BakedImage {
  Raster image;
  BakeCounts counts;
};

// Returns whether all control points of the map lie in [0, 1]^2.
bool is_in_unit_square(const BezierMap& map);

// Bakes on the threads of the caller; the result does not depend on their number. Polls `stop`:
// Stopped.
BakedImage bake(const InverseMap& layout, const BakeOptions& options,
                const Correspondence& place_of, const SurfaceValues& values,
                const StopCheck& stop = {});

// Texels along the side of a surface square of unit size: statistics over faces with an area, by
// area.
struct TexelDensity {
  double min = 0, mean = 0, max = 0;
};
TexelDensity texel_density(const BezierMap& map, int width, int height);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
