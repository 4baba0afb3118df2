// Baking: what a surface carries, as an image in the layout of a map.
//
//   const InverseMap layout(map);
//   const SurfaceTree tree(mesh->positions(), mesh->faces());
//   const PlaceOf place_of = nearest_places(map.mesh(), tree, 0.1);
//   const BakedImage baked = bake(layout, {}, place_of, position_values(*mesh));
//   const bool is_proven = baked.counts.doubly_covered == 0 && baked.counts.undecided == 0;
//
// Every texel whose centre lies in a chart gets the value there. Others that a bilinear filter
// reads at a point of a chart get that of the surface as it goes on beyond the chart's border,
// across cuts, levelled so that the filter reads at borders what is there: the two sides of a cut
// look alike. Where a chart is so thin that it has no centre around, they get the value at the
// middle of what is covered, of the face that covers most of it; charts without any centre have
// texels so. What is around is filled from the nearest of these texels.
//
// Not for layouts outside of [0, 1]^2, of which nothing is seen: is_in_unit_square().
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
  bool is_opposed = false;  // its normal makes more than 90 degrees with that of the other surface
};

// The point of the surface that carries the values for a point of the one that is baked for; none:
// a miss. likely: the face of the last answer, or -1. From several threads at a time.
using PlaceOf = std::function<std::optional<CarrierPlace>(const SurfacePlace& of, Index likely)>;

// Finds the same polygons, of the same vertices, by their numbers in the file: by input_face() and
// input_vertex(), at equal positions within kTenDigits. A polygon that `carrier` has cut into other
// triangles gives the nearest point of these. None where a polygon of `surface` is not in
// `carrier`.
std::optional<PlaceOf> same_places(const SurfaceMesh& surface, const SurfaceMesh& carrier);
// The sense of the carrier's faces, compared with the surface there.
enum class Sense { Equal, Reversed };
// The sense that most of the surface has beside the carrier, no farther than `distance`; Equal
// where nothing is near. tree: over the input positions of the carrier.
Sense sense_of(const SurfaceMesh& surface, const SurfaceTree& tree, double distance);
// Points no farther than `distance` on the side of the carrier that the surface shows: where the
// line along the surface's normal, interpolated between its vertices, meets faces of the carrier
// whose normals agree with it (less than 90 degrees), in either direction; where that is more than
// twice as far as the nearest point of such faces, or nowhere, that point. Where no face agrees,
// the nearest point, which is opposed. tree and `surface` outlive the result.
PlaceOf nearest_places(const SurfaceMesh& surface, const SurfaceTree& tree, double distance,
                       Sense sense = Sense::Equal);

// How what a surface carries goes on across the edges of its faces.
enum class Course {
  Picture,     // as Continuous; texels in charts give way by some codes, for cuts not to be seen
  Continuous,  // it may be mixed: what lies beyond a chart's border is shown around it
  OfFaces      // numbers, normals of flat faces: the nearest of the chart's own are shown around it
};

// What a surface carries: `channels` numbers at every point, written to `value`.
struct SurfaceValues {
  int channels = 1;
  std::function<void(const SurfacePlace& place, float* value)> at;  // from several threads
  float background = 0;                                             // where nothing is known
  Course course = Course::Continuous;
  Transfer seen = Transfer::Linear;  // of a picture: in what differences are seen
};
// What these refer to outlives them.
SurfaceValues position_values(const SurfaceMesh& mesh);  // x y z of the file; NaN: nothing
SurfaceValues normal_values(const SurfaceMesh& mesh);    // of flat faces
// Unit normals of the corners, #F by 9, interpolated.
SurfaceValues normal_values(Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> corners);
SurfaceValues face_values(const SurfaceMesh& mesh);  // polygon of the file; -1: nothing
// A row a face; a vertex, or a corner of a face (3 #F), interpolated.
SurfaceValues table_of_faces(RowMatrix rows);
SurfaceValues table_of_vertices(const SurfaceMesh& mesh, RowMatrix rows);
SurfaceValues table_of_corners(RowMatrix rows);
// The texture of a surface. Colours are linear where the decoder says so.
SurfaceValues texture_values(const BezierMap& layout, const Raster& image, Transfer transfer,
                             Filter filter, const Wraps& wraps = {});
// Colours of the corners of faces, 3 #F rows of 3 or 4 numbers of linear light, interpolated.
SurfaceValues color_values(RowMatrix corners);

struct BakeOptions {
  int width = 1024, height = 1024;
  int padding = 16;  // texels around charts that are filled; 0: none beside what charts cover
  int samples = 1;   // along each side of a texel
  PixelDepth depth = PixelDepth::Eight;
  Transfer transfer = Transfer::Linear;  // of the image
};

struct BakeCounts {
  long texels = 0;          // of the image
  long covered = 0;         // with their centre in a chart
  long doubly_covered = 0;  // of these, in two places of the layout or more
  long undecided = 0;       // of these, rounding leaves open which
  long partly = 0;          // covered but for their centre
  long misses = 0;          // covered or partly so, where nothing is known
  long opposed = 0;         // covered or partly so, shown by a place that is opposed
  Index charts = 0, charts_without_texels = 0;
};

struct BakedImage {
  Raster image;
  BakeCounts counts;
};

// Returns whether all control points of the map lie in [0, 1]^2.
bool is_in_unit_square(const BezierMap& map);

// Polls `stop`: Stopped. On the threads of the caller, the same for any number of them.
BakedImage bake(const InverseMap& layout, const BakeOptions& options, const PlaceOf& place_of,
                const SurfaceValues& values, const StopCheck& stop = {});

// Texels along the side of a square of the surface as large as a unit: of faces with an area, by
// area.
struct TexelDensity {
  double min = 0, mean = 0, max = 0;
};
TexelDensity texel_density(const BezierMap& map, int width, int height);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
