// Proves from its boundary that a locally injective map is injective, rounding included.
//
//   GlobalInjectivity proof = check_boundary(map);      // det J > 0 being certified elsewhere
//   if (proof.result == ProofStatus::Violated && !proof.contacts.empty())
//     proof.contacts[0].where;                          // uv where two boundary edges meet
//
// The proof assumes the following and does not check it. The surface is compact and orientable; its
// faces are the elements. The map is continuous across edges that two elements share. det J > 0 on
// every (closed) element (LocalInjectivity, measure_map()). The given loops are the whole boundary,
// with the surface on their left. The connected components of the surface are the charts, any
// number, with any number of loops each. Their genus is arbitrary (an injective chart has genus 0),
// and angles around inner vertices need not sum to 2 pi.
//
// Theorem. Let the boundary curves be simple and disjoint. Let one loop of every chart, the outer
// one, be counterclockwise, and the others be clockwise and lie inside of it. Let no outer loop lie
// in the image of another chart. Then the map is injective, on all charts together and on the
// closed surface.  Proof. (1) A point p off the image of the boundary has N(p) preimages, counted
// with their degree of at least 1; N(p) is the sum of the winding numbers of the loops around p.
// (2) A simple loop winds once around its inside, counterclockwise loops +1, others -1. So a chart
// has N <= 1, and its image is the inside of its outer loop minus those of its holes. (3) If
// boundaries are disjoint and images overlap, the outer loop of one chart lies in the image of the
// other. So N <= 1 for all charts together. A chart in a hole of another does not overlap it. (4)
// Suppose two points have the same image q, and one is interior. Its neighbourhoods cover all
// points around q, and those of the other point some of them: N = 2. If both are on the boundary,
// the boundary is not simple.
//
// Touching counts. Charts, or the two sides of a cut, that share a single point of the plane are
// Violated, since the map of the cut surface is not injective there. They are Undecided if curves
// touch between their ends. Consecutive edges of a loop may share only their vertex.
//
// Nothing else needs checking. Angle sums of 2 pi inside and less at the boundary follow, because
// each excess would give N >= 2 nearby. Conversely, such angle sums and simple loops determine the
// senses of a chart's loops by turning numbers, 2 pi (2 - 2 genus - #loops) in all. Orientations
// are simpler to compute than sums of angles. Neighbouring edges that fold back onto each other are
// contacts like any other. If a contact is only possible, a nearby point around which the loops
// wind twice proves the violation.
//
// Not for det J > 0, which is assumed here: measure_map() and MapProof prove it.
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
  // The largest number of subdivisions of pairs of curves; a pair itself takes one. None: 2^18 + 64
  // for every boundary edge, of which 2^18 take about a second. Maps of real models take 2 to 4 an
  // edge; edges with a neighbour at 1e-9 of their length take about 25.
  std::optional<long> max_subdivisions = {};
  // Called every few dozen microseconds. True ends the proof, as Undecided unless a result is
  // known. Empty: never.
  std::function<bool()> stopped = {};
};

struct BoundaryContact {
  Index half_edge_a, half_edge_b;  // boundary half-edges of the mesh, a <= b
  Vector2 where;                   // uv, approximately
  ProofStatus apart;               // Violated: they meet; Undecided: they may meet
};

// The search ends once this many contacts are listed and one of them is certain.
inline constexpr std::size_t kMaxContacts = 32;

struct GlobalInjectivity {
  // Violated if a contact is, or for the reason below.
  ProofStatus result = ProofStatus::Undecided;
  std::vector<BoundaryContact> contacts;  // the first ones, violated ones first
  // uv with at least two preimages, proven. None if boundaries only touch, or if no such point was
  // found near a contact.
  std::optional<Vector2> covered_twice;
  // The number of pairs of boundary edges that were compared: edges with overlapping bounding
  // boxes; for polygons, edges that are neighbours in the plane.
  long pairs_tested = 0;
  // The number of pairs with overlapping boxes that were not compared because the budget ended or
  // `stopped` returned true; at most a million.
  long pairs_left = 0;
  long subdivisions = 0;
  // The reason in one line; empty if Proven, or if the contacts tell it.
  std::string reason;
};

// Judges the boundary of the map's mesh, including both sides of its seams. The charts of a cut
// surface must neither overlap nor touch, even where a cut opens no gap. Polygons are decided
// exactly, in O(n log n). Curves take a few microseconds an edge.
GlobalInjectivity check_boundary(const BezierMap& map, const InjectivityOptions& options = {});

// Does the same for any boundary: of a map in memory, of several maps side by side, or of a file.
// Internal to certify. half_edge_a and half_edge_b of its contacts are BoundaryLoops::half_edge.
GlobalInjectivity check_layout(const BoundaryLoops& boundary,
                               const InjectivityOptions& options = {});
// Returns the violation and its place in words: "overlaps itself near (0.25, 1.5)". Boundaries that
// only touch, if that is proven, are called so.
std::string meeting_words(const GlobalInjectivity& proof);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
