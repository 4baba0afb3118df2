// Cuts of a surface that are as short as possible and let every piece be mapped onto the plane with
// little distortion.
//
//   SurfaceCuts cuts = choose_cuts(*mesh, {});
//   SurfaceMesh charts = mesh->cut_along(cuts.is_cut, nullptr);   // disks, some with holes
//
// Seamless maps need other cuts, which go through all cones.
//
// docs/atlas.md, "Where to cut", describes the rule of CutMethod::Automatic.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/congruent_surfaces.h"

namespace majorant {

// The rule that chooses cuts.
// * Automatic: where a cut reduces distortion most; one piece per component.
// * Texture: along the islands of the file's texture coordinates. Automatic in closed components
//  that these do not cut, and in faces without coordinates.
// * Sharp: along edges with a dihedral angle above sharp_angle that enclose pieces, then Automatic
//  in each piece.
// * Given: along CutOptions::edges only.
enum class CutMethod { Automatic, Texture, Sharp, Given };

// Returns whether the rule chooses cuts by their costs, so that further cuts may be made.
inline bool chooses_cuts(CutMethod method) {
  return method == CutMethod::Automatic || method == CutMethod::Sharp;
}

// Costs of cuts beside their length, by half-edge: 3 #F, both sides the same, or empty.
struct CutPreferences {
  // Flags of edges that count as creases at any angle, such as those of normals, smoothing groups
  // and materials of a file. A cut along a crease costs a quarter of its length.
  std::vector<char> creases = {};
  std::vector<double> weight = {};  // factors > 0 of all costs, large where seams are undesirable
};

struct CutOptions {
  CutMethod method = CutMethod::Automatic;
  // Automatic, Sharp: the limit of the estimated stretch [SSGH01] of a piece, in the mean of
  // squares; 1 is an isometry. If cuts through the cones of the smoothest field do not reach it,
  // their stretch is accepted. Maps of public meshes then have symmetric Dirichlet energies of 4.09
  // (docs/atlas.md).
  double max_stretch = 1.015;
  // Sharp: the least angle between the normals of two faces, degrees. Chosen, not tuned.
  double sharp_angle = 40;
  // Given: pairs of vertices of the file, counted from 0.
  std::vector<std::array<Index, 2>> edges = {};
  std::string edges_source = {};  // the origin of the edges, for messages
  // Vertices that should have one place in the layout: no chosen cut passes them unless every path
  // does. Cuts of Texture, Sharp and Given are made anyway.
  std::vector<Index> whole = {};
  std::vector<char> given = {};  // 3 #F flags, one side suffices, or empty: cut in any case
  CutPreferences preferences = {};
  // Automatic, Sharp: components that are copies of each other are cut like the first of them,
  // whatever the preferences of the others; not components with `whole` vertices.
  Stacking copies = Stacking::None;
  // Polled while cuts that suffice are shortened; if it does not return Continue, they are taken as
  // they are.
  StopCheck enough = {};
};

// The cuts of one component of the surface.
struct ComponentCuts {
  Index first_face = 0, faces = 0;
  Index genus = 0, boundary_loops = 0;  // of the uncut component
  Index pieces = 1;
  double length = 0;    // of its cuts, model units
  Index terminals = 0;  // Automatic, Sharp: ends of cuts inside the surface
  // Automatic, Sharp: estimated stretch of the worst piece with a free boundary; else 0.
  double estimated_stretch = 0;
};

struct SurfaceCuts {
  std::vector<char> is_cut;  // 3 #F, both half-edges of an edge or none; no edge of the boundary
  double length = 0;         // model units, every edge once
  Index edges = 0;
  // Texture, Sharp, Given: the length of cuts that the rule does not name. They open pieces that
  // would be closed or have handles, and flatten pieces without texture coordinates.
  double added_length = 0;
  Index added_edges = 0;
  Index untextured_faces = 0;  // Texture: polygons of the file without texture coordinates
  std::vector<ComponentCuts> components;  // in the order of their first faces
};

// Chooses cuts of a surface with any number of components. Every piece of mesh.cut_along(is_cut) is
// bounded and of genus 0. Edges inside polygons of the file are cut only if nothing else is
// possible. Components that consist of faces without an area (all at one point, or all on one line)
// are cut along all their edges.
//
// Throws InvalidArgument for a stretch, an angle or a weight out of range, a vertex that does not
// exist, and flags or weights of the wrong size. Throws Error(Usage) for a pair of `edges` that is
// no edge of the file, naming it. Throws Error(Unsupported) for a component of less than 1e-160 of
// the total area, for areas outside the range of doubles, and for Texture if no face has texture
// coordinates. Throws Stopped.
SurfaceCuts choose_cuts(const SurfaceMesh& mesh, const CutOptions& options,
                        const StopCheck& stop = {});

// The following functions cut a chart, connected and planar, whose map is not good enough. They
// return 3 #F flags, for both sides of an edge or none. Edges inside polygons are cut only if
// nothing else is possible. preferences: of the chart. Stopped.
//
// Returns the shortest cuts of the automatic rule that leave one piece with an estimated stretch of
// max_stretch. If that is not reached, returns cuts through all candidate vertices.
std::vector<char> cut_further(const SurfaceMesh& chart, const CutPreferences& preferences,
                              double max_stretch, const StopCheck& stop = {});
// Returns cuts through all inner vertices that are not flat, one piece: it unfolds, up to overlaps.
// Returns no flags if there are no such vertices, or more than a box of boxes has.
std::vector<char> cut_corners(const SurfaceMesh& chart, const CutPreferences& preferences,
                              const StopCheck& stop = {});
// The growth of two parts of a chart. Planes: two regions grow around planes so that the normals
// within each vary little [CSAD04]; where both planes fit, the border runs where it costs least.
// Ends: each face goes to the nearer one of two ends of the chart.
enum class PartsAround { Planes, Ends };
// Returns cuts into two connected parts of two or more faces.
std::vector<char> cut_in_two(const SurfaceMesh& chart, const CutPreferences& preferences,
                             PartsAround centres = PartsAround::Planes, const StopCheck& stop = {});
// Paths between boundary vertices. BetweenEnds: between the ends of the chart. FromOverlaps: from
// the boundary vertex with the largest angle, if that is a full turn or more, so that the chart
// overlaps itself there.
enum class PathsAcross { BetweenEnds, FromOverlaps };
// Returns the path of least cost per area of its smaller side; no flags if there is no such path.
std::vector<char> cut_across(const SurfaceMesh& chart, const CutPreferences& preferences,
                             PathsAcross paths, const StopCheck& stop = {});
// A path that divides a chart in two.
struct PathAcross {
  std::vector<Index> half_edges;               // one side of each cut edge
  double length = 0;                           // of the path, model units
  double smaller_area = 0;                     // area of its smaller side, in the map
  std::array<std::vector<Index>, 2> outlines;  // vertices around each part, without holes
};
// Returns paths from boundary to boundary, each the cheapest one between two stretches of the outer
// boundary: between the ends of the chart, and from the bottoms of bays in its outline. They serve
// a search for parts of better shape. uv: 2 #V, an injective map of the vertices. Stopped.
std::vector<PathAcross> paths_across(const SurfaceMesh& chart, const CutPreferences& preferences,
                                     const Vec& uv, const StopCheck& stop = {});
// Returns the flags of a path, or of a straighter one nearby.
std::vector<char> cut_along_path(const SurfaceMesh& chart, const CutPreferences& preferences,
                                 const PathAcross& path, const StopCheck& stop = {});
// Returns the length of cuts (3 #F flags, both sides), a quarter of it along creases, in model
// units.
double cost_of_cuts(const SurfaceMesh& mesh, const CutPreferences& preferences,
                    const std::vector<char>& is_cut);
// Returns whether the chart unfolds into the plane without distortion, up to overlaps: no inner
// vertex has curvature.
bool unfolds(const SurfaceMesh& chart);
// Returns whether the chart unfolds and consists of flat panels: one, or several between creases.
bool unfolds_at_creases(const SurfaceMesh& chart, const CutPreferences& preferences);
// Returns the estimated stretch of the chart as it is.
double estimated_stretch(const SurfaceMesh& chart, const StopCheck& stop = {});

// Returns the preferences of these faces of a surface, whose corners keep their order.
CutPreferences preferences_on(const std::vector<Index>& faces, const CutPreferences& all);

// Adds these half-edges of the surface, one side or both, to the cuts.
void add_cuts(const SurfaceMesh& mesh, const CutOptions& options,
              const std::vector<Index>& half_edges, SurfaceCuts& cuts);
// Removes these half-edges from the cuts, so that the faces there are joined again.
void remove_cuts(const SurfaceMesh& mesh, const CutOptions& options,
                 const std::vector<Index>& half_edges, SurfaceCuts& cuts);

// Throws Error(Unsupported) for sizes as choose_cuts() does, with any options.
void require_usable_sizes(const SurfaceMesh& mesh, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
