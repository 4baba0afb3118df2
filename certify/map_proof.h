// Proves a map from the points and uv in its file alone. It judges for `check` and for every file
// that is written, and trusts no claim.
//
//   const MapProof proof(read_map("bunny.vtu"), "bunny.vtu", {.surface = &polygons});
//   if (proof.verdict() == ProofStatus::Proven) ...
//   for (const auto& [question, finding] : proof.findings()) ...   // what is violated, and where
//
// Positivity is proven in floating point with bounds of rounding; cells that this leaves open are
// decided in exact arithmetic. Continuity compares the uv of both sides of an edge, to the last
// bit. Angle sums detect a map that winds twice around a vertex.
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

std::string_view name_of(ProofStatus status);  // returns "proven", "violated", "undecided" or "not
                                               // asked"

// The edges whose sides may have different uv.
enum class CutRule {
  Nothing,     // none
  Seams,       // edges whose sides agree up to a quarter turn and a translation, to kSeamClose
  Free,        // any; they are counted and listed
  SeamsOrFree  // any; seams are distinguished from other cuts
};

// Returns "1 edge", "3 edges".
std::string count_text(Index count, std::string_view noun);

// The largest mismatch of the sides of a seam, in diagonals of the layout. The optimizer holds
// seams to about 1e-15; coordinates need at least 10 printed digits.
inline constexpr double kSeamClose = kTenDigits;

struct ProofRequest {
  // The surface that should be mapped; null: the surface of the cells. A surface with defects is
  // repaired by repair() with this orientation.
  const PolygonMesh* surface = nullptr;
  Orientation orientation = Orientation::MadeConsistent;
  CutRule cuts = CutRule::Nothing;
  // The only edges to which `cuts` applies, by two vertices of the input in any order. Each is
  // listed as often as the cells may have differing edges there. Without a list it applies to all.
  std::optional<std::vector<std::array<Index, 2>>> cut_edges = {};
  // Reported: `global` is filled in, the verdict does not depend on it.
  enum class Overlap { NotRequested, Reported, Forbidden } overlap = Overlap::NotRequested;
  // Allowed: charts may lie exactly on others, mirrored or not, which is then no overlap. The
  // proven map is the one with mirrored charts turned back.
  enum class Stacks { Forbidden, Allowed } stacks = Stacks::Forbidden;
  // The layer of each cell, or empty. Charts of different layers may lie on each other, charts of
  // one layer may not, whatever `stacks` says. A chart in two layers counts as two.
  std::vector<Index> layers = {};
  // Partial: some polygons may have no cells. These are the polygons that no cell names or, if
  // labels are ignored, those that the file lists (MapFile::unmapped).
  enum class Coverage { Whole, Partial } coverage = Coverage::Whole;
  // For Partial: the number of polygons without cells, if known.
  std::optional<Index> unmapped = {};
  // Compared: vertices and input_face of the file must be those of the surface. A .vtu has a cell
  // for every face and names it. An .obj may have pieces of faces with new vertices, and its labels
  // are ignored.
  enum class FaceLabels { Ignored, Compared } labels = FaceLabels::Ignored;
  StopCheck stop = {};  // polled; after a stop, open questions are Undecided
};

// The edges of the surface whose sides differ, and the pieces of the map.
struct CutCount {
  Index seams = 0, others = 0;
  double length = 0;  // sum over both kinds on the surface, model units
  Index charts = 1;
  // The first of ProofRequest::cut_edges that is not cut: the cells have no inner edge there whose
  // sides differ or share no points, or fewer than listed.
  std::optional<std::array<Index, 2>> not_cut = {};
};

// Returns the number in the input of the vertex at corner 0, 1, 2 of a face of the map.
using CornerNames = std::function<Index(Index face, Index corner)>;
// Returns "boundary edges (12, 13) and (40, 41) meet near (0.25, 1.5)"; empty if Proven.
std::string describe(const GlobalInjectivity& proof, const CornerNames& input_vertex);

class MapProof {
 public:
  // Proves the requested properties. Cells that form no surface are a Violated or Undecided
  // finding, not an exception. Throws Error(Unsupported) for degrees that cannot be judged.
  MapProof(const MapFile& file, const std::string& name, const ProofRequest& request);

  // Returns the verdict on all requested questions: Violated if a finding is, else Undecided if one
  // is, else Proven.
  ProofStatus verdict() const;
  // Returns the findings in the order below, with their names.
  std::vector<std::pair<std::string_view, const Finding*>> findings() const;
  // Returns the first finding that is not Proven, "positive: cell 7: ..."; empty if all are.
  std::string first_defect() const;

  Finding surface;     // the cells are the faces of the surface, or of its covered part
  Finding flat;        // the control points of the surface are those of flat triangles
  Finding positive;    // det J > 0 on every closed cell, and no polygon is MapFile::folded
  Finding continuous;  // only allowed cuts
  Finding angles;     // one full turn around inner vertices, quarter turns around vertices of seams
  Finding injective;  // no overlaps, no contacts

  CutCount cuts;
  StackedCharts stacks;                     // if they are allowed
  Index other_triangles = 0;                // faces of the surface in other triangulations
  Index unmapped = 0;                       // polygons of the surface without cells
  std::vector<Index> not_positive;          // inverted or undecided cells
  std::vector<Cone> cones;                  // by vertex of the input; for CutRule::Seams
  std::optional<GlobalInjectivity> global;  // if overlaps were requested

  // Returns the map of the surface, cut where its sides differ; its faces are the cells in order.
  // If all cuts are seams it has these seams, and is also cut where the file shares no points. None
  // if the cells form no surface.
  const std::optional<BezierMap>& map() const { return map_; }

 private:
  class Judge;
  void judge(const MapFile& file, const std::string& name, const ProofRequest& request);
  std::optional<BezierMap> map_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
