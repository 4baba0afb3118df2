// Proves a map that a file holds, from its points and uv alone: the judge behind `check` and behind
// every file that is written. It believes no claim.
//
//   const MapProof proof(read_map("bunny.vtu"), "bunny.vtu", {.surface = &polygons});
//   if (proof.verdict() == ProofStatus::Proven) ...
//   for (const auto& [question, finding] : proof.findings()) ...   // what is violated, and where
//
// Positivity is proven in floating point with its rounding bounds, cells that this leaves open are
// decided in exact arithmetic. Continuity compares the uv of both sides of an edge, equal to the
// last bit. Angle sums tell a map that winds twice around a vertex.
//
// Not for maps in memory that a solver has certified: their MapMeasures say what is proven.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/stacked_charts.h"
#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/repair.h"

namespace majorant {

std::string_view name_of(ProofStatus status);  // "proven", "violated", "undecided", "not asked"

// The kinds of edges whose two sides may have different uv.
enum class CutRule {
  Nothing,     // none may differ
  Seams,       // sides that agree by a quarter turn and a translation, to kSeamClose
  Free,        // any, counted and listed
  SeamsOrFree  // seams are told from other cuts
};

// "1 edge", "3 edges".
std::string count_text(Index count, std::string_view noun);

// Mismatch of the sides of a seam, in diagonals of the layout, beyond which a map is not seamless.
// The optimizer holds seams to some 1e-15; a coordinate printed with fewer than 10 digits shows.
inline constexpr double kSeamClose = kTenDigits;

struct ProofRequest {
  // It should be a map of; null: what the cells make. Where the surface has defects, of what
  // repair() makes of it with this orientation.
  const PolygonMesh* surface = nullptr;
  Orientation orientation = Orientation::MadeConsistent;
  CutRule cuts = CutRule::Nothing;
  // The only edges that may be what `cuts` says, by two vertices of the input in any order, each as
  // often as the cells may have an edge there that differs; none given: all of them.
  std::optional<std::vector<std::array<Index, 2>>> cut_edges = {};
  // Reported: `global` is filled in, the verdict does not depend on it.
  enum class Overlap { NotRequested, Reported, Forbidden } overlap = Overlap::NotRequested;
  // Allowed: charts may lie exactly on others, mirrored ones, too: that is no
  // overlap, and what is proven is the map with mirrored charts turned back.
  enum class Stacks { Forbidden, Allowed } stacks = Stacks::Forbidden;
  // The layer of each cell, or empty: charts of different layers may lie on each other, those of
  // one layer not, whatever `stacks` says. A chart that is in two layers counts as two.
  std::vector<Index> layers = {};
  // Partial: the polygons that have cells are covered, others have none: those that no cell names,
  // or, where labels are ignored, those that the file has without cells (MapFile::unmapped).
  enum class Coverage { Whole, Partial } coverage = Coverage::Whole;
  // Of Partial: the number of polygons without cells, where it is known.
  std::optional<Index> unmapped = {};
  // Compared: vertices and input_face of the file must be those of the surface. A .vtu has a cell
  // for every face and names it; an .obj may have pieces of faces, with vertices of their own, and
  // its labels are ignored.
  enum class FaceLabels { Ignored, Compared } labels = FaceLabels::Ignored;
  StopCheck stop = {};  // asked now and then; after a stop, what is left is Undecided
};

// Edges of the surface whose sides differ, and the pieces that the map falls into.
struct CutCount {
  Index seams = 0, others = 0;
  double length = 0;  // of both on the surface, model units
  Index charts = 1;
  // The first of ProofRequest::cut_edges that is no cut: no inner edge of the cells whose sides
  // differ, or share no points, or one that is listed more often than there are such edges.
  std::optional<std::array<Index, 2>> not_cut = {};
};

// Number, in the input, of the vertex at corner 0, 1, 2 of a face of the map.
using CornerNames = std::function<Index(Index face, Index corner)>;
// "boundary edges (12, 13) and (40, 41) meet near (0.25, 1.5)"; empty when Proven.
std::string describe(const GlobalInjectivity& proof, const CornerNames& input_vertex);

class MapProof {
 public:
  // Cells that cannot be put together at all are a Violated or Undecided finding, no exception.
  // Throws Error(Unsupported) for degrees that cannot be judged.
  MapProof(const MapFile& file, const std::string& name, const ProofRequest& request);

  // The verdict on all questions asked: Violated if a finding is, else Undecided if one is, else
  // Proven.
  ProofStatus verdict() const;
  // Returns the findings in the order below, with their names.
  std::vector<std::pair<std::string_view, const Finding*>> findings() const;
  // Returns the first that is not Proven, "positive: cell 7: ..."; empty when all are.
  std::string first_defect() const;

  Finding surface;     // the cells are the faces of the surface, or of the part that is covered
  Finding flat;        // the surface's control points are those of flat triangles
  Finding positive;    // det J > 0 on every closed cell, and no polygon is MapFile::folded
  Finding continuous;  // no cut but as the request allows
  Finding angles;      // one full turn around inner vertices, quarter turns at those of seams
  Finding injective;   // nothing overlaps or touches

  CutCount cuts;
  StackedCharts stacks;                     // where they are allowed
  Index other_triangles = 0;                // faces of the surface in other triangles than its own
  Index unmapped = 0;                       // polygons of the surface without cells
  std::vector<Index> not_positive;          // cells, inverted or undecided
  std::vector<Cone> cones;                  // vertices of the input; of CutRule::Seams
  std::optional<GlobalInjectivity> global;  // when overlaps were asked for

  // The map of the surface, cut where its sides differ, with its seams when all cuts are seams (and
  // then also cut where the file shares no points); its faces are the cells in order. None when the
  // cells make no surface.
  const std::optional<BezierMap>& map() const { return map_; }

 private:
  class Judge;
  void judge(const MapFile& file, const std::string& name, const ProofRequest& request);
  std::optional<BezierMap> map_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
