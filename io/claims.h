// The claims of a result: the FieldData array majorant_claims of a .vtu, parsed once and strictly.
// They describe a map; `check` decides whether they are true.
//
//   const Claims claims = parse_claims(file.claims, "bunny.vtu");
//   if (claims.bijective.value_or(false)) ...
//
// All keys are optional, and null claims nothing. A given key must have the type and the range
// below; other keys are ignored.
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
  Index vertex = 0;  // vertex of the input, >= 0; may lie outside of the mapped part
  Vector2 target;    // uv, finite
};

// A normalization: uv in the file = (uv - origin) / size, after a possible rotation.
struct ClaimedNormalization {
  Vector2 origin;
  double size = 1;  // positive
};

// Charts (values of the array `chart`) that lie on each other, and those of them that are turned
// over.
struct ClaimedStack {
  std::vector<Index> charts, mirrored;
};

// An object with a layout of its own, and the number of its charts. Charts are numbered in the
// order of the objects.
struct ClaimedObject {
  std::string name;
  Index charts = 0;
};

struct ClaimedOptions {
  std::optional<bool> seamless;        // the seams of the input's texture coordinates were kept
  std::optional<std::string> handles;  // name of the handles' file; may be empty
};

// The method of the start. Other: names that no rule depends on.
enum class ClaimedStart { Tutte, Multiresolution, Input, Planar, Other };

struct Claims {
  std::optional<std::string> version, energy;
  std::optional<int> degree;    // >= 1
  std::optional<double> value;  // mean energy
  std::optional<BoundaryCondition> boundary;
  std::optional<ClaimedStart> init;
  std::optional<bool> seams, bijective;
  std::optional<bool> other_triangles;  // edges were flipped inside flat parts
  // False if a run was stopped before all charts had a map; faces without a map have no cells then.
  std::optional<bool> complete;
  std::optional<Vector2> aligned;  // unit vector that was turned to (1, 0)
  std::optional<ClaimedNormalization> normalized;
  std::optional<double> layout_scale;  // uv units per unit of the surface, positive
  std::optional<std::vector<ClaimedPin>> pins;
  std::optional<std::vector<Cone>> cones;  // vertices of the input; quarter turns >= 1
  // Edges of the input, by their vertices (>= 0), whose sides may have different uv, each as often
  // as the cells have an edge there. Older files do not have this claim.
  std::optional<std::vector<std::array<Index, 2>>> cuts;
  std::optional<std::vector<ClaimedStack>> stacks;
  std::optional<std::vector<ClaimedObject>> objects;
  std::optional<ClaimedOptions> options;
};

// Parses the content of the array; an empty text claims nothing. file: for messages, may be empty.
// Throws Error(Unreadable) naming the file and the claim, for text that is no JSON object or too
// deeply nested, and for claims of the wrong type, out of range or not finite.
Claims parse_claims(const std::string& text, const std::string& file);
// Returns the claims for pictures, which judge nothing: none for text that parse_claims() refuses.
Claims readable_claims(const std::string& text);

// Returns the units of the surface per unit of uv; 1 without a claim.
double claimed_scale(const Claims& claims);

// The part of the problem that held the layout in place, by its claims: nothing, pins or handles,
// or a boundary.
enum class Held { Nothing, Points, Boundary };
Held held_by(const Claims& claims);

// Returns whether the start had Tutte's boundary, which multiresolution starts also have. A file
// without the claim is an older one, whose start always had it.
bool starts_at_tutte_boundary(const Claims& claims);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
