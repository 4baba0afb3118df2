// Quads on a surface whose vertices move one at a time, with the effects on the surrounding quads.
//
//   MovableQuads quads(polygons, *mesh, held);
//   for (std::size_t v = 0; v < quads.vertex_count(); ++v)
//     if (!quads.is_on_border(v)) quads.move_towards(v, quads.middle(v));
//
// The quality of a vertex is the least sine of the corners of its quads,
//     min_{q around v} min_k (along_k x back_k) . n_q,   n_q = (c - a) x (d - b),
// for vectors of unit length. Vertices of the border and of features slide along these.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "majorant/mesh/nearest_point.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/surface_below.h"

namespace majorant {

// The vertices of quads on the border or on features.
struct HeldVertices {
  std::vector<BorderPoint> points;  // by vertex of the quads
  std::vector<char> is_feature;     // see BorderLengths
  // Edges of quads along features, in the direction of feature_lines().
  std::vector<std::array<Index, 2>> feature_edges;
  double border_turn = kCornerTurn;  // angle of its corners
};

class MovableQuads {
 public:
  // The sine above which a corner is good: 30 degrees.
  static constexpr double kGood = 0.5;

  // The arguments must outlive this. mesh: a manifold of quads.
  MovableQuads(PolygonMesh& mesh, const SurfaceMesh& surface, const HeldVertices& held);

  const PolygonMesh& mesh() const { return mesh_; }
  std::size_t vertex_count() const { return quads_.size(); }
  Index quad_count() const { return static_cast<Index>(mesh_.polygons.size()); }
  const std::vector<Index>& around(std::size_t v) const { return quads_[v]; }
  const std::vector<BorderPoint>& border() const { return border_; }
  const BorderLengths& lengths() const { return lengths_; }
  bool has_features() const { return has_features_; }
  bool is_on_border(std::size_t v) const { return border_[v].half_edge >= 0; }
  // Returns whether a vertex is on the border or on a feature, and not a corner.
  bool slides(std::size_t v) const { return sides_[v].slides; }

  void place(std::size_t v, const Vector3& p) { mesh_.positions[v] = p; }
  void place_on_border(std::size_t v, const BorderPoint& point);
  void restore(std::size_t v, const Vector3& p, const BorderPoint& point) {
    mesh_.positions[v] = p;
    border_[v] = point;
  }
  void restore(const std::vector<Vector3>& positions, const std::vector<BorderPoint>& border);

  // Returns the lengths along its line from a vertex to the previous one and to the next one.
  std::array<double, 2> room_of(std::size_t v) const;

  // Slides a vertex by a length along its line, unless a corner gets worse. Returns whether it
  // moved.
  bool slide(std::size_t v, double by);

  std::array<Vector3, 4> corners_of(Index q) const;

  static Vector3 normal_of(const std::array<Vector3, 4>& p);

  // Returns whether the quad is turned, like check_quads(), but without testing the corners of
  // quads whose centroid is right.
  bool is_turned(Index q);

  // Returns the number of turned quads around a vertex, now and when they were last recorded.
  int turned_around(std::size_t v);

  int known_turned_around(std::size_t v) const;

  // Returns whether no more quads around a vertex are turned than recorded. If so, records the
  // current ones.
  bool turns_no_more(std::size_t v);

  void note_turned(std::size_t v);

  // Returns the least sine of a corner of the quads around a vertex, relative to their normals.
  double worst(std::size_t v) const;

  // Returns the mean of the neighbours of a vertex.
  Vector3 middle(std::size_t v) const;

  // Returns the point of the surface nearest to p.
  Vector3 on_surface(std::size_t v, const Vector3& p);

  // Moves a vertex towards the goal, as far as no corner gets worse. Returns whether it moved.
  bool move_towards(std::size_t v, const Vector3& goal);

  // Records whether a quad is turned.
  void note_turned_quad(Index q) { is_turned_[q] = is_turned(q); }

  // These return the face of the surface below a quad's centroid, and below a vertex.
  Index face_below_quad(Index q);
  Index face_below_vertex(std::size_t v);
  Index face_near(std::size_t v, const Vector3& p) const {
    return surface_.tree().nearest(p, likely_[v]).face;
  }
  // Returns the face that on_surface() found last for a vertex.
  Index last_face(std::size_t v) const { return likely_[v]; }

  Vector3 normal_below(Index face) const;

  static double sine_at(const std::array<Vector3, 4>& p, std::size_t k, const Vector3& n);

 private:
  struct OnBorder {
    Index before = -1, after = -1;  // vertices
    bool slides = false;
  };

  // Finds the vertices that may slide, and their neighbours.
  void find_sliding(const SurfaceMesh& surface, const HeldVertices& held);

  PolygonMesh& mesh_;
  const SurfaceMesh& surface_mesh_;
  const SurfaceBelow surface_;
  const bool has_features_;
  const BorderLengths lengths_;
  std::vector<BorderPoint> border_;        // by vertex
  std::vector<OnBorder> sides_;            // by vertex
  std::vector<std::vector<Index>> quads_;  // by vertex
  std::vector<Index> likely_, below_;      // faces of the surface by vertex and by quad
  std::vector<char> is_turned_;            // by quad
  std::vector<char> turned_now_;           // of the quads around the vertex that was moved last
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
