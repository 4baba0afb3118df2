// Is a locally injective map injective? Proven from its boundary, rounding included.
//
//   GlobalInjectivity proof = check_boundary(map);      // det J > 0 being certified elsewhere
//   if (proof.result == ProofStatus::Violated && !proof.contacts.empty())
//     proof.contacts[0].where;                          // uv where two boundary edges meet
//
// The proof assumes of the map, and does not check: the surface is compact and orientable, its
// faces the elements; the map is continuous across edges that two elements share; det J > 0 on
// every (closed) element (LocalInjectivity, measure_map()); the loops given are the whole boundary,
// the surface on their left. Its connected components are the charts: any number, with any number
// of loops; their genus does not matter (an injective one turns out to be 0), nor does it matter
// that angles around inner vertices sum to 2 pi.
//
// Theorem. If the boundary curves are simple and disjoint, one loop of every chart is
// counterclockwise (the outer one) and the others are clockwise and lie inside of that one, and no
// chart's outer loop lies in the image of another chart, then the map is injective, on all charts
// together and on the closed surface.
// Proof. (1) A point p off the image of the boundary has N(p) preimages, counted with their degree
// of at least 1; N(p) is the sum of the winding numbers of the loops around p. (2) A simple loop
// winds once around its inside, counterclockwise loops +1, others -1: a chart has N <= 1, and its
// image is the inside of its outer loop less those of its holes. (3) Disjoint boundaries and
// overlapping images mean that one chart's outer loop lies in the other's image; so N <= 1 for all
// charts together. A chart in a hole of another is none. (4) If two points had the same image q and
// one was interior, the image of any neighbourhood of that one would cover all points around q, the
// image of one of the other some of them: N = 2. Both on the boundary: excluded.
//
// Touching counts: charts, or the two sides of a cut, that share as little as a point of the plane
// are Violated (or Undecided where curves touch between their ends), since the map of the cut
// surface is not injective there. Consecutive edges of a loop may share their vertex, and no more.
//
// Nothing else needs checking: angle sums of 2 pi inside and less than that at the boundary follow
// (each excess would be N >= 2 close by). That the loops of one chart are as required follows, in
// turn, from such angle sums and simple loops by counting turning numbers, 2 pi (2 - 2 genus -
// #loops) in all; to compute orientations is simpler than to trust sums of angles. Neighbouring
// edges that fold back onto each other are contacts like any other. Where contacts remain possible
// only, a point close by that the loops wind around twice proves the violation.
//
// Not for det J > 0, which is assumed: measure_map() and MapProof prove that.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

struct BoundaryLoops;  // internal to certify

struct Finding {
  ProofStatus answer = ProofStatus::NotRequested;
  std::string detail;  // one line: the defect or the open case and its place; where Proven, counts
};

struct InjectivityOptions {
  // At most this many subdivisions of pairs of curves, a pair itself taking one. None: 2^18 + 64
  // for every boundary edge. Maps of real models take 2 to 4 an edge, edges that all have a
  // neighbour at 1e-9 of their length about 25; 2^18 are about a second.
  std::optional<long> max_subdivisions = {};
  // Asked every few dozen microseconds, in every phase; true ends the proof, as Undecided unless it
  // has a result. Empty: never.
  std::function<bool()> stopped = {};
};

struct BoundaryContact {
  Index half_edge_a, half_edge_b;  // boundary half-edges of the mesh, a <= b
  Vector2 where;                   // uv, approximately
  ProofStatus apart;               // Violated: they meet; Undecided: that could not be excluded
};

// Once so many contacts are listed, some of them certain, the search ends.
inline constexpr std::size_t kMostContacts = 32;

struct GlobalInjectivity {
  // Violated: some contact is, or `reason` says what is wrong.
  ProofStatus result = ProofStatus::Undecided;
  std::vector<BoundaryContact> contacts;  // the first of them, violated ones first
  // uv that has at least two preimages: proven. None where boundaries only touch, and where no such
  // point was found close to a contact.
  std::optional<Vector2> covered_twice;
  // Pairs of boundary edges that were compared: those with overlapping bounding boxes; of polygons
  // those next to each other in the plane.
  long pairs_tested = 0;
  // Pairs with overlapping boxes that were not, where the budget ended or `stopped` said so;
  // counted up to a million.
  long pairs_left = 0;
  long subdivisions = 0;
  // The reason in one line; empty when Proven and where the contacts say it all.
  std::string reason;
};

// The boundary is that of the map's mesh, both sides of its seams included: of a cut surface the
// charts must not overlap, nor touch, not even where a cut opens no gap. Polygons are decided
// exactly, in O(n log n). Curves take a few microseconds an edge.
GlobalInjectivity check_boundary(const BezierMap& map, const InjectivityOptions& options = {});

// The same for boundaries of any source, internal to certify: that of a map in memory, of several
// maps side by side, or of what a file holds. half_edge_a and half_edge_b of its contacts are
// BoundaryLoops::half_edge.
GlobalInjectivity check_layout(const BoundaryLoops& boundary,
                               const InjectivityOptions& options = {});
// Returns in words what is violated and where: "overlaps itself near (0.25, 1.5)".
// Boundaries that only touch are no overlap, and are told apart where that is proven.
std::string meeting_words(const GlobalInjectivity& proof);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
