// The question that an automatic cut answers, and the cuts that are compared on the way.
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
  std::vector<Index> ends;   // vertices inside the surface where it ends
  bool unfolds = false;      // it was led through all vertices that are not flat
};

// Mirror images of a cut are looked for once a surface. Cuts that are added to a chart would be
// doubled by them.
enum class Images { Searched, Ignored };

// Preferences and limits of the cuts of one surface, by its own half-edges and vertices.
struct CutRequest {
  CutPreferences preferences;
  std::vector<char> whole;  // #V: vertices that cuts avoid
  StopCheck enough = {};    // CutOptions::enough
  Images images = Images::Searched;
};

// Surfaces with more vertices than this are large: one cut of them takes as long as many of others,
// and they get the short form of every search. 50,000 faces are then cut in ten seconds.
inline constexpr Index kLargeSurface = 20000;

// Vertices that are not flat. defect: #V, angle defects; is_whole: #V, vertices to leave out.
std::vector<Index> curved_vertices(const Vec& defect, const std::vector<char>& is_whole);

// A surface, the costs of its edges and the strain that a cut may leave. The surface and the
// request outlive it.
struct CutProblem {
  // strain_limit: flattening_strain.h; large surfaces aim below it.
  CutProblem(const SurfaceMesh& surface, const CutRequest& request, double strain_limit,
             const StopCheck& check = {});

  const SurfaceMesh& mesh;
  const CutRequest& request;
  Vec cost;        // 3 #F, of edges
  Vec plain_cost;  // 3 #F, without weights, which say where cuts run, not how much is cut
  double limit;    // of the strain
  Vec defect;      // #V, angle defects
  std::vector<Index> curved;  // vertices that are not flat and need not stay whole
  bool is_faceted;            // all curvature lies where creases meet: panels between them unfold
  std::vector<Index> cones;   // vertices of the first cut
  std::shared_ptr<FlatteningSystem> flattening;
  StopCheck stop;  // silent, as most of the work is done many times

  // The number of searches of one kind that the size of the surface allows, 1 for large ones.
  Index rounds() const;
};

// Sums along a cut, every edge once: costs in square roots of the area, lengths in model units.
double cost_of(const CutProblem& problem, const AutomaticCut& cut);
double plain_cost_of(const CutProblem& problem, const AutomaticCut& cut);
double length_of(const CutProblem& problem, const AutomaticCut& cut);
// The strain that these cuts (3 #F flags) leave.
double strain_of(const CutProblem& problem, const std::vector<char>& is_cut);

// 3 #F flags of the cut graph (cut_graph.h) through these vertices along straighter paths, where
// that still leaves one planar piece. Stopped.
std::vector<char> straight_cut_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                                     const Vec& cost, const StopCheck& stop);

// The cut through these vertices; it is too long, and leaves little strain. Stopped.
AutomaticCut routed(const CutProblem& problem, const std::vector<Index>& terminals);
// Takes back branches of a cut from their ends while the strain stays below the limit, or below
// that of the cut where this is larger. Branches end at terminals; ends and their images in the
// plane are taken back together. progress: for the share of the work alone. Stopped.
AutomaticCut shortened(const CutProblem& problem, const AutomaticCut& full,
                       const std::vector<Index>& terminals,
                       const std::optional<MirrorPlane>& mirror = {},
                       const StopCheck& progress = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
