// The problem of an automatic cut, and the cuts that are compared to solve it.
//
//   const CutRequest request{{}, std::vector<char>(mesh->vertex_count(), 0)};
//   const CutProblem problem(*mesh, request, 0.02);
//   const AutomaticCut full = routed(problem, {0, 7});
//   const AutomaticCut cut = shortened(problem, full, {0, 7});
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/seams/internal/flattening_system.h"
#include "majorant/parametrization/seams/internal/mirror_plane.h"

namespace majorant {

// A cut of a connected surface that leaves one planar piece.
struct AutomaticCut {
  std::vector<char> is_cut;  // 3 #F, both sides
  double strain = 0;         // flattening_strain.h
  std::vector<Index> ends;   // vertices inside the surface where the cut ends
  bool unfolds = false;      // it passes all vertices that are not flat
};

// The search for mirror images of a cut. Ignored: for cuts that are added to a chart, which mirror
// images would double.
enum class Images { Searched, Ignored };

// Preferences and limits of the cuts of one surface, in its own half-edges and vertices.
struct CutRequest {
  CutPreferences preferences;
  std::vector<char> whole;  // #V: vertices that cuts avoid
  StopCheck enough = {};    // CutOptions::enough
  Images images = Images::Searched;
};

// Surfaces with more vertices than this are large and get the short form of every search, since one
// cut of them takes as long as many of others. 50,000 faces are then cut in ten seconds.
inline constexpr Index kLargeSurface = 20000;

// Returns the vertices that are not flat. defect: #V, angle defects. is_whole: #V, vertices to
// leave out.
std::vector<Index> curved_vertices(const Vec& defect, const std::vector<char>& is_whole);

// A surface, the costs of its edges and the strain that a cut may leave. The surface and the
// request outlive it.
struct CutProblem {
  // strain_limit: see flattening_strain.h; large surfaces aim below it.
  CutProblem(const SurfaceMesh& surface, const CutRequest& request, double strain_limit,
             const StopCheck& check = {});

  const SurfaceMesh& mesh;
  const CutRequest& request;
  Vec cost;                   // 3 #F, of edges
  Vec plain_cost;             // 3 #F, without weights, which steer cuts but do not measure them
  double limit;               // of the strain
  Vec defect;                 // #V, angle defects
  std::vector<Index> curved;  // vertices that are not flat and need not stay whole
  bool is_faceted;            // all curvature lies where creases meet: panels between them unfold
  std::vector<Index> cones;   // vertices of the first cut
  std::shared_ptr<FlatteningSystem> flattening;
  StopCheck stop;  // without progress, since most of the work is repeated

  // Returns the number of searches of one kind that the size of the surface allows, 1 for large
  // ones.
  Index rounds() const;
};

// Return sums along a cut, every edge once: costs in square roots of the area, lengths in model
// units.
double cost_of(const CutProblem& problem, const AutomaticCut& cut);
double plain_cost_of(const CutProblem& problem, const AutomaticCut& cut);
double length_of(const CutProblem& problem, const AutomaticCut& cut);
// Returns the strain that these cuts (3 #F flags) leave.
double strain_of(const CutProblem& problem, const std::vector<char>& is_cut);

// Returns 3 #F flags of the cut graph (cut_graph.h) through these vertices, along straighter paths
// if those still leave one planar piece. Stopped.
std::vector<char> straight_cut_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                                     const Vec& cost, const StopCheck& stop);

// Returns the cut through these vertices, which is longer than necessary and leaves little strain.
// Stopped.
AutomaticCut routed(const CutProblem& problem, const std::vector<Index>& terminals);
// Removes branches of a cut from their ends while the strain stays below the limit, or below that
// of the cut if this is larger. Branches end at terminals. With a mirror plane, ends are shortened
// together with their images. progress: reports the fraction of the work only. Stopped.
AutomaticCut shortened(const CutProblem& problem, const AutomaticCut& full,
                       const std::vector<Index>& terminals,
                       const std::optional<MirrorPlane>& mirror = {},
                       const StopCheck& progress = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
