// CGAL's constrained Delaunay triangulation with the members that constrained_delaunay.h documents.
//
//     CgalDelaunay delaunay;
//     delaunay.insert(std::vector<Vector2>{{0, 0}, {1, 0}, {1, 1}});
//
// For .cpp files that are compiled with -frounding-math only; not installed.
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <optional>
#include <utility>
#include <vector>

#include "majorant/mesh/incremental_delaunay.h"

namespace majorant {

class CgalDelaunay {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
      Kernel,
      CGAL::Triangulation_data_structure_2<
          CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>,
          CGAL::Triangulation_face_base_with_info_2<
              FaceMark, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>>,
      CGAL::No_constraint_intersection_tag>;
  using Vertex = Triangulation::Vertex_handle;

 public:
  using Face = Triangulation::Face_handle;

  CgalDelaunay() { triangulation_.infinite_vertex()->info() = -1; }
  // Not copyable, because CGAL's handles point into it.
  CgalDelaunay(const CgalDelaunay&) = delete;
  CgalDelaunay& operator=(const CgalDelaunay&) = delete;

  std::vector<Index> insert(const std::vector<Vector2>& points) {
    std::vector<std::pair<Triangulation::Point, Index>> numbered;
    const std::size_t first = points_.size();
    for (const Vector2& p : points) numbered.push_back({{p.x(), p.y()}, add(p)});
    triangulation_.insert(numbered.begin(), numbered.end());
    for (const Vertex v : triangulation_.finite_vertex_handles()) vertices_[to_size(v->info())] = v;
    std::vector<Index> numbers;
    for (std::size_t k = first; k < points_.size(); ++k) {
      if (vertices_[k] == Vertex()) vertices_[k] = triangulation_.insert(numbered[k - first].first);
      numbers.push_back(vertices_[k]->info());
    }
    return numbers;
  }
  Index insert(const Vector2& point) { return insert(point, recent_); }
  Index insert(const Vector2& point, Face in) {
    const Index number = add(point);
    const Index before = vertex_count();
    const Vertex v = triangulation_.insert({point.x(), point.y()}, in);
    if (vertex_count() > before) v->info() = number;
    vertices_[to_size(number)] = v;
    recent_ = v->face();
    return v->info();
  }
  bool insert_constraint(Index a, Index b) {
    try {
      triangulation_.insert_constraint(vertices_[to_size(a)], vertices_[to_size(b)]);
      recent_ = vertices_[to_size(b)]->face();
      return true;
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      recent_ = vertices_[to_size(b)]->face();
      return false;
    }
  }

  Index vertex_count() const { return static_cast<Index>(triangulation_.number_of_vertices()); }
  bool is_flat() const { return triangulation_.dimension() < 2; }
  const Vector2& point(Index vertex) const { return points_[to_size(vertex)]; }
  std::optional<std::pair<Face, int>> find_edge(Index a, Index b) const {
    Face face;
    int opposite = 0;
    const Vertex from = vertices_[to_size(a)];
    if (!triangulation_.is_edge(from, vertices_[to_size(b)], face, opposite)) return {};
    if (face->vertex(Triangulation::ccw(opposite)) == from) return std::pair(face, opposite);
    const Face other = face->neighbor(opposite);
    return std::pair(other, other->index(face));
  }

  std::vector<Face> finite_faces() const {
    std::vector<Face> faces;
    for (const Face face : triangulation_.finite_face_handles()) faces.push_back(face);
    return faces;
  }
  Face infinite_face() const { return triangulation_.infinite_face(); }
  std::vector<Face> faces_around(Index vertex) const {
    std::vector<Face> faces;
    auto around = triangulation_.incident_faces(vertices_[to_size(vertex)]);
    const auto end = around;
    do faces.push_back(around);
    while (++around != end);
    return faces;
  }
  bool is_finite(Face f) const { return !triangulation_.is_infinite(f); }
  Index vertex(Face f, int i) const { return f->vertex(i)->info(); }
  Face neighbor(Face f, int i) const { return f->neighbor(i); }
  bool is_constrained(Face f, int i) const { return f->is_constrained(i); }
  FaceMark& mark(Face f) { return f->info(); }
  const FaceMark& mark(Face f) const { return f->info(); }

 private:
  Index add(const Vector2& point) {
    points_.push_back(point);
    vertices_.emplace_back();
    return static_cast<Index>(points_.size()) - 1;
  }

  Triangulation triangulation_;
  std::vector<Vector2> points_;
  std::vector<Vertex> vertices_;  // by number
  Face recent_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
