// The faces of a surface that one rank has, and what it shares with others.
//
//     const MeshPart part = distributed(mesh, ranks);        // mesh: rank 0's, null elsewhere
//     part.mesh->face_count();                               // of this rank, may be 0
//     part.unknowns(*space);                                 // MapPart: of a space over its faces
//
// Rank 0 cuts the surface along the borders between parts and sends each rank its faces. Where only
// a vertex joins the faces of one rank, it has the vertex several times, as copies of one. Vertices
// belong to the lowest rank that has them, nodes inside an edge likewise.
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
    std::vector<Index> owned, copies;  // vertices, as Partition::Neighbour has them
    std::vector<Index> half_edges;     // of this rank's faces; in the same order on both sides
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
  // The partition of one unknown per vertex. Collective.
  Partition vertices() const;

  std::shared_ptr<const Ranks> shared_ranks;
  std::shared_ptr<const SurfaceMesh> mesh;  // input_vertex() and input_face() of the file
  std::vector<Index> vertex, face;          // of the whole surface
  std::vector<Border> borders;              // by rank, this one's own copies among them
  std::vector<Index> boundary_vertices;     // of the whole surface's, here
  std::vector<Index> boundary_half_edges;
  Whole whole;
};

// Which rank each face goes to: connected parts of about one size with short borders, by PTScotch.
// Called by rank 0 alone.
std::vector<int> face_ranks(const SurfaceMesh& mesh, int count);

// Collective; mesh and rank_of_face are rank 0's.
MeshPart distributed(const SurfaceMesh* mesh, const std::vector<int>& rank_of_face,
                     std::shared_ptr<const Ranks> ranks);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
