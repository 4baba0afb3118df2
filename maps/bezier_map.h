// A continuous piecewise polynomial map of a surface onto the plane, the result of parametrize().
//
//   Vector2 uv = map.evaluate(12, {0.2, 0.3, 0.5});
//   auto [Sigma, sigma] = map.singular_values(12, {1, 0, 0});   // sigma < 0 where it flips
//
// Immutable and cheap to copy. Positions and uv are in model units. A map of a cut surface may
// store its seams; its mesh is then the cut surface.
//
// Files may be incomplete or inconsistent; MapFile (map_file.h) holds their maps.
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
  // Returns the piecewise linear map with these uv per vertex of the mesh.
  static BezierMap linear(std::shared_ptr<const SurfaceMesh> mesh, Vec uv,
                          std::shared_ptr<const Seams> seams = nullptr);
  // Returns the map of the same surface, with the same seams, that has these control points.
  BezierMap with(std::shared_ptr<const BezierTriangleSpace> space, Vec control_points) const;

  const SurfaceMesh& mesh() const { return *mesh_; }
  const BezierTriangleSpace& space() const { return *space_; }
  const std::shared_ptr<const SurfaceMesh>& shared_mesh() const { return mesh_; }
  const std::shared_ptr<const BezierTriangleSpace>& shared_space() const { return space_; }
  const std::shared_ptr<const Seams>& shared_seams() const { return seams_; }
  const Seams& seams() const { return *seams_; }  // empty if the surface is not cut
  const Vec& control_points() const { return *x_; }
  // Returns the control points as rows, u and v of every node: #N by 2, a view that is valid as
  // long as the map.
  Eigen::Map<const Points2> control_uv() const { return {x_->data(), x_->size() / 2, 2}; }
  // Returns uv of the corners of the faces, row 3 face + corner: 3 #F by 2, as in meshes with
  // texture coordinates. On a cut surface the corners of a vertex may differ.
  Points2 corner_uv() const;
  int degree() const { return space_->degree(); }

  // The following members throw InvalidArgument for a face out of range.
  Vector2 evaluate(Index face, const Barycentric& xi) const;
  // Returns the derivative in the face's orthonormal frame of RestShapes (e0 = p0 - p2 along the
  // first axis).
  Eigen::Matrix2d jacobian(Index face, const Barycentric& xi) const;
  // Returns signed singular values: first >= |second|, product = det J.
  std::pair<double, double> singular_values(Index face, const Barycentric& xi) const;
  // Returns uv at `points` on every face: (#F * #points) by 2, face by face.
  Points2 sample(const std::vector<Barycentric>& points) const;

  // Returns the same map with one degree more.
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

// A mesh of Bezier triangles in the plane whose triangulation may change, for edge flips and
// scaffolds.
//
// Every face stores all its control points. Both faces of an edge store its points, with equal
// values, so the mesh is continuous. Problems number shared points once (BezierTriangleSpace); this
// form is used between problems.

struct BezierMesh {
  int degree = 1;
  Cells faces;                  // #F by 3 vertices, counterclockwise
  std::vector<Index> opposite;  // 3 #F, from opposite_half_edges()
  // #F by (n+1)(n+2): u, v of the control points in VTK's order (TriangleIndices).
  RowMatrix points;

  Index face_count() const { return static_cast<Index>(faces.rows()); }
  Vector2 point(Index face, int local) const { return points.row(face).segment<2>(2 * local); }
  Index from_vertex(Index half_edge) const { return majorant::from_vertex(faces, half_edge); }
  Index to_vertex(Index half_edge) const { return majorant::to_vertex(faces, half_edge); }
};

// Returns the mesh. faces: #F by 3, consistently oriented. cells: #F by nodes of a face. x: 2
// numbers per node. Throws InvalidArgument if an edge has more than two faces.
BezierMesh bezier_mesh(int degree, const Cells& faces, const Cells& cells, VecIn x);

// Numbers of flips: attempts at edges that a criterion selected, repeated ones included, and
// performed flips.
struct FlipCounts {
  long intended = 0, performed = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
