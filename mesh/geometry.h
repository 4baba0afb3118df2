// Lengths and angles of points and triangles in space, for models of any size: squared areas of
// meshes of size 1e100 exceed the range of doubles.
//
//   const Vector3 a(3e100, 0, 0), b(0, 4e100, 0);
//   const double area = 0.5 * length_of(a.cross(b));
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Equals norm(), bit for bit, wherever that does not overflow or underflow.
inline double length_of(const Vector3& v) {
  const double norm = v.norm();
  return std::isnormal(norm) ? norm : v.stableNorm();
}

// Returns the largest side of the bounding box; 0 without points. points: #P by dimension.
template <class Points>
double extent(const Eigen::MatrixBase<Points>& points) {
  if (points.rows() == 0) return 0;
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

// Returns the diagonal of the bounding box. points: #P by dimension, at least one.
template <class Points>
double diagonal(const Eigen::MatrixBase<Points>& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

// The sine and cosine of a corner of a triangle, times the lengths of its two edges; this sine is
// twice the area.
struct CornerAngle {
  double sine, cosine;
  double radians() const { return std::atan2(sine, cosine); }
};

// The angle at the corner where the half-edge starts.
inline CornerAngle corner_angle(const SurfaceMesh& mesh, Index half_edge) {
  const Vector3 p = mesh.positions().row(mesh.from_vertex(half_edge));
  const Vector3 a = mesh.positions().row(mesh.to_vertex(half_edge)).transpose() - p;
  const Vector3 b = mesh.positions().row(mesh.from_vertex(previous(half_edge))).transpose() - p;
  return {length_of(a.cross(b)), a.dot(b)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
