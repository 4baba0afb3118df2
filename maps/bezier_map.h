// The result: a continuous piecewise polynomial map of a surface onto the plane.
//
//   Vector2 uv = map.evaluate(12, {0.2, 0.3, 0.5});
//   auto [Sigma, sigma] = map.singular_values(12, {1, 0, 0});   // sigma < 0 where it flips
//
// Immutable and cheap to copy. Positions and uv are in model units. A map of a cut surface may know
// its seams: its mesh is the cut surface then.
//
// Not for files, which may be torn or inconsistent: MapFile (map_file.h) holds these.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/mesh/seams.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

class BezierMap {
 public:
  // control_points: u, v per node of `space`, a space over the faces of `mesh`. seams: null, or
  // those of `mesh`. Throws InvalidArgument for null pointers and sizes that do not fit.
  BezierMap(std::shared_ptr<const SurfaceMesh> mesh,
            std::shared_ptr<const BezierTriangleSpace> space, Vec control_points,
            std::shared_ptr<const Seams> seams = nullptr);
  // The piecewise linear map with these uv per vertex of the mesh.
  static BezierMap linear(std::shared_ptr<const SurfaceMesh> mesh, Vec uv,
                          std::shared_ptr<const Seams> seams = nullptr);
  // The map of the same surface, with the same seams, that has these control points.
  BezierMap with(std::shared_ptr<const BezierTriangleSpace> space, Vec control_points) const;

  const SurfaceMesh& mesh() const { return *mesh_; }
  const BezierTriangleSpace& space() const { return *space_; }
  const std::shared_ptr<const SurfaceMesh>& shared_mesh() const { return mesh_; }
  const std::shared_ptr<const BezierTriangleSpace>& shared_space() const { return space_; }
  const std::shared_ptr<const Seams>& shared_seams() const { return seams_; }
  const Seams& seams() const { return *seams_; }  // empty where the surface is not cut
  const Vec& control_points() const { return *x_; }
  // The same as rows, u and v of every node: #N by 2, a view that lives as long as the map.
  Eigen::Map<const Points2> control_uv() const { return {x_->data(), x_->size() / 2, 2}; }
  // uv of the corners of the faces, row 3 face + corner: 3 #F by 2. What meshes with texture
  // coordinates have; where the surface is cut, the corners of a vertex differ.
  Points2 corner_uv() const;
  int degree() const { return space_->degree(); }

  // These throw InvalidArgument for a face that does not exist.
  Vector2 evaluate(Index face, const Barycentric& xi) const;
  // Derivative in the face's orthonormal frame of RestShapes (e0 = p0 - p2 along the first axis).
  Eigen::Matrix2d jacobian(Index face, const Barycentric& xi) const;
  // Signed: first >= |second|, product = det J.
  std::pair<double, double> singular_values(Index face, const Barycentric& xi) const;
  // uv at `points` on every face: (#F * #points) by 2, face by face.
  Points2 sample(const std::vector<Barycentric>& points) const;

  // The same map with one degree more.
  BezierMap elevated() const;
  // The piecewise linear interpolant on the K-fold subdivision: positions (#P by 3), uv (#P by 2),
  // triangles (#F K^2 by 3); points on shared edges are shared. K >= 1.
  struct Refinement {
    Points3 positions;
    Points2 uv;
    Cells triangles;
  };
  Refinement refine(int k) const;

 private:
  std::shared_ptr<const SurfaceMesh> mesh_;
  std::shared_ptr<const BezierTriangleSpace> space_;
  std::shared_ptr<const Seams> seams_;
  std::shared_ptr<const Vec> x_;
};

// A mesh of Bezier triangles in the plane that may change its triangulation: what edge flips and
// scaffolds work on.
//
// Every face keeps all its control points; points on an edge are kept by both of its faces and are
// equal, so the mesh is continuous. Problems are made from it by numbering shared points once
// (BezierTriangleSpace); this is the form for the time in between.

struct BezierMesh {
  int degree = 1;
  Cells faces;                  // #F by 3 vertices, counterclockwise
  std::vector<Index> opposite;  // 3 #F, as opposite_half_edges() has it
  RowMatrix
      points;  // #F by (n+1)(n+2): u, v of the control points in VTK's order (TriangleIndices)

  Index face_count() const { return static_cast<Index>(faces.rows()); }
  Vector2 point(Index face, int local) const { return points.row(face).segment<2>(2 * local); }
  Index from_vertex(Index half_edge) const { return majorant::from_vertex(faces, half_edge); }
  Index to_vertex(Index half_edge) const { return majorant::to_vertex(faces, half_edge); }
};

// faces: #F by 3, consistently oriented; cells: #F by nodes of a face, x: 2 numbers per node.
// Throws InvalidArgument when an edge has more than two faces.
BezierMesh bezier_mesh(int degree, const Cells& faces, const Cells& cells, VecIn x);

// Flips of edges that a criterion asked for, each time it was tried, and those that were done.
struct FlipCounts {
  long intended = 0, performed = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
