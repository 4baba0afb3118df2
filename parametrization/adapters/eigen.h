// An adapter for plain matrices, as libigl and numpy users have them: V and F in, uv of the corners
// out. Matrices may have any scalar and index type and either storage order; they are copied.
// SurfaceMesh::from_arrays() makes fewer copies of row-major matrices of doubles and ints.
//
//   Eigen::MatrixXd V(4, 3);
//   V << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
//   const Eigen::MatrixXi F = (Eigen::MatrixXi(2, 3) << 0, 1, 2, 0, 2, 3).finished();
//   const ParametrizationResult result = parametrize(V, F);
//   if (result.map) std::cout << corner_uv(F, *result.map) << "\n";
//
// For meshes with defects, use polygons_of(V, F) and repair().
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "majorant/parametrization/adapters/corner_uv.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// Returns the mesh as polygons. positions: #V by 3. faces: #F by 3, or #F by k for polygons of k
// corners; vertices count from 0. Throws InvalidArgument if the sizes differ or a vertex index is
// out of range.
template <class V, class F>
PolygonMesh polygons_of(const Eigen::MatrixBase<V>& positions, const Eigen::MatrixBase<F>& faces) {
  if (positions.cols() != 3)
    throw InvalidArgument("positions have " + std::to_string(positions.cols()) +
                          " columns, 3 are needed");
  PolygonMesh out;
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    out.positions.push_back(positions.row(v).transpose().template cast<double>());
  std::vector<Index> polygon;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    polygon.clear();
    for (Eigen::Index k = 0; k < faces.cols(); ++k) {
      const auto v = faces(f, k);
      if (std::cmp_less(v, 0) || std::cmp_greater_equal(v, positions.rows()))
        throw InvalidArgument("face " + std::to_string(f) + " has vertex " + std::to_string(v) +
                              ", there are " + std::to_string(positions.rows()));
      polygon.push_back(static_cast<Index>(v));
    }
    out.polygons.push_back(polygon);
  }
  return out;
}

// Parametrizes the mesh as parametrize() does a SurfaceMesh. Pins and handles refer to vertices of
// the SurfaceMesh; these are the rows of V if faces use all of them.
template <class V, class F>
ParametrizationResult parametrize(const Eigen::MatrixBase<V>& positions,
                                  const Eigen::MatrixBase<F>& faces,
                                  const ParametrizationOptions& options = {}) {
  return parametrize(std::make_shared<const SurfaceMesh>(
                         SurfaceMesh::from_polygons(polygons_of(positions, faces))),
                     options);
}

// Returns uv of corner k of face f in row F.cols() f + k. Throws the errors of corner_uv() of
// polygons.
template <class F>
Points2 corner_uv(const Eigen::MatrixBase<F>& faces, const BezierMap& map) {
  PolygonMesh polygons;
  std::vector<Index> polygon;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    polygon.clear();
    for (Eigen::Index k = 0; k < faces.cols(); ++k)
      polygon.push_back(static_cast<Index>(faces(f, k)));
    polygons.polygons.push_back(polygon);
  }
  Points2 out(faces.size(), 2);
  Eigen::Index row = 0;
  for (const auto& corners : corner_uv(polygons, map))
    for (const Vector2& uv : corners) out.row(row++) = uv;
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
