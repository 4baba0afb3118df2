// Chooses cuts of a surface so that every piece can be mapped onto the plane: as short as possible,
// where they help most.
//
//   SurfaceCuts cuts = choose_cuts(*mesh, {});
//   SurfaceMesh charts = mesh->cut_along(cuts.is_cut, nullptr);   // disks, some with holes
//
// Not for seamless maps, whose cuts go through all cones.
//
// The rule of CutMethod::Automatic is told in docs/atlas.md, "Where to cut".
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/congruent_surfaces.h"

namespace majorant {

enum class CutMethod {
  Automatic,  // where distortion is saved; one piece per component
  Texture,    // along the islands of the file's texture coordinates; as Automatic in components
              // that these do not cut, though they are closed, and in faces without any
  Sharp,      // along edges with a dihedral angle above sharp_angle that enclose pieces,
              // then as Automatic in each of them
  Given,      // along CutOptions::edges and nothing else
};

// Returns whether the rule chooses cuts by what they cost, so that more of them may be made.
inline bool chooses_cuts(CutMethod method) {
  return method == CutMethod::Automatic || method == CutMethod::Sharp;
}

// What else cuts cost, edge by edge: 3 #F, both sides the same, or empty.
struct CutPreferences {
  // Flags of creases, whatever their angle, as normals, smoothing groups and materials of a file
  // have them. A cut along a crease costs a quarter of its length.
  std::vector<char> creases = {};
  std::vector<double> weight = {};  // factors > 0 of all costs: where seams are not wanted
};

struct CutOptions {
  CutMethod method = CutMethod::Automatic;
  // Automatic, Sharp: the stretch [SSGH01] that a piece may have, estimated, in the mean of
  // squares; 1 is an isometry. Where it cannot be had through the cones of the smoothest field,
  // what those leave: symmetric Dirichlet energies of 4.09 on public meshes
  // (docs/atlas.md).
  double max_stretch = 1.015;
  // Sharp: degrees between the normals of two faces; chosen, not tuned.
  double sharp_angle = 40;
  // Given: vertices of the file from 0, two for every edge.
  std::vector<std::array<Index, 2>> edges = {};
  std::string edges_source = {};  // for messages: where they come from
  // Vertices that get one place in the layout where that is possible: no cut that these rules
  // choose passes them, unless every way does. What Texture, Sharp and Given ask for is cut anyway.
  std::vector<Index> whole = {};
  std::vector<char> given = {};  // 3 #F flags, one side is enough, or empty: cut in any case
  CutPreferences wanted = {};
  // Automatic, Sharp: components that are copies of each other are cut as the first of them is,
  // whatever is wanted of the others; not where `whole` vertices are.
  Stacking copies = Stacking::None;
  // Asked while cuts that suffice are made shorter: where it does not say Continue, they are taken
  // as they are.
  StopCheck enough = {};
};

// The cuts of one component of the surface.
struct ComponentCuts {
  Index first_face = 0, faces = 0;
  Index genus = 0, boundary_loops = 0;  // before it is cut
  Index pieces = 1;
  double length = 0;    // of its cuts, model units
  Index terminals = 0;  // Automatic, Sharp: ends of cuts inside the surface
  // Automatic, Sharp: stretch of the worst piece at best, with a free boundary; else 0.
  double estimated_stretch = 0;
};

struct SurfaceCuts {
  std::vector<char> is_cut;  // 3 #F, both half-edges of an edge or none; no edge of the boundary
  double length = 0;         // model units, every edge once
  Index edges = 0;
  // Texture, Sharp, Given: the part of it that no rule asked for, which opens pieces that would be
  // closed or have handles, and flattens those without texture coordinates.
  double added_length = 0;
  Index added_edges = 0;
  Index untextured_faces = 0;  // Texture: polygons of the file without texture coordinates
  std::vector<ComponentCuts> components;  // in the order of their first faces
};

// mesh: any number of components. Every piece of mesh.cut_along(is_cut) is bounded and of genus 0.
// Edges inside polygons of the file are cut only where nothing else is possible. Components of
// faces without an area alone (all at one place, all on one line) are cut along all their edges.
//
// Throws InvalidArgument for a stretch, an angle or a weight out of range, a vertex that does not
// exist, and flags or weights of the wrong size; Error(Usage) for a pair of `edges` that is no edge
// of the file, naming it; Error(Unsupported) for a component of less than 1e-160 of the area of
// all, for areas that are no doubles, and for Texture where no face has texture coordinates;
// Stopped.
SurfaceCuts choose_cuts(const SurfaceMesh& mesh, const CutOptions& options,
                        const StopCheck& stop = {});

// What can be done with one chart of these, connected and planar, whose map is not good enough:
// 3 #F flags of it, both sides of an edge or none. Edges inside polygons are cut only where nothing
// else is possible. wanted: of the chart. Stopped.
//
// The shortest cuts that leave it one piece with an estimated stretch of max_stretch, as the
// automatic rule has them; through all places that the estimate knows where that is not reached.
std::vector<char> cut_further(const SurfaceMesh& chart, const CutPreferences& wanted,
                              double max_stretch, const StopCheck& stop = {});
// Cuts through all inner vertices that are not flat, one piece: it unfolds, if without overlaps.
// No flags where there are none, or more of them than a box of boxes has.
std::vector<char> cut_corners(const SurfaceMesh& chart, const CutPreferences& wanted,
                              const StopCheck& stop = {});
// Two connected parts, of two or more faces. Around Planes: faces have as nearly one normal each as
// can be, two regions that grow around planes [CSAD04]; where both planes would do, the border runs
// where it costs least. Around Ends: what is nearer to one of two ends of the chart than to the
// other.
enum class PartsAround { Planes, Ends };
std::vector<char> cut_in_two(const SurfaceMesh& chart, const CutPreferences& wanted,
                             PartsAround centres = PartsAround::Planes, const StopCheck& stop = {});
// The path from boundary to boundary that costs least for the area that it leaves on its smaller
// side, between the ends of the chart or from the boundary vertex around which there is most, a
// full turn or more, so that the chart overlaps itself there, if there is one. No flags where there
// is no such path.
enum class PathsAcross { BetweenEnds, FromOverlaps };
std::vector<char> cut_across(const SurfaceMesh& chart, const CutPreferences& wanted,
                             PathsAcross paths, const StopCheck& stop = {});
// A path that divides a chart in two.
struct PathAcross {
  std::vector<Index> half_edges;               // that are cut, one side of each edge
  double length = 0;                           // of these, model units
  double smaller_area = 0;                     // of what lies on one side of it, in the map
  std::array<std::vector<Index>, 2> outlines;  // vertices around each part, but for its holes
};
// Paths from boundary to boundary, each the cheapest one between two stretches of the outer
// boundary: between the ends of the chart, and from the bottoms of bays in its outline, for who
// looks for parts of another shape. uv: 2 #V, where an injective map has the vertices. Stopped.
std::vector<PathAcross> paths_across(const SurfaceMesh& chart, const CutPreferences& wanted,
                                     const Vec& uv, const StopCheck& stop = {});
// The flags of a path, or of a straighter one nearby.
std::vector<char> cut_along_path(const SurfaceMesh& chart, const CutPreferences& wanted,
                                 const PathAcross& path, const StopCheck& stop = {});
// Of cuts (3 #F flags, both sides): their length, a quarter of it along creases, in model units.
double cost_of_cuts(const SurfaceMesh& mesh, const CutPreferences& wanted,
                    const std::vector<char>& is_cut);
// Returns whether the chart lies in the plane as it is, edge for edge, but for overlaps: there is
// no curvature inside.
bool unfolds(const SurfaceMesh& chart);
// Returns whether it does, and is of flat panels: one, or several between creases.
bool unfolds_at_creases(const SurfaceMesh& chart, const CutPreferences& wanted);
// The estimated stretch of the chart as it is.
double estimated_stretch(const SurfaceMesh& chart, const StopCheck& stop = {});

// Those of these faces of a surface, whose corners have the same order there.
CutPreferences preferences_on(const std::vector<Index>& faces, const CutPreferences& all);

// Takes these half-edges of the surface, one side or both, to the cuts that there are.
void add_cuts(const SurfaceMesh& mesh, const CutOptions& options,
              const std::vector<Index>& half_edges, SurfaceCuts& cuts);
// Takes these from them: what is cut there hangs together again.
void remove_cuts(const SurfaceMesh& mesh, const CutOptions& options,
                 const std::vector<Index>& half_edges, SurfaceCuts& cuts);

// Throws Error(Unsupported) as choose_cuts() for sizes, with any options.
void require_usable_sizes(const SurfaceMesh& mesh, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
