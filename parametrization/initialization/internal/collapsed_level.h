// A level of a multiresolution start: the surface that a CollapsingMesh has left, or a part of it,
// numbered without gaps.
//
//     const CollapsedLevel level(mesh, positions, flags);
//     const auto [problem, start] = level.problem(options, descent, flags, stop);
//     level.put(problem.expand(minimum), uv);
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/maps/map_options.h"
#include "majorant/parametrization/initialization/internal/vertex_descent.h"

namespace majorant {

struct CollapsedLevel {
  // positions: #V by 3. around: flags by vertex of the whole surface; the level has the faces with
  // a flagged corner.
  CollapsedLevel(const CollapsingMesh& mesh, const Points3& positions,
                 const std::vector<char>& around);

  // file: for messages.
  SurfaceMesh surface(const std::string& file) const;
  // Returns the map of the level, u, v per vertex, and takes it over into that of the whole
  // surface.
  Vec places(const VertexDescent& descent) const;
  void put(const Vec& x, Vec& uv) const;
  // Returns the weight of each face of the level; empty if options.face_weight is.
  Vec weights(const MapOptions& options, const VertexDescent& descent) const;
  // Returns the problem of the level, in which only the flagged vertices of the surface move, and
  // its start.
  std::pair<Problem, Vec> problem(const MapOptions& options, const VertexDescent& descent,
                                  const std::vector<char>& moves, const StopCheck& stop) const;

  Cells faces;
  std::vector<Index> vertex, face;  // of the whole surface
  Points3 positions;
};

// Returns weights of vertices after the first `gone` collapses: the mean weight of the faces around
// a vertex and around all vertices that collapsed onto it. face_weight: by face of the surface.
Vec collapsed_weights(const SurfaceMesh& surface, const Vec& face_weight,
                      const CollapsingMesh& mesh, Index gone);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
