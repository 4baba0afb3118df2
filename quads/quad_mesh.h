// Makes a pure quad mesh of a surface with a requested number of quads, aligned to a smooth cross
// field.
//
//   QuadMeshOptions options;
//   options.count = 4000;
//   const QuadMesh result = quad_mesh(*mesh, options, record);
//   std::cout << result.check.count << " quads, " << result.check.irregular << " irregular\n";
//
// The stages, in this order, are files in quads/internal. The first comment of each has its
// equation:
//
//     resolved_surface: no face has two edges of the border or of features
//     aligned_map: a seamless map of degree 1 with these edges along axes
//     seamless_lattice: the map on integers, on which seams hold exactly
//     motorcycle_graph, t_mesh: the surface cut into rectangles of the map
//     quantization, quantization_search: integer numbers of edges for their sides
//     quad_connectivity, extraction: quads with the same topology, and positions of their vertices
//     smoothing, untangling: better angles, no quad folded or turned
//     check_quads: the proof that the returned quads are valid
//
// quad_attempts and feature_choices list the numbers of quads and the sets of features that are
// tried. Edges of quads cover borders and features, with a vertex at every corner. See
// docs/quads.md.
//
// Not for quads of varying sizes: all have about the same size.
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

// The map that places the vertices of quads. Rectangles: the seamless map, with each rectangle of
// the motorcycle graph placed separately. IntegerGrid: the seamless map after its cones and
// translations were moved to integers, with det J > 0 on every triangle. Best: both; the one with
// valid quads is taken, or the one with better angles.
enum class QuadPlacing { Rectangles, IntegerGrid, Best };

// CrossFieldOptions::cone_cost, for quads with equal edge lengths.
inline constexpr double kIrregularCost = 0.003;

struct QuadMeshOptions {
  // At most one of the number of quads and the length of their edges in model units. Neither: half
  // as many quads as the surface has faces.
  std::optional<long> count = {};
  std::optional<double> edge_length = {};
  // 3 #F flags of edges that edges of quads cover (features.h), both sides; an empty list: none.
  // Nothing: sharp_edges() with kCornerTurn, or none if cones are given.
  std::optional<std::vector<char>> features = {};
  // Degrees, above 0, up to 180. Quads have a vertex where the border turns by at least this;
  // elsewhere the border is smoothed for the map.
  double border_turn = kCornerTurn;
  // The cones and the method of the map. Cones of one quarter turn are not allowed, since a single
  // quad around a vertex would meet itself.
  SeamlessOptions map = {.field = {.cone_energy = ConeEnergy::Scale,
                                   .cone_cost = kIrregularCost,
                                   .least_quarter_turns = 2}};
  QuadPlacing placing = QuadPlacing::Best;
  // Degrees of the integer-grid map, tried in order until one succeeds; 1 to 8.
  int first_degree = 1, last_degree = 3;
  int threads = 0;  // see SolveOptions
};

// Seconds of the stages, including failed attempts.
struct QuadSeconds {
  double map = 0;       // the cross field and the seamless map
  double quantize = 0;  // the motorcycle graph and the quantization
  double place = 0;     // vertices on the surface, including the integer-grid map
  double smooth = 0;
  double check = 0;  // check_quads(), including nearest points of the surface
};

struct QuadMesh {
  PolygonMesh quads;
  QuadCheck check;  // of these quads with the surface and `features`: valid
  // 3 #F flags of the requested features that are covered; the others were relaxed.
  std::vector<char> features;
  std::vector<std::array<Index, 2>> feature_edges;  // edges of the quads on `features`
  Index feature_lines = 0;                          // number of requested lines
  std::vector<LineEnds> relaxed;
  // The reason why quads do not cover all features, apart from lines that are too short for the
  // requested edges; empty if they do.
  std::string conflict;
  // In model units: shorter lines were relaxed (without_short_lines() in features.h).
  double shortest_feature = 0;
  long requested = 0;  // number of quads
  // The least number of quads that the cones allow; set if the quads exceed the request by more
  // than kCountClose.
  std::optional<long> least_count;
  Index cones = 0, patches = 0;
  std::vector<Index> patch_of;                   // by quad: its rectangle of the motorcycle graph
  QuadPlacing placed = QuadPlacing::Rectangles;  // never Best
  int degree = 1;                                // of the map that places the quads
  Status status = Status::Converged;  // of the map's optimization, which a limit may have ended
  QuadSeconds seconds = {};
};

// The first attempt with valid quads whose count is within this fraction of the requested one is
// taken, otherwise the closest one.
inline constexpr double kCountClose = 0.05;
// The limit of quads, since quads and half-edges are numbered by Index.
inline constexpr Index kMaxQuads = 100'000'000;
// Bytes of memory per quad, besides the surface's: 907 from 50,000 to 200,000 quads of
// examples/meshes/buckle.obj.
inline constexpr std::size_t kBytesOfQuad = 1000;

// Throws Error(Unsupported) with both figures if so many quads would need more memory than is
// available, or are more than kMaxQuads; InvalidArgument for options out of range.
void require_memory_for_quads(const SurfaceMesh& mesh, const QuadMeshOptions& options);

// Returns whether many vertices of the border, and a large part of them, are corners, as for torn
// borders of scans. A larger QuadMeshOptions::border_turn helps then.
bool has_ragged_border(const SurfaceMesh& mesh);

// Makes the quads. mesh: connected. Features that edges of the requested length cannot follow are
// relaxed. If there is no map with valid quads, features that edges of two, four, ... times that
// length cannot follow are relaxed, too, until there is one. Detected features are also relaxed if
// they need too many quads. If there are no valid quads without features either, more quads are
// made, with all features if possible. Throws Error(Unsupported) for cones on a surface with a
// border or features and for more than kMaxQuads; InvalidArgument for options that are out of range
// or exclude each other; the errors of require_memory_for_quads(). Throws Error(Infeasible) for
// cones of one quarter turn, and if no integers, no valid quads or no map with the border along its
// axes were found; else the errors of make_seamless(). Throws Stopped if the record's start_stop()
// says so.
QuadMesh quad_mesh(const SurfaceMesh& mesh, const QuadMeshOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
