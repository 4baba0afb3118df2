// The triangulated space around the image of a map. As long as all triangles of the map and of the
// scaffold stay positively oriented, the image cannot overlap. [MC20] Sec. 6, method.md N10.
//
//   Scaffold scaffold(space, x);              // around a piecewise linear image
//   Vec joint = scaffold.joined(x);           // x, then the scaffold's own nodes
//   scaffold.take(joint);                     // after a step on it, certified on both spaces
//   scaffold.flip();                          // keeps it in good shape
//   scaffold.relax(2, 5);
//
// Scaffold triangles are Bezier triangles of the map's degree and share its boundary control
// points; the outer frame is straight and stays fixed. Map and scaffold together fill the convex
// frame without folds: a homeomorphism.
#pragma once

#include <memory>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/parametrization/scaffold/internal/edge_flip.h"

namespace majorant {

class Scaffold {
 public:
  // x: 2 numbers per node of `image`, whose boundary edges are straight. Throws Error(Infeasible)
  // if the image's boundary meets itself.
  Scaffold(std::shared_ptr<const BezierTriangleSpace> image, VecIn x);

  const BezierMesh& mesh() const { return mesh_; }
  Index face_count() const { return mesh_.face_count(); }
  // Returns the scaffold's faces in the joint numbering: nodes of the image keep their numbers,
  // followed by the scaffold's own nodes.
  const std::shared_ptr<const BezierTriangleSpace>& space() const { return space_; }
  Index joint_node_count() const { return joint_node_count_; }
  const std::vector<Index>& frame_nodes() const { return frame_nodes_; }  // joint

  // Returns rest shapes: a unit equilateral triangle for every face.
  RestShapes rest() const;
  // Returns E_conf of the triangles, on rules that get finer. levels() holds the rule of each face.
  // refine() gives finer rules to faces that block a step, since their rule does not sample the
  // small det J.
  std::shared_ptr<const DensityTerm> energy_term() const;
  const std::vector<RuleId>& levels() const { return levels_; }
  void refine(const std::vector<Index>& faces);

  Vec joined(VecIn image) const;
  void take(VecIn joint);

  // Flips edges until the corner points are locally Delaunay. If the result has performed > 0,
  // nodes are renumbered and space() and the other accessors return new objects; likewise for
  // grow().
  FlipCounts flip();
  // Takes Newton steps on the shape of the scaffold with image and frame fixed, fewer if
  // options.stop says so. depth: of the certificates.
  void relax(int steps, int depth, const NewtonOptions& options = newton_of_maps());
  // Encloses the frame in a larger one if the image comes close to it. Returns whether it did.
  bool grow();
  // Returns a scaffold around the same image in a space of one degree more.
  Scaffold elevated(std::shared_ptr<const BezierTriangleSpace> image) const;

 private:
  Scaffold() = default;
  void number();
  void number_flipped();
  void number_jointly();
  Cells own_faces() const;
  Points2 frame_points() const;
  std::shared_ptr<const DensityTerm> term_on(std::shared_ptr<const BezierTriangleSpace>) const;

  std::shared_ptr<const BezierTriangleSpace> image_, space_;
  std::shared_ptr<const BezierTriangleSpace> own_;  // the scaffold alone, numbered by itself
  std::vector<Index> own_vertex_, joint_node_;      // by vertex; by node of own_
  BezierMesh mesh_;                 // vertices: those of the image, then the scaffold's own
  std::vector<Index> image_sides_;  // half-edges of the image's boundary
  std::vector<Index> frame_;        // vertices of the frame, counterclockwise
  std::vector<Index> frame_nodes_;
  std::vector<RuleId> levels_;  // by face
  Index joint_node_count_ = 0;
};

// A checker of the local injectivity of a map and the scaffold around it. Blocking elements: faces
// of the map, then those of the scaffold.
class ScaffoldInjectivity final : public FeasibilityChecker {
 public:
  ScaffoldInjectivity(std::shared_ptr<const LocalInjectivity> image, Index image_faces,
                      std::shared_ptr<const LocalInjectivity> scaffold);
  std::string_view name() const override { return "injectivity of image and scaffold"; }
  Verdict check(VecIn x) const override;
  StepBound max_step(VecIn x, VecIn d, double s) const override;

 private:
  std::shared_ptr<const LocalInjectivity> image_, scaffold_;
  Index image_faces_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
