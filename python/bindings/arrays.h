// Conversions between numpy arrays and the library's matrices.
//
//     view(self, file.uv)          an array over the matrix, which lives as long as `self` does
//     moved(std::move(x))          an array that owns the matrix
//     matrix<Points2>(array)       a copy in the library's type
//
// Returned arrays are float64 or int32 in C order and never copies. Views are read-only, because
// several objects may share the matrix. Array arguments were checked and converted in Python
// (majorant/_arrays.py), where a message can name the argument.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style>;
using Integers = py::array_t<Index, py::array::c_style>;

// matrix: row-major or a vector, owned by the object `owner`.
template <class Matrix>
py::array array_over(py::handle owner, const Matrix& matrix) {
  static_assert(Matrix::IsRowMajor || Matrix::ColsAtCompileTime == 1);
  std::vector<py::ssize_t> shape{matrix.rows()};
  if (Matrix::ColsAtCompileTime != 1) shape.push_back(matrix.cols());
  return py::array_t<typename Matrix::Scalar, py::array::c_style>(shape, matrix.data(), owner);
}

template <class Matrix>
py::array view(py::handle owner, const Matrix& matrix) {
  py::array array = array_over(owner, matrix);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

template <class Matrix>
py::array moved(Matrix matrix) {
  auto kept = std::make_unique<Matrix>(std::move(matrix));
  const Matrix& here = *kept;
  const py::capsule owner(kept.get(), [](void* p) { delete static_cast<Matrix*>(p); });
  kept.release();
  return array_over(owner, here);
}

// array: of one or two dimensions; the columns of a fixed-size Matrix must fit.
template <class Matrix>
Matrix matrix(const py::array_t<typename Matrix::Scalar, py::array::c_style>& array) {
  const auto columns = array.ndim() > 1 ? array.shape(1) : 1;
  if (array.ndim() < 1 || array.ndim() > 2 ||
      (Matrix::ColsAtCompileTime != Eigen::Dynamic && Matrix::ColsAtCompileTime != columns))
    throw py::value_error("an array of another shape was expected");
  using RowMajor =
      Eigen::Matrix<typename Matrix::Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(array.data(), array.shape(0), columns);
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
