// Is a locally injective map injective? Proven from its boundary, rounding included.
//
//   GlobalInjectivity proof = check_boundary(map);      // det J > 0 being certified elsewhere
//   if (proof.result == Injectivity::Violated && !proof.contacts.empty())
//     proof.contacts[0].where;                          // uv where two boundary edges meet
//
// Theorem. Let det J > 0 on every (closed) element. If the boundary curves are simple and disjoint,
// one loop of every component is counterclockwise and the others clockwise, and no component's
// counterclockwise loop lies in the image of another component, then the map is injective.
// Proof. (1) A point p off the image of the boundary has N(p) preimages, all of positive degree, so
// N(p) is the sum of the winding numbers of the loops around p. (2) A simple loop winds once around
// its inside, counterclockwise loops +1, others -1: a component with one of the former has N <= 1.
// (3) Disjoint boundaries and overlapping images mean that one component's outer loop lies in the
// other's image; so N <= 1 for all components together. (4) If two points had the same image q and
// one was interior, the image of any neighbourhood of that one would cover all points around q, the
// image of one of the other some of them: N = 2. Both on the boundary: excluded.
//
// Nothing else needs checking: angle sums of 2 pi inside and less than that at the boundary follow
// (each excess would be N >= 2 close by). That the loops of one component are as required follows,
// in turn, from such angle sums and simple loops by counting turning numbers, 2 pi (2 - 2 genus -
// #loops) in all; to compute orientations is simpler than to trust sums of angles. Neighbouring
// edges that fold back onto each other are contacts like any other.
#pragma once

#include <string>
#include <vector>

#include "majorant/parametrization/bezier_map.h"
#include "majorant/parametrization/curve_contact.h"

namespace majorant {

enum class Injectivity { Proven, Violated, Undecided };

struct BoundaryContact {
  Index half_edge_a, half_edge_b;  // boundary half-edges of the map's mesh, a <= b
  Vector2 where;                   // uv, approximately
  Contact kind;                    // Certain: they meet; Possible: that could not be excluded
};

struct GlobalInjectivity {
  // Violated: some contact is Certain, or a loop turns the wrong way, or components overlap.
  Injectivity result = Injectivity::Undecided;
  std::vector<BoundaryContact> contacts;  // the first few dozen, Certain ones first
  long pairs_tested = 0;                  // of boundary edges with overlapping bounding boxes
  std::string reason;                     // one line; empty when Proven or there are contacts
};

// The boundary is that of the map's mesh: both sides of its seams are part of it, and a map of a
// cut surface is injective when no two of its faces overlap anywhere in the plane. Precondition,
// not checked: det J > 0 on every element (LocalInjectivity, or measure()). About 2 us per edge.
GlobalInjectivity check_boundary(const BezierMap& map);

}  // namespace majorant
