#include "majorant/elements/exact_determinant.h"

#include <fmt/format.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <memory>

#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/framework/exact_integers.h"

namespace majorant {
namespace {

struct TriangleTables {
  explicit TriangleTables(const BernsteinElement& of)
      : element(of), det(element), subdivision(det.basis(), element.bisections) {}

  BernsteinElement element;
  DetCoefficients det;
  Subdivision subdivision;
};

const TriangleTables& tables_of_degree(int degree) {
  static const std::vector<std::unique_ptr<const TriangleTables>> kAll = [] {
    std::vector<std::unique_ptr<const TriangleTables>> all;
    Cells face(1, 3);
    face << 0, 1, 2;
    for (int n = 1; n <= BezierTriangleSpace::kMaxDegree; ++n)
      all.push_back(std::make_unique<TriangleTables>(BezierTriangleSpace(face, 3, n).element()));
    return all;
  }();
  return *kAll[to_size(degree - 1)];
}

}  // namespace

DeterminantRange exact_determinant_of_triangle(const Points2& control_points,
                                               const StopCheck& stop) {
  using Integer = boost::multiprecision::cpp_int;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int degree = degree_from_control_points(static_cast<int>(control_points.rows()));
  if (degree < 1 || degree > BezierTriangleSpace::kMaxDegree)
    throw InvalidArgument(
        fmt::format("exact_determinant_of_triangle: {} control points; a triangle of degree 1 to "
                    "{} is needed",
                    control_points.rows(), BezierTriangleSpace::kMaxDegree));
  if (!control_points.allFinite())
    return {ProofStatus::Undecided, -kInfinity, kInfinity, -kInfinity, kInfinity, {}};
  const TriangleTables& tables = tables_of_degree(degree);
  using Search = ExactDeterminant<Integer>;
  return Search({tables.element, tables.det, tables.subdivision}, Search::Bounds::None, stop)
      .find({to_integers<Integer>(control_points.reshaped<Eigen::RowMajor>()), 1});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
