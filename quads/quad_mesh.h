// A pure quad mesh of a surface, with as many quads as asked, aligned to a smooth cross field.
//
//   QuadMeshOptions wishes;
//   wishes.count = 4000;
//   const QuadMesh result = quad_mesh(*mesh, wishes, record);
//   std::cout << result.check.count << " quads, " << result.check.irregular << " irregular\n";
//
// Its stages, in this order, are files of quads/internal, each with its equation at the head:
//
//     resolved_surface: no face has two edges of the border or of features
//     aligned_map: a seamless map of degree 1 with these edges along axes
//     seamless_lattice: the map on integers, on which seams hold without any error
//     motorcycle_graph, t_mesh: the surface cut into rectangles of the map
//     quantization, quantization_search: whole numbers of edges for their sides
//     quad_connectivity, extraction: quads of the same topology, and the places of their vertices
//     smoothing, untangling: better angles, no quad folded or turned
//     check_quads: the judge; what is returned is valid
//
// Which numbers of quads and which sets of features are tried stands in quad_attempts and
// feature_choices there. Borders and features are covered by edges of quads, with a vertex at
// every corner. docs/quads.md.
//
// Not for quads that are smaller in some places than in others: all are about as large.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/quads/check_quads.h"

namespace majorant {

// The map in which vertices of quads are placed. Rectangles: the seamless map, every rectangle of
// the motorcycle graph by itself. IntegerGrid: the seamless map after its cones and translations
// were led to whole numbers, with det J > 0 on every triangle. Best: both, of which that is taken
// whose quads are valid and, where both are, have the better angles.
enum class QuadPlacing { Rectangles, IntegerGrid, Best };

// CrossFieldOptions::cone_cost, for edges of quads of equal lengths.
inline constexpr double kIrregularCost = 0.003;

struct QuadMeshOptions {
  // Of the two at most one: the number of quads, or the length of their edges, in model units.
  // Neither: half as many quads as the surface has faces.
  std::optional<long> count = {};
  std::optional<double> edge_length = {};
  // 3 #F flags of edges that edges of quads cover (features.h), both sides; an empty list: none.
  // Nothing: sharp_edges() of kCornerTurn, none where cones are given.
  std::optional<std::vector<char>> features = {};
  // Degrees, above 0 to 180: a turn of the border from which on quads have a vertex there. The
  // border is smoothed for the map at others.
  double border_turn = kCornerTurn;
  // Cones and how the map is found. One quad alone around a vertex would meet itself.
  SeamlessOptions map = {.field = {.cone_energy = ConeEnergy::Scale,
                                   .cone_cost = kIrregularCost,
                                   .least_quarter_turns = 2}};
  QuadPlacing placing = QuadPlacing::Best;
  // Of the integer-grid map: tried one after the other until one gets there; 1 to 8.
  int first_degree = 1, last_degree = 3;
  int threads = 0;  // as SolveOptions has it
};

// Seconds that stages took, attempts that failed included.
struct QuadSeconds {
  double map = 0;       // the cross field and the seamless map that follows it
  double quantize = 0;  // the motorcycle graph and the whole numbers of its arcs
  double place = 0;     // vertices on the surface, by the integer-grid map, too
  double smooth = 0;
  double check = 0;  // check_quads(), nearest points of the surface among it
};

struct QuadMesh {
  PolygonMesh quads;
  QuadCheck check;  // of these, with the surface and `features`: valid
  // 3 #F: of the features asked for those that are covered; the others were relaxed.
  std::vector<char> features;
  std::vector<std::array<Index, 2>> feature_edges;  // of the quads, those that cover these
  Index feature_lines = 0;                          // of those asked for
  std::vector<LineEnds> relaxed;
  // Why there are no quads with all features but those that are too short for quads as long as
  // asked; empty where there are.
  std::string conflict;
  // Model units: shorter lines were relaxed (without_short_lines() in features.h).
  double shortest_feature = 0;
  long asked = 0;
  // The number of quads with as few edges on every arc as the cones allow; where more than
  // kCountClose above the count asked for were made.
  std::optional<long> least_count;
  Index cones = 0, patches = 0;
  std::vector<Index> patch_of;  // by quad: the rectangle of the motorcycle graph that it is in
  QuadPlacing placed = QuadPlacing::Rectangles;  // never Best
  int degree = 1;                                // of the map that has placed them
  Status status = Status::Converged;  // of the map's optimization, which a limit may have ended
  QuadSeconds seconds = {};
};

// Of the attempts whose quads are valid the first with a count within this part of the one asked
// for, else the closest.
inline constexpr double kCountClose = 0.05;
// Numbers of quads, and of their half-edges, are Index.
inline constexpr Index kMostQuads = 100'000'000;
// The memory of a run for each quad, beside what the surface takes, in bytes: 907 from 50,000 to
// 200,000 quads of examples/meshes/buckle.obj.
inline constexpr std::size_t kBytesOfQuad = 1000;

// Throws Error(Unsupported) with both figures where so many quads would take more memory than is
// available, or are more than kMostQuads; InvalidArgument for options out of range.
void require_memory_for_quads(const SurfaceMesh& mesh, const QuadMeshOptions& options);

// Returns whether so many vertices of the border are corners, and such a part of them, as of one
// that is torn: QuadMeshOptions::border_turn helps.
bool has_ragged_border(const SurfaceMesh& mesh);

// mesh: connected. Features that edges of the length asked for cannot follow are relaxed; where
// there is no map with the others, or none with valid quads, also those that edges of twice that
// length cannot, four times, and so on, until there is one; of features that were not given
// (nothing) also where more quads than asked for would be made. Where there are no valid quads
// without features either, more are made, with all features if that is possible. Throws
// Error(Unsupported) for cones given on a surface with a border or with features and for more than
// kMostQuads; InvalidArgument for options out of range or that exclude each other; as
// require_memory_for_quads(); Error(Infeasible) for cones of one quarter turn, and where no whole
// numbers or no valid quads were found, or no map with the border along its axes; else as
// make_seamless(); Stopped when the record's start_stop() says so.
QuadMesh quad_mesh(const SurfaceMesh& mesh, const QuadMeshOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
