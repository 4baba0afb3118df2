// JSON files about vertices: pins and handles (their targets), cones (the angles around them),
// seams (edges along which to cut).
//
//     {"handles": [{"vertex": 12, "target": [0.1, 0.2]}, {"vertex": 3, "target": "initial"}]}
//     {"cones": [{"vertex": 12, "quarter_turns": 3}, {"vertex": 3, "index": -0.25}]}
//     {"edges": [[12, 13], [13, 40]]}
//
// Vertices count from 0; "index_base": 1 at the top makes them count from 1. Other keys are
// comments. Weights of faces are a text file: numbers separated by space or line ends, with
// comments from `#` on.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/seams.h"

namespace majorant {

struct Handle {
  Index vertex = 0;               // 0-based, whatever the file's base
  std::optional<Vector2> target;  // uv units; none for "initial", the place in the initial map
};

// Returns the handles in the order of the file; a repeated handle with the same target counts once.
// Throws Error(Unreadable), naming the file and the handle or the place, for broken JSON, missing
// or malformed entries, numbers that are not finite, vertices outside 0 .. vertex_count - 1, and
// two targets for one vertex. All functions here throw Stopped, also while a FIFO has no writer.
std::vector<Handle> read_handles(const std::string& path, Index vertex_count,
                                 const StopCheck& stop = {});

// Returns the cones in the order of the file; quarter turns = 4 - 4 index, at least 1. Throws the
// same errors.
std::vector<Cone> read_cones(const std::string& path, Index vertex_count,
                             const StopCheck& stop = {});

// Returns the edges in the order of the file, counted from 0; they need not be in the mesh. Throws
// the same errors.
std::vector<std::array<Index, 2>> read_seams(const std::string& path, Index vertex_count,
                                             const StopCheck& stop = {});

// Returns face_count positive numbers, in the order of the mesh file's faces, each a usable weight
// (map_problem.h). Throws Error(Unreadable), naming the file and the line, for anything else.
Vec read_face_weights(const std::string& path, Index face_count, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
