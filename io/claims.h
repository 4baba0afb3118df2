// What a result says of itself: the FieldData array majorant_claims of a .vtu, parsed once and
// strictly. Claims describe a map; whether they are true is for `check` to find out.
//
//   const Claims claims = parse_claims(file.claims, "bunny.vtu");
//   if (claims.bijective.value_or(false)) ...
//
// Every key that majorant writes is optional, and null says nothing. One that is there has the type
// and the range written below; keys not listed here are ignored.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/maps/map_options.h"
#include "majorant/mesh/seams.h"

namespace majorant {

struct ClaimedPin {
  Index vertex = 0;  // of the input, >= 0; may be beyond what the file maps
  Vector2 target;    // uv, finite
};

// uv in the file = (uv - origin) / size, of uv that have been turned, if they were.
struct ClaimedNormalization {
  Vector2 origin;
  double size = 1;  // positive
};

// Charts of the array `chart` that lie on each other; those of them that have their other side up.
struct ClaimedStack {
  std::vector<Index> charts, mirrored;
};

// An object with a layout of its own: so many of the charts of the array `chart`, in the order of
// the list.
struct ClaimedObject {
  std::string name;
  Index charts = 0;
};

struct ClaimedOptions {
  std::optional<bool> seamless;        // the run kept the seams of its input's texture coordinates
  std::optional<std::string> handles;  // the file of what pulled at it, or empty
};

// What the start was made from; Other: names that no rule depends on.
enum class ClaimedStart { Tutte, Multiresolution, Input, Planar, Other };

struct Claims {
  std::optional<std::string> version, energy;
  std::optional<int> degree;    // >= 1
  std::optional<double> value;  // mean energy
  std::optional<BoundaryCondition> boundary;
  std::optional<ClaimedStart> init;
  std::optional<bool> seams, bijective;
  std::optional<bool> other_triangles;  // edges were flipped inside flat parts
  // False: a run was stopped before all charts had a map, and faces without one have no cells.
  std::optional<bool> complete;
  std::optional<Vector2> aligned;  // the direction, of length 1, that was turned to (1, 0)
  std::optional<ClaimedNormalization> normalized;
  std::optional<double> layout_scale;  // uv units per unit of the surface, positive
  std::optional<std::vector<ClaimedPin>> pins;
  std::optional<std::vector<Cone>> cones;  // vertices of the input, quarter turns >= 1
  // Edges of the input, by their vertices (>= 0), whose two sides may have other uv: each as often
  // as the cells make an edge there. Not in files that were written before there was --cuts auto.
  std::optional<std::vector<std::array<Index, 2>>> cuts;
  std::optional<std::vector<ClaimedStack>> stacks;
  std::optional<std::vector<ClaimedObject>> objects;
  std::optional<ClaimedOptions> options;
};

// text: the array's content, empty for a file without claims, which claims nothing. Throws
// Error(Unreadable) naming `file`, if not empty, and the claim: for text that is no JSON object or
// nests too deeply, and for claims of the wrong type, out of their range or not finite.
Claims parse_claims(const std::string& text, const std::string& file);
// For pictures, which judge nothing: text that parse_claims() refuses claims nothing.
Claims readable_claims(const std::string& text);

// Units of the surface per unit of uv; 1 where nothing is said of it.
double claimed_scale(const Claims& claims);

// What kept the layout where it is, as far as it says: pins or handles, or a boundary.
enum class Held { Nothing, Points, Boundary };
Held held_by(const Claims& claims);

// Returns whether the boundary of the start was Tutte's, which starts in many resolutions have,
// too. Files that do not say are of the time when all were.
bool starts_at_tutte_boundary(const Claims& claims);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
