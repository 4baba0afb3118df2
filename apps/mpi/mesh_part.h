// The part of a surface on one rank, and what it shares with other ranks.
//
//     const MeshPart part = distributed(mesh, ranks);        // mesh: rank 0's, null elsewhere
//     part.mesh->face_count();                               // of this rank, may be 0
//     part.unknowns(*space);                                 // MapPart: of a space over its faces
//
// Rank 0 cuts the surface along the borders between parts and sends each rank its faces. A vertex
// that joins faces of one rank only at a point has several copies there. Vertices, and nodes inside
// edges, belong to the lowest rank that has them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/partition.h"
#include "majorant/maps/map_part.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

class MeshPart final : public MapPart {
 public:
  struct Border {
    int rank;
    std::vector<Index> owned, copies;  // vertices, see Partition::Neighbour
    std::vector<Index> half_edges;     // of this rank's faces, in the same order on both sides
  };
  struct Whole {
    GlobalIndex vertices = 0, edges = 0, faces = 0;
  };

  const Ranks& ranks() const override { return *shared_ranks; }
  std::shared_ptr<const Partition> unknowns(const BezierTriangleSpace& space) const override;
  std::vector<Index> boundary_nodes(const BezierTriangleSpace& space) const override;
  std::vector<Index> gauge_vertex() const override;
  std::string obstacle(const BezierMap& map, const Vec& rest_det, int depth) const override;
  MapMeasures measure(const BezierMap& map, const EnergySum& energy,
                      std::string& unproven) const override;
  // Returns the partition of one unknown for each vertex. Collective.
  Partition vertices() const;

  std::shared_ptr<const Ranks> shared_ranks;
  std::shared_ptr<const SurfaceMesh> mesh;  // with input_vertex() and input_face() of the file
  std::vector<Index> vertex, face;          // their numbers in the whole surface
  std::vector<Border> borders;              // by rank; one of them has this rank's own copies
  std::vector<Index> boundary_vertices;     // boundary vertices of the whole surface that are here
  std::vector<Index> boundary_half_edges;
  Whole whole;
};

// Returns the rank of each face: connected parts of similar size with short borders, by PTScotch.
// Called on rank 0 only.
std::vector<int> face_ranks(const SurfaceMesh& mesh, int count);

// Collective; mesh and rank_of_face are used on rank 0.
MeshPart distributed(const SurfaceMesh* mesh, const std::vector<int>& rank_of_face,
                     std::shared_ptr<const Ranks> ranks);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
