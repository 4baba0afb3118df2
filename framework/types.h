// The types that every layer shares: indices, vectors, matrices of rows.
//
//   const Points3 V = Points3::Zero(4, 3);         // a row a point
//   const Cells F = (Cells(2, 3) << 0, 1, 2, 0, 2, 3).finished();
//   const Vec x = Vec::Zero(2 * 4);                // unknowns, node by node
//   std::vector<double> area(to_size(static_cast<Index>(F.rows())));
//
// Not for sparse matrices: use a SparsePattern and its values (linear_solver.h).
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>

namespace majorant {

// The library's binaries and their users must agree on how Eigen allocates. The CMake target
// majorant::majorant defines both macros; without CMake, pass -DEIGEN_MAX_ALIGN_BYTES=16
// -DEIGEN_MALLOC_ALREADY_ALIGNED=1.
static_assert(EIGEN_MAX_ALIGN_BYTES == 16 && EIGEN_MALLOC_ALREADY_ALIGNED == 1,
              "compile with -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1");

using Index = int;  // sparse patterns, numbering; 32 bits on purpose
using Vec = Eigen::VectorXd;
using VecIn = Eigen::Ref<const Eigen::VectorXd>;
using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Barycentric = Eigen::Vector3d;  // of a point of a triangle, adding to 1
using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  // "#P by 2"
using Points3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  // "#P by 3"
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Cells = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Returns a non-negative Index as the position in a standard container: area[face]. Accepts only
// Index, since a longer integer would be truncated.
template <std::same_as<Index> I>
constexpr std::size_t to_size(I i) {
  return static_cast<std::size_t>(i);
}

// Returns twice the signed area of the triangle 0, a, b: positive if b is to the left of a.
inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
