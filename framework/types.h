// The few types every layer shares.
#pragma once

#include <Eigen/Core>

namespace majorant {

// The library's binaries and their users must agree on how Eigen allocates. The CMake target
// majorant::majorant defines both; who links by hand has to: -DEIGEN_MAX_ALIGN_BYTES=16
// -DEIGEN_MALLOC_ALREADY_ALIGNED=0.
static_assert(EIGEN_MAX_ALIGN_BYTES == 16 && EIGEN_MALLOC_ALREADY_ALIGNED == 0,
              "compile with -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=0");

using Index = int;  // sparse patterns, numbering; 32 bits on purpose
using Vec = Eigen::VectorXd;
using VecIn = Eigen::Ref<const Eigen::VectorXd>;
using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  // "#P by 2"
using Points3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  // "#P by 3"
using Cells = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace majorant
