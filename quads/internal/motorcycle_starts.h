// The motorcycles of a seamless map at their starts: lines along the axes from all cones and
// corners. Borders and features are complete lines.
//
//   MotorcycleStarts starts = motorcycle_starts(lattice);
//   std::cout << starts.motorcycles.size() << " lines\n";
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "majorant/quads/internal/seamless_lattice.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// Throws Error(Infeasible).
[[noreturn]] void refuse_lines(const std::string& problem);

// Thrown if a line passes through this vertex, so that it has no left and right side there.
struct VertexInTheWay {
  Index vertex;
};

// A line while it grows, or a line of the border or of a feature.
struct Motorcycle {
  Index cone;                 // the vertex that it starts from
  int order;                  // counterclockwise number among the lines that leave the cone
  std::vector<LineLeg> legs;  // the last one is unfinished
  bool has_ended = false;
  std::int64_t length = 0;  // set when it has ended
  Index on = -1;            // the line on which it ended, at `on_distance`
  std::int64_t on_distance = 0;
  int on_quarter = 0;  // direction of its way back, in quarter turns from that line
  Index met = -1;      // the line that it met head-on; both are one line, from cone to cone
  Side side = Side::Inside;
  // For the border and features: the vertex at the end, and the line's order there.
  Index end_vertex = -1;
  int end_order = 0;
  Index first_edge = -1, last_edge = -1;  // half-edges
};

// A leg of a motorcycle in the list of its face.
struct Passage {
  Index motorcycle, leg;
};

struct MotorcycleStarts {
  std::vector<Motorcycle> motorcycles;
  std::vector<char> is_start;  // by vertex: cones and corners
  std::vector<Passage> held;   // by half-edge of the border and of features, both sides
};

// Throws VertexInTheWay; Error(Infeasible) if a line would leave along an edge between two starts.
MotorcycleStarts motorcycle_starts(const SeamlessLattice& lattice);

// Throws VertexInTheWay, or Error(Infeasible) if the vertex is a start, which cannot be moved.
[[noreturn]] void refuse_vertex(const SeamlessLattice& lattice, const std::vector<char>& is_start,
                                Index vertex);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
